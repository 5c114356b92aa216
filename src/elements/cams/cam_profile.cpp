// SPDX-License-Identifier: BSD-3-Clause
#include "elements/cams/cam_profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace engrane::elements::cams {

namespace {

constexpr double whole_turn = 2 * std::numbers::pi;

/// From −π to π.
double difference(double a, double b) { return std::remainder(a - b, whole_turn); }

}  // namespace

CamProfile::CamProfile(std::unique_ptr<CamCurve> curve, double inset, bool inside) : curve_(std::move(curve)), inset_(inset) {
  const std::size_t n = std::clamp<std::size_t>(4 * curve_->pieces(), 720, 20000);
  step_ = whole_turn / static_cast<double>(n);
  samples_.reserve(n);
  for (std::size_t k = 0; k < n; ++k) samples_.push_back(curve_->at(step_ * static_cast<double>(k)).p);
  double area = 0;
  for (std::size_t k = 0; k < n; ++k) area += plane_cross(samples_[k], samples_[(k + 1) % n]);
  sense_ = (area > 0) == inside ? -1 : 1;
}

CamFoot CamProfile::at(double s) const {
  const CamCurve::Point c = curve_->at(s);
  CamFoot foot;
  foot.s = s;
  foot.p = c.p;
  const double speed = c.d1.norm();
  foot.t = c.d1 * (sense_ / speed);
  foot.n = -turned_left(foot.t);
  foot.curvature = sense_ * plane_cross(c.d1, c.d2) / (speed * speed * speed);
  return foot;
}

template <class F>
double CamProfile::settle(std::size_t k, F slope) const {
  const double middle = step_ * static_cast<double>(k);
  double a = middle - step_, b = middle + step_;
  for (int i = 0; i < 3 && slope(a).first > 0; ++i) a -= step_;
  for (int i = 0; i < 3 && slope(b).first < 0; ++i) b += step_;
  // Newton's method, by halves where it would leave the bracket
  double s = middle;
  for (int i = 0; i < 100; ++i) {
    const auto [f, df] = slope(s);
    if (f == 0) break;
    (f < 0 ? a : b) = s;
    double next = s - f / df;
    if (!(df > 0) || !(next > a && next < b)) next = 0.5 * (a + b);
    const double change = std::abs(next - s);
    s = next;
    if (change <= 1e-16 * whole_turn) break;
  }
  return s;
}

CamFoot CamProfile::nearest(const Vec2& q, std::optional<double> last) const {
  const std::size_t n = samples_.size();
  const auto counts = [&](std::size_t k) {
    return !last || std::abs(difference(step_ * static_cast<double>(k), *last)) <= whole_turn / 3;
  };
  std::vector<double> distance(n);  // squared
  for (std::size_t k = 0; k < n; ++k) distance[k] = (samples_[k] - q).squaredNorm();
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < n; ++k)
    if (counts(k)) best = std::min(best, distance[k]);

  // between samples the curve may come nearer by less than their spacing: every valley as deep as that is a candidate
  const auto slope = [&](double s) {
    const CamCurve::Point c = curve_->at(s);
    const Vec2 away = c.p - q;
    return std::pair(away.dot(c.d1), c.d1.squaredNorm() + away.dot(c.d2));
  };
  CamFoot foot;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t before = (k + n - 1) % n, after = (k + 1) % n;
    if (!counts(k) || distance[k] > distance[before] || distance[k] >= distance[after]) continue;
    if (std::sqrt(distance[k]) - std::sqrt(best) > (samples_[k] - samples_[after]).norm()) continue;
    const CamFoot found = at(settle(k, slope));
    const double d = (found.p - q).norm();
    if (d < least) {
      least = d;
      foot = found;
    }
  }
  if (!std::isfinite(least)) {  // the least is at the edge of the window, or the curve is a circle about q
    const auto k = static_cast<std::size_t>(std::find(distance.begin(), distance.end(), best) - distance.begin());
    return at(settle(std::min(k, n - 1), slope));
  }
  return foot;
}

CamFoot CamProfile::farthest(const Vec2& m) const {
  std::size_t best = 0;
  double reach = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < samples_.size(); ++k)
    if (const double here = samples_[k].dot(m); here > reach) {
      reach = here;
      best = k;
    }
  return at(settle(best, [&](double s) {
    const CamCurve::Point c = curve_->at(s);
    return std::pair(-c.d1.dot(m), -c.d2.dot(m));
  }));
}

std::optional<Vec2> CamProfile::crossing() const {
  // segments in order of their least x: only those that overlap there are compared
  const std::size_t n = samples_.size();
  struct Segment {
    std::size_t k;
    double low, high;
  };
  std::vector<Segment> segments;
  for (std::size_t k = 0; k < n; ++k) {
    const auto [low, high] = std::minmax(samples_[k][0], samples_[(k + 1) % n][0]);
    segments.push_back({k, low, high});
  }
  std::sort(segments.begin(), segments.end(), [](const Segment& a, const Segment& b) { return a.low < b.low; });
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n && segments[b].low <= segments[a].high; ++b) {
      const std::size_t i = segments[a].k, j = segments[b].k;
      if ((i + 1) % n == j || (j + 1) % n == i) continue;
      const Vec2 &p = samples_[i], &q = samples_[j];
      const Vec2 along = samples_[(i + 1) % n] - p, other = samples_[(j + 1) % n] - q;
      const double area = plane_cross(along, other);
      if (area == 0) continue;
      const double x = plane_cross(Vec2(q - p), other) / area, y = plane_cross(Vec2(q - p), along) / area;
      if (x >= 0 && x < 1 && y >= 0 && y < 1) return Vec2(p + x * along);
    }
  return {};
}

}  // namespace engrane::elements::cams
