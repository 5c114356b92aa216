// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "math/vector.hpp"

namespace engrane {

/// Positions of the nodes of a deck by number. Node 0 is the ground.
class NodePositions {
 public:
  struct Node {
    int id = 0;
    Vec3 x = Vec3::Zero();
  };

  NodePositions() = default;
  /// Implicit, so that a few nodes can be given as a table.
  NodePositions(const std::map<int, Vec3>& nodes);
  /// In any order; the last of several positions for one number counts.
  explicit NodePositions(std::vector<Node> nodes);

  bool contains(int id) const { return index(id) >= 0; }
  /// Index among the nodes in ascending order of number; -1 if there is no such node.
  int index(int id) const;
  /// Throws std::out_of_range when there is no such node.
  const Vec3& at(int id) const;
  /// Changes the position of an existing node.
  void move(int id, const Vec3& x);

  const std::vector<Node>& by_number() const { return nodes_; }
  /// Moves the nodes out.
  std::vector<Node> release() { return std::move(nodes_); }

 private:
  std::vector<Node> nodes_;
};

}  // namespace engrane
