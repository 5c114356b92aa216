// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "output/extreme.hpp"
#include "output/stretch.hpp"

namespace engrane::output {

/// Extremes, mean and root mean square over time of a sampled channel, within a window of time.
///
/// Between samples the channel is the cubic through the four samples around, or through fewer where a smooth stretch has no more.
/// Errors of the integrals are of fourth order where the channel is smooth. An extreme between samples is only found where the
/// parabolas through three of them have it, too: at a corner or jump of which nothing is known none is invented.
class Window {
 public:
  /// Limits of the window; infinite: the whole run.
  explicit Window(double from = -std::numeric_limits<double>::infinity(), double to = std::numeric_limits<double>::infinity());

  /// Adds a sample. The same time again, as at a jump, begins a new stretch. `ends`: a stretch ends here. `slack`: times closer
  /// than this to a limit lie within.
  void add(double time, double value, bool ends, double slack);

  struct Measures {
    double least, largest, mean, rms;  ///< NaN if no sample lies within
  };
  Measures measures() const;

  /// For restarts: all data but the limits.
  std::vector<double> save() const;
  void load(std::span<const double> saved);

 private:
  void see(double value);
  /// Takes the interval behind sample `i` of the stretch.
  void take(std::size_t i);
  std::vector<Sample> samples() const;

  double from_, to_;
  Stretch<double> stretch_;
  double last_ = 0;  ///< latest value
  double least_, largest_;
  double area_ = 0, squares_ = 0, covered_ = 0;
};

}  // namespace engrane::output
