// SPDX-License-Identifier: BSD-3-Clause
// A piece of a beam: the finite element with two or three nodes.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "elements/beams/beam_strain.hpp"
#include "elements/common/rotation_vector.hpp"
#include "elements/common/warmth.hpp"
#include "math/chain.hpp"
#include "model/templated_block.hpp"

namespace engrane::elements::beams {

/// Data of a piece and its residual. Nodes are ordered along the piece. The reference node r is the first of two or the middle
/// one of three. With the rotations relative to it,
///
///     ψ_i = log(R_rᵀ R_i),   ψ = Σ N_i ψ_i,   y_i = R_rᵀ (x_i − x_r),   h = Σ N_i′ y_i
///
/// the strains (BeamStrain) are objective (invariant under rigid-body motion) and path-independent. Stiffness: reduced
/// integration, with one Gauss point fewer than nodes, which avoids locking. Inertia: consistent mass on the line of centres of
/// mass, whose points move rigidly with the nodes; inertia tensors of the sections lumped at the nodes. Momentum and rigid-body
/// motion are exact.
///
/// Warm pieces: the stretch α ΔT causes no stress. It is uniform in a section, and the section keeps its size.
///
/// Each strain constrained to zero (BeamSection::held) has a multiplier at each Gauss point, ordered by point. The constraint
/// is Φ = −strain · length and the multiplier is the constraint force.
template <int Nodes>
struct BeamPiece {
  static constexpr int points = Nodes - 1;
  static constexpr std::size_t reference = Nodes == 3 ? 1 : 0;
  /// Limit on |ψ_i|, rad, beyond which the residual is NaN. Rotation vectors are unique up to π, but the interpolation becomes
  /// inaccurate earlier.
  static constexpr double most_turn = 2;

  struct Point {
    double length = 0;                           ///< Gauss weight times Jacobian: its share of the length at rest
    std::array<double, Nodes> shape{}, slope{};  ///< N_i and their derivatives by arc length at rest
    Mat3 axes;                                   ///< of the section at rest, as columns
    std::shared_ptr<const BeamSection> section;
  };
  std::array<Point, static_cast<std::size_t>(points)> at{};
  std::shared_ptr<const BeamSection> section;  ///< in the middle of the piece
  /// Positions of the nodes at rest, for small displacements; nullptr: large displacements.
  std::shared_ptr<const std::array<Vec3, Nodes>> small;
  std::array<Mat3, Nodes> axes;  ///< of the sections at the nodes at rest
  Eigen::Matrix<double, Nodes, Nodes> mass;
  std::array<Vec3, Nodes> centers;  ///< centre of mass relative to each node, in body axes that are the global ones at rest
  std::array<Mat3, Nodes> inertia;  ///< about these centres, in the same axes
  NodeWarmth warmth;

  template <class T>
  void evaluate(const Motion<T, Nodes>& motion, const State& state, Balance<T, Nodes>& balance) const {
    if (small)
      resist_small(motion, state.time, balance);
    else if (section->damping > 0)
      resist<true>(motion, state.time, balance);
    else
      resist<false>(motion, state.time, balance);
    if (section->has_mass()) add_inertia(motion, state, balance);
  }

  /// Whether there is a closed-form tangent. Pieces with held strains or small displacements differentiate evaluate() instead.
  bool has_tangent() const { return !small && section->held.empty(); }
  /// Residual and closed-form tangent, with six unknowns per node.
  void tangent(const State& state, Weights weights, std::span<double> r, std::span<double> k) const;

