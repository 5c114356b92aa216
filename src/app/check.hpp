// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>

#include "app/read.hpp"

namespace engrane::app {

/// `engrane check`: what would be built (nodes, unknowns by kind, equations by element, derived geometry), the
/// degrees of freedom, and which constraints repeat one another. Returns the exit status: a mechanism that does not close is
/// a solution that fails.
int print_model(const Reading& reading, std::ostream& out);

}  // namespace engrane::app
