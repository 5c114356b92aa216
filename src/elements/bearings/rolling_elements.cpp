// SPDX-License-Identifier: BSD-3-Clause
#include "elements/bearings/rolling_elements.hpp"

#include <algorithm>
#include <numbers>

#include "elements/bearings/hertz.hpp"

namespace engrane::elements::bearings {

namespace {

using std::numbers::pi;

/// Typical deflection of rolling bearings, relative to the element diameter: scale of the stiffness and preload searches.
constexpr double typical_deflection = 1e-3;

}  // namespace

RollingElements::RollingElements(const RollingData& data)
    : data_(data), sine_(std::sin(data.contact_angle)), cosine_(std::cos(data.contact_angle)) {
  const double D = data.diameter;
  const double modulus = data.young / (2 * (1 - data.poisson * data.poisson));  // E* of two bodies of the same material
  if (data.balls) {
    distance_ = (data.inner_conformity + data.outer_conformity - 1) * D;
    // diametral play also allows axial play: at its end the balls touch at this contact angle
    if (data.clearance > 0) {
      cosine_ = std::max(0.0, 1 - data.clearance / (2 * distance_));
      sine_ = std::sqrt(1 - cosine_ * cosine_);
    }
    axial_ = distance_ * std::sin(data.contact_angle);
    radial_ = distance_ * std::cos(data.contact_angle) - data.clearance / 2;
    groove_radius_ = data.pitch_diameter / 2 + (data.inner_conformity - 0.5) * D * cosine_;
  }
  const double gamma = D * cosine_ / data.pitch_diameter;
  // sum of curvatures of element and ring in the plane of rolling
  const double inner = 2 / (D * (1 - gamma)), outer = 2 / (D * (1 + gamma));
  if (data.balls) {
    const PointContact in = point_contact(2 / D - 1 / (data.inner_conformity * D), inner, modulus);
    const PointContact out = point_contact(2 / D - 1 / (data.outer_conformity * D), outer, modulus);
    exponent_ = 1.5;
    stiffness_ = std::pow(std::pow(in.stiffness, -2.0 / 3) + std::pow(out.stiffness, -2.0 / 3), -1.5);
    inner_pressure_ = in.pressure;
    outer_pressure_ = out.pressure;
  } else {
    exponent_ = 10.0 / 9;
    // ISO/TS 16281, spring constant c_L: 35948 N/mm² for steel with E = 206 GPa and ν = 0.3 is 0.3176 E*; both contacts
    // together
    constexpr double of_modulus = 35948 * 2 * (1 - 0.3 * 0.3) / 206000;
    stiffness_ = of_modulus * modulus * std::pow(data.length, 8.0 / 9) / data.slices;
    // p₀² = w E*/(π R) for a force w per unit length (Johnson, eq. 4.45)
    const double per_length = data.slices / data.length;
    inner_pressure_ = std::sqrt(per_length * modulus * inner / pi);
    outer_pressure_ = std::sqrt(per_length * modulus * outer / pi);
  }
  const double typical =
      exponent_ * stiffness_ * per_element() * std::pow(typical_deflection * D, exponent_ - 1) * data.count / 2;
  const double lever = data.pitch_diameter / 2;
  search_ = {2 * typical, typical, typical, typical * lever * lever, typical * lever * lever};
  for (int j = 0; j < data.count; ++j) {
    const double azimuth = 2 * pi * j / data.count;
    for (int k = 0; k < per_element(); ++k) {
      const double along = data.balls ? 0 : data.length * ((k + 0.5) / data.slices - 0.5);
      spots_.push_back({std::cos(azimuth), std::sin(azimuth), along, data.clearance / 2 * cosine_ + 2 * profile(along)});
    }
  }
  if (data.preload > 0) find_preload();
}

/// ISO/TS 16281, eqs. 42 to 44: profile drop of a roller from its ring.
double RollingElements::profile(double along) const {
  if (data_.balls || !data_.crowned) return 0;
  const double D = data_.diameter, L = data_.length;
  const auto drop = [&](double share, double place) { return share * D * -std::log1p(-place * place); };
  if (data_.contact_angle != 0) return drop(0.00045, 2 * along / L);
  if (L <= 2.5 * D) return drop(0.00035, 2 * along / L);
  return drop(0.0005, std::max(0.0, (2 * std::abs(along) - (L - 2.5 * D)) / (2.5 * D)));
}

void RollingElements::find_preload() {
  const auto carried = [&](double approach) {
    shift_ = approach;
    return load(Five<double>{}, 0)[0];
  };
  double low = 0, high = typical_deflection * data_.diameter;
  while (carried(high) < data_.preload) {
    low = high;
    high *= 2;
  }
  for (int i = 0; i < 100 && low < high; ++i) {
    const double middle = (low + high) / 2;
    (carried(middle) < data_.preload ? low : high) = middle;
  }
  shift_ = high;
}

double RollingElements::stored(double penetration) const {
  return penetration <= 0 ? 0 : stiffness_ * std::pow(penetration, exponent_ + 1) / (exponent_ + 1);
}

double RollingElements::energy(const Five<double>& q) const {
  double total = 0;
  for (const Spot& spot : spots_) total += stored(touch(spot, q).penetration);
  return total;
}

RollingElements::Loads RollingElements::loads(const Five<double>& q) const {
  Loads found;
  double of_spot = 0;
  const auto slices = static_cast<std::size_t>(per_element());
  for (std::size_t first = 0; first < spots_.size(); first += slices) {
    double sum = 0;
    for (std::size_t i = first; i < first + slices; ++i) {
      const Touch<double> t = touch(spots_[i], q);
      const double load = t.penetration > 0 ? force(t.penetration) : 0;
      sum += load;
      of_spot = std::max(of_spot, load);
    }
    found.force = std::max(found.force, sum);
    if (sum > 0) ++found.loaded;
  }
  const double root = data_.balls ? std::cbrt(of_spot) : std::sqrt(of_spot);
  found.pressure = std::max(inner_pressure_, outer_pressure_) * root;
  return found;
}

std::vector<RollingElements::Touch<double>> RollingElements::deepest(const Five<double>& q) const {
  std::vector<Touch<double>> found;
  const auto slices = static_cast<std::size_t>(per_element());
  for (std::size_t i = 0; i < spots_.size(); ++i) {
    const Touch<double> t = touch(spots_[i], q);
    if (i % slices == 0)
      found.push_back(t);
    else if (t.penetration > found.back().penetration)
      found.back() = t;
  }
  return found;
}

}  // namespace engrane::elements::bearings
