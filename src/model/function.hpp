// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "deck/cards/cards.hpp"
#include "math/dual.hpp"
#include "math/expression.hpp"
#include "math/jet.hpp"
#include "math/taylor.hpp"

namespace engrane {

/// A function of one variable (`.FCT`) with what elements need to differentiate through it.
class Function {
 public:
  using Jet = engrane::Jet;
  Function() = default;
  virtual ~Function() = default;
  Function(const Function&) = delete;
  Function& operator=(const Function&) = delete;

  /// Value and derivatives with respect to the variable; at corners and jumps those on the right. Not a number outside
  /// the domain of a formula.
  virtual Jet at(double x) const = 0;
  /// ∫ from 0 to x: what a drive in speed turns into an angle. Exact for every form but a formula, whose integral is good
  /// to about 1e-13 of ∫|f|.
  virtual double integral(double x) const = 0;
  /// Between two values of x, in increasing order: where the function jumps or has a corner, and where it begins or ends to
  /// change. None where there are more than `most` of them: a measured curve. Those of user routines are not known, nor between
  /// infinite values those of formulas and of what repeats.
  virtual std::vector<double> corners(double /*from*/, double /*to*/, std::size_t /*most*/) const { return {}; }
  /// With which it repeats; 0: it does not, or nobody knows.
  virtual double period() const { return 0; }
  /// The formula, if this is one.
  virtual const Expression* formula() const { return nullptr; }
  /// The formula of a law, if this is one and no function of one variable.
  virtual const Expression* law() const { return nullptr; }
};

/// What a USER function must know of the deck besides its record.
struct FunctionSetting {
  std::string folder;                      ///< of the file the record stands in
  double start = 0, end = 1, step = 0.01;  ///< of the run
};

/// Builds a function from its record (a FunctionCard); faults go to `diagnostics` and yield nullptr.
///
/// TABLE joins its points by straight lines, with SPLINE by a natural cubic spline, and keeps its first and last ordinate
/// outside them; with PERIOD either repeats. SINUS is
/// mean + amplitude sin(2π frequency x + phase). RAMP and STEP lead from (t0, y0) to (t1, y1), by a straight line or by
/// the polynomial of degree five that makes value, slope and curvature continuous, and are constant outside.
std::unique_ptr<Function> make_function(const deck::Record& record, Diagnostics& diagnostics,
                                        const FunctionSetting& setting = {});

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
