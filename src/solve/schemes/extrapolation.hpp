// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/snapshot.hpp"

namespace engrane::solve {

/// The polynomial through the latest values of some quantities, at most three, continued by a step: where Newton's iteration
/// begins.
class Extrapolation {
 public:
  void clear() { count_ = 0; }
  bool empty() const { return count_ == 0; }
  /// Values at a time after the others.
  void add(double time, std::span<const double> values);
  /// Writes what the polynomial has at `time`, after all of the values. Values that are much closer together than it is far away
  /// are left out.
  void at(double time, std::span<double> values) const;

  /// Under `name`.
  void save(Snapshot& snapshot, const std::string& name) const;
  void load(const Snapshot& snapshot, const std::string& name);

 private:
  static constexpr std::size_t most = 3;
  struct Point {
    double time = 0;
    std::vector<double> values;
  };
  std::array<Point, most> points_;  ///< the latest first
  std::size_t count_ = 0;
};

}  // namespace engrane::solve
