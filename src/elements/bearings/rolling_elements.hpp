// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "math/chain.hpp"
#include "math/taylor.hpp"

namespace engrane::elements::bearings {

/// Data of a ball or roller bearing, as in catalogues and drawings.
struct RollingData {
  bool balls = true;
  int count = 0;
  double diameter = 0;                                ///< of a ball, or of a roller at mid-length
  double pitch_diameter = 0;                          ///< of the circle through the element centres
  double contact_angle = 0;                           ///< when the elements touch without load, radians
  double clearance = 0;                               ///< diametral play; negative: interference
  double inner_conformity = 0, outer_conformity = 0;  ///< balls: groove radius over ball diameter
  double length = 0;                                  ///< rollers: effective length
  bool crowned = true;                                ///< rollers: profile of ISO/TS 16281
  int slices = 30;                                    ///< slices per roller
  double young = 0, poisson = 0;
  double preload = 0;  ///< axial force on the shaft in the reference configuration
};

/// The rolling elements of a bearing between its rings: forces as a function of the displacement of the shaft's ring relative
/// to the housing's.
///
/// Coordinates: displacements along the axis 1 and the radial axes 2 and 3, and the tilts θ₂, θ₃ about the latter. Balls touch
/// grooves whose centres of curvature move apart (Harris and Kotzalas, Rolling Bearing Analysis, 5th ed., ch. 7); rollers are
/// divided into slices (ISO/TS 16281:2008). The elements do not orbit (the first stays on axis 2) and have no inertia.
class RollingElements {
 public:
  explicit RollingElements(const RollingData& data);

  template <class T>
  using Five = std::array<T, 5>;

  /// Resisting forces and moments of the elements on the coordinates. `homotopy`: State::contact_homotopy.
  template <class T>
  Five<T> load(const Five<T>& q, double homotopy) const {
    Five<T> load = through_few<5>(q, [&](const auto& own) { return sum(own); });
    if (homotopy > 0)
      for (std::size_t i = 0; i < 5; ++i) load[i] += q[i] * (homotopy * search_[i]);
    return load;
  }

  double energy(const Five<double>& q) const;

  struct Loads {
    double force = 0;     ///< largest on one element
    double pressure = 0;  ///< largest of both rings' contacts
    int loaded = 0;       ///< number of elements that carry load
  };
  Loads loads(const Five<double>& q) const;

  template <class T>
  struct Touch {
    T penetration;     ///< negative: minus the gap
    Five<T> gradient;  ///< with respect to the coordinates
  };
  /// Of each element; of a roller, where it is pressed in most.
  std::vector<Touch<double>> deepest(const Five<double>& q) const;

  /// Axial displacement caused by the preload in the reference configuration.
  double preload_approach() const { return shift_; }
  double contact_angle() const { return std::atan2(sine_, cosine_); }
  int count() const { return data_.count; }
  bool balls() const { return data_.balls; }
  double size() const { return data_.diameter; }

 private:
  /// One element, or one slice of a roller: its position around the axis and along the roller.
  struct Spot {
    double c, s;   ///< cosine and sine of the azimuth from axis 2
    double along;  ///< from the middle of the roller
    double gap;    ///< of a slice from its rings without displacement
  };
  template <class T>
  Touch<T> touch(const Spot& spot, const Five<T>& q) const;
  /// Contact force of one spot with positive penetration.
  template <class T>
  T force(const T& penetration) const;
  double stored(double penetration) const;
  template <class T>
  Five<T> sum(const Five<T>& q) const;
  int per_element() const { return data_.balls ? 1 : data_.slices; }
  double profile(double along) const;
  void find_preload();

  RollingData data_;
  double sine_ = 0, cosine_ = 1;                    ///< sine and cosine of the contact angle
  double distance_ = 0;                             ///< balls: distance of the groove centres when they touch without load
  double axial_ = 0, radial_ = 0;                   ///< its components in the reference configuration
  double groove_radius_ = 0;                        ///< radius of the circle of the inner groove's centres
  double stiffness_ = 0, exponent_ = 1.5;           ///< of one spot: Q = stiffness δ^exponent
  double inner_pressure_ = 0, outer_pressure_ = 0;  ///< p₀ = pressure Q^(1/3) of balls, Q^(1/2) of a slice
  Five<double> search_{};  ///< of the contact homotopy in statics: contacts alone leave some motions free
  double shift_ = 0;
  std::vector<Spot> spots_;  ///< grouped by element
};

template <class T>
RollingElements::Touch<T> RollingElements::touch(const Spot& spot, const Five<T>& q) const {
  using std::sqrt;
  const double c = spot.c, s = spot.s;
  const T lean = q[4] * c - q[3] * s;  // tilt of the shaft's axis towards the spot
  const T out = q[1] * c + q[2] * s, along = q[0] + shift_;
  if (data_.balls) {
    const T a = axial_ + along - lean * groove_radius_, r = radial_ + out;
    const T distance = sqrt(a * a + r * r), over = T(1) / distance, sine = a * over, cosine = r * over;
    return {distance - distance_, {sine, cosine * c, cosine * s, sine * (groove_radius_ * s), sine * (-groove_radius_ * c)}};
  }
  const double arm = spot.along - 0.5 * data_.pitch_diameter * sine_;
  return {along * sine_ + out * cosine_ + lean * arm - spot.gap,
          {T(sine_), T(cosine_ * c), T(cosine_ * s), T(-arm * s), T(arm * c)}};
}

template <class T>
T RollingElements::force(const T& penetration) const {
  const double x = value_of(penetration);
  const double slope = stiffness_ * std::pow(x, exponent_ - 1);
  return compose(penetration, slope * x, exponent_ * slope, exponent_ * (exponent_ - 1) * slope / x);
}

template <class T>
RollingElements::Five<T> RollingElements::sum(const Five<T>& q) const {
  Five<T> total;
  total.fill(T(0));
  for (const Spot& spot : spots_) {
    const Touch<T> t = touch(spot, q);
    if (value_of(t.penetration) <= 0) continue;
    const T load = force(t.penetration);
    for (std::size_t i = 0; i < 5; ++i) total[i] += load * t.gradient[i];
  }
  return total;
}

}  // namespace engrane::elements::bearings
