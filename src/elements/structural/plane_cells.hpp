// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "elements/structural/cell_book.hpp"

namespace engrane::elements::structural {

/// Adds a cell of 3, 6, 4 or 8 nodes, corners first, to the block of its kind; alone in one where `blocks` is nullptr. `places`:
/// x and y of the nodes.
std::unique_ptr<Element> make_plane_cell(int id, std::span<const int> nodes, const std::vector<Eigen::Vector2d>& places,
                                         const std::shared_ptr<const CellSection>& section, BlockStore* blocks);

/// Whether the cell has an area: its determinant has one sign at all points where something is evaluated.
bool has_area(const std::vector<Eigen::Vector2d>& places);

}  // namespace engrane::elements::structural
