// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "math/expression.hpp"
#include "math/expression_operations.hpp"

namespace engrane {

namespace {

using Code = Expression::Instruction::Code;

constexpr int looks = 1000;

using Decisions = std::vector<signed char>;

Decisions all_decisions(const std::vector<Expression::Instruction>& program, double x) {
  Decisions found;
  evaluate_program<Series>(program, {Series{x, 1, 0, 0}, Series{0}, Series{0}}, [&found](Code code, const Series* operands) {
    if (decides(code)) found.push_back(decision(code, operands));
  });
  return found;
}

/// Calls `see` with each pair of operands whose difference decides an operation by its sign.
template <class See>
void see_differences(Code code, const Series* operands, See&& see) {
  static constexpr Series zero;
  if (!decides(code) || code == Code::equal || code == Code::not_equal) return;
  if (operand_count(code) == 1 || code == Code::transfer_sign) see(operands[0], zero);
  if (code == Code::transfer_sign) see(operands[1], zero);
  if (operand_count(code) == 2 && code != Code::transfer_sign) see(operands[0], operands[1]);
}

std::string word(Code code) {
  switch (code) {
    case Code::absolute:
      return "abs";
    case Code::minimum:
      return "min";
    case Code::maximum:
      return "max";
    case Code::less:
      return "<";
    case Code::less_or_equal:
      return "<=";
    case Code::greater:
      return ">";
    case Code::greater_or_equal:
      return ">=";
    default:
      return "sign";
  }
}

}  // namespace

void Expression::name_decisions() {
  constexpr Series operands[3];
  decisions_.clear();
  std::map<std::string, int> uses;
  for (const Instruction& i : program_) {
    if (i.code == Instruction::Code::number || i.code == Instruction::Code::variable) continue;
    see_differences(i.code, operands, [&](const Series&, const Series&) {
      const std::string name = word(i.code);
      const int use = ++uses[name];
      decisions_.push_back(use == 1 ? name : fmt::format("{} ({})", name, use));
    });
  }
}

void Expression::decide(const Taylor& x, double time, double size, std::span<Decision> found) const {
  const auto evaluate = [&](const std::array<Series, 3>& variables, auto&& take) {
    std::size_t next = 0;
    evaluate_program<Series>(program_, variables, [&](Instruction::Code code, const Series* operands) {
      see_differences(code, operands, [&](const Series& a, const Series& b) { take(found[next++], a, b); });
    });
  };
  const Series along{x.value, x.d1, x.d2 / 2, 0}, rate{x.d1, x.d2, 0, 0};
  evaluate({uses_law_ ? Series{time, 1, 0, 0} : along, along, rate}, [](Decision& d, const Series& a, const Series& b) {
    d = {a.c0 - b.c0, a.c1 - b.c1, std::abs(a.c0) + std::abs(b.c0)};
  });
  // rounding error propagated from the variables
  const auto add_part = [&](const std::array<Series, 3>& variables, double of) {
    evaluate(variables, [of](Decision& d, const Series& a, const Series& b) { d.size += std::abs(a.c1 - b.c1) * of; });
  };
  const Series place{x.value, 1, 0, 0};
  add_part({uses_law_ ? Series{time} : place, place, Series{x.d1}}, size);
  if (uses_law_) add_part({Series{time}, Series{x.value}, Series{x.d1, 1, 0, 0}}, std::abs(x.d1));
}

std::vector<double> Expression::corners(double from, double to, std::size_t most) const {
  if (std::none_of(program_.begin(), program_.end(), [](const Instruction& i) { return decides(i.code); })) return {};
  std::vector<double> found;
  double left = from;
  Decisions on_left = all_decisions(program_, left);
  for (int k = 1; k <= looks; ++k) {
    const double right = from + (to - from) * k / looks;
    const Decisions on_right = all_decisions(program_, right);
    while (on_left != on_right) {
      double corner = right;  // the leftmost number with decisions that differ from those on the left
      Decisions there = on_right;
      while (true) {
        const double middle = left + 0.5 * (corner - left);
        if (middle <= left || middle >= corner) break;
        Decisions in_middle = all_decisions(program_, middle);
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
