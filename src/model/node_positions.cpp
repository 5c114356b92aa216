// SPDX-License-Identifier: BSD-3-Clause
#include "model/node_positions.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

namespace engrane {

NodePositions::NodePositions(const std::map<int, Vec3>& nodes) {
  nodes_.reserve(nodes.size());
  for (const auto& [id, x] : nodes) nodes_.push_back({id, x});
}

NodePositions::NodePositions(std::vector<Node> nodes) : nodes_(std::move(nodes)) {
  const auto before = [](const Node& a, const Node& b) { return a.id < b.id; };
  if (!std::is_sorted(nodes_.begin(), nodes_.end(), before)) std::stable_sort(nodes_.begin(), nodes_.end(), before);
  // from the back, so that the last of equals remains
  const auto same = [](const Node& a, const Node& b) { return a.id == b.id; };
  nodes_.erase(nodes_.begin(), std::unique(nodes_.rbegin(), nodes_.rend(), same).base());
}

int NodePositions::index(int id) const {
  const auto place = std::lower_bound(nodes_.begin(), nodes_.end(), id, [](const Node& n, int wanted) { return n.id < wanted; });
  return place != nodes_.end() && place->id == id ? static_cast<int>(place - nodes_.begin()) : -1;
}

const Vec3& NodePositions::at(int id) const {
  const int place = index(id);
  if (place < 0) throw std::out_of_range("there is no node " + std::to_string(id));
  return nodes_[static_cast<std::size_t>(place)].x;
}

void NodePositions::move(int id, const Vec3& x) { nodes_.at(static_cast<std::size_t>(index(id))).x = x; }

}  // namespace engrane
