// SPDX-License-Identifier: BSD-3-Clause
#include "output/window.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace engrane::output {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Window::Window(double from, double to) : from_(from), to_(to), least_(nothing), largest_(nothing) {}

void Window::see(double value) {
  least_ = std::fmin(least_, value);
  largest_ = std::fmax(largest_, value);
}

void Window::add(double time, double value, bool ends, double slack) {
  last_ = value;
  if (time >= from_ - slack && time <= to_ + slack) see(value);
  const auto take = [this](std::size_t i) { this->take(i); };
  stretch_.add(time, value, take);
  if (ends) stretch_.end(take);
}

void Window::take(std::size_t i) {
  const std::vector<Sample> samples = this->samples();
  const double a = std::max(from_, samples[i].time), b = std::min(to_, samples[i + 1].time);
  if (!(b > a)) return;
  const Cubic cubic(samples);
  // Gauss's quadrature is exact for the square of a cubic
  static constexpr std::array points{0.0694318442029737, 0.3300094782075719, 0.6699905217924281, 0.9305681557970263};
  static constexpr std::array weights{0.1739274225687269, 0.3260725774312731, 0.3260725774312731, 0.1739274225687269};
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double y = cubic(a + points[k] * (b - a));
    area_ += weights[k] * (b - a) * y;
    squares_ += weights[k] * (b - a) * y * y;
  }
  covered_ += b - a;
  // limits of the window may lie between samples
  const double ya = a > samples[i].time ? cubic(a) : samples[i].value;
  const double yb = b < samples[i + 1].time ? cubic(b) : samples[i + 1].value;
  see(ya);
  see(yb);
  if (samples.size() < 4) return;
  for (const double sign : {1.0, -1.0}) {
    const double level = std::max(sign * ya, sign * yb);
    see(sign * (level + extreme_between(samples, i, a, b, sign, level).beyond));
  }
}

std::vector<Sample> Window::samples() const {
  std::vector<Sample> all;
  for (const auto& point : stretch_.points()) all.push_back({point.time, point.value});
  return all;
}

Window::Measures Window::measures() const {
  Window all = *this;
  all.stretch_.end([&all](std::size_t i) { all.take(i); });
  if (std::isnan(all.largest_)) return {nothing, nothing, nothing, nothing};
  // a single instant is its own mean
  if (all.covered_ == 0) return {all.least_, all.largest_, last_, std::abs(last_)};
  return {all.least_, all.largest_, all.area_ / all.covered_, std::sqrt(all.squares_ / all.covered_)};
}

std::vector<double> Window::save() const {
  std::vector<double> all{last_, least_, largest_, area_, squares_, covered_, static_cast<double>(stretch_.taken())};
  for (const Sample& sample : samples()) all.insert(all.end(), {sample.time, sample.value});
  return all;
}

void Window::load(std::span<const double> saved) {
  std::size_t next = 0;
  for (double* value : {&last_, &least_, &largest_, &area_, &squares_, &covered_}) *value = saved[next++];
  const auto taken = static_cast<std::size_t>(saved[next++]);
  std::vector<Stretch<double>::Point> points;
  for (; next + 1 < saved.size(); next += 2) points.push_back({saved[next], saved[next + 1]});
  stretch_.restore(std::move(points), taken);
}

}  // namespace engrane::output