  /// α ΔT at a point, and its rate.
  double free_stretch(std::size_t point, double time) const {
    return warmth ? at[point].section->expansion * rise_at(warmth, at[point].shape, time) : 0;
  }
  double free_stretch_rate(std::size_t point, double time) const {
    return warmth ? at[point].section->expansion * rise_rate_at(warmth, at[point].shape, time) : 0;
  }
  /// Strains ε at a point that cause stress: all but the free stretch.
  Vec6 strain(const Motion<double, Nodes>& motion, std::size_t point, double time) const {
    Vec6 strain = small ? map(small_strain(at[point], small_shift(motion), small_turn(motion)))
                        : map(BeamStrain<double>(Relative<double>(motion).at(at[point]), at[point].axes).strain());
    strain[0] -= free_stretch(point, time);
    return strain;
  }
  /// Elastic stress resultants at a point, without damping and constraint forces. Half their product with the strains is the
  /// strain energy per unit length.
  Vec6 stress(std::size_t point, const Vec6& strain) const { return at[point].section->stiffness * strain; }
  /// Stress resultants at a point due to the constraint forces of held strains.
  Vec6 holding(const State& state, std::size_t point) const {
    Vec6 sum = Vec6::Zero();
    const std::vector<Vec6>& held = at[point].section->held;
    for (std::size_t i = 0; i < held.size(); ++i) sum += state.multipliers[point * held.size() + i] * held[i];
    return sum;
  }
  Vec6 strain_rate(const Motion<double, Nodes>& motion, std::size_t point) const {
    if (small) return map(small_strain(at[point], velocities(motion), spins(motion)));
    const Relative<double> relative(motion);
    return map(BeamStrain<double>(relative.at(at[point]), at[point].axes).strain_rate(relative.rates(motion).at(at[point])));
  }

 private:
  class Tangent;

  bool has_mass_aside() const {
    return std::any_of(centers.begin(), centers.end(), [](const Vec3& arm) { return !arm.isZero(0); });
  }

  static Vec6 map(const std::array<double, 6>& values) { return Eigen::Map<const Vec6>(values.data()); }

  /// y_i and ψ_i, or their rates. Entries of the reference node are unused: they are zero by definition.
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

  /// C ε.
  template <class S>
  static std::array<S, 6> elastic(const BeamSection& section, const std::array<S, 6>& strain) {
    std::array<S, 6> stress;
    for (std::size_t row = 0; row < 6; ++row) {
      stress[row] = S(0);
      for (std::size_t c = 0; c < 6; ++c) {
        const double stiffness = section.stiffness(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(c));
        if (stiffness != 0) stress[row] += strain[c] * stiffness;
      }
    }
    return stress;
  }

  template <class S>
  static std::array<S, 6> strains(const Point& point, const std::array<S, BeamPlace<S>::size>& x) {
    return BeamStrain<S>(BeamPlace<S>::of(x.data()), point.axes).strain();
  }

  /// Adds the constraints Φ of the strains held at a point to the balance; returns their multipliers.
  template <class T>
  std::array<T, 3> hold(std::size_t point, const std::array<T, 6>& strain, Balance<T, Nodes>& balance) const {
    const std::vector<Vec6>& held = at[point].section->held;
    std::array<T, 3> force = {T(0), T(0), T(0)};
    for (std::size_t i = 0; i < held.size(); ++i) {
      T value(0);
      for (std::size_t c = 0; c < 6; ++c)
        if (const double part = held[i][static_cast<Eigen::Index>(c)]; part != 0) value += strain[c] * part;
      force[i] = balance.constraint(static_cast<int>(point * held.size() + i), value * (-at[point].length));
    }
    return force;
  }

  /// Adds the constraint forces of held strains to the stress resultants.
  template <class S>
  static void add_held(const BeamSection& section, const S* force, std::array<S, 6>& stress) {
    for (std::size_t i = 0; i < section.held.size(); ++i)
      for (std::size_t c = 0; c < 6; ++c)
        if (const double part = section.held[i][static_cast<Eigen::Index>(c)]; part != 0) stress[c] += force[i] * part;
  }

  /// Generalised forces conjugate to h, ψ, ψ′ at a point with a free stretch. `x` holds h, ψ, ψ′, then their rates (damped
  /// sections), then the multipliers (held strains).
  template <bool Damped, bool Held, class S, std::size_t Size>
  std::array<S, BeamPlace<S>::size> forces(const Point& point, double free_stretch, const std::array<S, Size>& x) const {
    const BeamStrain<S> strain(BeamPlace<S>::of(x.data()), point.axes);
    std::array<S, 6> total = strain.strain();
    if (free_stretch != 0) total[0] -= S(free_stretch);
    if constexpr (Damped) {
      const auto rate = strain.strain_rate(BeamPlace<S>::of(x.data() + BeamPlace<S>::size));
      for (std::size_t c = 0; c < 6; ++c) total[c] += rate[c] * section->damping;
    }
    std::array<S, 6> stress = elastic(*point.section, total);
    if constexpr (Held) add_held(*point.section, x.data() + (Size - 3), stress);
    std::array<S, BeamPlace<S>::size> out;
    strain.forces(stress).copy_to(out.data());
    return out;
  }

