// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace engrane::output {

/// The last samples, at most four, of a stretch within which what is sampled is smooth. Stretches end at events and corners, and
/// where intervals differ a hundredfold, as those of a sample beside the end of a step: polynomials through samples so much
/// closer together are noise. The same time again, as at a jump, begins a new one.
///
/// Each interval is handed out once, when two samples behind it are known or its stretch ends: `take(i)` has the samples around
/// it, and begins with sample `i` of these.
template <class Value>
class Stretch {
 public:
  struct Point {
    double time;
    Value value;
  };

  template <class Take>
  void add(double time, Value value, const Take& take) {
    if (!points_.empty() && time <= points_.back().time) {
      end(take);
      points_.clear();
    } else if (points_.size() > 1) {
      const double before = points_.back().time - points_[points_.size() - 2].time, now = time - points_.back().time;
      if (now > most_uneven * before || before > most_uneven * now) end(take);
    }
    if (points_.size() == 4) {
      points_.erase(points_.begin());
      --taken_;
    }
    points_.push_back({time, std::move(value)});
    if (points_.size() == 4)
      while (taken_ < 2) take(taken_++);
  }

  /// Ends the stretch; the next one begins with its last sample.
  template <class Take>
  void end(const Take& take) {
    while (taken_ + 1 < points_.size()) take(taken_++);
    if (!points_.empty()) points_.erase(points_.begin(), points_.end() - 1);
    taken_ = 0;
  }

  const std::vector<Point>& points() const { return points_; }
  std::size_t taken() const { return taken_; }  ///< intervals of these that have been handed out
  void restore(std::vector<Point> points, std::size_t taken) {
    points_ = std::move(points);
    taken_ = taken;
  }

 private:
  static constexpr double most_uneven = 100;
  std::vector<Point> points_;
  std::size_t taken_ = 0;
};

}  // namespace engrane::output
