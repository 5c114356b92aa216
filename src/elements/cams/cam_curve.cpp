// SPDX-License-Identifier: BSD-3-Clause
#include "elements/cams/cam_curve.hpp"

#include <cmath>

#include "math/angle.hpp"

namespace engrane::elements::cams {

namespace {

using Complex = std::complex<double>;
constexpr Complex i{0, 1};

Vec2 plane(const Complex& z) { return {z.real(), z.imag()}; }

/// A curve by splines, whose third derivative jumps at each of its points.
class Splined : public CamCurve {
 public:
  explicit Splined(std::span<const double> s) : s_(s.begin(), s.end()) {}
  std::size_t pieces() const override { return s_.size(); }
  std::vector<double> joints() const override {
    constexpr std::size_t most = 20;
    std::vector<double> found;
    if (s_.size() > most) return found;
    for (const double s : s_) found.push_back(s - whole_turn * std::floor(s / whole_turn));
    return found;
  }

 private:
  std::vector<double> s_;  ///< of the points
};

class Spline final : public Splined {
 public:
  Spline(std::span<const double> s, Curve x, Curve y) : Splined(s), x_(std::move(x)), y_(std::move(y)) {}
  Point at(double s) const override {
    const Jet x = x_.at(s), y = y_.at(s);
    return {{x.f, y.f}, {x.d1, y.d1}, {x.d2, y.d2}};
  }

 private:
  Curve x_, y_;
};

class Polar final : public Splined {
 public:
  Polar(std::span<const double> angle, Curve radius) : Splined(angle), radius_(std::move(radius)) {}
  Point at(double s) const override {
    const Jet r = radius_.at(s);
    const Complex e = std::polar(1.0, s);
    return {plane(e * r.f), plane(e * (r.d1 + i * r.f)), plane(e * (r.d2 - r.f + i * 2.0 * r.d1))};
  }

 private:
  Curve radius_;
};

/// The curve traced in the cam by a point or a face of the moving follower: e^(−iθ) times a function of θ.
class Moved : public CamCurve {
 public:
  explicit Moved(const CamMotion& motion) : motion_(motion) {}
  const CamMotion* motion() const override { return &motion_; }
  std::vector<double> joints() const override { return motion_.joints(); }
  std::size_t pieces() const override { return motion_.segments().size(); }

 protected:
  /// From z and its derivatives with respect to θ.
  static Point carried(double theta, const Complex& z, const Complex& z1, const Complex& z2) {
    const Complex e = std::polar(1.0, -theta);
    return {plane(e * z), plane(e * (z1 - i * z)), plane(e * (z2 - 2.0 * i * z1 - z))};
  }
  CamMotion motion_;
};

class PathOfSlide final : public Moved {
 public:
  PathOfSlide(const CamMotion& motion, double height, double offset) : Moved(motion), height_(height), offset_(offset) {}
  Point at(double s) const override {
    const Jet lift = motion_.at(s);
    return carried(s, {height_ + lift.f, offset_}, lift.d1, lift.d2);
  }

 private:
  double height_, offset_;
};

class PathOfArm final : public Moved {
 public:
  PathOfArm(const CamMotion& motion, double distance, double arm, double angle, double side)
      : Moved(motion), distance_(distance), arm_(arm), angle_(angle), side_(side) {}
  Point at(double s) const override {
    const Jet lift = motion_.at(s);
    const double angle = side_ * (angle_ - lift.f), d1 = -side_ * lift.d1, d2 = -side_ * lift.d2;
    const Complex arm = std::polar(arm_, angle);
    return carried(s, distance_ + arm, i * d1 * arm, (i * d2 - d1 * d1) * arm);
  }

 private:
  double distance_, arm_, angle_, side_;
};

class EnvelopeOfFace final : public Moved {
 public:
  EnvelopeOfFace(const CamMotion& motion, double height, double slope) : Moved(motion), height_(height), slope_(slope) {}
  Point at(double s) const override {
    const Jet lift = motion_.at(s);
    const double k = slope_;
    // the face's distance h is the support function of the envelope: p = h m + (dh/dφ) m', φ = −θ; the third derivative of h
    // enters d2
    return carried(s, {height_ + k * lift.f, -k * lift.d1}, {k * lift.d1, -k * lift.d2}, {k * lift.d2, -k * lift.d3});
  }
  /// The generating face had this normal at the cam angle s; a face that undercuts the profile is rejected.
  std::optional<double> facing(const Vec2& m) const override { return -std::atan2(m[1], m[0]); }

 private:
  double height_, slope_;
};

}  // namespace

std::unique_ptr<CamCurve> curve_through(std::span<const Vec2> points) {
  const std::size_t n = points.size();
  std::vector<double> s(n), x(n), y(n);
  double length = 0;
  for (std::size_t k = 0; k < n; ++k) {
    s[k] = length;
    x[k] = points[k][0];
    y[k] = points[k][1];
    length += (points[(k + 1) % n] - points[k]).norm();
  }
  for (double& value : s) value *= whole_turn / length;
  return std::make_unique<Spline>(s, Curve::periodic_spline(s, x, whole_turn), Curve::periodic_spline(s, y, whole_turn));
}

std::unique_ptr<CamCurve> polar_curve(std::span<const double> angle, std::span<const double> radius) {
  return std::make_unique<Polar>(angle, Curve::periodic_spline(angle, radius, whole_turn));
}

std::unique_ptr<CamCurve> path_of_slide(const CamMotion& motion, double height, double offset) {
  return std::make_unique<PathOfSlide>(motion, height, offset);
}

std::unique_ptr<CamCurve> path_of_arm(const CamMotion& motion, double distance, double arm, double angle, double side) {
  return std::make_unique<PathOfArm>(motion, distance, arm, angle, side);
}

std::unique_ptr<CamCurve> envelope_of_face(const CamMotion& motion, double height, double slope) {
  return std::make_unique<EnvelopeOfFace>(motion, height, slope);
}

}  // namespace engrane::elements::cams