  template <bool Damped, bool Held, class T>
  BeamPlace<T> point_forces(std::size_t p, const Relative<T>& relative, const Arms<T>& rates, double time,
                            Balance<T, Nodes>& balance) const {
    constexpr std::size_t size = BeamPlace<T>::size;
    std::array<T, (Damped ? 2 * size : size) + (Held ? 3 : 0)> x;
    const BeamPlace<T> place = relative.at(at[p]);
    place.copy_to(x.data());
    if constexpr (Damped) rates.at(at[p]).copy_to(x.data() + size);
    if constexpr (Held) {
      std::array<T, size> own;
      place.copy_to(own.data());
      const auto force = hold(p, through_few<6>(own, [&](const auto& numbers) { return strains(at[p], numbers); }), balance);
      std::copy(force.begin(), force.end(), x.end() - 3);
    }
    const double stretch = free_stretch(p, time);
    const auto f = through_few<size>(x, [&](const auto& own) { return forces<Damped, Held>(at[p], stretch, own); });
    return BeamPlace<T>::of(f.data());
  }

  template <bool Damped, class T>
  void resist(const Motion<T, Nodes>& motion, double time, Balance<T, Nodes>& balance) const {
    const Relative<T> relative(motion);
    Arms<T> rates;
    if constexpr (Damped) rates = relative.rates(motion);
    const Vec3T<T> none(T(0), T(0), T(0));
    std::array<Vec3T<T>, Nodes> force, moment;  // conjugate to y_i and ψ_i
    force.fill(none);
    moment.fill(none);
    for (std::size_t p = 0; p < at.size(); ++p) {
      const Point& point = at[p];
      const auto of = section->held.empty() ? point_forces<Damped, false>(p, relative, rates, time, balance)
                                            : point_forces<Damped, true>(p, relative, rates, time, balance);
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
  using Vectors = std::array<Vec3T<T>, Nodes>;

  template <class T>
  Vectors<T> small_shift(const Motion<T, Nodes>& motion) const {
    Vectors<T> u;
    for (std::size_t i = 0; i < Nodes; ++i) u[i] = motion.node[i].x - (*small)[i].template cast<T>();
    return u;
  }
  template <class T>
  static Vectors<T> small_turn(const Motion<T, Nodes>& motion) {
    Vectors<T> theta;
    for (std::size_t i = 0; i < Nodes; ++i) theta[i] = RotationVector<T>::of(motion.node[i].R).theta;
    return theta;
  }
  template <class T>
  static Vectors<T> velocities(const Motion<T, Nodes>& motion) {
    Vectors<T> v;
    for (std::size_t i = 0; i < Nodes; ++i) v[i] = motion.node[i].v;
    return v;
  }
  template <class T>
  static Vectors<T> spins(const Motion<T, Nodes>& motion) {
    Vectors<T> w;
    for (std::size_t i = 0; i < Nodes; ++i) w[i] = rotate(motion.node[i].R, motion.node[i].W);
    return w;
  }

  /// Strains linearised at rest: γ = u′ + x′ × θ, k = θ′.
  template <class T>
  static std::array<T, 6> small_strain(const Point& point, const Vectors<T>& u, const Vectors<T>& theta) {
    Vec3T<T> slope(T(0), T(0), T(0)), turn = slope, twist = slope;
    for (std::size_t i = 0; i < Nodes; ++i) {
      slope += u[i] * point.slope[i];
      turn += theta[i] * point.shape[i];
      twist += theta[i] * point.slope[i];
    }
    const Vec3T<T> first = point.axes.col(0).template cast<T>();
    const Vec3T<T> gamma = rotate_back(point.axes, Vec3T<T>(slope + cross(first, turn))), k = rotate_back(point.axes, twist);
    return {gamma[0], gamma[1], gamma[2], k[0], k[1], k[2]};
  }

  /// Forces linear in the displacements and moments linear in the rotation vectors. Both are in global axes, so that
  /// equilibrium with given forces and moments is a linear system.
  template <class T>
  void resist_small(const Motion<T, Nodes>& motion, double time, Balance<T, Nodes>& balance) const {
    const auto u = small_shift(motion), theta = small_turn(motion);
    for (std::size_t p = 0; p < at.size(); ++p) {
      const Point& point = at[p];
      std::array<T, 6> total = small_strain(point, u, theta);
      const auto held = hold(p, total, balance);
      total[0] -= T(free_stretch(p, time));
      if (section->damping > 0) {
        const auto rate = small_strain(point, velocities(motion), spins(motion));
        for (std::size_t c = 0; c < 6; ++c) total[c] += rate[c] * section->damping;
      }
      std::array<T, 6> stress = elastic(*point.section, total);
      add_held(*point.section, held.data(), stress);
      const Vec3T<T> n = rotate(point.axes, Vec3T<T>(stress[0], stress[1], stress[2]));
      const Vec3T<T> m = rotate(point.axes, Vec3T<T>(stress[3], stress[4], stress[5]));
      const Vec3T<T> turning = cross(n, Vec3T<T>(point.axes.col(0).template cast<T>()));
      for (std::size_t i = 0; i < Nodes; ++i) {
        balance.force(static_cast<int>(i), n * (point.length * point.slope[i]));
        const Vec3T<T> moment = turning * (point.length * point.shape[i]) + m * (point.length * point.slope[i]);
        balance.moment(static_cast<int>(i), moment_on_node(motion.node[i].R, moment));
      }
    }
  }

  /// With small displacements the arms to the centres of mass keep their directions, so that weight gives constant moments.
  template <class T>
  void add_inertia(const Motion<T, Nodes>& motion, const State& state, Balance<T, Nodes>& balance) const {
    std::array<Vec3T<T>, Nodes> acceleration;
    const bool aside = has_mass_aside();
    for (std::size_t i = 0; i < Nodes; ++i) {
      const auto& node = motion.node[i];
      acceleration[i] = node.a - state.gravity.template cast<T>();
      if (aside) {
        const Vec3T<T> arm = centers[i].template cast<T>();
        acceleration[i] += small ? Vec3T<T>(cross(node.A, arm))
                                 : rotate(node.R, Vec3T<T>(cross(node.A, arm) + cross(node.W, Vec3T<T>(cross(node.W, arm)))));
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
      if (aside) {
        const Vec3T<T> arm = centers[i].template cast<T>();
        moment += cross(arm, small ? force : Vec3T<T>(rotate_back(node.R, force)));
      }
      balance.moment(static_cast<int>(i), moment);
    }
  }
};

/// Includes lanes for the multipliers of held strains, also for pieces without any. Separate sweeps for those would double the
/// compile time, and only pieces with small displacements would gain.
template <int Nodes>
using BeamSweep = TemplatedBlock<BeamPiece<Nodes>, Nodes, 6 * Nodes + 3 * (Nodes - 1)>;

/// Block of all pieces of a model with this number of nodes and the same held strains. `Held`: whether any strain is held.
template <int Nodes, bool Held>
class Beams final : public BeamSweep<Nodes> {
 public:
  Beams(bool inextensible, bool unshearable);
  ~Beams() override;

  void tangent(std::size_t first, std::span<const State> states, Weights weights, std::span<double> r,
               std::span<double> k) const override;
  Energies energies(std::size_t e, const State& state) const override;
  bool is_body() const override { return true; }
  bool keeps_shape() const override { return true; }
  bool is_linear(std::size_t e) const override { return this->data(e).small != nullptr; }
  const char* why_not_finite() const override {
    return "is bent or twisted by more than 2 radians between two of its nodes: more pieces, smaller steps H, "
           "or loads that grow from zero (NF)";
  }
  Mat3 inertia_at(std::size_t e, int node) const override;
  const std::vector<Channel>& channels() const override;
  void observe(std::size_t e, const State& state, std::span<double> values) const override;
  const std::vector<Field>& fields() const override;
  void evaluate_fields(std::size_t e, const State& state, std::span<double> values) const override;
  std::vector<Derived> derived(std::size_t e) const override;
  Drawing drawing(std::size_t e) const override;
};

extern template class Beams<2, false>;
extern template class Beams<3, false>;
extern template class Beams<2, true>;
extern template class Beams<3, true>;

}  // namespace engrane::elements::beams

// Instantiated once in beam_piece.cpp: sweeps of dual numbers take long to compile.
extern template class engrane::TemplatedBlock<engrane::elements::beams::BeamPiece<2>, 2, 15>;
extern template class engrane::TemplatedBlock<engrane::elements::beams::BeamPiece<3>, 3, 24>;
