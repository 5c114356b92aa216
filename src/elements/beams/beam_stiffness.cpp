// SPDX-License-Identifier: BSD-3-Clause
#include "elements/beams/beam_stiffness.hpp"

namespace engrane::elements::beams {

namespace {

using Mat69 = Eigen::Matrix<double, 6, 9>;

/// Hessian by ψ of f(u) ψ·p with u = ψ·ψ; `f1` and `f2` are f′(u) and f″(u).
Mat3 second_derivatives(const Vec3& psi, const Vec3& p, double f1, double f2) {
  const Mat3 half = 2 * (f1 * p + f2 * psi.dot(p) * psi) * psi.transpose();
  Mat3 sum = half + half.transpose();
  sum.diagonal().array() += 2 * f1 * psi.dot(p);
  return sum;
}

/// Hessian by ψ of f(u) b·(ψ × (ψ × a)) = f(u) ((ψ·a)(ψ·b) − u a·b).
Mat3 second_derivatives(const Vec3& psi, const Vec3& a, const Vec3& b, double f, double f1, double f2) {
  const double in_a = psi.dot(a), in_b = psi.dot(b), both = a.dot(b), value = in_a * in_b - psi.squaredNorm() * both;
  const Vec3 slope = a * in_b + b * in_a - 2 * both * psi;
  const Mat3 half = f * a * b.transpose() + 2 * (f1 * slope + f2 * value * psi) * psi.transpose();
  Mat3 sum = half + half.transpose();
  sum.diagonal().array() += 2 * (f1 * value - f * both);
  return sum;
}

/// Axes, strains and their derivatives at a point: with E = exp(ψ) axes and T = axesᵀ T(ψ),
///
///     δγ = Eᵀ δh + γ × T δψ,   δk = T δψ′ + (T′ + k × T) δψ
class Point {
 public:
  Point(const BeamPlace<double>& at, const Mat3& axes, double free_stretch)
      : psi_(at.psi), slope_(at.psi_slope), h_(at.h), axes_(axes), f_(at.psi.squaredNorm()), rest_(1 + free_stretch) {
    const Mat3 spin = skew(psi_), square = spin * spin;
    turn_ = axes + (f_.phi[1] * spin + f_.phi[2] * square) * axes;
    tangent_ = axes.transpose() * (Mat3::Identity() - f_.phi[2] * spin + f_.phi[3] * square);
    gamma_ = turn_.transpose() * h_;
    k_ = tangent_ * slope_;
  }

  /// The strains that cause stress.
  Vec6 strain() const {
    Vec6 strain;
    strain << gamma_ - rest_ * Vec3::UnitX(), k_;
    return strain;
  }
  /// ∂ε/∂x.
  Mat69 strain_by() const {
    Mat69 by;
    by << turn_.transpose(), skew(gamma_) * tangent_, Mat3::Zero(),  //
        Mat3::Zero(), axes_.transpose() * tangent_change(slope_) + skew(k_) * tangent_, tangent_;
    return by;
  }

  /// ∂ε̇/∂x at constant rates.
  Mat69 strain_rate_by(const BeamPlace<double>& rates) const {
    const Mat3 spin = skew(tangent_ * rates.psi);
    // k̇ = T ψ̇′ + Ṫ ψ′
    Mat69 by;
    by << -spin * turn_.transpose(),
        (skew(turn_.transpose() * rates.h) - spin * skew(gamma_)) * tangent_ +
            skew(gamma_) * axes_.transpose() * tangent_by_psi(rates.psi, -1),
        Mat3::Zero(),  //
        Mat3::Zero(), axes_.transpose() * (tangent_by_psi(rates.psi_slope, -1) + tangent_change_by_psi(rates.psi)),
        axes_.transpose() * tangent_change(rates.psi);
    return by;
  }

