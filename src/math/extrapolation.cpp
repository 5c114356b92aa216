// SPDX-License-Identifier: BSD-3-Clause
#include "math/extrapolation.hpp"

#include <algorithm>
#include <cmath>

namespace engrane {

void Extrapolation::add(double time, std::span<const double> values) {
  if (count_ == 0 || time > points_[0].time) {
    std::rotate(points_.begin(), points_.end() - 1, points_.end());
    count_ = std::min(count_ + 1, points_.size());
  }
  points_[0].time = time;
  points_[0].values.assign(values.begin(), values.end());
}

std::size_t Extrapolation::reach(double h) const {
  std::size_t points = 1;
  while (points < count_ && h <= longest_ * (points_[points - 1].time - points_[points].time)) ++points;
  return points;
}

double Extrapolation::share(double time, double h) const {
  // both errors are the same derivative times a product of distances from the points
  const std::size_t points = reach(h);
  const auto distances = [&](double from, std::size_t count) {
    double product = 1;
    for (std::size_t p = 0; p < count; ++p) product *= std::abs(from - points_[p].time);
    return product;
  };
  constexpr int samples = 8;
  double largest = 0;
  for (int s = 1; s < samples; ++s) {
    const double between = points_[0].time + (time - points_[0].time) * s / samples;
    largest = std::max(largest, distances(between, points - 1) * (time - between));
  }
  return largest / distances(time, points);
}

std::vector<double> Extrapolation::weights(double time, double h, double most) const {
  std::vector<double> all;  // Lagrange weights
  for (std::size_t points = reach(h); points > 0; --points) {
    all.assign(points, 1.0);
    double sum = 0;
    for (std::size_t p = 0; p < points; ++p) {
      for (std::size_t q = 0; q < points; ++q)
        if (q != p) all[p] *= (time - points_[q].time) / (points_[p].time - points_[q].time);
      sum += std::abs(all[p]);
    }
    if (sum <= most || points <= 2) break;
  }
  return all;
}

void Extrapolation::at(double time, double h, std::span<double> values) const {
  const std::vector<double> weight = weights(time, h);
  std::fill(values.begin(), values.end(), 0.0);
  for (std::size_t p = 0; p < weight.size(); ++p)
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += weight[p] * points_[p].values[i];
}

Extrapolation::Around Extrapolation::around(double time) const {
  std::size_t after = 0;
  while (after + 2 < count_ && points_[after + 1].time > time) ++after;
  const Point &to = points_[after], &from = points_[count_ > 1 ? after + 1 : after];
  const double part = to.time > from.time ? std::clamp((time - from.time) / (to.time - from.time), 0.0, 1.0) : 1;
  return {from.values, to.values, part};
}

void Extrapolation::save(Snapshot& snapshot, const std::string& name) const {
  std::vector<double> all;
  for (std::size_t p = 0; p < count_; ++p) {
    all.push_back(points_[p].time);
    all.insert(all.end(), points_[p].values.begin(), points_[p].values.end());
  }
  snapshot.put(name, std::move(all));
  snapshot.put(name + "_points", static_cast<double>(count_));
}

void Extrapolation::load(const Snapshot& snapshot, const std::string& name) {
  const std::vector<double>& all = snapshot.array(name);
  count_ = std::min(static_cast<std::size_t>(snapshot.number(name + "_points")), points_.size());
  const auto length = static_cast<std::ptrdiff_t>(count_ > 0 ? all.size() / count_ : 0);
  for (std::size_t p = 0; p < count_; ++p) {
    const auto first = all.begin() + length * static_cast<std::ptrdiff_t>(p);
    points_[p].time = *first;
    points_[p].values.assign(first + 1, first + length);
  }
}

}  // namespace engrane
