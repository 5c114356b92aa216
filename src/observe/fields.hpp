// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "model/model.hpp"
#include "observe/reactions.hpp"

namespace engrane::observe {

/// Fields over the nodes at one instant: three global components for each node but the ground, in the order of Model::nodes.
struct NodalFields {
  std::vector<double> displacement, rotation;      ///< rotation vectors, length at most π
  std::vector<double> velocity, angular_velocity;  ///< empty where nothing moves
  std::vector<double> reaction_force, reaction_torque;
};

NodalFields nodal_fields(const Model& model, const Configuration& c, const std::vector<Reaction>& reactions, bool moves);

}  // namespace engrane::observe
