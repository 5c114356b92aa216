// SPDX-License-Identifier: BSD-3-Clause
#include "app/error_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace engrane::app {

double ErrorEstimate::error_at(double other) const { return error * std::pow(other / tolerance, order); }

double ErrorEstimate::seconds_at(double other) const {
  // by numbers of steps: times of short runs hold much that is not steps
  const double slope = std::clamp(std::log(ratio_of_steps) / std::log(companion_tolerance / tolerance), 0.0, 1.0);
  return seconds * std::pow(tolerance / other, slope);
}

double ErrorEstimate::tolerance_for(double target) const { return tolerance * std::pow(0.5 * target / error, 1 / order); }

double ErrorEstimate::tolerance_of(const AccuracyRung& rung) const {
  if (begins_looser && error_at(rung.first) <= rung.target) return rung.first;
  return error_at(rung.tolerance) <= rung.target ? rung.tolerance : std::min(rung.tolerance, tolerance_for(rung.target));
}

std::string ErrorEstimate::describe(double target) const {
  std::string text =
      fmt::format("  asked for          {:g} of the range of each channel, root of the mean square over time\n", target);
  if (!trouble.empty()) return text + "  estimated error    none: " + trouble + "\n";
  text += fmt::format("  estimated error    {:.2g}, {}; by a second run with TOL {:.2g}, where this one has {:.2g}\n", error,
                      channel, companion_tolerance, tolerance);
  if (since) text += fmt::format("  estimated from     t = {:.6g} on, where the run was continued\n", *since);
  text +=
      fmt::format("  processor time     {:.2g} s, and {:.2g} s for the estimate\n", seconds, companion_seconds + earlier_seconds);
  for (const AccuracyRung& rung : accuracy_rungs)
    if (rung.target != target)
      text += fmt::format("  ACCURACY {:<10}error about {:.1g}, about {:.2g} s\n", rung.name, error_at(tolerance_of(rung)),
                          seconds_at(tolerance_of(rung)));
  return text;
}

}  // namespace engrane::app
