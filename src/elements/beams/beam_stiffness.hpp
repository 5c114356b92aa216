// SPDX-License-Identifier: BSD-3-Clause
// Closed-form forces and stiffness at a point of a beam.
#pragma once

#include "elements/beams/beam_strain.hpp"

namespace engrane::elements::beams {

/// Generalised forces conjugate to x = (h, ψ, ψ′) at a point, per unit length, and their derivatives. The forces are those of
/// BeamStrain::forces for the stress resultants σ = C (ε − α ΔT e_1 + c ε̇), with the free stretch α ΔT.
struct BeamStiffness {
  using Vec9 = Eigen::Matrix<double, 9, 1>;
  using Mat9 = Eigen::Matrix<double, 9, 9>;

  /// Elastic section: `force` is the gradient of the energy, `by_place` its Hessian.
  BeamStiffness(const BeamPlace<double>& at, const Mat3& axes, const Mat6& stiffness, double free_stretch);
  /// Damped section moving at the given rates; c > 0 is a time.
  BeamStiffness(const BeamPlace<double>& at, const Mat3& axes, const Mat6& stiffness, double free_stretch,
                const BeamPlace<double>& rates, double c);

  Vec9 force;
  Mat9 by_place;
  Mat9 by_rate;  ///< damped sections only
};

}  // namespace engrane::elements::beams
