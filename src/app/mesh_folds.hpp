// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/diagnostics.hpp"
#include "model/model.hpp"

namespace engrane::app {

/// Warns about cells that are turned inside out at a corner: concave quadrilaterals, sides whose middle lies nearer to the corner
/// than a quarter of the side or bends back. Their quadrature points, which are all the elements check, may be regular.
void warn_of_folded_corners(const Model& model, Diagnostics& diagnostics);

}  // namespace engrane::app
