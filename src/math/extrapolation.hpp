// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "base/snapshot.hpp"

namespace engrane {

/// Polynomial through the latest values of a set of quantities. Extrapolated over a time step, it predicts the start of the
/// Newton iteration. Between the last two points, it interpolates results at equidistant output times.
class Extrapolation {
 public:
  /// Uses at most `most` points, going back only while the step is no longer than `longest` times the spacing of consecutive
  /// points: differences of closer points would show their errors rather than the trend.
  Extrapolation(std::size_t most, double longest) : points_(most), longest_(longest) {}

  void clear() { count_ = 0; }
  bool empty() const { return count_ == 0; }
  std::size_t points() const { return count_; }
  /// Appends a point; `time` must not be earlier than the others. At the same time as the latest, as after a drift too short to
  /// move the time, it takes its place.
  void add(double time, std::span<const double> values);
  /// Evaluates the polynomial for a step of length h at `time`, within this step.
  void at(double time, double h, std::span<double> values) const;
  /// Lagrange weights of the points used, latest first; of so few that their magnitudes add up to `most` at most. On points ever
  /// farther apart, as steps grow behind an event, high orders enlarge whatever is no polynomial.
  std::vector<double> weights(double time, double h, double most = std::numeric_limits<double>::infinity()) const;
  std::span<const double> values(std::size_t point) const { return points_[point].values; }
  /// The two stored points around a time; `part` is the interpolation weight, 0 at `before` and 1 at `after`.
  struct Around {
    std::span<const double> before, after;
    double part;
  };
  Around around(double time) const;
  /// Ratio of two errors for a step of length h: the largest interpolation error between the latest point and `time` of the
  /// polynomial through a new value at `time` and the latest points, over the prediction error of at() at `time`. Both
  /// polynomials use the same number of points.
  double share(double time, double h) const;

  /// Saves and restores the points under `name`.
  void save(Snapshot& snapshot, const std::string& name) const;
  void load(const Snapshot& snapshot, const std::string& name);

 private:
  struct Point {
    double time = 0;
    std::vector<double> values;
  };
  /// Number of points used for a step of length h.
  std::size_t reach(double h) const;
  std::vector<Point> points_;  ///< latest first
  std::size_t count_ = 0;      ///< number in use
  double longest_;
};

}  // namespace engrane
