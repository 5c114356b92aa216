// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "math/expression.hpp"

namespace engrane {

/// A Taylor series in one variable, truncated after the third power: c0 = f, c1 = f′, c2 = f″/2, c3 = f‴/6.
struct Series {
  double c0 = 0, c1 = 0, c2 = 0, c3 = 0;

  bool constant() const { return c1 == 0 && c2 == 0 && c3 == 0; }
};

/// Capacity of the operand stack of an evaluation.
inline constexpr std::size_t most_waiting_operands = 64;

/// Number of operands an operation takes from the stack, 1 to 3.
std::size_t operand_count(Expression::Instruction::Code code);

/// Result of one operation; operands beyond operand_count() are ignored.
double apply(Expression::Instruction::Code code, double a, double b = 0, double c = 0);
/// The same on series; at corners and jumps, right-hand limits.
Series apply(Expression::Instruction::Code code, const Series& a, const Series& b = {}, const Series& c = {});

/// Whether an operation is a comparison, abs, sign, min or max, at which a formula of smooth parts may jump or have a corner.
bool decides(Expression::Instruction::Code code);
/// Outcome of such an operation just to the right of the current point: -1, 0 or 1, or 2 if it is NaN. For the sign transfer,
/// the outcome of the first operand plus eight times that of the second, as abs is applied to the first. `operands` must hold
/// operand_count() entries.
signed char decision(Expression::Instruction::Code code, const Series* operands);

/// Runs a program on doubles or series. `variables` are in the order of Instruction::number. The parser has checked that the
/// stack suffices. `see` is called before each operation with its code and operands.
template <class T, class See>
T evaluate_program(const std::vector<Expression::Instruction>& program, const std::array<T, 3>& variables, See&& see) {
  using Code = Expression::Instruction::Code;
  std::array<T, most_waiting_operands> stack;
  std::size_t top = 0;
  for (const Expression::Instruction& i : program) {
    if (i.code == Code::number) {
      stack[top++] = T{i.number};
    } else if (i.code == Code::variable) {
      stack[top++] = variables[static_cast<std::size_t>(i.number)];
    } else {
      const std::size_t count = operand_count(i.code);
      top -= count - 1;
      T& result = stack[top - 1];
      see(i.code, &result);
      result = count == 1   ? apply(i.code, result)
               : count == 2 ? apply(i.code, result, stack[top])
                            : apply(i.code, result, stack[top], stack[top + 1]);
    }
  }
  return stack[0];
}
template <class T>
T evaluate_program(const std::vector<Expression::Instruction>& program, const std::array<T, 3>& variables) {
  return evaluate_program<T>(program, variables, [](auto&&...) {});
}

}  // namespace engrane
