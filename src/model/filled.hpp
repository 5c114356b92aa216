// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/element.hpp"

namespace engrane {

/// An element with a content q that is a function of time: a gas that is filled, a string that is reeled in. The work of filling
/// is ∫ g dq, where g(q, s) = ∂E/∂q depends on the size s, too. The power g q̇ jumps where the function has a corner; g and q do
/// not. The work is therefore computed from these, wherever corners lie.
class Filled {
 public:
  struct Filling {
    double content = 0;  ///< q
    double size = 0;     ///< s: the volume of a gas, the tension of a string
    double power = 0;    ///< g q̇, a part of energies().external
  };
  /// Whether this element has such a function.
  virtual bool is_filled() const { return true; }
  virtual Filling filling(const State& state) const = 0;
  /// Work of filling from one content to another at constant size.
  virtual double work_of_filling(double from, double to, double size) const = 0;
  /// g(q, s) − g(q, size), with q and s of `at`.
  virtual double slope_beside(const Filling& at, double size) const = 0;

 protected:
  ~Filled() = default;
};

/// The interface of an element that is filled; else nullptr.
inline const Filled* filled(const Element& element) {
  const auto* found = dynamic_cast<const Filled*>(&element);
  return found != nullptr && found->is_filled() ? found : nullptr;
}

}  // namespace engrane
