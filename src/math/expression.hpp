// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "math/jet.hpp"

namespace engrane {

/// A formula of at most one variable, such as `2*sin(PI*T)**2 + max(0, T - 1)`.
///
/// Grammar, as in Fortran: `+ - * / **` and `( )`, a sign before any operand (`-2**2` is -4, `2**-1` is 0.5), `**` from
/// the right, numbers with E or D exponents, PI, and sin cos tan asin acos atan (radians), atan2(y, x), sqrt, exp, log,
/// abs, min and max of one or more. The variable is called T or X, whichever the text uses; case does not matter.
///
/// Derivatives are exact: truncated Taylor series of order three go through the same operations as the value. At the
/// kinks of abs, min and max they are those on the right. Outside a function's domain the value is not a number.
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
  /// With `variable_allowed` false, T and X are unknown names: constant arithmetic.
  static Parsed parse(std::string_view text, bool variable_allowed = true);

  double value(double x) const;
  Jet at(double x) const;
  /// Does the text not use the variable?
  bool constant() const { return constant_; }

  /// One step of the formula in postfix order; operands are on a stack.
  struct Instruction {
    enum class Code : unsigned char {
      number,
      variable,
      negate,
      add,
      subtract,
      multiply,
      divide,
      power,
      sine,
      cosine,
      tangent,
      arcsine,
      arccosine,
      arctangent,
      arctangent2,
      square_root,
      exponential,
      logarithm,
      absolute,
      minimum,
      maximum
    };
    Code code = Code::number;
    double number = 0;
  };

 private:
  std::vector<Instruction> program_;
  bool constant_ = true;
};

/// A formula, or why there is none.
struct Expression::Parsed {
  Expression expression;
  Fault fault;

  bool good() const { return fault.message.empty(); }
};

}  // namespace engrane
