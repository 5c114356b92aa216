// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "math/jet.hpp"
#include "math/taylor.hpp"

namespace engrane {

/// A formula of one variable, such as `2*sin(PI*T)**2 + max(0, T - 1)`, or a law: a formula of an elongation D, its rate V and
/// the time T, such as `2E4*D*(1 + 0.3*V)`.
///
/// Grammar, as in Fortran: `+ - * / **` and `( )`; a sign before any operand (`-2**2` is -4, `2**-1` is 0.5); `**` is
/// right-associative; numbers may have E or D exponents. The constant is PI. Functions: sin cos tan asin acos atan (radians),
/// atan2(y, x), sqrt, exp, log, tanh, abs, min and max of one or more arguments, sign(a) (-1, 0 or 1), Fortran's sign(a, b)
/// (|a| with the sign of b), and if(c, a, b) (a where c is not 0, otherwise b). The comparisons `< <= > >= == /=`, also written
/// `.LT. .LE. .GT. .GE. .EQ. .NE.`, and `.NOT.`, `.AND.`, `.OR.` give 1 if true and 0 if false; they bind less tightly than
/// `+`, in this order. The variable is called T or X, whichever the text uses. Case does not matter.
///
/// Derivatives are exact: truncated Taylor series of order three pass through the same operations as the value. At corners and
/// jumps, at() returns the right-hand limits. Outside the domain of a function the result is NaN, and NaN propagates except
/// through the branch that an `if` does not choose.
class Expression {
 public:
  /// A syntax error and its position.
  struct Fault {
    std::string message;
    std::string hint;
    std::size_t at = 0;      ///< byte offset in the text, from 0
    std::size_t length = 1;  ///< in bytes
  };
  struct Parsed;

  /// Parses the whole text. A constant subexpression that is not a finite number (`1/0`, `sqrt(-1)`) is a fault at its
  /// operator. With `variable_allowed` false, the variables are unknown names: only constant arithmetic is accepted.
  static Parsed parse(std::string_view text, bool variable_allowed = true);

  double value(double x) const;
  Jet at(double x) const;
  /// Points in (from, to), ascending, at which the outcome of a comparison, sign, abs, min or max changes, so that the formula
  /// may jump or have a corner. Each is located to the last digit by bisection. The interval is sampled at a thousand points: a
  /// change that reverts between two of them is missed. Empty if there are more than `most`.
  std::vector<double> corners(double from, double to, std::size_t most) const;
  /// Switch function of a comparison, sign, abs, min or max: where its sign changes, the formula may jump or have a corner.
  struct Decision {
    double value = 0;
    double rate = 0;  ///< its time derivative
    double size = 0;  ///< magnitude of the terms whose difference is `value`; the scale of its rounding error
  };
  /// Names of the switch functions: `max`, `abs (2)` for the second of two. `==` and `/=` have none, as they do not depend on a
  /// side.
  const std::vector<std::string>& decisions() const { return decisions_; }
  /// Evaluates the switch functions along a motion of the variable, or of D with the rate V. `size` is the magnitude of the
  /// terms whose difference is x.
  void decide(const Taylor& x, double time, double size, std::span<Decision> found) const;
  /// Bound on the rounding error of value(time), or of a law's value, if the variables are exact.
  double rounding(double time, double elongation = 0, double rate = 0) const;
  /// Whether the text uses no variable.
  bool constant() const { return constant_; }

  /// Whether the text uses D or V, and whether it uses the time T. A formula without D and V is not a law.
  bool is_law() const { return uses_law_; }
  bool uses_time() const { return uses_time_; }
  /// The name the text uses for its variable: T or X.
  char variable() const { return variable_; }
  struct Law {
    double value = 0, by_elongation = 0, by_rate = 0;
  };
  Law law(double elongation, double rate, double time) const;

  /// One instruction of the formula in postfix order; operands are on a stack.
  struct Instruction {
    enum class Code : unsigned char {
      number,
      variable,
      // one operand
      negate,
      sine,
      cosine,
      tangent,
      arcsine,
      arccosine,
      arctangent,
      square_root,
      exponential,
      logarithm,
      hyperbolic_tangent,
      absolute,
      sign,
      logical_not,
      // two operands
      add,
      subtract,
      multiply,
      divide,
      power,
      arctangent2,
      minimum,
      maximum,
      transfer_sign,
      less,
      less_or_equal,
      greater,
      greater_or_equal,
      equal,
      not_equal,
      logical_and,
      logical_or,
      // three operands
      choice
    };
    Code code = Code::number;
    double number = 0;  ///< the constant; for a variable: 0 for T or X, 1 for D, 2 for V
  };

 private:
  void name_decisions();

  std::vector<Instruction> program_;
  std::vector<std::string> decisions_;
  bool constant_ = true, uses_law_ = false, uses_time_ = false;
  char variable_ = 'T';
};

/// A formula, or the fault that prevented it.
struct Expression::Parsed {
  Expression expression;
  Fault fault;

  bool good() const { return fault.message.empty(); }
};

}  // namespace engrane
