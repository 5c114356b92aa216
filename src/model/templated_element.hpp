// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "math/dual.hpp"
#include "math/taylor.hpp"
#include "model/element.hpp"

namespace engrane {

/// State of an element's nodes and unknowns in numbers of type T (double, Dual<N> or Taylor).
template <class T, int Nodes>
struct Motion {
  struct Node {
    Vec3T<T> x;
    Mat3T<T> R;
    Vec3T<T> v, W, a, A;
  };
  std::array<Node, static_cast<std::size_t>(Nodes)> node;
  std::array<T, 8> scalar, scalar_rate, scalar_acceleration;
  T time;
};

/// Collects a residual in numbers of type T.
template <class T, int Nodes>
class Balance {
 public:
  Balance(const State& state) : state_(state) {  // NOLINT(google-explicit-constructor)
    force_.fill(Vec3T<T>(T(0), T(0), T(0)));
    moment_.fill(Vec3T<T>(T(0), T(0), T(0)));
    scalar_.fill(T(0));
    constraint_.fill(T(0));
  }

  /// Adds a force with which the element resists at a node (global components).
  void force(int node, const Vec3T<T>& f) { force_[static_cast<std::size_t>(node)] += f; }
  /// Adds a moment with which the element resists at a node (material components of the node).
  void moment(int node, const Vec3T<T>& m) { moment_[static_cast<std::size_t>(node)] += m; }
  /// Adds to the row of an own unknown.
  void scalar(int i, const T& f) { scalar_[static_cast<std::size_t>(i)] += f; }

  /// States that constraint i has the value phi and returns the force kλ − pΦ along its gradient (paper, eq. 2); the
  /// caller then subtracts that force times ∂Φ/∂q by force(), moment() and scalar().
  T constraint(int i, const T& phi) {
    constraint_[static_cast<std::size_t>(i)] = phi;
    return T(state_.multipliers[static_cast<std::size_t>(i)]) + multiplier_lane(i) - state_.penalty * phi;
  }

  double contact_homotopy() const { return state_.contact_homotopy; }

  const Vec3T<T>& force_at(int node) const { return force_[static_cast<std::size_t>(node)]; }
  const Vec3T<T>& moment_at(int node) const { return moment_[static_cast<std::size_t>(node)]; }
  const T& scalar_at(int i) const { return scalar_[static_cast<std::size_t>(i)]; }
  const T& constraint_at(int i) const { return constraint_[static_cast<std::size_t>(i)]; }

  /// Seed of multiplier i: set by the tangent, zero otherwise.
  std::array<T, 16> multiplier_seed{};

 private:
  T multiplier_lane(int i) const { return multiplier_seed[static_cast<std::size_t>(i)]; }

  const State& state_;
  std::array<Vec3T<T>, static_cast<std::size_t>(Nodes)> force_, moment_;
  std::array<T, 8> scalar_;
  std::array<T, 16> constraint_;
};

/// Base of elements that write one templated residual
///
///     template <class T> void evaluate(const Motion<T, Nodes>&, const State&, Balance<T, Nodes>&) const;
///
/// and get residual, exact tangent and constraint rates from it: the tangent by one sweep of dual numbers, each lane
/// moving one unknown with displacement, velocity and acceleration in the proportion cq : cv : ca.
/// `Lanes` is the largest number of unknowns the element can have (ground nodes and unneeded unknowns excluded).
template <class Derived, int Nodes, int Lanes>
class TemplatedElement : public Element {
 public:
  using Element::Element;

  const Layout& layout() const final { return layout_; }

  void residual(const State& state, std::span<double> r) const final {
    Balance<double, Nodes> balance(state);
    self().evaluate(motion<double>(state), state, balance);
    const auto nodes = layout_.nodes.size();
    for (std::size_t i = 0; i < nodes; ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        r[6 * i + c] = balance.force_at(static_cast<int>(i))[static_cast<Eigen::Index>(c)];
        r[6 * i + 3 + c] = balance.moment_at(static_cast<int>(i))[static_cast<Eigen::Index>(c)];
      }
    const std::size_t s0 = 6 * nodes, m0 = s0 + layout_.scalars.size();
    for (std::size_t i = 0; i < layout_.scalars.size(); ++i) r[s0 + i] = balance.scalar_at(static_cast<int>(i));
    for (std::size_t i = 0; i < layout_.multipliers.size(); ++i) r[m0 + i] = -balance.constraint_at(static_cast<int>(i));
  }

