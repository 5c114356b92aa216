// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "deck/cards.hpp"
#include "math/dual.hpp"
#include "math/taylor.hpp"

namespace engrane {

/// A function of one variable (`.FCT`) with what elements need to differentiate through it.
class Function {
 public:
  struct Jet {
    double f = 0, d1 = 0, d2 = 0, d3 = 0;  ///< value and derivatives with respect to the variable
  };
  virtual ~Function() = default;
  virtual Jet at(double x) const = 0;
  /// ∫ from 0 to x: what a drive in speed turns into an angle.
  virtual double integral(double x) const = 0;
};

/// Builds a function from its record; faults go to `diagnostics` and yield nullptr.
std::unique_ptr<Function> make_function(const deck::Record& record, Diagnostics& diagnostics);

/// The function of a differentiated variable; `derivative` 1 or 2 gives f′ or f″ in the same arithmetic.
template <class T>
T evaluate(const Function& function, const T& x, int derivative = 0) {
  const Function::Jet j = function.at(value_of(x));
  if (derivative == 0) return compose(x, j.f, j.d1, j.d2);
  if (derivative == 1) return compose(x, j.d1, j.d2, j.d3);
  return compose(x, j.d2, j.d3, 0);
}
/// Its integral from 0, in the same arithmetic.
template <class T>
T evaluate_integral(const Function& function, const T& x) {
  const Function::Jet j = function.at(value_of(x));
  return compose(x, function.integral(value_of(x)), j.f, j.d1);
}

}  // namespace engrane
