// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/meshes_at_start.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace engrane::solve {

namespace {

/// Nodes that move by less than this part of the fastest one of their mesh are left behind. Of a mesh that moves as one few do
/// so, however near to its axis.
constexpr double left_behind = 0.03, most_behind = 0.25;

/// For each node the first one of its mesh; −1: it is not in one.
std::vector<int> meshes_of(const Model& model) {
  std::vector<int> first(model.nodes.size(), -1);
  const auto root = [&first](int node) {
    const auto above = [&first](int of) -> int& { return first[static_cast<std::size_t>(of)]; };
    while (above(node) != node) node = above(node) = above(above(node));
    return node;
  };
  for (const Model::Part& part : model.parts) {
    if (part.element->cell_shape() == CellShape::none) continue;
    int joined = -1;
    for (const int node : part.nodes) {
      if (node <= 0) continue;
      int& own = first[static_cast<std::size_t>(node)];
      if (own < 0) own = node;
      const int other = root(node);
      if (joined >= 0) first[static_cast<std::size_t>(std::max(joined, other))] = std::min(joined, other);
      joined = joined < 0 ? other : std::min(joined, other);
    }
  }
  for (std::size_t n = 0; n < first.size(); ++n)
    if (first[n] >= 0) first[n] = first[static_cast<std::size_t>(first[n])];  // lower nodes have theirs already
  return first;
}

}  // namespace

void remark_on_torn_mesh(const Model& model, std::span<const double> moved, double least, const std::string& what,
                         const std::string& remedy, std::vector<std::string>& remarks) {
  if (std::all_of(moved.begin(), moved.end(), [least](double move) { return move <= least; })) return;
  const std::vector<int> mesh = meshes_of(model);
  struct Count {
    double most = 0;
    int fastest = 0, nodes = 0, behind = 0;
  };
  std::vector<Count> counts(mesh.size());
  for (std::size_t n = 1; n < mesh.size(); ++n) {
    if (mesh[n] < 0) continue;
    Count& count = counts[static_cast<std::size_t>(mesh[n])];
    ++count.nodes;
    if (moved[n] <= count.most) continue;
    count.most = moved[n];
    count.fastest = static_cast<int>(n);
  }
  for (std::size_t n = 1; n < mesh.size(); ++n)
    if (mesh[n] >= 0)
      if (Count& count = counts[static_cast<std::size_t>(mesh[n])]; moved[n] < left_behind * count.most) ++count.behind;
  for (const Count& count : counts) {
    if (count.most <= least || count.behind <= most_behind * count.nodes) continue;
    const auto holds = [&](const Model::Part& part) {
      return part.element->cell_shape() == CellShape::none &&
             std::find(part.nodes.begin(), part.nodes.end(), count.fastest) != part.nodes.end();
    };
    const auto link = std::find_if(model.parts.begin(), model.parts.end(), holds);
    remarks.push_back(fmt::format("{} node {}{} and leaves {} of the {} nodes of its mesh behind: {}", what,
                                  model.nodes[static_cast<std::size_t>(count.fastest)].id,
                                  link == model.parts.end() ? "" : " of " + link->name(), count.behind, count.nodes, remedy));
    return;
  }
}

}  // namespace engrane::solve
