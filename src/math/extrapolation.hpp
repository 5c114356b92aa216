// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/snapshot.hpp"

namespace engrane {

/// The polynomial through the latest values of some quantities: continued by a step, where Newton's iteration begins; between the
/// last two of them, what results at even times are.
class Extrapolation {
 public:
  /// Through at most `most` values, as far back as a step is no longer than `longest` times the time from one to the next: the
  /// difference of closer ones tells more of their errors than of what follows.
  Extrapolation(std::size_t most, double longest) : points_(most), longest_(longest) {}

  void clear() { count_ = 0; }
  bool empty() const { return count_ == 0; }
  std::size_t points() const { return count_; }
  /// Values at a time after the others.
  void add(double time, std::span<const double> values);
  /// Writes what the polynomial for a step of h has at `time`, within this step.
  void at(double time, double h, std::span<double> values) const;
  /// The weights of the points in it, the latest first, and their values.
  std::vector<double> weights(double time, double h) const;
  std::span<const double> values(std::size_t point) const { return points_[point].values; }
  /// The latest values at both sides of a time; part 0 stands for those before it, 1 for those after it.
  struct Around {
    std::span<const double> before, after;
    double part;
  };
  Around around(double time) const;
  /// How far the polynomial through a new value at `time` and the latest ones departs from the truth since the last of them, over
  /// how far at() was from the new value; as many points in both, for a step of h.
  double share(double time, double h) const;

  /// Under `name`.
  void save(Snapshot& snapshot, const std::string& name) const;
  void load(const Snapshot& snapshot, const std::string& name);

 private:
  struct Point {
    double time = 0;
    std::vector<double> values;
  };
  /// So many points serve for a step of h.
  std::size_t reach(double h) const;
  std::vector<Point> points_;  ///< the latest first
  std::size_t count_ = 0;      ///< of them in use
  double longest_;
};

}  // namespace engrane
