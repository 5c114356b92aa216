// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "math/vector.hpp"

namespace engrane {

/// Where the nodes of a deck are, by number. The ground, node 0, is one of them.
class NodePositions {
 public:
  struct Node {
    int id = 0;
    Vec3 x = Vec3::Zero();
  };

  NodePositions() = default;
  /// Implicit, so that a few nodes can be given by a table.
  NodePositions(const std::map<int, Vec3>& nodes);
  /// In any order; of a number given again the last position counts.
  explicit NodePositions(std::vector<Node> nodes);

  bool contains(int id) const { return index(id) >= 0; }
  /// Place among the nodes by ascending number; -1 when there is no such node.
  int index(int id) const;
  /// Throws std::out_of_range when there is no such node.
  const Vec3& at(int id) const;
  /// Puts a node that exists elsewhere.
  void move(int id, const Vec3& x);

  const std::vector<Node>& by_number() const { return nodes_; }
  /// Gives the nodes away.
  std::vector<Node> release() { return std::move(nodes_); }

 private:
  std::vector<Node> nodes_;
};

}  // namespace engrane
