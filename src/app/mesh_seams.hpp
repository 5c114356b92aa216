// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/diagnostics.hpp"
#include "model/model.hpp"

namespace engrane::app {

/// Warns about mid-side nodes on a side that another cell has without them: there the displacements of the two cells differ.
/// Nodes that supports or constraints hold are left out.
void warn_of_loose_middles(const Model& model, Diagnostics& diagnostics);

/// Warns about pressures on edges or faces that two cells share, which are inside the mesh. Requires the records of the model.
void warn_of_inner_pressures(const Model& model, Diagnostics& diagnostics);

}  // namespace engrane::app
