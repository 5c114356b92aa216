// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "model/determined_channels.hpp"
#include "model/function.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements::loads {

/// Base of a force or moment of a given size. `Derived` has the residual evaluate(), `double speed(const State&) const` along the
/// load, and channels of which the first is the size and the last two are the speed and the power.
template <class Derived, int Nodes, int Lanes>
class AppliedLoad : public TemplatedElement<Derived, Nodes, Lanes>, public DeterminedChannels {
 public:
  /// `function`: of time, multiplies the value; nullptr: the load is constant.
  AppliedLoad(int id, double value, const Function* function)
      : TemplatedElement<Derived, Nodes, Lanes>(id), value_(value), function_(function) {}

  bool is_load() const override { return true; }
  Energies energies(const State& state) const override {
    Energies e;
    e.external = size(state.time) * self().speed(state);
    return e;
  }

  void observe(const State& state, std::span<double> values) const override {
    const std::size_t power = this->channels().size() - 1;
    values[0] = size(state.time);
    values[power - 1] = self().speed(state);
    values[power] = values[0] * values[power - 1];
  }

  std::vector<Determined> determined() const override {
    const int power = static_cast<int>(this->channels().size()) - 1;
    return function_ ? std::vector<Determined>{{0}, {power, {power - 1}}} : std::vector<Determined>();
  }
  double determine(int channel, double time, std::span<const double> speed) const override {
    return channel == 0 ? size(time) : size(time) * speed[0];
  }

 protected:
  double value() const { return value_; }
  /// The size with its derivatives, for evaluate().
  template <class T>
  T size_at(const T& time) const {
    return function_ ? T(value_) * engrane::evaluate(*function_, time) : T(value_);
  }

 private:
  const Derived& self() const { return static_cast<const Derived&>(*this); }
  double size(double time) const { return function_ ? value_ * function_->at(time).f : value_; }

  double value_;
  const Function* function_;
};

}  // namespace engrane::elements::loads
