// SPDX-License-Identifier: BSD-3-Clause
// A piece of a beam: two or three nodes.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "elements/beams/beam_strain.hpp"
#include "elements/common/rotation_vector.hpp"
#include "math/chain.hpp"
#include "model/templated_block.hpp"

namespace engrane::elements::beams {

/// Data of a piece, and its residual. Nodes stand along it; the reference node is the first of two, the middle one of three. With
/// the rotations of the others from it,
///
///     ψ_i = log(R_rᵀ R_i),   ψ = Σ N_i ψ_i,   y_i = R_rᵀ (x_i − x_r),   h = Σ N_i′ y_i
///
/// strains (BeamStrain) do not change when the piece moves as a body, nor depend on how it came where it is. Stiffness: one point
/// of Gauss less than nodes, which is free of locking. Inertia: masses consistent with N_i on the line of centres of mass, whose
/// points the nodes carry; tensors of the sections at the nodes. Momentum, and any motion as a body, are exact.
template <int Nodes>
struct BeamPiece {
  static constexpr int points = Nodes - 1;
  static constexpr std::size_t reference = Nodes == 3 ? 1 : 0;
  /// Half a turn is the end of what a rotation vector tells; before, the shape functions have ceased to follow the beam.
  static constexpr double most_turn = 2;

  struct Point {
    double length = 0;                           ///< of the piece that it stands for, at rest
    std::array<double, Nodes> shape{}, slope{};  ///< N_i, and their slopes by the length at rest
    Mat3 axes;                                   ///< of the section at rest, columns
  };
  std::array<Point, static_cast<std::size_t>(points)> at{};
  std::shared_ptr<const BeamSection> section;
  std::array<Mat3, Nodes> axes;  ///< of the sections at the nodes at rest
  Eigen::Matrix<double, Nodes, Nodes> mass;
  std::array<Vec3, Nodes> centers;  ///< where each node carries the mass, from the node at rest
  std::array<Mat3, Nodes> inertia;  ///< about these centres, in axes that are the global ones at rest

  template <class T>
  void evaluate(const Motion<T, Nodes>& motion, const State& state, Balance<T, Nodes>& balance) const {
    if (section->damping > 0)
      resist<true>(motion, balance);
    else
      resist<false>(motion, balance);
    if (section->has_mass()) add_inertia(motion, state, balance);
  }

  /// Strains ε at a point.
  std::array<double, 6> strain(const Motion<double, Nodes>& motion, std::size_t point) const {
    return BeamStrain<double>(Relative<double>(motion).at(at[point]), at[point].axes).strain();
  }
  /// Forces and moments of the section at a point, without damping; half their product with the strains is the energy there.
  Vec6 stress(const std::array<double, 6>& strain) const { return section->stiffness * Eigen::Map<const Vec6>(strain.data()); }
  Vec6 strain_rate(const Motion<double, Nodes>& motion, std::size_t point) const {
    const Relative<double> relative(motion);
    const auto rate =
        BeamStrain<double>(relative.at(at[point]), at[point].axes).strain_rate(relative.rates(motion).at(at[point]));
    return Eigen::Map<const Vec6>(rate.data());
  }

 private:
  /// y_i and ψ_i, or their rates; those of the reference node are zero.
  template <class T>
  struct Arms {
    std::array<Vec3T<T>, Nodes> y, psi;

    BeamPlace<T> at(const Point& point) const {
      BeamPlace<T> place{Vec3T<T>(T(0), T(0), T(0)), Vec3T<T>(T(0), T(0), T(0)), Vec3T<T>(T(0), T(0), T(0))};
      for (std::size_t i = 0; i < Nodes; ++i) {
        if (i == reference) continue;
        place.h += y[i] * point.slope[i];
        place.psi += psi[i] * point.shape[i];
        place.psi_slope += psi[i] * point.slope[i];
      }
      return place;
    }
  };

  template <class T>
  struct Relative : Arms<T> {
    explicit Relative(const Motion<T, Nodes>& motion) {
      const auto& r = motion.node[reference];
      for (std::size_t i = 0; i < Nodes; ++i) {
        if (i == reference) continue;
        this->y[i] = rotate_back(r.R, Vec3T<T>(motion.node[i].x - r.x));
        for (int c = 0; c < 3; ++c) turn[i].col(c) = rotate_back(r.R, Vec3T<T>(motion.node[i].R.col(c)));
        vector[i] = RotationVector<T>::of(turn[i]);
        this->psi[i] = vector[i].theta;
        if (!(value_of(dot(this->psi[i], this->psi[i])) < most_turn * most_turn)) this->psi[i] *= T(std::nan(""));
      }
    }

    Arms<T> rates(const Motion<T, Nodes>& motion) const {
      const auto& r = motion.node[reference];
      Arms<T> rates;
      for (std::size_t i = 0; i < Nodes; ++i) {
        if (i == reference) continue;
        const auto& node = motion.node[i];
        rates.y[i] = rotate_back(r.R, Vec3T<T>(node.v - r.v)) - cross(r.W, this->y[i]);
        rates.psi[i] = vector[i].change(rotate(turn[i], node.W) - r.W);
      }
      return rates;
    }

    std::array<Mat3T<T>, Nodes> turn;  ///< R_rᵀ R_i
    std::array<RotationVector<T>, Nodes> vector;
  };

