// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "math/jet.hpp"

namespace engrane {

/// A curve through given points: piecewise linear, or a cubic spline (C²).
///
/// Outside its points a non-periodic curve keeps its first and last ordinate, so it is bounded and continuous. At corners and
/// jumps, value and derivatives are right-hand limits.
class Curve {
 public:
  /// Piecewise linear. Abscissas must be strictly increasing, at least one, with one ordinate each. A period must be no shorter
  /// than the range of the points. If the range is shorter than the period, a line closes the gap. If it equals the period and
  /// the last ordinate differs from the first, the curve jumps there.
  static Curve lines(std::span<const double> x, std::span<const double> y, std::optional<double> period = {});

  /// Natural cubic spline: zero second derivative at both ends. One point gives a constant, two give a line.
  static Curve natural_spline(std::span<const double> x, std::span<const double> y);

  /// Periodic cubic spline. If the points span the whole period, the last ordinate must repeat the first.
  static Curve periodic_spline(std::span<const double> x, std::span<const double> y, double period);

  Jet at(double x) const;
  /// ∫ from 0 to x, exact up to rounding.
  double integral(double x) const { return from_anchor(x) - from_anchor_to_zero_; }
  /// 0 if not periodic.
  double period() const { return period_.value_or(0); }
  /// Abscissas in (from, to), ascending, at which the curve jumps or one of its derivatives up to `derivative` does. Empty if
  /// there are more than `most`, or if the curve is periodic and the interval infinite.
  std::vector<double> joints(double from, double to, std::size_t most, int derivative = 3) const;
  /// Those of jumps and corners.
  std::vector<double> corners(double from, double to, std::size_t most) const { return joints(from, to, most, 1); }

 private:
  /// y = c0 + s (c1 + s (c2 + s c3)), s = x - origin, from x0 to the next piece. The origin is the end nearer to 0: in a table
  /// that goes far out, as -1E9 -1E15 0 0 1E9 1E15, a distance from there would leave few digits of a small x.
  struct Piece {
    double x0 = 0, origin = 0;
    double c0 = 0, c1 = 0, c2 = 0, c3 = 0;
    double area = 0;  ///< integral from the anchor to the origin: from 0, or from the first abscissa of a periodic curve
    double value(double x) const;
    Jet jet(double x) const;
    double integral(double x) const;  ///< from the anchor
  };
  /// A piece and the abscissa in it, after `turns` whole periods.
  struct Place {
    const Piece* piece = nullptr;
    double x = 0;
    double turns = 0;
  };
  static Curve hermite(std::span<const double> x, std::span<const double> y, std::span<const double> slope);

  /// The abscissa from which the piece that begins at x0 applies, after `turns` whole periods.
  double begin(double x0, double turns) const { return period_ ? x0 + turns * *period_ : x0; }

  Place find(double x) const;
  double from_anchor(double x) const;
  void sum_areas(double end);

  std::vector<Piece> pieces_;  ///< the first and last extend to infinity unless the curve is periodic
  std::optional<double> period_;
  double area_of_period_ = 0;
  double from_anchor_to_zero_ = 0;
};

}  // namespace engrane