  void tangent(const State& state, Weights w, std::span<double> r, std::span<double> k) const override {
    using D = Dual<Lanes>;
    auto m = motion<D>(state);
    Balance<D, Nodes> balance(state);
    std::size_t lane = 0;
    for (std::size_t i = 0; i < layout_.nodes.size(); ++i) seed_node(m.node[i], state.nodes[i], i, w, lane);
    for (std::size_t i = 0; i < layout_.scalars.size(); ++i, ++lane) {
      m.scalar[i].d[lane] = w.q;
      m.scalar_rate[i].d[lane] = w.v;
      m.scalar_acceleration[i].d[lane] = w.a;
    }
    for (std::size_t i = 0; i < layout_.multipliers.size(); ++i, ++lane) balance.multiplier_seed[i].d[lane] = 1;
    assert(lane == lane_slots_.size());

    self().evaluate(m, state, balance);

    const std::size_t n = static_cast<std::size_t>(layout_.slots());
    std::fill(k.begin(), k.end(), 0.0);
    const auto write = [&](std::size_t row, const D& value, double sign) {
      r[row] = sign * value.value;
      for (std::size_t j = 0; j < lane; ++j) k[row * n + lane_slots_[j]] = sign * value.d[j];
    };
    const auto nodes = layout_.nodes.size();
    for (std::size_t i = 0; i < nodes; ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        write(6 * i + c, balance.force_at(static_cast<int>(i))[static_cast<Eigen::Index>(c)], 1);
        write(6 * i + 3 + c, balance.moment_at(static_cast<int>(i))[static_cast<Eigen::Index>(c)], 1);
      }
    const std::size_t s0 = 6 * nodes, m0 = s0 + layout_.scalars.size();
    for (std::size_t i = 0; i < layout_.scalars.size(); ++i) write(s0 + i, balance.scalar_at(static_cast<int>(i)), 1);
    for (std::size_t i = 0; i < layout_.multipliers.size(); ++i) write(m0 + i, balance.constraint_at(static_cast<int>(i)), -1);
  }

  void constraint_rates(const State& state, std::span<double> phi, std::span<double> rate, std::span<double> second) const final {
    auto m = motion<Taylor>(state);
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
    self().evaluate(m, state, balance);
    for (std::size_t i = 0; i < layout_.multipliers.size(); ++i) {
      const Taylor& c = balance.constraint_at(static_cast<int>(i));
      phi[i] = c.value;
      rate[i] = c.d1;
      second[i] = c.d2;
    }
  }

 protected:
  /// To be called once in the derived constructor.
  void set_layout(Layout layout) {
    layout_ = std::move(layout);
    lane_slots_.clear();
    for (std::size_t i = 0; i < layout_.nodes.size(); ++i) {
      if (layout_.nodes[i] == 0) continue;
      for (std::size_t c = 0; c < 6; ++c)
        if (needs(i, c < 3 ? NodeNeed::translation : NodeNeed::rotation)) lane_slots_.push_back(6 * i + c);
    }
    const std::size_t s0 = 6 * layout_.nodes.size();
    for (std::size_t i = 0; i < layout_.scalars.size() + layout_.multipliers.size(); ++i) lane_slots_.push_back(s0 + i);
    assert(lane_slots_.size() <= static_cast<std::size_t>(Lanes) && "Lanes is too small for this element");
    assert(layout_.scalars.size() <= 8 && layout_.multipliers.size() <= 16);
  }

  /// The state in numbers of type T, without derivatives.
  template <class T>
  Motion<T, Nodes> motion(const State& state) const {
    Motion<T, Nodes> m;
    const auto fill = [](Vec3T<T>& to, const Vec3& from) {
      for (int c = 0; c < 3; ++c) to[c] = T(from[c]);
    };
    for (std::size_t i = 0; i < layout_.nodes.size(); ++i) {
      const NodeState& s = state.nodes[i];
      fill(m.node[i].x, s.x);
      fill(m.node[i].v, s.v);
      fill(m.node[i].W, s.W);
      fill(m.node[i].a, s.a);
      fill(m.node[i].A, s.A);
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) m.node[i].R(a, b) = T(s.R(a, b));
    }
    for (std::size_t i = 0; i < layout_.scalars.size(); ++i) {
      m.scalar[i] = T(state.scalars[i]);
      m.scalar_rate[i] = T(state.scalar_rates[i]);
      m.scalar_acceleration[i] = T(state.scalar_accelerations[i]);
    }
    m.time = T(state.time);
    return m;
  }

  /// Lanes `lane` to `lane` + 2 move the node along the global axes, or turn it about its own.
  template <class Node>
  static void seed_translation(Node& node, Weights w, std::size_t lane) {
    for (int c = 0; c < 3; ++c, ++lane) {
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
  bool needs(std::size_t node, NodeNeed need) const {
    return (static_cast<unsigned>(layout_.needs[node]) & static_cast<unsigned>(need)) != 0;
  }

 private:
  const Derived& self() const { return static_cast<const Derived&>(*this); }

  template <class Node>
  void seed_node(Node& node, const NodeState& s, std::size_t i, Weights w, std::size_t& lane) const {
    if (layout_.nodes[i] == 0) return;
    if (needs(i, NodeNeed::translation)) {
      seed_translation(node, w, lane);
      lane += 3;
    }
    if (needs(i, NodeNeed::rotation)) {
      seed_rotation(node, s, w, lane);
      lane += 3;
    }
  }

  Layout layout_;
  std::vector<std::size_t> lane_slots_;  ///< slot of every lane
};

}  // namespace engrane
