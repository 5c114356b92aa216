// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "model/model.hpp"

namespace engrane {

/// Whether the static forces of all elements are linear in the displacements.
inline bool has_linear_forces(const Model& model) {
  return std::all_of(model.parts.begin(), model.parts.end(), [](const Model::Part& part) { return part.element->is_linear(); });
}

/// Whether the analysis is one linear system, whose solutions are proportional to the loads: nodes then have rotation vectors
/// that add up (linear_rotation()).
inline bool is_linear_statics(const Model& model) {
  return model.commands.analysis.type.is("STATIC") && !model.commands.path && !model.commands.buckling &&
         has_linear_forces(model);
}

}  // namespace engrane
