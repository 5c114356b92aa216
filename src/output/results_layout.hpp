// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/dimension.hpp"
#include "math/vector.hpp"
#include "model/element.hpp"

namespace engrane::output {

/// Histories of elements or nodes that have the same channels: a group below /history with one table, a row for each sample and
/// a column for each channel of each owner. The channels of one owner stand side by side.
struct HistoryTable {
  std::string path;      ///< `element/GEAR`, `node/NODE` or `run`
  std::string type;      ///< of elements: the card's name
  std::vector<int> ids;  ///< of the owners; empty for `run`, which is one owner
  std::vector<Channel> channels;

  std::size_t owners() const { return ids.empty() ? 1 : ids.size(); }
  std::size_t columns() const { return owners() * channels.size(); }
  /// `element/7`, `node/4` or `run`.
  std::string owner(std::size_t index) const {
    return ids.empty() ? path : path.substr(0, path.find('/') + 1) + std::to_string(ids[index]);
  }
};

/// What stands for (a part of) an element in the mesh: a point, a polyline, or a cell.
struct Cell {
  std::vector<int> points;            ///< 0-based places in ResultsLayout::points
  int element = 0;                    ///< id
  CellShape shape = CellShape::none;  ///< of a cell of a mesh; none: the points stand on a line
};

/// A field with any components, beside those over the nodes with three global ones: over the cells, or over the points.
struct CellField {
  Named named;
  std::vector<std::string> components;  ///< none: a scalar

  std::size_t width() const { return components.empty() ? 1 : components.size(); }
};

/// A field with several values in an element, one at each of its nodes or integration points. Beside it stands the CellField of
/// the same name, with their mean.
struct PointField {
  CellField field;
  std::vector<int> elements;  ///< id of the element that each value belongs to
  std::vector<int> points;    ///< and its number in that element, from 0
  std::size_t count = 0;      ///< of values, where the two lists are forgotten

  std::size_t rows() const { return elements.empty() ? count : elements.size(); }
  /// Once a file has the two lists they need not be kept.
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
  std::string deck_text;  ///< canonical, defaults filled in
  std::string model_json;
  std::string version;    ///< of the program: `0.1.0`
  std::string libraries;  ///< names and versions in one line
  UnitSystem units;
  /// Ids of all nodes, then those of nodes that are points once more because several sections of cells meet there.
  std::vector<int> node_ids;
  std::vector<Vec3> points;  ///< reference positions of all of these
  std::vector<Cell> cells;
  std::vector<Named> node_fields;  ///< three global components each
  std::vector<CellField> cell_fields;
  std::vector<PointField> point_fields;
  std::vector<CellField> averages;  ///< at `points`, averaged over the cells there
  std::vector<HistoryTable> history;
  std::size_t expected_samples = 1024;  ///< about how many there will be: tables are laid out for so many rows at a time

  /// Columns of all tables together: how many values a sample has.
  std::size_t channel_count() const {
    std::size_t n = 0;
    for (const HistoryTable& table : history) n += table.columns();
    return n;
  }
};

/// The fields of a frame.
struct FrameValues {
  /// Those of ResultsLayout::node_fields: a row of three global components for each of ResultsLayout::points.
  std::vector<std::vector<double>> nodes;
  /// Those of ResultsLayout::cell_fields: a row of CellField::width() for each of ResultsLayout::cells.
  std::vector<std::vector<double>> cells = {};
  /// Those of ResultsLayout::point_fields: a row of CellField::width() for each of PointField::elements.
  std::vector<std::vector<double>> points = {};
  /// Those of ResultsLayout::averages: a row of CellField::width() for each of ResultsLayout::points.
  std::vector<std::vector<double>> averages = {};
};

/// A mode of linearised buckling.
struct ModeShape {
  double load_time = 0;
  /// A row of three global components for each of ResultsLayout::points.
  std::vector<double> displacement, rotation;
};

/// A line of `/checks` and of the listing: a `.CHK` and what came of it.
struct CheckResult {
  std::string text;  ///< what was checked: `ELEMENT 1 NORMAL_FORCE at 1`
  double value = 0;  ///< computed; not a number when the run never got there
  double expected = 0;
  double tolerance = 0;  ///< largest allowed |value - expected|
  bool passed = false;
  std::string reference;  ///< where `expected` comes from
  std::string remark;     ///< why it failed when no value says so: "the run ended at t = 0.4"
};

}  // namespace engrane::output
