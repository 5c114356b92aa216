// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "assembly/numbering.hpp"

namespace engrane::solve {

/// Names the largest components of a vector by equation: translations of nodes over the largest of them; if there are none,
/// rotations and scalars. "node 5 (x) 1, node 4 (x) 0.92"
std::string largest_components(const Numbering& numbering, std::span<const double> vector);

/// Whether an equation belongs to a translation of a node.
bool is_translation(const Numbering& numbering, std::size_t equation);

}  // namespace engrane::solve
