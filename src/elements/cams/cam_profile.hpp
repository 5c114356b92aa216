// SPDX-License-Identifier: BSD-3-Clause
// Where a follower touches the profile of a cam.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "elements/cams/cam_curve.hpp"

namespace engrane::elements::cams {

/// A place on the curve, with its normal towards the follower.
struct CamFoot {
  double s = 0;
  Vec2 p = Vec2::Zero(), n = Vec2::Zero();
  Vec2 t = Vec2::Zero();  ///< n turned by 90 degrees, anticlockwise
  double curvature = 0;   ///< positive where the curve is convex towards the follower
};

/// Where a follower touches the curve, or all but touches it; the deepest place first.
struct CamFeet {
  static constexpr std::size_t most = 3;
  std::array<CamFoot, most> feet;
  std::size_t count = 0;

  const CamFoot* begin() const { return feet.data(); }
  const CamFoot* end() const { return feet.data() + count; }
};

/// The profile: a curve, or one parallel to it by `inset`, away from the follower. A profile made for a roller is parallel to the
/// path of its centre, so that neither roots nor points of the envelope are ever needed.
class CamProfile {
 public:
  /// `inside`: the follower is within the curve.
  CamProfile(std::unique_ptr<CamCurve> curve, double inset, bool inside);

  /// The point of the curve that is nearest to q. With `last`, the s of the last step, only the part of the curve within a third
  /// of its turn counts: a pin in a groove does not leap to another branch.
  CamFoot nearest(const Vec2& q, std::optional<double> last = {}) const;

  /// The point of the curve farthest in the direction of the unit vector m: where a flat face rests on it.
  CamFoot farthest(const Vec2& m) const;

  /// nearest(q), and every other place where a roller about q, of this radius, reaches into the curve. A roller that is wider
  /// than a hollow touches both sides of it.
  CamFeet under_roller(const Vec2& q, double radius) const;

  /// farthest(m), and every other hill of the curve that touches a flat face at this distance from the origin, or all but touches
  /// it.
  CamFeet under_face(const Vec2& m, double distance) const;

  CamFoot at(double s) const;
  const CamCurve& curve() const { return *curve_; }
  double inset() const { return inset_; }

  /// The place on the curve where f is least, to rounding of f; f is given feet.
  template <class F>
  CamFoot least(F f) const {
    std::size_t best = 0;
    double value = f(at(0));
    for (std::size_t k = 1; k < samples_.size(); ++k)
      if (const double here = f(at(step_ * static_cast<double>(k))); here < value) {
        value = here;
        best = k;
      }
    // golden section about the best sample; it never returns worse than that
    double a = step_ * (static_cast<double>(best) - 1), b = step_ * (static_cast<double>(best) + 1);
    double found = step_ * static_cast<double>(best);
    for (int k = 0; k < 60; ++k) {
      constexpr double part = 0.3819660112501051;
      const double x = a + part * (b - a), y = b - part * (b - a);
      const double fx = f(at(x)), fy = f(at(y));
      if (fx < value) value = fx, found = x;
      if (fy < value) value = fy, found = y;
      (fx < fy ? b : a) = fx < fy ? y : x;
    }
    return at(found);
  }

  /// Where two pieces of the curve cross, if they do.
  std::optional<Vec2> crossing() const;

 private:
  /// Zero of the slope of a function along the curve that is least near sample k. `slope` gives the first and second derivative.
  template <class F>
  double settle(std::size_t k, F slope) const;
  /// Half of the derivative of the squared distance from q, and its derivative.
  std::pair<double, double> slope_of_distance(double s, const Vec2& q) const;
  /// Derivatives of −p·m.
  std::pair<double, double> slope_of_height(double s, const Vec2& m) const;

  std::unique_ptr<CamCurve> curve_;
  double inset_;
  double sense_;  ///< 1: t runs with s
  double step_;   ///< of s between samples
  std::vector<Vec2> samples_;
  /// Neighbouring samples and a circle around them: a search looks into those groups only that the circle does not rule out,
  /// and finds what a look at every sample would find.
  struct Group {
    std::size_t begin, end;
    Vec2 center;
    double radius;
  };
  std::vector<Group> groups_;
  double longest_ = 0;   ///< distance of neighbouring samples
  double greatest_ = 0;  ///< distance of a sample from the origin
};

}  // namespace engrane::elements::cams
