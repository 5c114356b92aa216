// SPDX-License-Identifier: BSD-3-Clause
// Sides and faces of cells, and the notation of their nodes in a deck.
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

/// Reads the list of `N` of `.MAI`: the corners of a plane cell in order, or of a solid those of the base, a 0 and those of the
/// top. Mid-side nodes are negative: those of base and top are between their corners, those of the sides from base to top
/// between two zeros. Nothing if the list is no valid plane cell or solid.
std::optional<Connectivity> connectivity(std::span<const int> written);

/// Nodes along a line from `n1 n2` or `n1 -m12 n2`; nothing if the list is not a line.
std::optional<std::vector<int>> line_of(std::span<const int> written);

bool is_solid(CellShape shape);
bool has_middles(CellShape shape);
/// Indices of the corners at the ends of each side. Mid-side nodes have the same order.
std::span<const std::pair<int, int>> sides(CellShape shape);
int corner_count(CellShape shape);

/// Number of faces of a solid (base, those on the sides of the base in order, top) or edges of a plane cell.
int face_count(CellShape shape);
/// Indices of the nodes of a face, counted from 0: corners, then mid-side nodes. For a right-handed cell (handedness() > 0) the
/// normal of a solid's face points outwards and an edge has its cell to the left.
std::vector<int> face_nodes(CellShape shape, int face);

}  // namespace engrane::elements::structural
