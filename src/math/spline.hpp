// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "math/jet.hpp"

namespace engrane {

/// A curve through given points: straight lines, or a cubic spline (C²).
///
/// Outside its points a curve keeps its first and last ordinate, unless it is periodic: it is bounded, and continuous. At
/// corners and jumps the derivatives (and the value) are those on the right.
class Curve {
 public:
  /// Straight lines. Abscissas strictly increasing, at least one point, as many ordinates. With a period, no shorter than
  /// the points reach: when they reach less, a line closes the gap; when they reach just as far and the last ordinate
  /// differs from the first, the curve jumps.
  static Curve lines(std::span<const double> x, std::span<const double> y, std::optional<double> period = {});

  /// Natural cubic spline: second derivative zero at both ends. One point is a constant, two are a line.
  static Curve natural_spline(std::span<const double> x, std::span<const double> y);

  /// Periodic cubic spline. When the points reach over the whole period, the last must repeat the first ordinate.
  static Curve periodic_spline(std::span<const double> x, std::span<const double> y, double period);

  Jet at(double x) const;
  /// ∫ from 0 to x, exact for the curve.
  double integral(double x) const { return from_start(x) - from_start_to_zero_; }
  /// 0: it does not repeat.
  double period() const { return period_.value_or(0); }
  /// Where it jumps or has a corner between two abscissas, in increasing order; none where there are more than `most`, nor
  /// between infinite ones where it repeats.
  std::vector<double> corners(double from, double to, std::size_t most) const;

 private:
  /// y = c0 + s (c1 + s (c2 + s c3)), s = x - x0.
  struct Piece {
    double x0 = 0;
    double c0 = 0, c1 = 0, c2 = 0, c3 = 0;
    double area = 0;  ///< integral from the curve's first abscissa to x0
  };
  /// A piece and the place in it; `turns` whole periods before it.
  struct Place {
    const Piece* piece = nullptr;
    double s = 0;
    double turns = 0;
  };
  static Curve hermite(std::span<const double> x, std::span<const double> y, std::span<const double> slope);

  Place find(double x) const;
  double from_start(double x) const;
  void sum_areas(double end);

  std::vector<Piece> pieces_;  ///< the first and last reach to infinity unless the curve is periodic
  std::optional<double> period_;
  double area_of_period_ = 0;
  double from_start_to_zero_ = 0;
};

}  // namespace engrane
