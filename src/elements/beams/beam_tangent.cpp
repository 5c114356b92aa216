// SPDX-License-Identifier: BSD-3-Clause
// Closed-form tangent of a piece. Variations are expressed in the axes of the reference node r: with δx in global axes and δθ
// in the body axes of each node,
//
//     δy_i = R_rᵀ (δx_i − δx_r) + y_i × δθ_r,   δφ_i = R_rᵀ R_i δθ_i − δθ_r,   δψ_i = A_i δφ_i
//
// where A = 1 − ½ ψ̂ + κ ψ̂² (RotationVector::change). With g_i conjugate to y_i and μ_i conjugate to ψ_i, τ_i = A_iᵀ μ_i.
#include "elements/beams/beam_piece.hpp"
#include "elements/beams/beam_stiffness.hpp"

namespace engrane::elements::beams {

namespace {

/// A.
Mat3 change_matrix(const RotationVector<double>& v) {
  const Mat3 spin = skew(v.theta);
  return Mat3::Identity() - 0.5 * spin + v.kappa * spin * spin;
}

/// ∂(A f)/∂ψ for `sign` −1, ∂(Aᵀ f)/∂ψ for 1.
Mat3 change_by_vector(const RotationVector<double>& v, const Vec3& f, double sign) {
  const Vec3 twice = cross(v.theta, Vec3(cross(v.theta, f)));
  Mat3 sum = -0.5 * sign * skew(f) + 2 * v.kappa_slope() * twice * v.theta.transpose() +
             v.kappa * (v.theta * f.transpose() - 2 * f * v.theta.transpose());
  sum.diagonal().array() += v.kappa * v.theta.dot(f);
  return sum;
}

}  // namespace

template <int Nodes>
class BeamPiece<Nodes>::Tangent {
 public:
  Tangent(const BeamPiece& piece, const State& state, Weights weights, std::span<double> r, std::span<double> k)
      : piece_(piece), state_(state), weights_(weights), damped_(piece.section->damping > 0), r_(r.data()), k_(k.data()) {
    r_.setZero();
    k_.setZero();
    add_elastic();
    if (piece.section->has_mass()) add_inertia();
  }

 private:
  static constexpr Eigen::Index unknowns = 6 * Nodes, others = 6 * (Nodes - 1);
  using Inner = Eigen::Matrix<double, others, others>;  ///< by y_i and ψ_i of the nodes except r

  /// Index of the `other`-th node, not counting r.
  static constexpr std::size_t node(Eigen::Index other) { return Nodes == 3 ? static_cast<std::size_t>(2 * other) : 1; }
  static constexpr Eigen::Index row(std::size_t node) { return 6 * static_cast<Eigen::Index>(node); }
  template <class M>
  static auto block(M& matrix, Eigen::Index i, Eigen::Index j) {
    return matrix.template block<3, 3>(i, j);
  }

  /// Transforms the derivatives at a point, by (h, ψ, ψ′), to those by y_i and ψ_i, and adds them to `sum`.
  static void add_point(const Point& point, const BeamStiffness::Mat9& at, Inner& sum) {
    for (Eigen::Index o = 0; o < Nodes - 1; ++o)
      for (Eigen::Index q = 0; q < Nodes - 1; ++q) {
        const double value = point.length * point.shape[node(o)], slope = point.length * point.slope[node(o)];
        const double n = point.shape[node(q)], d = point.slope[node(q)];
        block(sum, 6 * o, 6 * q) += slope * d * block(at, 0, 0);
        block(sum, 6 * o, 6 * q + 3) += slope * n * block(at, 0, 3) + slope * d * block(at, 0, 6);
        block(sum, 6 * o + 3, 6 * q) += value * d * block(at, 3, 0) + slope * d * block(at, 6, 0);
        block(sum, 6 * o + 3, 6 * q + 3) +=
            value * n * block(at, 3, 3) + value * d * block(at, 3, 6) + slope * n * block(at, 6, 3) + slope * d * block(at, 6, 6);
      }
  }

  /// Sums the forces over the points, with their derivatives by y_i and ψ_i and, if damped, by the rates of these.
  void sum_points(const Relative<double>& relative, const Arms<double>& rates) {
    force_.setZero();
    by_place_.setZero();
    by_rate_.setZero();
    for (std::size_t p = 0; p < piece_.at.size(); ++p) {
      const Point& point = piece_.at[p];
      const auto place = relative.at(point);
      const Mat6& stiffness = point.section->stiffness;
      const double free = piece_.free_stretch(p, state_.time);
      const BeamStiffness s = damped_
                                  ? BeamStiffness(place, point.axes, stiffness, free, rates.at(point), piece_.section->damping)
                                  : BeamStiffness(place, point.axes, stiffness, free);
      for (Eigen::Index o = 0; o < Nodes - 1; ++o) {
        const double value = point.length * point.shape[node(o)], slope = point.length * point.slope[node(o)];
        force_.template segment<3>(6 * o) += slope * s.force.template head<3>();
        force_.template segment<3>(6 * o + 3) += value * s.force.template segment<3>(3) + slope * s.force.template tail<3>();
      }
      add_point(point, s.by_place, by_place_);
      if (damped_) add_point(point, s.by_rate, by_rate_);
    }
  }

