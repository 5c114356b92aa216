// SPDX-License-Identifier: BSD-3-Clause
// Where a follower touches the profile of a cam.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "elements/cams/cam_curve.hpp"

namespace engrane::elements::cams {

/// A point of the curve, with its normal towards the follower.
struct CamFoot {
  double s = 0;
  Vec2 p = Vec2::Zero(), n = Vec2::Zero();
  Vec2 t = Vec2::Zero();  ///< n turned by 90 degrees, anticlockwise
  double curvature = 0;   ///< positive where the curve is convex towards the follower
  double speed = 0;       ///< of the point along t, over the rate of s; negative where s decreases along t
};

/// Points where a follower touches the curve, or nearly touches it; the deepest one first.
struct CamFeet {
  static constexpr std::size_t most = 3;
  std::array<CamFoot, most> feet;
  std::size_t count = 0;

  const CamFoot* begin() const { return feet.data(); }
  const CamFoot* end() const { return feet.data() + count; }
};

/// The profile: a curve, or the parallel curve at the distance `inset`, away from the follower. A profile made for a roller is
/// parallel to the path of its centre, so that the envelope itself is never computed.
class CamProfile {
 public:
  /// `inside`: the follower is inside the curve.
  CamProfile(std::unique_ptr<CamCurve> curve, double inset, bool inside);

  /// The point of the curve nearest to q. With `last`, the s of the last step, only the part of the curve within a third of a
  /// turn of it is searched: a pin in a groove must not jump to another branch.
  CamFoot nearest(const Vec2& q, std::optional<double> last = {}) const;

  /// The point of the curve farthest in the direction of the unit vector m, where a flat face rests on it.
  CamFoot farthest(const Vec2& m) const;

  /// nearest(q), and every other point where a roller of this radius centred at q reaches into the curve, or nearly does. A
  /// roller wider than a hollow touches both sides of it.
  CamFeet under_roller(const Vec2& q, double radius) const;

  /// farthest(m), and every other local maximum of the curve in direction m that touches a flat face at this distance from the
  /// origin, or nearly does.
  CamFeet under_face(const Vec2& m, double distance) const;

  CamFoot at(double s) const;
  const CamCurve& curve() const { return *curve_; }
  double inset() const { return inset_; }
  /// Largest distance of the curve from its centre.
  double greatest() const { return greatest_; }

  /// The point of the curve at which f is smallest, to rounding error; f takes a CamFoot.
  template <class F>
  CamFoot least(F f) const {
    std::size_t best = 0;
    double value = f(at(0));
    for (std::size_t k = 1; k < samples_.size(); ++k)
      if (const double here = f(at(step_ * static_cast<double>(k))); here < value) {
        value = here;
        best = k;
      }
    // golden-section search about the best sample, which is kept if nothing better is found
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

  /// A point where the sampled curve crosses itself, if any.
  std::optional<Vec2> crossing() const;

 private:
  /// Parameter of the local minimum of a function near sample k. `slope` returns its first and second derivatives.
  template <class F>
  double settle(std::size_t k, F slope) const;
  /// Half the derivative of the squared distance from q, and its derivative.
  std::pair<double, double> slope_of_distance(double s, const Vec2& q) const;
  /// First and second derivatives of −p·m.
  std::pair<double, double> slope_of_height(double s, const Vec2& m) const;

  std::unique_ptr<CamCurve> curve_;
  double inset_;
  double sense_;  ///< 1: t points in the direction of increasing s, −1: opposite
  double step_;   ///< spacing of the samples in s
  std::vector<Vec2> samples_;
  /// Consecutive samples and a circle around them. Searches skip the groups that their circle rules out, with the same result
  /// as looking at every sample.
  struct Group {
    std::size_t begin, end;
    Vec2 center;
    double radius;
  };
  std::vector<Group> groups_;
  double longest_ = 0;   ///< between neighbouring samples
  double greatest_ = 0;  ///< of a sample from the origin
};

}  // namespace engrane::elements::cams
