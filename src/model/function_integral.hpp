// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <mutex>
#include <utility>
#include <vector>

namespace engrane {

/// ∫ from 0 to x of a function known only by its values.
///
/// The line is divided into panels on which 15-point Gauss–Kronrod rules are exact to rounding. Panels start at 0 and extend
/// outward as far as has been requested. Their ends depend on the function only, not on the order of the calls, so that the
/// same x always gives the same result. A call inside known panels costs one rule. A panel is at most a twentieth of its
/// distance from 0 wide: a much narrower peak may be missed.
class PanelIntegral {
 public:
  using Curve = std::function<double(double)>;
  /// `rounding`: bound on the rounding error of f, used to decide whether a difference on a small panel is significant. The
  /// first panel then ends at 1e-15, so that the unit of x does not matter.
  PanelIntegral(Curve f, Curve rounding) : PanelIntegral(std::move(f), std::move(rounding), 1e-15) {}
  /// For unknown rounding error: panels are no narrower than `first` unless f requires it.
  PanelIntegral(Curve f, double first) : PanelIntegral(std::move(f), {}, first) {}

  double operator()(double x) const;

 private:
  PanelIntegral(Curve f, Curve rounding, double first) : f_(std::move(f)), rounding_(std::move(rounding)), first_(first) {
    right_.width = left_.width = first;
  }
  /// Panels on one side of 0: their ends, and the integrals from 0 to each end.
  struct Side {
    std::vector<double> ends{0};
    std::vector<double> areas{0};
    double magnitude = 0;  ///< ∫|f| so far: reference for rounding errors
    double width = 0;      ///< trial width of the next panel
    bool broken = false;   ///< the function was not finite in the last panel
  };
  void extend(Side& side, double sign) const;

  Curve f_, rounding_;
  double first_;
  mutable std::mutex mutex_;
  mutable Side right_, left_;
};

}  // namespace engrane
