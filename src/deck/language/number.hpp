// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace engrane::deck {

/// Maximum number of values of one repeat count or one range of ids; more is assumed to be a typing error.
inline constexpr int most_repeated = 1'000'000;

/// A number in any Fortran notation, with its repeat count: `3`, `.5`, `2.1E+08`, `1.5d-3`, `1.5+3`, `3*0.`.
struct Number {
  double value = 0;
  int repeat = 1;
  std::string fault;  ///< why the word is not a number; empty if it is one
  std::string hint;

  bool good() const { return fault.empty(); }
};

/// Whether the word starts like a number. It must then be one, as no keyword starts with a digit.
bool looks_like_number(std::string_view word);

/// Parses the whole word. Overflow and underflow are faults, never infinity or a silent zero.
Number parse_number(std::string_view word);

}  // namespace engrane::deck
