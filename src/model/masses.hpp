// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/model.hpp"

namespace engrane {

/// Rigid-body mass properties of a body. Global axes, in the reference configuration.
struct MassProperties {
  double mass = 0;
  Vec3 centre = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();  ///< about the centre of mass

  bool any() const { return mass != 0 || !inertia.isZero(0); }
  /// Combines both bodies, by the parallel-axis theorem.
  void add(const MassProperties& other);
};

/// Mass properties of one element: its inertia forces and moments for rigid-body accelerations of all its nodes.
MassProperties mass_properties(const Model& model, const Model::Part& part);
/// The mass alone; for a plane cell at half the cost.
double mass_of(const Model& model, const Model::Part& part);
/// Radius of gyration of a body about its first node, √(J/M) with the largest J; 0 if it has no mass there.
double radius_of_gyration(const Model& model, const Model::Part& part);

}  // namespace engrane
