// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/dimension.hpp"
#include "math/vector.hpp"
#include "model/element.hpp"

namespace engrane::output {

/// Histories of elements or nodes with the same channels: a group below /history with one table. It has a row per sample and a
/// column per channel of each owner; the channels of one owner are adjacent.
struct HistoryTable {
  std::string path;      ///< `element/GEAR`, `node/NODE` or `run`
  std::string type;      ///< name of the card, for elements
  std::vector<int> ids;  ///< of the owners; empty for `run`, which is one owner
  std::vector<Channel> channels;

  std::size_t owners() const { return ids.empty() ? 1 : ids.size(); }
  std::size_t columns() const { return owners() * channels.size(); }
  /// `element/7`, `node/4` or `run`.
  std::string owner(std::size_t index) const {
    return ids.empty() ? path : path.substr(0, path.find('/') + 1) + std::to_string(ids[index]);
  }
};

/// Representation of an element, or of a part of one, in the mesh: a point, a polyline or a cell.
struct Cell {
  std::vector<int> points;            ///< 0-based indices into ResultsLayout::points
  int element = 0;                    ///< id
  CellShape shape = CellShape::none;  ///< for cells of a mesh; none: the points form a polyline
};

/// A field over the cells or the points with any number of components (nodal fields have three global ones).
struct CellField {
  Named named;
  std::vector<std::string> components;  ///< empty for a scalar

  std::size_t width() const { return components.empty() ? 1 : components.size(); }
};

/// A field with several values per element, one at each of its nodes or integration points. The CellField of the same name
/// holds their mean.
struct PointField {
  CellField field;
  std::vector<int> elements;  ///< element id of each value
  std::vector<int> points;    ///< number of each value within its element, from 0
  std::size_t count = 0;      ///< number of values, once the two lists have been freed

  std::size_t rows() const { return elements.empty() ? count : elements.size(); }
  /// Frees the two lists, which are not needed once they are in a file.
  void forget() {
    count = rows();
    std::vector<int>().swap(elements);
    std::vector<int>().swap(points);
  }
};

/// Everything about a result file that is known before the first step (docs/format.md).
struct ResultsLayout {
  std::string title;
  std::string analysis;   ///< STATIC, KINEMATIC or DYNAMIC
  std::string deck_text;  ///< canonical, with defaults filled in
  std::string model_json;
  std::string version;    ///< of the program: `0.1.0`
  std::string libraries;  ///< names and versions in one line
  UnitSystem units;
  /// Ids of all nodes, then those of the copies of nodes where several sections of cells meet.
  std::vector<int> node_ids;
  std::vector<Vec3> points;  ///< reference positions of all of these
  std::vector<Cell> cells;
  std::vector<Named> node_fields;  ///< three global components each
  std::vector<CellField> cell_fields;
  std::vector<PointField> point_fields;
  std::vector<CellField> averages;  ///< at `points`, averaged over the adjacent cells
  std::vector<HistoryTable> history;
  std::size_t expected_samples = 1024;  ///< approximate; determines the chunk size of the tables

  /// Number of values per sample: columns of all tables.
  std::size_t channel_count() const {
    std::size_t n = 0;
    for (const HistoryTable& table : history) n += table.columns();
    return n;
  }
};

/// The fields of a frame.
struct FrameValues {
  /// For each of ResultsLayout::node_fields: a row of three global components per entry of ResultsLayout::points.
  std::vector<std::vector<double>> nodes;
  /// For each of ResultsLayout::cell_fields: a row of CellField::width() per entry of ResultsLayout::cells.
  std::vector<std::vector<double>> cells = {};
  /// For each of ResultsLayout::point_fields: a row of CellField::width() per entry of PointField::elements.
  std::vector<std::vector<double>> points = {};
  /// For each of ResultsLayout::averages: a row of CellField::width() per entry of ResultsLayout::points.
  std::vector<std::vector<double>> averages = {};
};

/// A mode of linearised buckling.
struct ModeShape {
  double load_time = 0;
  /// A row of three global components per entry of ResultsLayout::points.
  std::vector<double> displacement, rotation;
};

/// A line of `/checks` and of the listing: a `.CHK` record and its outcome.
struct CheckResult {
  std::string text;  ///< title of the check: `ELEMENT 1 NORMAL_FORCE at 1`
  double value = 0;  ///< computed; NaN if the run never got there
  double expected = 0;
  double tolerance = 0;  ///< largest allowed |value - expected|
  bool passed = false;
  std::string reference;  ///< source of `expected`
  std::string remark;     ///< reason for a failure that the value does not show: "the run ended at t = 0.4"
};

}  // namespace engrane::output
