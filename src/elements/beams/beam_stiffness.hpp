// SPDX-License-Identifier: BSD-3-Clause
// Forces and stiffness at a point of a beam in closed form.
#pragma once

#include "elements/beams/beam_strain.hpp"

namespace engrane::elements::beams {

/// The forces on x = (h, ψ, ψ′) at a point, per unit length, with stresses σ = C (ε + c ε̇), as BeamStrain::forces has them, and
/// their derivatives.
struct BeamStiffness {
  using Vec9 = Eigen::Matrix<double, 9, 1>;
  using Mat9 = Eigen::Matrix<double, 9, 9>;

  /// Of an elastic section, where forces are the first derivatives of the energy ½ εᵀCε, and the matrix the second.
  BeamStiffness(const BeamPlace<double>& at, const Mat3& axes, const Mat6& stiffness);
  /// Of a damped one that moves at these rates; c > 0 is a time.
  BeamStiffness(const BeamPlace<double>& at, const Mat3& axes, const Mat6& stiffness, const BeamPlace<double>& rates, double c);

  Vec9 force;
  Mat9 by_place;
  Mat9 by_rate;  ///< of a damped section
};

}  // namespace engrane::elements::beams
