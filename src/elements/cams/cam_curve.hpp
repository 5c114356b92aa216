// SPDX-License-Identifier: BSD-3-Clause
// Closed plane curves that cam profiles are made from.
#pragma once

#include <complex>
#include <memory>
#include <optional>
#include <span>
#include <vector>

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
    Vec2 p, d1, d2;  ///< point, and derivatives with respect to s
  };
  CamCurve() = default;
  virtual ~CamCurve() = default;
  CamCurve(const CamCurve&) = delete;
  CamCurve& operator=(const CamCurve&) = delete;

  virtual Point at(double s) const = 0;
  /// The motion that the curve was generated from; nullptr for other curves.
  virtual const CamMotion* motion() const { return nullptr; }
  /// The parameter at which the outward normal of the curve is the unit vector m, if it is known without a search.
  virtual std::optional<double> facing(const Vec2& m) const {
    (void)m;
    return {};
  }
  /// Values of s in [0, 2π) at which a derivative jumps: the joints of the motion, or the points of a spline. Curves through
  /// more than twenty points (measured ones) have none.
  virtual std::vector<double> joints() const = 0;
  /// Number of pieces of the curve, for the resolution of searches.
  virtual std::size_t pieces() const = 0;
};

/// Curve through points: periodic cubic splines of both coordinates over the chord length.
std::unique_ptr<CamCurve> curve_through(std::span<const Vec2> points);

/// Curve from radii over polar angles (radians, increasing, within one turn), by a periodic cubic spline.
std::unique_ptr<CamCurve> polar_curve(std::span<const double> angle, std::span<const double> radius);

/// Path of a roller's centre (or a knife edge) relative to a rotating cam; s is the cam's turn. The follower moves along the x
/// axis: its position is `height` + lift in x and `offset` in y.
std::unique_ptr<CamCurve> path_of_slide(const CamMotion& motion, double height, double offset);

/// The same for a follower on an arm of length `arm`, whose pivot is on the x axis at `distance` from the cam's centre. At the
/// pivot the arm makes the angle `angle` − lift with the x axis; `side` is 1 if it is on the side of positive y.
std::unique_ptr<CamCurve> path_of_arm(const CamMotion& motion, double distance, double arm, double angle, double side);

/// Envelope of a flat face perpendicular to the x axis at `height` + `slope` times the lift; s is the cam's turn.
std::unique_ptr<CamCurve> envelope_of_face(const CamMotion& motion, double height, double slope);

}  // namespace engrane::elements::cams
