// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "elements/common/warmth.hpp"
#include "elements/structural/cell_book.hpp"

namespace engrane::elements::structural {

/// Data of a cell to be built; nodes and places are in the order of CellShape.
struct CellPlan {
  int id = 0;
  CellShape shape = CellShape::none;
  std::vector<int> nodes;
  std::vector<Vec3> places;
  std::shared_ptr<const CellSection> section;
  NodeWarmth warmth = nullptr;
  std::shared_ptr<const CellRotation> rotation = nullptr;  ///< nullptr: it does not rotate
};

/// Adds a cell to the block of its kind, or to a block of its own if `blocks` is nullptr.
std::unique_ptr<Element> make_plane_cell(const CellPlan& plan, BlockStore* blocks);
std::unique_ptr<Element> make_solid_cell(const CellPlan& plan, BlockStore* blocks);

/// The same for a membrane in space; defined in elements/membranes/skin.cpp. Returns nullptr if it is folded or has no area.
std::unique_ptr<Element> make_skin(const CellPlan& plan, BlockStore* blocks);

/// Nodes of a MEMBRANE of `.MCE`; nullptr for records of other cards. Defined in elements/membranes/skin.cpp.
const std::vector<int>* membrane_nodes(const deck::Record& record);

/// Whether the Jacobian determinant has the same sign, and is not zero, at all stiffness and load points.
bool is_regular_plane(CellShape shape, const std::vector<Vec3>& places);
bool is_regular_solid(CellShape shape, const std::vector<Vec3>& places);

/// Positive if a regular cell is right-handed: the corners of a plane cell are counterclockwise, those of a solid's base are
/// counterclockwise seen from its top.
double handedness(CellShape shape, const std::vector<Vec3>& places);

}  // namespace engrane::elements::structural