  /// Forces on h, ψ, ψ′ of a point; of a damped section by their rates too, which follow them in `x`.
  template <bool Damped, class S, std::size_t Size>
  std::array<S, BeamPlace<S>::size> forces(const Point& point, const std::array<S, Size>& x) const {
    const BeamStrain<S> strain(BeamPlace<S>::of(x.data()), point.axes);
    std::array<S, 6> total = strain.strain(), stress;
    if constexpr (Damped) {
      const auto rate = strain.strain_rate(BeamPlace<S>::of(x.data() + BeamPlace<S>::size));
      for (std::size_t c = 0; c < 6; ++c) total[c] += rate[c] * section->damping;
    }
    for (std::size_t row = 0; row < 6; ++row) {
      stress[row] = S(0);
      for (std::size_t c = 0; c < 6; ++c) {
        const double stiffness = section->stiffness(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(c));
        if (stiffness != 0) stress[row] += total[c] * stiffness;
      }
    }
    std::array<S, BeamPlace<S>::size> out;
    strain.forces(stress).copy_to(out.data());
    return out;
  }

  template <bool Damped, class T>
  void resist(const Motion<T, Nodes>& motion, Balance<T, Nodes>& balance) const {
    constexpr std::size_t size = BeamPlace<T>::size;
    const Relative<T> relative(motion);
    Arms<T> rates;
    if constexpr (Damped) rates = relative.rates(motion);
    const Vec3T<T> none(T(0), T(0), T(0));
    std::array<Vec3T<T>, Nodes> force, moment;  // on y_i and ψ_i
    force.fill(none);
    moment.fill(none);
    for (const Point& point : at) {
      std::array<T, Damped ? 2 * size : size> x;
      relative.at(point).copy_to(x.data());
      if constexpr (Damped) rates.at(point).copy_to(x.data() + size);
      const auto f = through_few<size>(x, [&](const auto& own) { return forces<Damped>(point, own); });
      const auto of = BeamPlace<T>::of(f.data());
      for (std::size_t i = 0; i < Nodes; ++i) {
        if (i == reference) continue;
        force[i] += of.h * (point.length * point.slope[i]);
        moment[i] += of.psi * (point.length * point.shape[i]) + of.psi_slope * (point.length * point.slope[i]);
      }
    }
    Vec3T<T> all_force = none, all_moment = none;  // on the reference node, in its axes
    for (std::size_t i = 0; i < Nodes; ++i) {
      if (i == reference) continue;
      const Vec3T<T> turning = relative.vector[i].moment(moment[i]);
      balance.force(static_cast<int>(i), rotate(motion.node[reference].R, force[i]));
      balance.moment(static_cast<int>(i), rotate_back(relative.turn[i], turning));
      all_force -= force[i];
      all_moment -= turning + cross(relative.y[i], force[i]);
    }
    balance.force(static_cast<int>(reference), rotate(motion.node[reference].R, all_force));
    balance.moment(static_cast<int>(reference), all_moment);
  }

  template <class T>
  void add_inertia(const Motion<T, Nodes>& motion, const State& state, Balance<T, Nodes>& balance) const {
    std::array<Vec3T<T>, Nodes> acceleration;
    const bool aside = !section->center.isZero(0);
    for (std::size_t i = 0; i < Nodes; ++i) {
      const auto& node = motion.node[i];
      acceleration[i] = node.a - state.gravity.template cast<T>();
      if (aside) {
        const Vec3T<T> arm = centers[i].template cast<T>();
        acceleration[i] += rotate(node.R, Vec3T<T>(cross(node.A, arm) + cross(node.W, Vec3T<T>(cross(node.W, arm)))));
      }
    }
    for (std::size_t i = 0; i < Nodes; ++i) {
      const auto& node = motion.node[i];
      Vec3T<T> force(T(0), T(0), T(0));
      for (std::size_t j = 0; j < Nodes; ++j)
        force += acceleration[j] * mass(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      balance.force(static_cast<int>(i), force);
      const Vec3T<T> spin = rotate(inertia[i], node.W);
      Vec3T<T> moment = rotate(inertia[i], node.A) + cross(node.W, spin);
      if (aside) moment += cross(Vec3T<T>(centers[i].template cast<T>()), rotate_back(node.R, force));
      balance.moment(static_cast<int>(i), moment);
    }
  }
};

/// All pieces of so many nodes of a model.
template <int Nodes>
class Beams final : public TemplatedBlock<BeamPiece<Nodes>, Nodes, 6 * Nodes> {
 public:
  Beams();

  Energies energies(std::size_t e, const State& state) const override;
  bool is_body() const override { return true; }
  const char* why_not_finite() const override {
    return "is bent or twisted by more than 2 radians between two of its nodes: more pieces, smaller steps H, "
           "or loads that grow from zero (NF)";
  }
  Mat3 inertia_at(std::size_t e, int node) const override;
  const std::vector<Named>& channels() const override;
  void observe(std::size_t e, const State& state, std::span<double> values) const override;
  const std::vector<Field>& fields() const override;
  void evaluate_fields(std::size_t e, const State& state, std::span<double> values) const override;
  std::vector<Derived> derived(std::size_t e) const override;
  Drawing drawing(std::size_t e) const override;
};

extern template class Beams<2>;
extern template class Beams<3>;

}  // namespace engrane::elements::beams
