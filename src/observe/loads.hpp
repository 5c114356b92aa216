// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "assembly/assembler.hpp"

namespace engrane::observe {

/// Where a force on a node acts; small displacements do not move it.
Vec3 place_of_force(const Model& model, const Configuration& c, int node);

/// The sum of loads on nodes, of pressures and of the weight of cells, global components, the moment about the origin, and their
/// work on the displacements from the reference configuration: u·F, twice the strain energy where all is linear and no support
/// moves.
struct LoadSum {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double work = 0;
};

/// On every rank; each evaluates its own elements. Collective.
LoadSum sum_loads(const Assembler& assembler, const Configuration& c);

}  // namespace engrane::observe
