// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

#include "model/sweep.hpp"

namespace engrane {

/// Base of elements that implement one templated residual
///
///     template <class T> void evaluate(const Motion<T, Nodes>&, const State&, Balance<T, Nodes>&) const;
///
/// and obtain residual, exact tangent and constraint rates from it (Sweep). `Lanes` is the maximum number of unknowns of the
/// element (ground nodes and unneeded unknowns excluded).
template <class Derived, int Nodes, int Lanes>
class TemplatedElement : public Element {
 public:
  using Element::Element;

  const Layout& layout() const final { return sweep_.layout(); }

  void residual(const State& state, std::span<double> r) const final { sweep_.residual(state, r, evaluation(state)); }

  void tangent(const State& state, Weights w, std::span<double> r, std::span<double> k) const override {
    sweep_.tangent(state, w, r, k, evaluation(state));
  }

  void constraint_rates(const State& state, std::span<double> phi, std::span<double> rate, std::span<double> second) const final {
    sweep_.constraint_rates(state, phi, rate, second, evaluation(state));
  }

 protected:
  /// Call once in the derived constructor.
  void set_layout(Layout layout) { sweep_ = Sweep<Nodes, Lanes>(std::move(layout)); }
  const Sweep<Nodes, Lanes>& sweep() const { return sweep_; }

  /// The state in numbers of type T, without derivatives.
  template <class T>
  static Motion<T, Nodes> motion(const State& state) {
    return Motion<T, Nodes>(state);
  }

 private:
  auto evaluation(const State& state) const {
    return [this, &state](const auto& motion, auto& balance) {
      static_cast<const Derived&>(*this).evaluate(motion, state, balance);
    };
  }

  Sweep<Nodes, Lanes> sweep_;
};

}  // namespace engrane
