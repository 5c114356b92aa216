// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <mutex>
#include <utility>
#include <vector>

namespace engrane {

/// ∫ from 0 to x of a function known only by its values.
///
/// The line is cut into panels on which 15-point Gauss–Kronrod rules are exact to rounding, starting at 0 and going
/// outward as far as was ever asked for. Their ends depend on the function alone, not on the order of the questions, so that
/// the same x always gives the same answer; a question inside known panels costs one rule. A panel is at most a
/// twentieth of its distance from 0 wide: a peak much narrower may be missed.
class PanelIntegral {
 public:
  using Curve = std::function<double(double)>;
  /// `rounding`: how far rounding takes each value of f, which tells small panels whether they differ by more. The first one
  /// then ends at 1e-15, so that no unit of x counts.
  PanelIntegral(Curve f, Curve rounding) : PanelIntegral(std::move(f), std::move(rounding), 1e-15) {}
  /// Where nothing is known of rounding: panels are no narrower than `first` unless f asks for it.
  PanelIntegral(Curve f, double first) : PanelIntegral(std::move(f), {}, first) {}

  double operator()(double x) const;

 private:
  PanelIntegral(Curve f, Curve rounding, double first) : f_(std::move(f)), rounding_(std::move(rounding)), first_(first) {
    right_.width = left_.width = first;
  }
  /// Panels on one side of 0: end k and the integral from 0 to it.
  struct Side {
    std::vector<double> ends{0};
    std::vector<double> areas{0};
    double magnitude = 0;  ///< ∫|f| so far: what rounding is measured against
    double width = 0;      ///< tried for the next panel
    bool broken = false;   ///< the function stopped being finite at the last end
  };
  void extend(Side& side, double sign) const;

  Curve f_, rounding_;
  double first_;
  mutable std::mutex mutex_;
  mutable Side right_, left_;
};

}  // namespace engrane
