// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "math/matrix6.hpp"
#include "math/vector.hpp"
#include "model/registry.hpp"

namespace engrane::elements::beams {

/// What a section resists with, and its mass, both per unit length. Axes: 1 along the beam, 2 and 3 across it; the origin is the
/// line of the nodes.
struct BeamSection {
  /// Of the forces N, V2, V3 and the moments T, M2, M3 by the strains: stretch, shears, twist and curvatures.
  Mat6 stiffness = Mat6::Zero();
  double mass = 0;
  Vec3 center = Vec3::Zero();   ///< of mass; its first coordinate is 0
  Mat3 inertia = Mat3::Zero();  ///< tensor about the centre of mass
  double damping = 0;           ///< a time: forces are those of the strain, and this times those of its rate
  bool is_round = false;        ///< axes 2 and 3 may be any

  Vec6 own_stiffness = Vec6::Zero();     ///< of a shape about its centroid and shear centre, else the diagonal of `stiffness`
  double young = 0;                      ///< Young's modulus; 0: the section is not a shape of one material
  std::vector<Eigen::Vector2d> outline;  ///< corners of the shape on axes 2 and 3; empty: not known
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double radius = 0;  ///< of a round shape about `middle`: what the outline goes round

  bool has_mass() const { return mass > 0 || !inertia.isZero(0); }
};

/// The section of a `.BPR` made of a `.MAT`; `material` 0: none is given. Faults are reported at the keywords of the record that
/// is built; nullptr then. Records are looked up once in a model.
std::shared_ptr<const BeamSection> section_of(int profile, int material, double damping, const BuildContext& context);

}  // namespace engrane::elements::beams
