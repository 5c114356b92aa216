// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace engrane::output {

/// A value at a time.
struct Sample {
  double time, value;
};

/// An extreme of a curve: how far it lies beyond a level, and when; 0 if it does not.
struct Extreme {
  double beyond = 0, time = 0;
};

/// Polynomial of degree up to three through two to four samples, in powers of the time from the first.
class Cubic {
 public:
  explicit Cubic(std::span<const Sample> samples);
  double operator()(double time) const;
  /// Largest value of `sign` times this within (a, b), beyond `level`.
  Extreme beyond(double a, double b, double sign, double level) const;

 private:
  double origin_;
  std::array<double, 4> c_{};
};

/// The extreme within (a, b), a part of interval `i` of four samples, of `sign` times the cubic through them, beyond `level`. It
/// counts only where the parabolas through three of them that cover the interval have it, too: at a corner or jump between
/// samples none is invented.
Extreme extreme_between(std::span<const Sample> samples, std::size_t i, double a, double b, double sign, double level);

}  // namespace engrane::output
