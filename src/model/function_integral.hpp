// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <mutex>
#include <vector>

namespace engrane {

/// ∫ from 0 to x of a function known only by its values.
///
/// The line is cut into panels on which 15-point Gauss–Kronrod rules are exact to rounding, starting at 0 and going
/// outward as far as was ever asked for. Their ends depend on the function alone, not on the order of the questions, so that
/// the same x always gives the same answer; a question inside known panels costs one rule. A panel is at most a
/// twentieth of its distance from 0 wide, whatever that distance, so that no unit of x counts: a peak much narrower may be
/// missed. The first one ends at 1e-15.
class PanelIntegral {
 public:
  explicit PanelIntegral(std::function<double(double)> f) : f_(std::move(f)) {}

  double operator()(double x) const;

 private:
  static constexpr double first = 1e-15;
  /// Panels on one side of 0: end k and the integral from 0 to it.
  struct Side {
    std::vector<double> ends{0};
    std::vector<double> areas{0};
    double magnitude = 0;  ///< ∫|f| so far: what rounding is measured against
    double width = first;  ///< tried for the next panel
    bool broken = false;   ///< the function stopped being finite at the last end
  };
  void extend(Side& side, double sign) const;

  std::function<double(double)> f_;
  mutable std::mutex mutex_;
  mutable Side right_, left_;
};

}  // namespace engrane
