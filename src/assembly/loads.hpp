// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "assembly/assembler.hpp"

namespace engrane {

/// Point of application of a force on a node. With small displacements this is the reference position.
Vec3 place_of_force(const Model& model, const Configuration& c, int node);

/// Sum of all loads, pressures and weights, in global components, and their moment about the origin. `work`
/// is the work u·F on the displacements from the reference configuration. It is twice the strain energy if everything is linear
/// and no support moves.
struct LoadSum {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double work = 0;
};

/// Whether a load, a pressure or a weight acts. Collective.
bool any_loads(const Assembler& assembler, const Configuration& c);

/// On every rank; each evaluates its own elements. Collective.
LoadSum sum_loads(const Assembler& assembler, const Configuration& c);

}  // namespace engrane
