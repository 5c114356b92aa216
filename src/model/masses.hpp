// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/model.hpp"

namespace engrane {

/// How a body resists rigid accelerations. Global axes, in the reference configuration.
struct MassProperties {
  double mass = 0;
  Vec3 centre = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();  ///< about the centre

  bool any() const { return mass != 0 || !inertia.isZero(0); }
  /// Both together, by the theorem of parallel axes.
  void add(const MassProperties& other);
};

/// Of one element: the forces and moments with which its residual resists accelerations of all its nodes as one rigid body.
MassProperties mass_properties(const Model& model, const Model::Part& part);
/// The mass alone, the same number: of a plane cell half of the work.
double mass_of(const Model& model, const Model::Part& part);

}  // namespace engrane
