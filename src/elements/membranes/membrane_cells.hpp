// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "elements/membranes/membrane_law.hpp"
#include "model/block.hpp"
#include "model/function.hpp"

namespace engrane::elements::membranes {

/// What a membrane is made of, and what presses on it.
struct MembraneSection {
  MembraneLaw law;
  double density = 0;
  double thickness = 0;
  double pressure = 0;                 ///< on the side that its corners go round clockwise
  const Function* function = nullptr;  ///< factor of the pressure; nullptr: 1

  double pressure_at(double time) const { return pressure * (function ? function->at(time).f : 1); }
};

/// Adds a membrane of 3, 6, 4 or 8 nodes to the block of its shape; alone in one where `blocks` is nullptr. Nothing where its
/// surface is folded or has no area.
std::unique_ptr<Element> make_membrane(int id, CellShape shape, const std::vector<int>& nodes, const std::vector<Vec3>& places,
                                       const std::shared_ptr<const MembraneSection>& section, BlockStore* blocks);

}  // namespace engrane::elements::membranes
