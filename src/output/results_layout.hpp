// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/dimension.hpp"
#include "math/vector.hpp"
#include "model/element.hpp"

namespace engrane::output {

/// Histories of one owner: a group below /history.
struct ChannelGroup {
  std::string path;                               ///< `element/7`, `node/4` or `run`
  std::map<std::string, std::string> attributes;  ///< `type` and `name` of an element
  std::vector<Named> channels;
};

/// What stands for (a part of) an element in the mesh: a point, a polyline, a triangle or a quadrilateral.
struct Cell {
  std::vector<int> points;  ///< 0-based places in ResultsLayout::points
  int element = 0;          ///< id
  bool surface = false;     ///< three or four points are a face, not a line
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
  std::vector<int> node_ids;
  std::vector<Vec3> points;  ///< reference positions, one per node
  std::vector<Cell> cells;
  std::vector<ChannelGroup> history;
  bool velocities = false;  ///< frames carry velocities

  /// Channels of all groups together: how many values a sample has.
  std::size_t channel_count() const {
    std::size_t n = 0;
    for (const ChannelGroup& group : history) n += group.channels.size();
    return n;
  }
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
