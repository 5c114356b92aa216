// SPDX-License-Identifier: BSD-3-Clause
// Strains at a point of a beam and the conjugate forces.
#pragma once

#include <array>
#include <cstddef>

#include "elements/beams/beam_section.hpp"
#include "math/rotation_series.hpp"

namespace engrane::elements::beams {

/// Kinematics of a point of a beam in the axes of the reference node (Crisfield and Jelenić 1999, Proc. R. Soc. A 455, eq. 4.6,
/// with rotations from the reference configuration). exp(ψ) is the rotation of the section relative to that node and h the
/// slope of the line of nodes; ′ is the derivative by arc length at rest.
template <class T>
struct BeamPlace {
  Vec3T<T> h, psi, psi_slope;

  static constexpr std::size_t size = 9;
  static BeamPlace of(const T* x) { return {Vec3T<T>(x[0], x[1], x[2]), Vec3T<T>(x[3], x[4], x[5]), Vec3T<T>(x[6], x[7], x[8])}; }
  void copy_to(T* x) const {
    for (int c = 0; c < 3; ++c) x[c] = h[c], x[3 + c] = psi[c], x[6 + c] = psi_slope[c];
  }
};

/// Reissner–Simo strains (Simo 1985, Comput. Methods Appl. Mech. Eng. 49, eq. 3.6), in the rotated axes of the section. `axes`
/// are those at rest:
///
///     γ = exp(ψ)ᵀ h,   k = T(ψ) ψ′,   ε = (axesᵀ γ − e_1, axesᵀ k)
///
/// with T(ψ) = 1 − φ_2 ψ̂ + φ_3 ψ̂², so that a variation δψ rotates the section by δθ = T δψ in its own axes.
template <class T>
class BeamStrain {
 public:
  BeamStrain(const BeamPlace<T>& at, const Mat3& axes) : at_(at), axes_(axes), f_(dot(at.psi, at.psi)) {
    gamma_ = turned(at.h, T(-1));
    k_ = tangent(at.psi_slope, T(-1));
    // T′ = −φ_2′ ψ̂ − φ_2 ψ̂′ + φ_3′ ψ̂² + φ_3 (ψ̂ ψ̂′ + ψ̂′ ψ̂)
    const T rate = dot(at.psi, at.psi_slope) * 2.0;
    f2_slope_ = f_.f2_slope * rate;
    f3_slope_ = f_.f3_slope * rate;
  }

  /// ε: stretch, shears, twist, curvatures.
  std::array<T, 6> strain() const {
    const Vec3T<T> gamma = rotate_back(axes_, gamma_), k = rotate_back(axes_, k_);
    return {gamma[0] - 1.0, gamma[1], gamma[2], k[0], k[1], k[2]};
  }

  /// ε̇ for the given rates of h, ψ, ψ′.
  std::array<T, 6> strain_rate(const BeamPlace<T>& rates) const {
    const Vec3T<T> spin = tangent(rates.psi, T(-1));
    const Vec3T<T> gamma_rate = turned(rates.h, T(-1)) + cross(gamma_, spin);
    const Vec3T<T> k_rate = tangent(rates.psi_slope, T(-1)) + tangent_slope(rates.psi, T(-1)) + cross(k_, spin);
    const Vec3T<T> gamma = rotate_back(axes_, gamma_rate), k = rotate_back(axes_, k_rate);
    return {gamma[0], gamma[1], gamma[2], k[0], k[1], k[2]};
  }

  /// Generalised forces f with f·δ(h, ψ, ψ′) = σ·δε.
  BeamPlace<T> forces(const std::array<T, 6>& stress) const {
    const Vec3T<T> n = rotate(axes_, Vec3T<T>(stress[0], stress[1], stress[2]));
    const Vec3T<T> m = rotate(axes_, Vec3T<T>(stress[3], stress[4], stress[5]));
    const Vec3T<T> turning = cross(n, gamma_) - cross(k_, m);
    return {turned(n, T(1)), tangent(turning, T(1)) + tangent_slope(m, T(1)), tangent(m, T(1))};
  }

 private:
  /// exp(ψ) v for `sign` 1, exp(ψ)ᵀ v for −1.
  Vec3T<T> turned(const Vec3T<T>& v, const T& sign) const {
    const Vec3T<T> across = cross(at_.psi, v);
    return v + across * (sign * f_.f1) + cross(at_.psi, across) * f_.f2;
  }
  /// T(ψ) v for `sign` −1, T(ψ)ᵀ v for 1.
  Vec3T<T> tangent(const Vec3T<T>& v, const T& sign) const {
    const Vec3T<T> across = cross(at_.psi, v);
    return v + across * (sign * f_.f2) + cross(at_.psi, across) * f_.f3;
  }
  /// T′ v for `sign` −1, T′ᵀ v for 1.
  Vec3T<T> tangent_slope(const Vec3T<T>& v, const T& sign) const {
    const Vec3T<T> across = cross(at_.psi, v), across_slope = cross(at_.psi_slope, v);
    return (across * f2_slope_ + across_slope * f_.f2) * sign + cross(at_.psi, across) * f3_slope_ +
           (cross(at_.psi, across_slope) + cross(at_.psi_slope, across)) * f_.f3;
  }

  BeamPlace<T> at_;
  const Mat3& axes_;
  RotationSeries<T> f_;
  Vec3T<T> gamma_, k_;
  T f2_slope_, f3_slope_;
};

}  // namespace engrane::elements::beams
