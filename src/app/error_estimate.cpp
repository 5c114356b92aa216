// SPDX-License-Identifier: BSD-3-Clause
#include "app/error_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace engrane::app {

namespace {

/// A difference of runs has fallen if it is this part of an earlier one.
constexpr double falling = 0.5;
/// Differences no larger than others by more than this are about the same.
constexpr double same = 2;
/// Two runs of a chaotic motion soon differ by more than this part of the range. Smaller differences need one more run to show
/// that they do not fall: a channel of small range may only begin to be followed.
constexpr double much = 0.05;
/// Below, rounding of a step is more than its error.
constexpr double least_tolerance = 1e-14;
/// A step of this over ω loses 1.6e-5 of a vibration: a hundredth in 70 periods.
constexpr double followed = 0.7;
/// What is lost falls with a power of TOL between 0, while all of it is lost, and 1.75: a step loses (ωh)⁶, and TOL allows
/// (ωh)⁴ of its velocity. This one serves where steps that lose some are no longer than those that follow it.
constexpr double order_of_lost = 1.5;

}  // namespace

void ErrorEstimate::follow(const std::vector<double>& differences) {
  constexpr std::size_t most = 4;
  const std::size_t enough = difference() > much ? 2 : 3;
  if (differences.size() < enough || difference() < falling * differences.front()) return;
  const auto [least, largest] = std::minmax({differences.end()[-2], differences.back(), difference()});
  // a vibration that the first runs damp makes later ones differ more; chaos makes all differ alike
  if (differences.size() < most && largest > same * least) return;
  falls = false;
  error = difference();
  share = 1;
}

void ErrorEstimate::include_lost(double lost, const std::string& where, double period, double target) {
  // runs that hold some of a vibration differ by it at random, as in chaos
  const bool explains = !falls && lost > target;
  if (!(lost > error) && !explains) return;
  if (lost > error) channel = where;
  error = std::max(error, lost);
  vibration = period;
  share = 1;
  order = order_of_lost;
  falls = true;
}

void ErrorEstimate::steps_reach(double longest_step) {
  longest = longest_step;
  falls = true;
}

double ErrorEstimate::follows_vibration() const { return followed * vibration / (2 * std::numbers::pi); }

double ErrorEstimate::longest_for(double target, const std::vector<double>& differences) const {
  constexpr double most_at_once = 0.1, least = 0.7;
  // what is shorter than the steps shows no order
  if (!differences.empty() && difference() >= falling * differences.back()) return most_at_once * longest;
  return std::clamp(std::pow(0.5 * target / error, 1 / order_of_steps), most_at_once, least) * longest;
}

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

std::string ErrorEstimate::miss(double target) const {
  const std::string asked = fmt::format("{:g}", target);
  std::string found;
  for (int digits = 2; digits <= 6 && (found.empty() || found == asked); ++digits) found = fmt::format("{:.{}g}", error, digits);
  return fmt::format("the error is estimated to be {} of the range of {}, more than the {} asked for", found, channel, asked);
}

std::string ErrorEstimate::warning(double target, const std::string& sharper_failed) const {
  if (!trouble.empty()) return "the error is not estimated: " + trouble;
  if (error <= target) return {};
  if (!falls)
    return fmt::format(
        "runs with TOL {:.1g} and {:.1g} differ by {:.2g} of the range of {}, hardly less than with the TOL before: a smaller "
        "one will not make this motion certain. It is chaotic, or goes through many impacts; averages over time may still be "
        "right",
        companion_tolerance, tolerance, error, channel);
  std::string advice = sharper_failed;
  if (advice.empty() && vibration > 0)
    advice = fmt::format(
        "steps lose a vibration with a period of about {:.2g}. Where it matters take HMAX {:.2g} in .SUB; where it does not, "
        "give what vibrates some damping",
        vibration, follows_vibration());
  else if (advice.empty() && longest > 0)
    advice = fmt::format("take HMAX {:.1g} in .SUB", longest_for(target, {}));
  else if (advice.empty())
    advice = tolerance_for(target) > least_tolerance
                 ? fmt::format("take TOL {:.1g} in .SUB", tolerance_for(target))
                 : "no TOL will reach it, as the numbers of this machine have 16 digits; ask for less, or for other channels";
  return miss(target) + ": " + advice;
}

std::string ErrorEstimate::describe(double target) const {
  std::string text =
      fmt::format("  asked for          {:g} of the range of each channel, root of the mean square over time\n", target);
  if (!trouble.empty()) return text + "  estimated error    none: " + trouble + "\n";
  if (vibration > 0)
    text += fmt::format("  estimated error    {:.2g}, {}; steps lose a vibration with a period of about {:.2g}; TOL {:.2g}\n",
                        error, channel, vibration, tolerance);
  else
    text += fmt::format("  estimated error    {:.2g}, {}; by a second run with TOL {:.2g}, where this one has {:.2g}{}\n", error,
                        channel, companion_tolerance, tolerance, falls ? "" : "; it does not fall with TOL");
  if (since)
    text += fmt::format(
        "  estimated from     t = {:.6g} on, where the run was continued; the error of the state there, from which it "
        "starts, is not included\n",
        *since);
  text +=
      fmt::format("  processor time     {:.2g} s, and {:.2g} s for the estimate\n", seconds, companion_seconds + earlier_seconds);
  if (shortened > 0)
    return text + fmt::format("  longest step       {:.2g}, shorter than the deck allows: here it limits the error, not TOL\n",
                              shortened);
  for (const AccuracyRung& rung : accuracy_rungs)
    if (falls && vibration == 0 && rung.target != target)
      text += fmt::format("  ACCURACY {:<10}error about {:.1g}, about {:.2g} s\n", rung.name, error_at(tolerance_of(rung)),
                          seconds_at(tolerance_of(rung)));
  return text;
}

}  // namespace engrane::app
