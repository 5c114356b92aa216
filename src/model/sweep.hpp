// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <memory>
#include <utility>

#include "math/dual.hpp"
#include "math/taylor.hpp"
#include "model/element.hpp"

namespace engrane {

/// Up to N numbers, of which only `count` are constructed: numbers with derivatives are large.
template <class T, std::size_t N>
class UpTo {
 public:
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
  explicit UpTo(std::size_t count) {
    assert(count <= N);
    for (std::size_t i = 0; i < count; ++i) new (raw_ + i * sizeof(T)) T(0);
  }

  T& operator[](std::size_t i) { return *std::launder(reinterpret_cast<T*>(raw_ + i * sizeof(T))); }
  const T& operator[](std::size_t i) const { return *std::launder(reinterpret_cast<const T*>(raw_ + i * sizeof(T))); }

 private:
  alignas(T) std::byte raw_[N * sizeof(T)];
};

/// Motion of an element's nodes and unknowns in numbers of type T (double, Dual<N> or Taylor). All values, including `time`,
/// are copied from the state without derivatives.
template <class T, int Nodes>
struct Motion {
  explicit Motion(const State& state)
      : scalar(state.scalars.size()),
        scalar_rate(state.scalars.size()),
        scalar_acceleration(state.scalars.size()),
        time(state.time) {
    const auto fill = [](Vec3T<T>& to, const Vec3& from) {
      for (int c = 0; c < 3; ++c) to[c] = T(from[c]);
    };
    for (std::size_t i = 0; i < state.nodes.size(); ++i) {
      const NodeState& s = state.nodes[i];
      fill(node[i].x, s.x);
      fill(node[i].v, s.v);
      fill(node[i].W, s.W);
      fill(node[i].a, s.a);
      fill(node[i].A, s.A);
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) node[i].R(a, b) = T(s.R(a, b));
    }
    for (std::size_t i = 0; i < state.scalars.size(); ++i) {
      scalar[i] = T(state.scalars[i]);
      scalar_rate[i] = T(state.scalar_rates[i]);
      scalar_acceleration[i] = T(state.scalar_accelerations[i]);
    }
  }

  struct Node {
    Vec3T<T> x;
    Mat3T<T> R;
    Vec3T<T> v, W, a, A;
  };
  std::array<Node, static_cast<std::size_t>(Nodes)> node;
  UpTo<T, 8> scalar, scalar_rate, scalar_acceleration;
  T time;
};

/// Accumulates a residual in numbers of type T.
template <class T, int Nodes>
class Balance {
 public:
  Balance(const State& state)  // NOLINT(google-explicit-constructor)
      : state_(state), scalar_(state.scalars.size()), constraint_(state.multipliers.size()) {
    force_.fill(Vec3T<T>(T(0), T(0), T(0)));
    moment_.fill(Vec3T<T>(T(0), T(0), T(0)));
  }

  /// Adds a resisting force of the element at a node (global components).
  void force(int node, const Vec3T<T>& f) { force_[static_cast<std::size_t>(node)] += f; }
  /// Adds a resisting moment of the element at a node (material components of the node).
  void moment(int node, const Vec3T<T>& m) { moment_[static_cast<std::size_t>(node)] += m; }
  /// Adds to the row of an internal unknown.
  void scalar(int i, const T& f) { scalar_[static_cast<std::size_t>(i)] += f; }

  /// Sets constraint i to the value phi and returns the force kλ − pΦ along its gradient (paper, eq. 2). The caller then
  /// subtracts that force times ∂Φ/∂q by force(), moment() and scalar().
  T constraint(int i, const T& phi) {
    constraint_[static_cast<std::size_t>(i)] = phi;
    T force(state_.multipliers[static_cast<std::size_t>(i)]);
    if constexpr (!std::is_same_v<T, double> && !std::is_same_v<T, Taylor>)
      if (multiplier_lane_ >= 0) force.d[static_cast<std::size_t>(multiplier_lane_ + i)] += multiplier_weight_;
    return force - state_.penalty * phi;
  }

  double contact_homotopy() const { return state_.contact_homotopy; }

