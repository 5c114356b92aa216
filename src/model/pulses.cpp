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

/// Ranges of samples, first and last, within which the values bend.
std::vector<std::pair<std::size_t, std::size_t>> bends(const std::vector<double>& values) {
  std::vector<double> bending(values.size(), 0.0);
  for (std::size_t i = 1; i + 1 < values.size(); ++i)
    if (const double b = std::abs(values[i + 1] - 2 * values[i] + values[i - 1]); std::isfinite(b)) bending[i] = b;
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

}  // namespace

std::vector<double> short_pulses(const Function& function, double from, double to, double long_enough) {
  if (!(to > from) || !is_sampled(function)) return {};
  const double spacing = (to - from) / static_cast<double>(samples);
  std::vector<double> values(samples + 1);
  const Expression* formula = function.formula();
  for (std::size_t i = 0; i <= samples; ++i) {
    const double x = from + static_cast<double>(i) * spacing;
    values[i] = formula ? formula->value(x) : function.at(x).f;  // a formula notes where at() is not finite
  }
  const std::vector<double> corners = formula ? function.corners(from, to, samples) : std::vector<double>();
  std::vector<double> found;
  for (const auto& [first, last] : bends(values)) {
    if (static_cast<double>(last - first) * spacing > long_enough) continue;
    const std::size_t begin = first - 1, end = last + 1;
    const auto corner = std::lower_bound(corners.begin(), corners.end(), from + static_cast<double>(begin) * spacing);
    if (last - first <= at_corner && corner != corners.end() && *corner <= from + static_cast<double>(end) * spacing) continue;
    std::size_t farthest = begin;
    for (std::size_t i = begin; i <= end; ++i)
      if (std::abs(values[i] - values[begin]) > std::abs(values[farthest] - values[begin])) farthest = i;
    for (const std::size_t i : {begin, farthest, end})
      if (const double x = from + static_cast<double>(i) * spacing; i > 0 && i < samples && (found.empty() || x > found.back()))
        found.push_back(x);
    if (found.size() > 3 * most_pulses) return {};
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