  /// Adds the geometric stiffness: the Hessian of n·γ + m·k at constant n and m. Its terms are products of φ_1, φ_2, φ_3 with
  /// polynomials in ψ.
  void add_stress(const Vec6& stress, BeamStiffness::Mat9& matrix) const {
    const Vec3 n = axes_ * stress.head<3>(), m = axes_ * stress.tail<3>();
    const Mat3 by_h = -turn_ * skew(stress.head<3>()) * tangent_, by_slope = tangent_by_psi(m, 1);
    matrix.block<3, 3>(0, 3) += by_h;
    matrix.block<3, 3>(3, 0) += by_h.transpose();
    matrix.block<3, 3>(6, 3) += by_slope;
    matrix.block<3, 3>(3, 6) += by_slope.transpose();
    matrix.block<3, 3>(3, 3) += second_derivatives(psi_, n, h_, f_.phi[2], f_.first[2], f_.second[2]) -
                                second_derivatives(psi_, cross(h_, n), f_.first[1], f_.second[1]) +
                                second_derivatives(psi_, m, slope_, f_.phi[3], f_.first[3], f_.second[3]) -
                                second_derivatives(psi_, cross(slope_, m), f_.first[2], f_.second[2]);
  }

 private:
  /// ∂(T(ψ) v)/∂ψ for `sign` −1, ∂(T(ψ)ᵀ v)/∂ψ for 1.
  Mat3 tangent_by_psi(const Vec3& v, double sign) const {
    const Vec3 across = cross(psi_, v), twice = cross(psi_, across);
    Mat3 by = -sign * f_.phi[2] * skew(v) + 2 * (sign * f_.first[2] * across + f_.first[3] * twice) * psi_.transpose() +
              f_.phi[3] * (psi_ * v.transpose() - 2 * v * psi_.transpose());
    by.diagonal().array() += f_.phi[3] * psi_.dot(v);
    return by;
  }
  /// Directional derivative of T(ψ) along `d`.
  Mat3 tangent_change(const Vec3& d) const {
    const Mat3 spin = skew(psi_), mixed = spin * skew(d);
    const double rate = 2 * psi_.dot(d);
    return -f_.first[2] * rate * spin - f_.phi[2] * skew(d) + f_.first[3] * rate * spin * spin +
           f_.phi[3] * (mixed + mixed.transpose());
  }
  /// ∂(tangent_change(d) ψ′)/∂ψ at constant d and ψ′.
  Mat3 tangent_change_by_psi(const Vec3& d) const {
    const double rate = 2 * psi_.dot(d);
    const Mat3 spin = skew(psi_), turning = skew(d), slope = skew(slope_);
    const Vec3 across = cross(psi_, slope_), twice = cross(psi_, across), turned = cross(d, slope_);
    const Vec3 mixed = cross(psi_, turned) + cross(d, across);
    return 2 * (rate * (f_.second[3] * twice - f_.second[2] * across) - f_.first[2] * turned + f_.first[3] * mixed) *
               psi_.transpose() +
           2 * (f_.first[3] * twice - f_.first[2] * across) * d.transpose() + f_.first[2] * rate * slope -
           f_.first[3] * rate * (skew(across) + spin * slope) - f_.phi[3] * (skew(turned) + turning * slope);
  }

  const Vec3 psi_, slope_, h_;
  const Mat3& axes_;
  const RotationSeriesDerivatives f_;
  const double rest_;  ///< first component of γ without stress
  Mat3 turn_, tangent_;
  Vec3 gamma_, k_;  // in the axes of the section
};

}  // namespace

BeamStiffness::BeamStiffness(const BeamPlace<double>& at, const Mat3& axes, const Mat6& stiffness, double free_stretch) {
  const Point point(at, axes, free_stretch);
  const Mat69 strain_by = point.strain_by(), stress_by = stiffness.lazyProduct(strain_by);
  const Vec6 stress = stiffness * point.strain();
  force = strain_by.transpose() * stress;
  by_place = strain_by.transpose().lazyProduct(stress_by);
  point.add_stress(stress, by_place);
}

BeamStiffness::BeamStiffness(const BeamPlace<double>& at, const Mat3& axes, const Mat6& stiffness, double free_stretch,
                             const BeamPlace<double>& rates, double c) {
  const Point point(at, axes, free_stretch);
  Vec9 rate;
  rates.copy_to(rate.data());
  const Mat69 strain_by = point.strain_by(), stress_by = stiffness.lazyProduct(strain_by);
  const Vec6 stress = stiffness * (point.strain() + c * (strain_by * rate));
  force = strain_by.transpose() * stress;
  by_rate = c * strain_by.transpose().lazyProduct(stress_by);
  const Mat69 damping_by = c * stiffness.lazyProduct(point.strain_rate_by(rates));
  by_place = strain_by.transpose().lazyProduct(Mat69(stress_by + damping_by));
  point.add_stress(stress, by_place);
}

}  // namespace engrane::elements::beams
