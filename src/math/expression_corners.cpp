// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>
#include <vector>

#include "math/expression.hpp"
#include "math/expression_operations.hpp"

namespace engrane {

namespace {

constexpr int looks = 1000;

using Decisions = std::vector<signed char>;

Decisions decisions(const std::vector<Expression::Instruction>& program, double x) {
  Decisions found;
  evaluate_program<Series>(program, {Series{x, 1, 0, 0}, Series{0}, Series{0}},
                           [&found](Expression::Instruction::Code code, const Series* operands) {
                             if (decides(code)) found.push_back(decision(code, operands));
                           });
  return found;
}

}  // namespace

std::vector<double> Expression::corners(double from, double to, std::size_t most) const {
  if (std::none_of(program_.begin(), program_.end(), [](const Instruction& i) { return decides(i.code); })) return {};
  std::vector<double> found;
  double left = from;
  Decisions on_left = decisions(program_, left);
  for (int k = 1; k <= looks; ++k) {
    const double right = from + (to - from) * k / looks;
    const Decisions on_right = decisions(program_, right);
    while (on_left != on_right) {
      double corner = right;  // the first number with other decisions than on the left
      Decisions there = on_right;
      while (true) {
        const double middle = left + 0.5 * (corner - left);
        if (middle <= left || middle >= corner) break;
        Decisions in_middle = decisions(program_, middle);
        if (in_middle == on_left) {
          left = middle;
        } else {
          corner = middle;
          there = std::move(in_middle);
        }
      }
      if (corner >= to) return found;
      found.push_back(corner);
      if (found.size() > most) return {};
      left = corner;
      on_left = std::move(there);
    }
    left = right;
  }
  return found;
}

}  // namespace engrane