  /// Derivatives of y_i, ψ_i and their rates by the unknowns of node i and of r.
  struct Changes {
    Mat3 change;                 ///< A
    Mat3 place, turn;            ///< y by x_i and ψ by θ_i
    Mat3 arm, counter;           ///< y and ψ by θ_r; y by x_r is −place
    Mat3 place_rate, turn_rate;  ///< the same for ẏ and ψ̇
    Mat3 arm_rate, counter_rate;
    Mat3 phi, phi_counter;  ///< φ by θ_i and by θ_r
  };

  Changes changes(const Relative<double>& relative, const Arms<double>& rates, std::size_t i) const {
    const NodeState &own = state_.nodes[i], &r = state_.nodes[reference];
    const auto [q, v, a, m] = weights_;
    const RotationVector<double>& vector = relative.vector[i];
    Changes c;
    c.change = change_matrix(vector);
    c.phi = q * relative.turn[i] * own.T;
    c.phi_counter = -q * r.T;
    c.place = q * r.R.transpose();
    c.turn = c.change * c.phi;
    c.arm = q * skew(relative.y[i]) * r.T;
    c.counter = c.change * c.phi_counter;
    if (!damped_) return c;
    const Mat3 spin = skew(r.W);
    const Vec3 own_spin = relative.turn[i] * own.W, phi_rate = own_spin - r.W;
    // ẏ = R_rᵀ (v_i − v_r) − W_r × y and ψ̇ = A φ̇, φ̇ = R_rᵀ R_i W_i − W_r
    const Vec3 apart = rates.y[i] + spin * relative.y[i];
    const Mat3 bend = change_by_vector(vector, phi_rate, -1);
    c.place_rate = v * r.R.transpose() - spin * c.place;
    c.arm_rate = q * skew(apart) * r.T + v * skew(relative.y[i]) - spin * c.arm;
    c.turn_rate = c.change * (v * relative.turn[i] - relative.turn[i] * skew(own.W) * own.T * q) + bend * c.turn;
    c.counter_rate = c.change * (q * skew(own_spin) * r.T - v * Mat3::Identity()) + bend * c.counter;
    return c;
  }

  void add_elastic() {
    constexpr std::size_t r = reference;
    const Motion<double, Nodes> motion(state_);
    const Relative<double> relative(motion);
    Arms<double> rates;
    if (damped_) rates = relative.rates(motion);
    sum_points(relative, rates);

    // derivatives of g_i and μ_i by the unknowns
    std::array<Changes, Nodes - 1> all;
    Eigen::Matrix<double, others, unknowns> by;
    auto by_place = by.template middleCols<3>(row(r)), by_turn = by.template middleCols<3>(row(r) + 3);
    by_place.setZero();
    by_turn.setZero();
    for (Eigen::Index o = 0; o < Nodes - 1; ++o) {
      const std::size_t i = node(o);
      const Changes& c = all[static_cast<std::size_t>(o)] = changes(relative, rates, i);
      auto by_own_place = by.template middleCols<3>(row(i)), by_own_turn = by.template middleCols<3>(row(i) + 3);
      const auto by_y = by_place_.template middleCols<3>(6 * o), by_psi = by_place_.template middleCols<3>(6 * o + 3);
      by_own_place = by_y.lazyProduct(c.place);
      by_own_turn = by_psi.lazyProduct(c.turn);
      by_turn += by_y.lazyProduct(c.arm) + by_psi.lazyProduct(c.counter);
      if (damped_) {
        const auto by_y_rate = by_rate_.template middleCols<3>(6 * o), by_psi_rate = by_rate_.template middleCols<3>(6 * o + 3);
        by_own_place += by_y_rate.lazyProduct(c.place_rate);
        by_own_turn += by_psi_rate.lazyProduct(c.turn_rate);
        by_turn += by_y_rate.lazyProduct(c.arm_rate) + by_psi_rate.lazyProduct(c.counter_rate);
      }
      by_place -= by_own_place;
    }

    const Mat3& frame = state_.nodes[r].R;
    for (Eigen::Index o = 0; o < Nodes - 1; ++o) {
      const std::size_t i = node(o);
      const Changes& c = all[static_cast<std::size_t>(o)];
      const Mat3 back = relative.turn[i].transpose();
      const Vec3 g = force_.template segment<3>(6 * o), mu = force_.template segment<3>(6 * o + 3),
                 tau = c.change.transpose() * mu;
      const Vec3 in_space = frame * g;
      r_.template segment<3>(row(i)) += in_space;
      r_.template segment<3>(row(i) + 3) += back * tau;
      r_.template segment<3>(row(r)) -= in_space;
      r_.template segment<3>(row(r) + 3) -= tau + cross(relative.y[i], g);

      // derivatives of τ_i, then of the moment on r, −(τ_i + y_i × g_i), then of the force and moment on i
      using Rows = Eigen::Matrix<double, 3, unknowns>;
      const auto forces = by.template middleRows<3>(6 * o);
      const Mat3 bend = change_by_vector(relative.vector[i], mu, 1), pull = skew(g);
      Rows moments = c.change.transpose().lazyProduct(by.template middleRows<3>(6 * o + 3));
      block(moments, 0, row(i) + 3) += bend * c.turn;
      block(moments, 0, row(r) + 3) += bend * c.counter;
      k_.template middleRows<3>(row(r) + 3) -= moments + skew(relative.y[i]).lazyProduct(forces);
      block(k_, row(r) + 3, row(i)) += pull * c.place;
      block(k_, row(r) + 3, row(r)) -= pull * c.place;
      block(k_, row(r) + 3, row(r) + 3) += pull * c.arm;

      auto on_place = k_.template middleRows<3>(row(i));
      on_place = frame.lazyProduct(forces);
      block(k_, row(i), row(r) + 3) += frame * pull * c.phi_counter;
      k_.template middleRows<3>(row(r)) -= on_place;
      block(moments, 0, row(i) + 3) += skew(tau) * c.phi;
      block(moments, 0, row(r) + 3) += skew(tau) * c.phi_counter;
      k_.template middleRows<3>(row(i) + 3) = back.lazyProduct(moments);
    }
  }