  const Vec3T<T>& force_at(int node) const { return force_[static_cast<std::size_t>(node)]; }
  const Vec3T<T>& moment_at(int node) const { return moment_[static_cast<std::size_t>(node)]; }
  const T& scalar_at(int i) const { return scalar_[static_cast<std::size_t>(i)]; }
  const T& constraint_at(int i) const { return constraint_[static_cast<std::size_t>(i)]; }

  /// Seeds the derivative of multiplier i in lane `first` + i from now on.
  void differentiate_multipliers(int first, double weight) {
    multiplier_lane_ = first;
    multiplier_weight_ = weight;
  }

 private:
  const State& state_;
  std::array<Vec3T<T>, static_cast<std::size_t>(Nodes)> force_, moment_;
  UpTo<T, 8> scalar_;
  UpTo<T, 16> constraint_;
  int multiplier_lane_ = -1;
  double multiplier_weight_ = 0;
};

/// For each node of a layout: first slots of its translations and rotations (−1 if none), and number of translations.
/// `lane_slots` receives the slots that have a tangent column. Returns the number of slots.
std::size_t plan_sweep(const Layout& layout, std::span<int> translation, std::span<int> rotation, std::span<int> directions,
                       std::vector<std::size_t>& lane_slots);

/// A layout, and the evaluation of a residual templated on its number type as residual, exact tangent and constraint rates.
/// `evaluate(const Motion<T, Nodes>&, Balance<T, Nodes>&)` is that residual. The tangent is one evaluation in dual numbers:
/// each lane varies displacement, velocity and acceleration of one unknown in the proportion cq : cv : ca. `Lanes` is the
/// maximum number of unknowns (those of ground nodes excluded).
template <int Nodes, int Lanes>
class Sweep {
 public:
  Sweep() = default;
  explicit Sweep(Layout layout) : layout_(std::move(layout)) {
    slots_ = plan_sweep(layout_, translation_, rotation_, directions_, lane_slots_);
    first_scalar_ = static_cast<std::size_t>(layout_.node_slots());
    first_multiplier_ = first_scalar_ + layout_.scalars.size();
    assert(lane_slots_.size() <= static_cast<std::size_t>(Lanes) && "Lanes is too small for this element");
  }

  const Layout& layout() const { return layout_; }
  std::size_t slots() const { return slots_; }
  std::size_t first_multiplier() const { return first_multiplier_; }
  /// First slot of a node's translations or rotations, or −1.
  int translation(std::size_t node) const { return translation_[node]; }
  int rotation(std::size_t node) const { return rotation_[node]; }

  template <class Evaluate>
  void residual(const State& state, std::span<double> r, Evaluate&& evaluate) const {
    Balance<double, Nodes> balance(state);
    evaluate(Motion<double, Nodes>(state), balance);
    each_row(balance, [&](std::size_t row, double value) { r[row] = value; });
    assert(nothing_else(balance));
  }

  template <class Evaluate>
  void tangent(const State& state, Weights w, std::span<double> r, std::span<double> k, Evaluate&& evaluate) const {
    using D = Dual<Lanes>;
    Motion<D, Nodes> m(state);
    Balance<D, Nodes> balance(state);
    std::size_t lane = 0;
    for (std::size_t i = 0; i < layout_.nodes.size(); ++i) {
      if (layout_.nodes[i] == 0) continue;
      const auto directions = static_cast<std::size_t>(directions_[i]);
      if (translation_[i] >= 0) seed_translation(m.node[i], w, std::exchange(lane, lane + directions), directions_[i]);
      if (rotation_[i] >= 0) seed_rotation(m.node[i], state.nodes[i], w, std::exchange(lane, lane + 3));
    }
    for (std::size_t i = 0; i < layout_.scalars.size(); ++i, ++lane) {
      m.scalar[i].d[lane] = w.q;
      m.scalar_rate[i].d[lane] = w.v;
      m.scalar_acceleration[i].d[lane] = w.a;
    }
    balance.differentiate_multipliers(static_cast<int>(lane), w.multipliers);
    evaluate(m, balance);

    std::fill(k.begin(), k.end(), 0.0);
    each_row(balance, [&](std::size_t row, const D& value) {
      r[row] = value.value;
      double* to = &k[row * slots_];
      for (std::size_t j = 0; j < lane_slots_.size(); ++j) to[lane_slots_[j]] = value.d[j];
    });
  }

