// SPDX-License-Identifier: BSD-3-Clause
// Which nodes of a cell belong to its sides and faces, and how a deck writes them.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "model/element.hpp"

namespace engrane::elements::structural {

/// Nodes of a cell in the order of CellShape.
struct Connectivity {
  CellShape shape = CellShape::none;
  std::vector<int> nodes;
};

/// From the list behind `N` of `.MAI`: of a plane cell its corners in turn, of a solid those of the base, a 0, those of the top.
/// Mid-side nodes are below zero; those of base and top stand between their corners, those of the sides from base to top
/// between two zeros. Nothing when it is no cell.
std::optional<Connectivity> connectivity(std::span<const int> written);

/// Nodes of a line along it, from `n1 n2` or `n1 -m12 n2`; nothing when it is none.
std::optional<std::vector<int>> line_of(std::span<const int> written);

bool is_solid(CellShape shape);
bool has_middles(CellShape shape);
/// Corners, as indices of nodes, at the ends of each side; the mid-side nodes stand in this order.
std::span<const std::pair<int, int>> sides(CellShape shape);
int corner_count(CellShape shape);

/// Faces of a solid: its base, those that stand on the sides of the base in turn, its top; edges of a plane cell in turn.
int face_count(CellShape shape);
/// Indices of the nodes of a face, which is counted from 0: corners, then mid-side nodes. Corners go round so that the normal
/// of a solid's face points out of it where its base goes round its top, right-handed; an edge has its cell to the left.
std::vector<int> face_nodes(CellShape shape, int face);

}  // namespace engrane::elements::structural
