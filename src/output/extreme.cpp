// SPDX-License-Identifier: BSD-3-Clause
#include "output/extreme.hpp"

#include <cmath>

namespace engrane::output {

namespace {

/// Parabolas through three samples may differ by so much from the cubic in how far an extreme lies beyond the samples.
constexpr double trusted = 0.5;

}  // namespace

Cubic::Cubic(std::span<const Sample> samples) : origin_(samples[0].time) {
  // Newton's divided differences, then powers
  std::array<double, 4> d{};
  for (std::size_t i = 0; i < samples.size(); ++i) d[i] = samples[i].value;
  for (std::size_t k = 1; k < samples.size(); ++k)
    for (std::size_t i = samples.size() - 1; i >= k; --i) d[i] = (d[i] - d[i - 1]) / (samples[i].time - samples[i - k].time);
  for (std::size_t k = samples.size(); k-- > 0;) {
    const double shift = samples[k].time - origin_;
    for (std::size_t i = 3; i > 0; --i) c_[i] = c_[i - 1] - shift * c_[i];
    c_[0] = d[k] - shift * c_[0];
  }
}

double Cubic::operator()(double time) const {
  const double x = time - origin_;
  return c_[0] + x * (c_[1] + x * (c_[2] + x * c_[3]));
}

Extreme Cubic::beyond(double a, double b, double sign, double level) const {
  // zeros of the slope c1 + 2 c2 x + 3 c3 x²
  const double square = 4 * c_[2] * c_[2] - 12 * c_[1] * c_[3];
  Extreme most;
  if (!(square >= 0)) return most;
  const double sum = -(2 * c_[2] + std::copysign(std::sqrt(square), c_[2]));
  for (const double x : {sum / (6 * c_[3]), 2 * c_[1] / sum}) {
    const double time = origin_ + x;
    if (!(time > a && time < b)) continue;
    if (const double over = sign * (*this)(time)-level; over > most.beyond) most = {over, time};
  }
  return most;
}

Extreme extreme_between(std::span<const Sample> samples, std::size_t i, double a, double b, double sign, double level) {
  const Extreme found = Cubic(samples).beyond(a, b, sign, level);
  if (found.beyond == 0) return found;
  for (std::size_t first = i > 0 ? i - 1 : 0; first <= i && first + 2 < samples.size(); ++first) {
    const double one = Cubic(samples.subspan(first, 3)).beyond(a, b, sign, level).beyond;
    if (!(one > 0 && std::abs(found.beyond - one) <= trusted * one)) return {};
  }
  return found;
}

}  // namespace engrane::output
