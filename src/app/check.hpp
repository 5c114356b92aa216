// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>

#include "app/read.hpp"

namespace engrane::app {

/// `engrane check`: prints what would be built (nodes, unknowns by kind, equations by element, derived geometry), the degrees
/// of freedom, the redundant constraints and the expected cost. Returns the exit status. A mechanism that cannot be assembled
/// counts as a failed solution.
int print_model(const Reading& reading, std::ostream& out);

}  // namespace engrane::app
