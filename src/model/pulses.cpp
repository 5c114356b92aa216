// SPDX-License-Identifier: BSD-3-Clause
#include "model/pulses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace engrane {

namespace {

constexpr std::size_t samples = 16384, most_pulses = 100;
/// A pulse bends this many times as much as the function does in half of its samples, and by more than this part of its range.
constexpr double much = 100, little = 1e-6;
/// Points of inflection do not divide a pulse: nor do so many samples between two bends.
constexpr std::size_t straight = 8;
/// No more samples than these bend at a corner or a jump that is known.
constexpr std::size_t at_corner = 2;

bool is_sampled(const Function& function) {
  if (const Expression* formula = function.formula()) return !formula->is_law() && !formula->constant();
  const double infinity = std::numeric_limits<double>::infinity();
  return function.period() == 0 && function.joints(-infinity, infinity, most_pulses).empty() &&
         !function.joints(-infinity, infinity, std::numeric_limits<std::size_t>::max()).empty();
}

/// A function at equidistant points.
struct Samples {
  double from, spacing;
  std::vector<double> values;

  Samples(const Function& function, double first, double last, std::size_t count)
      : from(first), spacing((last - first) / static_cast<double>(count)), values(count + 1) {
    const Expression* formula = function.formula();
    for (std::size_t i = 0; i <= count; ++i)
      values[i] = formula ? formula->value(at(i)) : function.at(at(i)).f;  // a formula notes where at() is not finite
  }
  double at(std::size_t i) const { return from + static_cast<double>(i) * spacing; }
  /// Absolute second differences; 0 at the ends and where a value is not finite.
  std::vector<double> bending() const {
    std::vector<double> found(values.size(), 0.0);
    for (std::size_t i = 1; i + 1 < values.size(); ++i)
      if (const double b = std::abs(values[i + 1] - 2 * values[i] + values[i - 1]); std::isfinite(b)) found[i] = b;
    return found;
  }
};

/// Ranges of samples, first and last, within which the values bend.
std::vector<std::pair<std::size_t, std::size_t>> bends(const Samples& samples_of) {
  const std::vector<double>& values = samples_of.values;
  const std::vector<double> bending = samples_of.bending();
  std::vector<double> sorted = bending;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  double least = std::numeric_limits<double>::infinity(), largest = -least;
  for (const double value : values)
    if (std::isfinite(value)) {
      least = std::min(least, value);
      largest = std::max(largest, value);
    }
  const double threshold = std::max(much * *middle, little * (largest - least));
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (std::size_t i = 1; i + 1 < values.size(); ++i) {
    if (!(bending[i] > threshold)) continue;
    if (!found.empty() && i - found.back().second <= straight)
      found.back().second = i;
    else
      found.emplace_back(i, i);
  }
  return found;
}

/// Samples a formula between two samples of it, and between those between which it bends, until it bends at half of them: a
/// step from one level to another may be far shorter than the samples of a whole run.
Samples look_closer(const Function& function, double from, double to) {
  constexpr std::size_t count = 64;
  constexpr int most_looks = 8;
  constexpr double bent = 1e-3;  // of what bends most
  Samples seen(function, from, to, count);
  for (int look = 0; look < most_looks; ++look) {
    const std::vector<double> bending = seen.bending();
    const double least = bent * *std::max_element(bending.begin(), bending.end());
    const auto is_bent = [least](double b) { return b > least; };
    const auto first = std::find_if(bending.begin(), bending.end(), is_bent);
    const auto last = std::find_if(bending.rbegin(), bending.rend(), is_bent).base();
    if (first == bending.end() || last - first > static_cast<std::ptrdiff_t>(count / 2)) break;
    seen = Samples(function, seen.at(static_cast<std::size_t>(first - bending.begin()) - 1),
                   seen.at(static_cast<std::size_t>(last - bending.begin())), count);
  }
  return seen;
}

/// Where steps should end in a pulse, or in a change from one level to another: at both ends, half-way between the levels and
/// where the value is farthest from that of the beginning.
std::vector<double> ends_within(const Samples& pulse) {
  const std::vector<double>& y = pulse.values;
  const auto change = [&](std::size_t i) { return std::abs(y[i] - y[0]); };
  const std::size_t last = y.size() - 1;
  std::size_t farthest = 0, half_way = 0;
  for (std::size_t i = 0; i <= last; ++i)
    if (change(i) > change(farthest)) farthest = i;
  if (change(last) > change(farthest) / 2)
    while (change(half_way) < change(last) / 2) ++half_way;
  std::vector<double> ends;
  for (const std::size_t i : {std::size_t{0}, half_way, farthest, last})
    if (ends.empty() || pulse.at(i) > ends.back()) ends.push_back(pulse.at(i));
  return ends;
}

}  // namespace

std::vector<double> short_pulses(const Function& function, double from, double to, double long_enough) {
  if (!(to > from) || !is_sampled(function)) return {};
  const Samples whole(function, from, to, samples);
  const bool formula = function.formula() != nullptr;
  const std::vector<double> corners = formula ? function.corners(from, to, samples) : std::vector<double>();
  std::vector<double> found;
  std::size_t pulses = 0;
  for (const auto& [first, last] : bends(whole)) {
    if (static_cast<double>(last - first) * whole.spacing > long_enough) continue;
    const double begin = whole.at(first - 1), end = whole.at(last + 1);
    const auto corner = std::lower_bound(corners.begin(), corners.end(), begin);
    if (last - first <= at_corner && corner != corners.end() && *corner <= end) continue;
    if (++pulses > most_pulses) return {};
    const Samples pulse = formula ? look_closer(function, begin, end) : Samples(function, begin, end, last - first + 2);
    for (const double x : ends_within(pulse))
      if (from < x && x < to && (found.empty() || x > found.back())) found.push_back(x);
  }
  return found;
}

std::vector<double> step_ends(const Model& model, double from, double to) {
  constexpr double part_of_run = 0.1;  // longer pulses take several of the longest steps
  const double start = model.commands.stepping.start, end = model.commands.stepping.end;
  std::vector<double> all = model.joints(start, end);  // as many as the whole run has, also where it is continued
  for (const Function* function : model.of_time) {
    const std::vector<double> pulses = short_pulses(*function, start, end, part_of_run * (end - start));
    all.insert(all.end(), pulses.begin(), pulses.end());
  }
  std::erase_if(all, [&](double x) { return !(from < x && x < to); });
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace engrane
