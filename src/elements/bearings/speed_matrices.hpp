// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "math/dual.hpp"
#include "math/matrix6.hpp"

namespace engrane::elements::bearings {

/// A 6 × 6 matrix as a function of speed: linear between the given speeds, constant below the first and above the last.
class SpeedMatrices {
 public:
  /// Zero matrix.
  SpeedMatrices() = default;
  /// One matrix per speed; speeds strictly increasing. A single matrix needs no speed.
  SpeedMatrices(std::vector<double> speeds, std::vector<Mat6> values) : speeds_(std::move(speeds)), values_(std::move(values)) {}

  bool empty() const { return values_.empty(); }
  bool varies() const { return values_.size() > 1; }
  std::span<const Mat6> values() const { return values_; }
  /// Speeds at which the slope changes.
  std::vector<double> corners() const { return varies() ? speeds_ : std::vector<double>(); }

  /// The matrix at `speed` times x.
  template <class T>
  std::array<T, 6> times(const std::array<T, 6>& x, const T& speed) const {
    std::array<T, 6> y;
    y.fill(T(0));
    if (values_.empty()) return y;
    const auto behind = std::upper_bound(speeds_.begin(), speeds_.end(), value_of(speed)) - speeds_.begin();
    const std::size_t at = static_cast<std::size_t>(std::max<std::ptrdiff_t>(behind - 1, 0));
    add(values_[at], x, T(1), y);
    if (behind > 0 && at + 1 < values_.size())
      add(values_[at + 1] - values_[at], x, T((speed - speeds_[at]) * (1 / (speeds_[at + 1] - speeds_[at]))), y);
    return y;
  }

 private:
  template <class T>
  static void add(const Mat6& m, const std::array<T, 6>& x, const T& share, std::array<T, 6>& y) {
    for (Eigen::Index r = 0; r < 6; ++r) {
      T sum(0);
      for (Eigen::Index c = 0; c < 6; ++c)
        if (m(r, c) != 0) sum += x[static_cast<std::size_t>(c)] * m(r, c);
      y[static_cast<std::size_t>(r)] += share * sum;
    }
  }

  std::vector<double> speeds_;
  std::vector<Mat6> values_;
};

}  // namespace engrane::elements::bearings
