// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>

#include "math/expression.hpp"
#include "math/expression_operations.hpp"

namespace engrane {

namespace {

/// A number with a bound on its accumulated rounding error.
struct Rounded {
  double value = 0, error = 0;
};

/// Running error analysis (Higham 2002, Accuracy and Stability of Numerical Algorithms, 3.3): operand errors times the partial
/// derivatives, plus the rounding error of the result.
Rounded apply(Expression::Instruction::Code code, const Rounded& a, const Rounded& b = {}, const Rounded& c = {}) {
  Rounded result{apply(code, a.value, b.value, c.value), 0};
  result.error = std::numeric_limits<double>::epsilon() * std::abs(result.value);
  const Rounded* operands[] = {&a, &b, &c};
  for (std::size_t i = 0; i < operand_count(code); ++i) {
    if (operands[i]->error == 0) continue;
    Series at[] = {{a.value}, {b.value}, {c.value}};
    at[i].c1 = 1;
    const double part = std::abs(apply(code, at[0], at[1], at[2]).c1) * operands[i]->error;
    if (std::isfinite(part)) result.error += part;
  }
  return result;
}

}  // namespace

double Expression::rounding(double time, double elongation, double rate) const {
  return evaluate_program<Rounded>(program_, {Rounded{time}, Rounded{elongation}, Rounded{rate}}).error;
}

}  // namespace engrane
