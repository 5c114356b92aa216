// SPDX-License-Identifier: BSD-3-Clause
#include "elements/cams/cam_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace engrane::elements::cams {

namespace {

constexpr double pi = std::numbers::pi;

constexpr std::array<std::pair<const char*, CamLaw>, 5> names = {{{"CYCLOIDAL", CamLaw::cycloidal},
                                                                  {"MODIFIED_SINE", CamLaw::modified_sine},
                                                                  {"POLY345", CamLaw::poly_345},
                                                                  {"POLY4567", CamLaw::poly_4567},
                                                                  {"HARMONIC", CamLaw::harmonic}}};

/// constant + slope τ − amplitude sin(rate τ + shift).
Jet line_and_sine(double tau, double constant, double slope, double amplitude, double rate, double shift) {
  const double s = std::sin(rate * tau + shift), c = std::cos(rate * tau + shift);
  return {constant + slope * tau - amplitude * s, slope - amplitude * rate * c, amplitude * rate * rate * s,
          amplitude * rate * rate * rate * c};
}

/// Σ c_k τ^(first + k).
template <std::size_t N>
Jet polynomial(double tau, const std::array<double, N>& c, int first) {
  Jet j;
  for (std::size_t k = 0; k < N; ++k) {
    const double n = first + static_cast<double>(k), p = c[k] * std::pow(tau, n - 3);
    j.f += p * tau * tau * tau;
    j.d1 += n * p * tau * tau;
    j.d2 += n * (n - 1) * p * tau;
    j.d3 += n * (n - 1) * (n - 2) * p;
  }
  return j;
}

/// Part of a modified sine's segment in which the acceleration rises from zero, or falls to it.
constexpr double quarter_wave = 0.125;

/// Quarter sine waves, the middle one three times as long, joined with continuous acceleration (Norton, eqs. 3.11).
Jet modified_sine(double tau) {
  constexpr double scale = 1 / (4 + pi);
  if (tau < quarter_wave) return line_and_sine(tau, 0, scale * pi, scale / 4, 4 * pi, 0);
  if (tau > 1 - quarter_wave) return line_and_sine(tau, 4 * scale, scale * pi, scale / 4, 4 * pi, 0);
  return line_and_sine(tau, 2 * scale, scale * pi, scale * 9 / 4, 4 * pi / 3, pi / 3);
}

}  // namespace

std::optional<CamLaw> cam_law(const std::string& name) {
  for (const auto& [word, law] : names)
    if (name == word) return law;
  return {};
}

std::string cam_law_names() {
  std::string list;
  for (const auto& [word, law] : names) list += (list.empty() ? "" : ", ") + std::string(word);
  return list;
}

Jet unit_rise(CamLaw law, double tau) {
  switch (law) {
    case CamLaw::cycloidal:
      return line_and_sine(tau, 0, 1, 0.5 / pi, 2 * pi, 0);
    case CamLaw::modified_sine:
      return modified_sine(tau);
    case CamLaw::poly_345:
      return polynomial<3>(tau, {10, -15, 6}, 3);
    case CamLaw::poly_4567:
      return polynomial<4>(tau, {35, -84, 70, -20}, 4);
    case CamLaw::harmonic:
      return line_and_sine(tau, 0.5, 0, 0.5, pi, pi / 2);
  }
  return {};
}

Jet CamMotion::at(double turn) const {
  double angle = std::fmod(turn - phase_, 2 * pi);
  if (angle < 0) angle += 2 * pi;
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const Segment& s = segments_[i];
    // the widths sum to a full turn up to rounding error
    if (angle >= s.width && i + 1 < segments_.size()) {
      angle -= s.width;
      continue;
    }
    if (s.from == s.to) return {s.from, 0, 0, 0};
    const Jet j = stretched(unit_rise(s.law, std::min(angle / s.width, 1.0)), 1 / s.width);
    const double lift = s.to - s.from;
    return {s.from + lift * j.f, lift * j.d1, lift * j.d2, lift * j.d3};
  }
  return {};
}

std::vector<double> CamMotion::joints() const {
  std::vector<double> places;
  double begin = phase_, highest = 0, narrowest = 2 * pi;
  for (const Segment& s : segments_) {
    places.push_back(begin);
    if (s.from != s.to) {
      narrowest = std::min(narrowest, s.width);
      if (s.law == CamLaw::modified_sine)
        for (const double tau : {quarter_wave, 1 - quarter_wave}) places.push_back(begin + tau * s.width);
    }
    begin += s.width;
    highest = std::max({highest, s.from, s.to});
  }
  // second to fourth derivatives on either side, over those that a rise of so much in so small an angle may have
  const auto derivatives = [&](double place, double side) {
    const double step = 1e-4 * narrowest;
    const Jet near = at(place + 1e-6 * side * step), far = at(place + side * step);
    std::array<double, 3> found{near.d2, near.d3, (far.d3 - near.d3) / (side * step)};
    for (std::size_t k = 0; k < found.size(); ++k) found[k] *= std::pow(narrowest, 2 + static_cast<double>(k)) / highest;
    return found;
  };
  std::vector<double> found;
  for (const double place : places) {
    constexpr std::array least{1e-6, 1e-6, 0.1};  // a fourth derivative is known to the fifth times the step
    const auto before = derivatives(place, -1), behind = derivatives(place, 1);
    bool jumps = false;
    for (std::size_t k = 0; k < least.size(); ++k) jumps = jumps || std::abs(behind[k] - before[k]) > least[k];
    if (!jumps) continue;
    const double angle = std::fmod(place, 2 * pi);
    found.push_back(angle < 0 ? angle + 2 * pi : angle);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace engrane::elements::cams
