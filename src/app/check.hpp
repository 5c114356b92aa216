// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>

#include "model/model.hpp"

namespace engrane {

/// `engrane check`: what would be built (nodes, unknowns by kind, equations by element, derived geometry, expected cost).
void print_model(const Model& model, std::ostream& out);

}  // namespace engrane
