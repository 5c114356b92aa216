// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "elements/structural/cell_book.hpp"

namespace engrane::elements::structural {

/// All that a cell is made from; nodes and places in the order of CellShape.
struct CellPlan {
  int id = 0;
  CellShape shape = CellShape::none;
  std::vector<int> nodes;
  std::vector<Vec3> places;
  std::shared_ptr<const CellSection> section;
  std::shared_ptr<const std::vector<Warmth>> warmth = nullptr;  ///< of each node; none: no change of temperature
  std::shared_ptr<const CellRotation> rotation = nullptr;       ///< none: it does not turn
};

/// Adds a cell to the block of its kind; alone in one where `blocks` is nullptr.
std::unique_ptr<Element> make_plane_cell(const CellPlan& plan, BlockStore* blocks);
std::unique_ptr<Element> make_solid_cell(const CellPlan& plan, BlockStore* blocks);

/// A membrane in space, made where these are: elements/membranes/skin.cpp. nullptr where it is folded or has no area.
std::unique_ptr<Element> make_skin(const CellPlan& plan, BlockStore* blocks);

/// Whether the cell has an area or a volume: its determinant has one sign at all points where something is evaluated.
bool is_regular_plane(CellShape shape, const std::vector<Vec3>& places);
bool is_regular_solid(CellShape shape, const std::vector<Vec3>& places);

/// Above zero where the corners of a regular cell go round right-handed: counterclockwise in a plane, the top of a solid above
/// its base as seen from there.
double handedness(CellShape shape, const std::vector<Vec3>& places);

}  // namespace engrane::elements::structural
