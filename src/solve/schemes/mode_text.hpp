// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "assembly/numbering.hpp"

namespace engrane::solve {

/// The largest components of a vector by equation: translations of nodes over the largest of them; where there are none,
/// rotations and scalars. "node 5 (x) 1, node 4 (x) 0.92"
std::string largest_components(const Numbering& numbering, std::span<const double> vector);

/// Whether an equation is of a node's translation.
bool is_translation(const Numbering& numbering, std::size_t equation);

}  // namespace engrane::solve
