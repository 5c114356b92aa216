// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace engrane::solve {

/// Adds a remark on a mesh of cells of which the start moves only the nodes on links, so that it begins torn, if there is one.
/// Meshes are elastic: constraints move the nodes that they reach, and no others. `moved`: size by which each node is moved, or
/// its velocity changed, to fit joints and drives; up to `least` is rounding. `what`: what that is, `remedy`: what moves a whole
/// mesh.
void remark_on_torn_mesh(const Model& model, std::span<const double> moved, double least, const std::string& what,
                         const std::string& remedy, std::vector<std::string>& remarks);

}  // namespace engrane::solve
