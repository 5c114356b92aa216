// SPDX-License-Identifier: BSD-3-Clause
// Closed plane curves that cams are cut to.
#pragma once

#include <complex>
#include <memory>
#include <optional>
#include <span>

#include "elements/cams/cam_motion.hpp"
#include "math/spline.hpp"
#include "math/vector.hpp"

namespace engrane::elements::cams {

using Vec2 = Eigen::Vector2d;

/// The vector turned by 90 degrees, anticlockwise.
inline Vec2 turned_left(const Vec2& v) { return {-v[1], v[0]}; }
inline double plane_cross(const Vec2& a, const Vec2& b) { return a[0] * b[1] - a[1] * b[0]; }

/// A closed curve p(s) in the plane of a cam, s periodic by 2π.
class CamCurve {
 public:
  struct Point {
    Vec2 p, d1, d2;  ///< place and derivatives by s
  };
  CamCurve() = default;
  virtual ~CamCurve() = default;
  CamCurve(const CamCurve&) = delete;
  CamCurve& operator=(const CamCurve&) = delete;

  virtual Point at(double s) const = 0;
  /// Follower's lift and derivatives where it touches at s; only a curve made from a motion has one.
  virtual const CamMotion* motion() const { return nullptr; }
  /// Where the outward normal of the curve is the unit vector m, if that needs no search.
  virtual std::optional<double> facing(const Vec2& m) const {
    (void)m;
    return {};
  }
  /// How many pieces it is made of: what a search must look at.
  virtual std::size_t pieces() const = 0;
};

/// Through points, by a periodic cubic spline of both coordinates over the length of the chords.
std::unique_ptr<CamCurve> curve_through(std::span<const Vec2> points);

/// Radius over polar angle (radians, increasing, within one turn), by a periodic cubic spline.
std::unique_ptr<CamCurve> polar_curve(std::span<const double> angle, std::span<const double> radius);

/// The path of a roller's centre (or a knife's edge) in a cam that turns, s its turn. The follower moves along the x axis:
/// its place is `height` + lift in x, `offset` in y.
std::unique_ptr<CamCurve> path_of_slide(const CamMotion& motion, double height, double offset);

/// The same of a follower on an arm of length `arm`, whose pivot is on the x axis at `distance` from the cam's centre. Seen from
/// the pivot the arm stands at `angle` − lift from the x axis, `side` 1: on the side of positive y.
std::unique_ptr<CamCurve> path_of_arm(const CamMotion& motion, double distance, double arm, double angle, double side);

/// The envelope of a flat face across the x axis at `height` + `slope` times the lift; s is the cam's turn.
std::unique_ptr<CamCurve> envelope_of_face(const CamMotion& motion, double height, double slope);

}  // namespace engrane::elements::cams