  template <class Evaluate>
  void constraint_rates(const State& state, std::span<double> phi, std::span<double> rate, std::span<double> second,
                        Evaluate&& evaluate) const {
    Motion<Taylor, Nodes> m(state);
    for (std::size_t i = 0; i < layout_.nodes.size(); ++i) {
      const NodeState& s = state.nodes[i];
      // R exp(Wt + ½At²) to second order
      const Mat3 W = skew(s.W);
      const Mat3 R1 = s.R * W;
      const Mat3 R2 = s.R * (skew(s.A) + W * W);
      for (int a = 0; a < 3; ++a) {
        m.node[i].x[a] = {s.x[a], s.v[a], s.a[a]};
        for (int b = 0; b < 3; ++b) m.node[i].R(a, b) = {s.R(a, b), R1(a, b), R2(a, b)};
      }
    }
    for (std::size_t i = 0; i < layout_.scalars.size(); ++i)
      m.scalar[i] = {state.scalars[i], state.scalar_rates[i], state.scalar_accelerations[i]};
    m.time = {state.time, 1, 0};
    Balance<Taylor, Nodes> balance(state);
    evaluate(m, balance);
    for (std::size_t i = 0; i < layout_.multipliers.size(); ++i) {
      const Taylor& c = balance.constraint_at(static_cast<int>(i));
      phi[i] = c.value;
      rate[i] = c.d1;
      second[i] = c.d2;
    }
  }

  /// Seeds lanes `lane` to `lane` + 2 with translations along the global axes, or rotations about the axes of the node.
  template <class Node>
  static void seed_translation(Node& node, Weights w, std::size_t lane, int directions = 3) {
    for (int c = 0; c < directions; ++c, ++lane) {
      node.x[c].d[lane] = w.q;
      node.v[c].d[lane] = w.v;
      node.a[c].d[lane] = w.a;
    }
  }
  template <class Node>
  static void seed_rotation(Node& node, const NodeState& s, Weights w, std::size_t lane) {
    for (int c = 0; c < 3; ++c, ++lane) {
      const Mat3 dR = s.R * skew(s.T.col(c) * w.q);
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) node.R(a, b).d[lane] = dR(a, b);
      node.W[c].d[lane] = w.v;
      node.A[c].d[lane] = w.a;
    }
  }

  /// Calls `write(row, value)` for every row that has a slot.
  template <class T, class Write>
  void each_row(const Balance<T, Nodes>& balance, Write&& write) const {
    for (std::size_t i = 0; i < layout_.nodes.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        if (translation_[i] >= 0 && c < directions_[i])
          write(static_cast<std::size_t>(translation_[i] + c), balance.force_at(static_cast<int>(i))[c]);
        if (rotation_[i] >= 0) write(static_cast<std::size_t>(rotation_[i] + c), balance.moment_at(static_cast<int>(i))[c]);
      }
    for (std::size_t i = 0; i < layout_.scalars.size(); ++i) write(first_scalar_ + i, balance.scalar_at(static_cast<int>(i)));
    for (std::size_t i = 0; i < layout_.multipliers.size(); ++i)
      write(first_multiplier_ + i, -balance.constraint_at(static_cast<int>(i)));
  }

 private:
  /// Whether unknowns outside the layout have no force or moment. Zeros and NaNs are ignored.
  bool nothing_else(const Balance<double, Nodes>& balance) const {
    for (std::size_t i = 0; i < layout_.nodes.size(); ++i)
      for (int c = 0; c < 3; ++c)
        if ((translation_[i] < 0 && std::abs(balance.force_at(static_cast<int>(i))[c]) > 0) ||
            (rotation_[i] < 0 && std::abs(balance.moment_at(static_cast<int>(i))[c]) > 0))
          return false;
    return true;
  }

  Layout layout_;
  std::array<int, static_cast<std::size_t>(Nodes)> translation_{}, rotation_{}, directions_{};
  std::size_t first_scalar_ = 0, first_multiplier_ = 0, slots_ = 0;
  std::vector<std::size_t> lane_slots_;  ///< slot of every lane
};

}  // namespace engrane
