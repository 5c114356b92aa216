// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "elements/common/warmth.hpp"
#include "elements/membranes/membrane_law.hpp"
#include "model/block.hpp"
#include "model/function.hpp"

namespace engrane::elements::membranes {

/// Material, thickness and pressure of a membrane.
struct MembraneSection {
  MembraneLaw law;
  double density = 0;
  double thickness = 0;
  double pressure = 0;                 ///< acts on the side from which the corners appear clockwise
  const Function* function = nullptr;  ///< factor on the pressure; nullptr: 1

  double pressure_at(double time) const { return pressure * (function ? function->at(time).f : 1); }
};

/// Adds a membrane with 3, 6, 4 or 8 nodes to the block of its shape, or to a block of its own if `blocks` is nullptr. Returns
/// nullptr if its surface is folded or has no area.
std::unique_ptr<Element> make_membrane(int id, CellShape shape, const std::vector<int>& nodes, const std::vector<Vec3>& places,
                                       const std::shared_ptr<const MembraneSection>& section, const NodeWarmth& warmth,
                                       BlockStore* blocks);

}  // namespace engrane::elements::membranes
