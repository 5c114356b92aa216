// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace engrane::deck {

/// Most values that one repeat count or one range of ids may stand for; more is a slip of the pen.
inline constexpr int most_repeated = 1'000'000;

/// A number as Fortran spells it, with its repeat count: `3`, `.5`, `2.1E+08`, `1.5d-3`, `1.5+3`, `3*0.`.
struct Number {
  double value = 0;
  int repeat = 1;
  std::string fault;  ///< why the word is no number; empty when it is one
  std::string hint;

  bool good() const { return fault.empty(); }
};

/// Does the word start the way numbers do? If so it must be one: no keyword starts with a digit.
bool looks_like_number(std::string_view word);

/// Reads the whole word. Overflow and underflow are faults, never infinity or a silent zero.
Number parse_number(std::string_view word);

}  // namespace engrane::deck
