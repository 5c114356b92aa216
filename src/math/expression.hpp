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
/// Grammar, as in Fortran: `+ - * / **` and `( )`, a sign before any operand (`-2**2` is -4, `2**-1` is 0.5), `**` from
/// the right, numbers with E or D exponents, PI, and sin cos tan asin acos atan (radians), atan2(y, x), sqrt, exp, log, tanh,
/// abs, min and max of one or more, sign(a) (-1, 0 or 1) and Fortran's sign(a, b) (|a| with the sign of b), and if(c, a, b): a
/// where c is not 0, b elsewhere. Comparisons `< <= > >= == /=`, also written `.LT. .LE. .GT. .GE. .EQ. .NE.`, and `.NOT.`,
/// `.AND.`, `.OR.` give 1 where they hold and 0 where not; they bind less than `+`, in this order. The variable is called T or X,
/// whichever the text uses; case does not matter.
///
/// Derivatives are exact: truncated Taylor series of order three go through the same operations as the value. at() gives at
/// corners and jumps what is on their right. Outside a function's domain the value is not a number, and so is all that is made
/// of it, except by an `if` that does not choose it.
class Expression {
 public:
  /// What is wrong with a text, and where.
  struct Fault {
    std::string message;
    std::string hint;
    std::size_t at = 0;      ///< byte of the text, from 0
    std::size_t length = 1;  ///< how many bytes
  };
  struct Parsed;

  /// Reads the whole text. A constant part that is not a finite number (`1/0`, `sqrt(-1)`) is a fault at its operator.
  /// With `variable_allowed` false, the variables are unknown names: constant arithmetic.
  static Parsed parse(std::string_view text, bool variable_allowed = true);

  double value(double x) const;
  Jet at(double x) const;
  /// Between two values of the variable, in increasing order: where a comparison, sign, abs, min or max decides otherwise than
  /// before, which is where the formula may jump or have a corner; to the last digit. Looked for at a thousand places: what comes
  /// and goes between two of them is not seen. None where there are more than `most`.
  std::vector<double> corners(double from, double to, std::size_t most) const;
  /// A difference whose sign a comparison, sign, abs, min or max goes by: the formula may jump or have a corner where it is zero.
  struct Decision {
    double value = 0;
    double rate = 0;  ///< its time derivative
    double size = 0;  ///< of the terms that `value` is the difference of
  };
  /// Their operations in words: `max`, `abs (2)` for the second of two. Those of `==` and `/=` say nothing of a side.
  const std::vector<std::string>& decisions() const { return decisions_; }
  /// Their values along a motion of the variable, or of D with the rate V; `size` is that of the terms which x is the difference
  /// of.
  void decide(const Taylor& x, double time, double size, std::span<Decision> found) const;
  /// How far rounding may have taken value(time), or a law's value there, where its variables are exact.
  double rounding(double time, double elongation = 0, double rate = 0) const;
  /// Does the text not use the variable?
  bool constant() const { return constant_; }

  /// Does the text use D or V, or the time T? A formula without D and V is no law.
  bool is_law() const { return uses_law_; }
  bool uses_time() const { return uses_time_; }
  /// The name that the text gives its variable: T or X.
  char variable() const { return variable_; }
  struct Law {
    double value = 0, by_elongation = 0, by_rate = 0;
  };
  Law law(double elongation, double rate, double time) const;

  /// One step of the formula in postfix order; operands are on a stack.
  struct Instruction {
    enum class Code : unsigned char {
      number,
      variable,
      // of one operand
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
      // of two
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
      // of three
      choice
    };
    Code code = Code::number;
    double number = 0;  ///< of a variable: 0 for T or X, 1 for D, 2 for V
  };

 private:
  void name_decisions();

  std::vector<Instruction> program_;
  std::vector<std::string> decisions_;
  bool constant_ = true, uses_law_ = false, uses_time_ = false;
  char variable_ = 'T';
};

/// A formula, or why there is none.
struct Expression::Parsed {
  Expression expression;
  Fault fault;

  bool good() const { return fault.message.empty(); }
};

}  // namespace engrane
