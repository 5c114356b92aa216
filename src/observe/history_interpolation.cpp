// SPDX-License-Identifier: BSD-3-Clause
#include "observe/history_interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace engrane::observe {

namespace {

/// Largest sum of the magnitudes of the points' weights: 3.1 for six points evenly spread, 4.8 within a step of Radau IIA that is
/// twice as long as the last one.
constexpr double most_weight = 5;
/// Parts of the range of the points: by which a value of the polynomial through all of them may differ from that of the order
/// that this leaves, and by which the latter may leave the range.
constexpr double trusted = 0.5, overshoot = 0.5;
/// A size less than this part of those around counts as zero: a corner so near makes no larger difference.
constexpr double no_size = 1e-6;

}  // namespace

bool of_motion(const Dimension& d) {
  return d == dimension::angle || d == dimension::angular_velocity || d == dimension::velocity;
}

HistoryInterpolation::HistoryInterpolation(std::vector<const Channel*> channels, std::size_t element_values, MPI_Comm comm)
    : channels_(std::move(channels)),
      element_values_(element_values),
      comm_(comm),
      points_(most_points, std::numeric_limits<double>::infinity()) {}

void HistoryInterpolation::add(double time, std::span<const double> values, std::span<const double> sources) {
  if (begins_anew_ || points_.empty()) {
    const bool at_latest = std::exchange(begins_anew_, false);
    points_.clear();
    if (at_latest && !latest_.empty()) points_.add(latest_time_, latest_);
    steady_ = most_points;
  }
  int jump = 0;
  if (!latest_.empty())
    for (std::size_t i = 0; i < element_values_; ++i)
      if (channels_[i]->dimension == dimension::angle && std::abs(values[i] - latest_[i]) > std::numbers::pi) jump = 1;
  MPI_Bcast(&jump, 1, MPI_INT, 0, comm_);
  steady_ = jump != 0 ? 0 : steady_ + 1;
  latest_.assign(values.begin(), values.end());
  latest_.insert(latest_.end(), sources.begin(), sources.end());
  latest_time_ = time;
  points_.add(time, latest_);
}

std::span<const double> HistoryInterpolation::latest() const {
  return latest_.empty() ? std::span<const double>() : std::span(latest_).first(channels_.size());
}

std::vector<double> HistoryInterpolation::at(double time, std::span<const double> moved, std::size_t first,
                                             std::span<double> values) const {
  std::vector<double> all(latest_.size());
  points_.at(time, 0, all);
  std::copy_n(all.begin(), values.size(), values.begin());
  for (std::size_t i = first; i < moved.size(); ++i)
    if (of_motion(channels_[i]->dimension)) values[i] = moved[i];
  const auto [before, after, part] = points_.around(time);
  const std::vector<double> weights = points_.weights(time, 0), calm = points_.weights(time, 0, most_weight);
  const bool astray = calm.size() < weights.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Channel& channel = *channels_[i];
    switch (channel.course) {
      case Channel::Course::smooth:
        if (astray && (moved.empty() || !of_motion(channel.dimension)))
          values[i] = calmed(i, weights.size(), weighted(i, calm), values[i]);
        break;
      case Channel::Course::size:
        values[i] = size_between(i, weights, values[i]);
        if (astray) values[i] = calmed(i, weights.size(), size_between(i, calm, weighted(i, calm)), values[i]);
        break;
      case Channel::Course::ratio:
        values[i] = before[i] + part * (after[i] - before[i]);
        break;
      case Channel::Course::state:
        values[i] = part < 0.5 ? before[i] : after[i];
        break;
      case Channel::Course::step:
        values[i] = latest_[i];
        break;
    }
    // an angle that begins anew after a turn
    if (moved.empty() && i < element_values_ && channel.dimension == dimension::angle &&
        std::abs(after[i] - before[i]) > std::numbers::pi)
      values[i] = part < 0.5 ? before[i] : after[i];
    values[i] = std::clamp(values[i], channel.low, channel.high);
  }
  for (std::size_t i = values.size(); astray && i < all.size(); ++i)
    all[i] = calmed(i, weights.size(), weighted(i, calm), all[i]);
  return {all.begin() + static_cast<std::ptrdiff_t>(values.size()), all.end()};
}

double HistoryInterpolation::weighted(std::size_t column, std::span<const double> weights) const {
  double sum = 0;
  for (std::size_t p = 0; p < weights.size(); ++p) sum += weights[p] * points_.values(p)[column];
  return sum;
}

double HistoryInterpolation::calmed(std::size_t column, std::size_t points, double calm, double value) const {
  double least = points_.values(0)[column], most = least;
  for (std::size_t p = 1; p < points; ++p) {
    least = std::min(least, points_.values(p)[column]);
    most = std::max(most, points_.values(p)[column]);
  }
  const double range = most - least;
  if (std::abs(value - calm) <= trusted * range) return value;
  return std::clamp(calm, least - overshoot * range, most + overshoot * range);
}

double HistoryInterpolation::size_between(std::size_t column, std::span<const double> weights, double smooth) const {
  double square = 0, largest = 0;
  for (std::size_t p = 0; p < weights.size(); ++p) {
    const double size = points_.values(p)[column];
    square += weights[p] * size * size;
    largest = std::max(largest, size);
  }
  // a size that grows from zero has no corner, and its square, of high order there, is hardly seen by polynomials
  const double none = no_size * largest;
  const bool grows = points_.values(0)[column] <= none || points_.values(weights.size() - 1)[column] <= none;
  return grows ? std::max(smooth, 0.0) : std::sqrt(std::max(square, 0.0));
}

void HistoryInterpolation::save(Snapshot& snapshot) const {
  snapshot.put("observe/end", latest_);
  snapshot.put("observe/points", {latest_time_, static_cast<double>(steady_), begins_anew_ ? 1.0 : 0.0});
  points_.save(snapshot, "observe/ends");
}

void HistoryInterpolation::load(const Snapshot& snapshot, std::size_t sources) {
  if (!snapshot.has("observe/points") || snapshot.array("observe/end").size() != channels_.size() + sources) return;
  latest_ = snapshot.array("observe/end");
  const std::vector<double>& points = snapshot.array("observe/points");
  latest_time_ = points.at(0);
  steady_ = static_cast<std::size_t>(points.at(1));
  begins_anew_ = points.at(2) != 0;
  points_.load(snapshot, "observe/ends");
}

}  // namespace engrane::observe
