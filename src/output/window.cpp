// SPDX-License-Identifier: BSD-3-Clause
#include "output/window.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace engrane::output {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
/// Neighbouring intervals of a stretch differ at most by this factor: polynomials through samples closer together are noise.
constexpr double most_uneven = 100;
/// Parabolas through three samples may differ by so much from the cubic in how far an extreme lies beyond the samples.
constexpr double trusted = 0.5;

/// Polynomial of degree up to three through samples, in powers of the time from `origin`.
struct Cubic {
  double origin;
  std::array<double, 4> c{};

  template <class Samples>
  explicit Cubic(const Samples& s) : origin(s[0].time) {
    // Newton's divided differences, then powers
    std::array<double, 4> d{};
    for (std::size_t i = 0; i < s.size(); ++i) d[i] = s[i].value;
    for (std::size_t k = 1; k < s.size(); ++k)
      for (std::size_t i = s.size() - 1; i >= k; --i) d[i] = (d[i] - d[i - 1]) / (s[i].time - s[i - k].time);
    for (std::size_t k = s.size(); k-- > 0;) {
      const double shift = s[k].time - origin;
      for (std::size_t i = 3; i > 0; --i) c[i] = c[i - 1] - shift * c[i];
      c[0] = d[k] - shift * c[0];
    }
  }

  double operator()(double time) const {
    const double x = time - origin;
    return c[0] + x * (c[1] + x * (c[2] + x * c[3]));
  }
  /// Largest value of `sign` times this within (a, b), less `level`; 0 if there is none above it.
  double beyond(double a, double b, double sign, double level) const {
    // zeros of the slope c1 + 2 c2 x + 3 c3 x²
    const double square = 4 * c[2] * c[2] - 12 * c[1] * c[3];
    if (!(square >= 0)) return 0;
    const double sum = -(2 * c[2] + std::copysign(std::sqrt(square), c[2]));
    double most = 0;
    for (const double x : {sum / (6 * c[3]), 2 * c[1] / sum})
      if (origin + x > a && origin + x < b) most = std::max(most, sign * (*this)(origin + x) - level);
    return most;
  }
};

}  // namespace

Window::Window(double from, double to) : from_(from), to_(to), least_(nothing), largest_(nothing) {}

void Window::see(double value) {
  least_ = std::fmin(least_, value);
  largest_ = std::fmax(largest_, value);
}

void Window::add(double time, double value, bool ends, double slack) {
  last_ = value;
  if (time >= from_ - slack && time <= to_ + slack) see(value);
  if (!stretch_.empty() && time <= stretch_.back().time) {
    end_stretch();
    stretch_ = {{time, value}};
  } else {
    if (stretch_.size() > 1) {
      const double before = stretch_.back().time - stretch_[stretch_.size() - 2].time, now = time - stretch_.back().time;
      if (now > most_uneven * before || before > most_uneven * now) end_stretch();
    }
    if (stretch_.size() == 4) {
      stretch_.erase(stretch_.begin());
      --taken_;
    }
    stretch_.push_back({time, value});
    if (stretch_.size() == 4)
      while (taken_ < 2) take(taken_++);
  }
  if (ends) end_stretch();
}

void Window::end_stretch() {
  while (taken_ + 1 < stretch_.size()) take(taken_++);
  if (!stretch_.empty()) stretch_.erase(stretch_.begin(), stretch_.end() - 1);
  taken_ = 0;
}

void Window::take(std::size_t i) {
  const double a = std::max(from_, stretch_[i].time), b = std::min(to_, stretch_[i + 1].time);
  if (!(b > a)) return;
  const Cubic cubic(stretch_);
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
  const double ya = a > stretch_[i].time ? cubic(a) : stretch_[i].value;
  const double yb = b < stretch_[i + 1].time ? cubic(b) : stretch_[i + 1].value;
  see(ya);
  see(yb);
  std::vector<Cubic> parabolas;
  for (std::size_t first = i > 0 ? i - 1 : 0; first <= i && first + 2 < stretch_.size(); ++first)
    parabolas.emplace_back(std::span(stretch_).subspan(first, 3));
  for (const double sign : {1.0, -1.0}) {
    const double level = std::max(sign * ya, sign * yb), beyond = cubic.beyond(a, b, sign, level);
    const auto confirms = [&](const Cubic& parabola) {
      const double one = parabola.beyond(a, b, sign, level);
      return one > 0 && std::abs(beyond - one) <= trusted * one;
    };
    const bool found = stretch_.size() == 4 && std::all_of(parabolas.begin(), parabolas.end(), confirms);
    if (found) see(sign * (level + beyond));
  }
}

Window::Measures Window::measures() const {
  Window all = *this;
  all.end_stretch();
  if (std::isnan(all.largest_)) return {nothing, nothing, nothing, nothing};
  // a single instant is its own mean
  if (all.covered_ == 0) return {all.least_, all.largest_, last_, std::abs(last_)};
  return {all.least_, all.largest_, all.area_ / all.covered_, std::sqrt(all.squares_ / all.covered_)};
}

std::vector<double> Window::save() const {
  std::vector<double> all{last_, least_, largest_, area_, squares_, covered_, static_cast<double>(taken_)};
  for (const Sample& sample : stretch_) all.insert(all.end(), {sample.time, sample.value});
  return all;
}

void Window::load(std::span<const double> saved) {
  std::size_t next = 0;
  for (double* value : {&last_, &least_, &largest_, &area_, &squares_, &covered_}) *value = saved[next++];
  taken_ = static_cast<std::size_t>(saved[next++]);
  stretch_.clear();
  for (; next + 1 < saved.size(); next += 2) stretch_.push_back({saved[next], saved[next + 1]});
}

}  // namespace engrane::output
