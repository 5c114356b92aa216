// SPDX-License-Identifier: BSD-3-Clause
#include "elements/cams/cam_profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/angle.hpp"

namespace engrane::elements::cams {

namespace {

/// Contacts of a roller closer together than this fraction of its radius count as one.
constexpr double one_contact = 0.1;
/// Near contacts are included up to a gap of this fraction of the roller's radius or, for a face, of the curve's largest
/// radius. Their gaps are needed when statics searches for contacts (State::contact_homotopy) and when events are located.
constexpr double seen_by_roller = 0.1, seen_by_face = 0.02;

/// Angle difference in [−π, π].
double difference(double a, double b) { return std::remainder(a - b, whole_turn); }

/// Adds a foot behind the first, which stays first; the others are sorted by `depth`. If there is no room, the shallowest is
/// dropped.
template <class Depth>
void insert(CamFeet& all, const CamFoot& foot, Depth depth) {
  const bool full = all.count == CamFeet::most;
  if (full && depth(all.feet.back()) >= depth(foot)) return;
  std::size_t at = full ? all.count - 1 : all.count++;
  for (; at > 1 && depth(all.feet[at - 1]) < depth(foot); --at) all.feet[at] = all.feet[at - 1];
  all.feet[at] = foot;
}

}  // namespace

CamProfile::CamProfile(std::unique_ptr<CamCurve> curve, double inset, bool inside) : curve_(std::move(curve)), inset_(inset) {
  const std::size_t n = std::clamp<std::size_t>(4 * curve_->pieces(), 720, 20000);
  step_ = whole_turn / static_cast<double>(n);
  samples_.reserve(n);
  for (std::size_t k = 0; k < n; ++k) samples_.push_back(curve_->at(step_ * static_cast<double>(k)).p);
  double area = 0;
  for (std::size_t k = 0; k < n; ++k) area += plane_cross(samples_[k], samples_[(k + 1) % n]);
  sense_ = (area > 0) == inside ? -1 : 1;

  constexpr std::size_t in_group = 16;
  for (const Vec2& p : samples_) greatest_ = std::max(greatest_, p.norm());
  for (std::size_t k = 0; k < n; ++k) longest_ = std::max(longest_, (samples_[(k + 1) % n] - samples_[k]).norm());
  for (std::size_t begin = 0; begin < n; begin += in_group) {
    Group group{begin, std::min(begin + in_group, n), Vec2::Zero(), 0};
    for (std::size_t k = begin; k < group.end; ++k) group.center += samples_[k] / static_cast<double>(group.end - begin);
    for (std::size_t k = begin; k < group.end; ++k) group.radius = std::max(group.radius, (samples_[k] - group.center).norm());
    group.radius *= 1 + 1e-6;  // margin for rounding error
    groups_.push_back(group);
  }
}

CamFoot CamProfile::at(double s) const {
  const CamCurve::Point c = curve_->at(s);
  CamFoot foot;
  foot.s = s;
  foot.p = c.p;
  const double speed = c.d1.norm();
  foot.t = c.d1 * (sense_ / speed);
  foot.n = -turned_left(foot.t);
  foot.speed = sense_ * speed;
  foot.curvature = sense_ * plane_cross(c.d1, c.d2) / (speed * speed * speed);
  return foot;
}

std::pair<double, double> CamProfile::slope_of_distance(double s, const Vec2& q) const {
  const CamCurve::Point c = curve_->at(s);
  const Vec2 away = c.p - q;
  return {away.dot(c.d1), c.d1.squaredNorm() + away.dot(c.d2)};
}

std::pair<double, double> CamProfile::slope_of_height(double s, const Vec2& m) const {
  const CamCurve::Point c = curve_->at(s);
  return {-c.d1.dot(m), -c.d2.dot(m)};
}

template <class F>
double CamProfile::settle(std::size_t k, F slope) const {
  const double middle = step_ * static_cast<double>(k);
  double a = middle - step_, b = middle + step_;
  for (int i = 0; i < 3 && slope(a).first > 0; ++i) a -= step_;
  for (int i = 0; i < 3 && slope(b).first < 0; ++i) b += step_;
  // Newton's method, with bisection when it would leave the bracket
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
  const auto square = [&](std::size_t k) { return (samples_[k] - q).squaredNorm(); };
  // upper bound for the nearest sample: the far side of any group that is searched as a whole
  double reach = std::numeric_limits<double>::infinity();
  for (const Group& group : groups_)
    if (counts(group.begin) && counts(group.end - 1)) reach = std::min(reach, (group.center - q).norm() + group.radius);
  double best = std::numeric_limits<double>::infinity();
  std::size_t best_sample = 0;
  for (const Group& group : groups_) {
    if ((group.center - q).norm() - group.radius > reach) continue;
    for (std::size_t k = group.begin; k < group.end; ++k)
      if (const double here = square(k); here < best && counts(k)) {
        best = here;
        best_sample = k;
      }
  }

  // between samples the curve can be nearer by up to their spacing, so every local minimum within it is a candidate
  const auto slope = [&](double s) { return slope_of_distance(s, q); };
  CamFoot foot;
  double least = std::numeric_limits<double>::infinity();
  const double nearest = std::sqrt(best);
  for (const Group& group : groups_) {
    if ((group.center - q).norm() - group.radius > nearest + longest_) continue;
    for (std::size_t k = group.begin; k < group.end; ++k) {
      const std::size_t before = (k + n - 1) % n, after = (k + 1) % n;
      const double here = square(k);
      if (!counts(k) || here > square(before) || here >= square(after)) continue;
      if (std::sqrt(here) - nearest > (samples_[k] - samples_[after]).norm()) continue;
      const CamFoot found = at(settle(k, slope));
      const double d = (found.p - q).norm();
      if (d < least) {
        least = d;
        foot = found;
      }
    }
  }
  // the minimum is at the edge of the window, or the curve is a circle about q
  return std::isfinite(least) ? foot : at(settle(best_sample, slope));
}

CamFoot CamProfile::farthest(const Vec2& m) const {
  if (const auto s = curve_->facing(m)) return at(*s);
  // lower bound for the farthest sample: the near side of any group
  double far = -std::numeric_limits<double>::infinity();
  for (const Group& group : groups_) far = std::max(far, group.center.dot(m) - group.radius);
  std::size_t best = 0;
  double reach = -std::numeric_limits<double>::infinity();
  for (const Group& group : groups_) {
    if (group.center.dot(m) + group.radius < std::max(far, reach)) continue;
    for (std::size_t k = group.begin; k < group.end; ++k)
      if (const double here = samples_[k].dot(m); here > reach) {
        reach = here;
        best = k;
      }
  }
  return at(settle(best, [&](double s) { return slope_of_height(s, m); }));
}

CamFeet CamProfile::under_roller(const Vec2& q, double radius) const {
  CamFeet all;
  all.feet[all.count++] = nearest(q);
  const double reach = (1 + seen_by_roller) * radius;
  const auto depth = [&](const CamFoot& foot) { return reach - (q - foot.p).norm(); };
  const std::size_t n = samples_.size();
  const auto square = [&](std::size_t k) { return (samples_[k] - q).squaredNorm(); };
  for (const Group& group : groups_) {
    if ((group.center - q).norm() - group.radius > reach + longest_) continue;
    for (std::size_t k = group.begin; k < group.end; ++k) {
      const double here = square(k);
      if (here > square((k + n - 1) % n) || here >= square((k + 1) % n)) continue;
      if (std::sqrt(here) > reach + longest_) continue;
      const CamFoot foot = at(settle(k, [&](double s) { return slope_of_distance(s, q); }));
      const double distance = (q - foot.p).dot(foot.n);  // negative on the far side of a wall
      if (!(distance > 0 && distance < reach && 1 + foot.curvature * distance > 0)) continue;
      const auto same = [&](const CamFoot& other) { return (other.p - foot.p).norm() < one_contact * radius; };
      if (std::none_of(all.begin(), all.end(), same)) insert(all, foot, depth);
    }
  }
  return all;
}

CamFeet CamProfile::under_face(const Vec2& m, double distance) const {
  CamFeet all;
  all.feet[all.count++] = farthest(m);
  const double least = distance - seen_by_face * greatest_;
  const auto height = [&](const CamFoot& foot) { return foot.p.dot(m); };
  const std::size_t n = samples_.size();
  const auto sample = [&](std::size_t k) { return samples_[k].dot(m); };
  for (const Group& group : groups_) {
    if (group.center.dot(m) + group.radius + longest_ < least) continue;
    for (std::size_t k = group.begin; k < group.end; ++k) {
      const double here = sample(k);
      if (here < sample((k + n - 1) % n) || here <= sample((k + 1) % n) || here + longest_ < least) continue;
      const CamFoot foot = at(settle(k, [&](double s) { return slope_of_height(s, m); }));
      if (!(height(foot) > least && foot.n.dot(m) > 0 && foot.curvature > 0)) continue;
      const auto same = [&](const CamFoot& other) { return std::abs(difference(other.s, foot.s)) < step_; };
      if (std::none_of(all.begin(), all.end(), same)) insert(all, foot, height);
    }
  }
  return all;
}

std::optional<Vec2> CamProfile::crossing() const {
  // segments sorted by their least x, so that only those that overlap in x are compared
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
