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

/// A function of one variable (`.FCT`) with the derivatives that elements need.
class Function {
 public:
  using Jet = engrane::Jet;
  Function() = default;
  virtual ~Function() = default;
  Function(const Function&) = delete;
  Function& operator=(const Function&) = delete;

  /// Value and derivatives with respect to the variable; right-hand limits at corners and jumps. NaN outside the domain of a
  /// formula.
  virtual Jet at(double x) const = 0;
  /// ∫ from 0 to x: a drive in speed integrates its function to an angle. Exact up to rounding, except for formulas, whose
  /// integral is accurate to about 1e-13 of ∫|f|.
  virtual double integral(double x) const = 0;
  /// Points in (from, to), ascending, at which the function jumps, has a corner, or starts or stops changing. Empty if there
  /// are more than `most`, as for a measured curve. Unknown, hence empty, for user routines, and between infinite limits for
  /// formulas and periodic functions.
  virtual std::vector<double> corners(double /*from*/, double /*to*/, std::size_t /*most*/) const { return {}; }
  /// The corners and the points at which a derivative up to the third jumps: the function is smooth between them.
  virtual std::vector<double> joints(double from, double to, std::size_t most) const { return corners(from, to, most); }
  /// Period; 0 if not periodic or unknown.
  virtual double period() const { return 0; }
  /// The formula, if the function is one; otherwise nullptr.
  virtual const Expression* formula() const { return nullptr; }
  /// The formula of a law (of D and V), if this is one and not a function of one variable; otherwise nullptr.
  virtual const Expression* law() const { return nullptr; }
};

/// Information about the deck that a USER function needs besides its record.
struct FunctionSetting {
  std::string folder;                      ///< of the file that contains the record
  double start = 0, end = 1, step = 0.01;  ///< of the run
};

/// Builds a function from its record (a FunctionCard). Faults go to `diagnostics`, and the result is nullptr.
///
/// TABLE joins its points by straight lines, or with SPLINE by a natural cubic spline, and keeps its first and last ordinate
/// outside them; with PERIOD either repeats. SINUS is mean + amplitude sin(2π frequency x + phase). RAMP and STEP lead from
/// (t0, y0) to (t1, y1), by a straight line or by the polynomial of degree five with continuous value, slope and curvature, and
/// are constant outside. At a corner where the run ends, the slopes are those of the run, not of what would follow.
std::unique_ptr<Function> make_function(const deck::Record& record, Diagnostics& diagnostics,
                                        const FunctionSetting& setting = {});

/// Evaluates the function in the arithmetic of x; with `derivative` 1 or 2, f′ or f″.
template <class T>
T evaluate(const Function& function, const T& x, int derivative = 0) {
  const Function::Jet j = function.at(value_of(x));
  if (derivative == 0) return compose(x, j.f, j.d1, j.d2);
  if (derivative == 1) return compose(x, j.d1, j.d2, j.d3);
  return compose(x, j.d2, j.d3, 0);
}
/// Evaluates the integral from 0 in the arithmetic of x.
template <class T>
T evaluate_integral(const Function& function, const T& x) {
  const Function::Jet j = function.at(value_of(x));
  return compose(x, function.integral(value_of(x)), j.f, j.d1);
}

}  // namespace engrane
