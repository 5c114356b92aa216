// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "deck/schema/schema.hpp"
#include "model/registry.hpp"

namespace engrane::elements::structural {

/// `.MAI I id [AT a 0] N n1 -m12 n2 …`: a cell of a mesh.
struct CellData {
  std::vector<int> attribute;  ///< AT: the attribute; the others mean nothing here
  std::vector<int> nodes;      ///< corners in turn, a mid-side node below zero between its corners
};

/// The nodes of a cell, corners first and then mid-side nodes from the side of the first two on; nothing when it is no plane
/// cell of 3, 6, 4 or 8 nodes.
std::optional<std::vector<int>> ordered_nodes(const CellData& data);

ElementType cell_type();

}  // namespace engrane::elements::structural