  void add_inertia() {
    std::array<Vec3, Nodes> acceleration;
    std::array<Mat3, Nodes> by_turn;
    const bool aside = piece_.has_mass_aside();
    for (std::size_t i = 0; i < Nodes; ++i) {
      const NodeState& node = state_.nodes[i];
      acceleration[i] = node.a - state_.gravity;
      if (!aside) continue;
      const Vec3& arm = piece_.centers[i];
      const Vec3 sweep = cross(node.W, arm), own = cross(node.A, arm) + cross(node.W, sweep);
      acceleration[i] += node.R * own;
      by_turn[i] = -node.R * (weights_.q * skew(own) * node.T + weights_.a * skew(arm) +
                              weights_.v * (skew(sweep) + skew(node.W) * skew(arm)));
    }
    for (std::size_t i = 0; i < Nodes; ++i) {
      const NodeState& node = state_.nodes[i];
      const Mat3& tensor = piece_.inertia[i];
      Vec3 force = Vec3::Zero();
      for (std::size_t j = 0; j < Nodes; ++j) {
        const double shared = piece_.mass(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        force += shared * acceleration[j];
        block(k_, row(i), row(j)).diagonal().array() += weights_.a * shared;
        if (!aside) continue;
        block(k_, row(i), row(j) + 3) += shared * by_turn[j];
        const Mat3 lever = shared * skew(piece_.centers[i]) * node.R.transpose();
        block(k_, row(i) + 3, row(j)) += weights_.a * lever;
        block(k_, row(i) + 3, row(j) + 3) += lever * by_turn[j];
      }
      const Vec3 spin = tensor * node.W;
      r_.template segment<3>(row(i)) += force;
      r_.template segment<3>(row(i) + 3) += tensor * node.A + cross(node.W, spin);
      block(k_, row(i) + 3, row(i) + 3) += weights_.a * tensor + weights_.v * (skew(node.W) * tensor - skew(spin));
      if (!aside) continue;
      const Vec3 own = node.R.transpose() * force;
      r_.template segment<3>(row(i) + 3) += cross(piece_.centers[i], own);
      block(k_, row(i) + 3, row(i) + 3) += weights_.q * skew(piece_.centers[i]) * skew(own) * node.T;
    }
  }

  const BeamPiece& piece_;
  const State& state_;
  const Weights weights_;
  const bool damped_;
  Eigen::Map<Eigen::Matrix<double, unknowns, 1>> r_;
  Eigen::Map<Eigen::Matrix<double, unknowns, unknowns, Eigen::RowMajor>> k_;
  Eigen::Matrix<double, others, 1> force_;  ///< g_i and μ_i
  Inner by_place_, by_rate_;                ///< derivatives of `force_` by y_i and ψ_i, and by ẏ_i and ψ̇_i
};

template <int Nodes>
void BeamPiece<Nodes>::tangent(const State& state, Weights weights, std::span<double> r, std::span<double> k) const {
  Tangent(*this, state, weights, r, k);
}

template void BeamPiece<2>::tangent(const State&, Weights, std::span<double>, std::span<double>) const;
template void BeamPiece<3>::tangent(const State&, Weights, std::span<double>, std::span<double>) const;

}  // namespace engrane::elements::beams
