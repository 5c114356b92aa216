// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "elements/cams/cam_profile.hpp"
#include "elements/common/axis_angle.hpp"
#include "elements/common/friction_law.hpp"
#include "elements/common/stop_law.hpp"
#include "model/fine_forces.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements::cams {

/// How the follower is guided, for its pressure angle; directions in the reference configuration.
struct CamGuide {
  enum class Kind { none, slide, arm };
  Kind kind = Kind::none;
  Vec3 direction = Vec3::Zero();  ///< of a slide; carried by B
  Vec3 pivot = Vec3::Zero();      ///< of an arm: from B to its pivot
};

/// The parts of the element.
struct CamParts {
  std::array<int, 2> nodes{};
  Mat3 axes = Mat3::Identity();                        ///< columns: x and y of the cam's plane and the cam's axis; carried by A
  Vec3 center = Vec3::Zero();                          ///< from A to the centre
  Vec3 place = Vec3::Zero(), follower = Vec3::Zero();  ///< positions of the centre and of the follower's point, for drawings
  Vec3 point = Vec3::Zero();                           ///< from B to the follower's point
  Vec3 face = Vec3::Zero();                            ///< normal of a flat face, away from the cam, carried by B
  bool flat = false;
  bool inside = false;  ///< the follower is inside the profile
  double radius = 0;    ///< of a roller; 0: knife edge
  std::shared_ptr<const CamProfile> profile;
  std::optional<StopLaw> law;  ///< nullopt: the follower is held to the profile
  bool several = false;        ///< can touch at several places at once
  std::optional<FrictionLaw> friction;
  CamGuide guide;
  std::vector<Derived> derived;
};

/// A follower on the profile of a cam (docs/elements/cams/cam.md).
class Cam final : public TemplatedElement<Cam, 2, 13>, public FineForces {
 public:
  Cam(int id, CamParts parts);

  template <class T>
  using Nodes = std::array<typename Motion<T, 2>::Node, 2>;

  /// Position of the follower relative to the cam.
  template <class T>
  struct Place {
    Vec3T<T> u, v, axis, center;  ///< axes of the cam, and from A to its centre
    Vec3T<T> reach, arm;          ///< to the follower's point, from A and from B
    T along, x, y;                ///< of that point, from the centre: along the axis and in the plane
    Vec3T<T> face;                ///< normal of a flat face
    T fx, fy, square;             ///< components of the normal in the cam's plane, and their sum of squares
    T mx, my;                     ///< unit vector along them
  };
  template <class T>
  Place<T> place(const Nodes<T>& node) const;

  /// A contact in a configuration. The gap is exact to the second derivative, all else to the first.
  template <class T>
  struct Contact {
    T gap;
    Vec3T<T> normal;      ///< from the cam to the follower
    Vec3T<T> reach, arm;  ///< to the follower's point, from A and from B
    T s;                  ///< place on the profile, from that of the foot
    T lever;              ///< flat face: from the contact point to the follower's point, along the face
    Vec3T<T> turn;        ///< flat face: gradient of its direction in the cam with respect to the rotation of B relative to A
    Vec3T<T> touch;       ///< from A to the contact point; for a knife edge to the edge
    CamFoot foot;
  };
  /// The contact at a foot that was computed for the values of `place`.
  template <class T>
  Contact<T> contact(const Place<T>& place, const CamFoot& foot) const;

  /// The points of the profile that the follower touches, or would touch first; the deepest one first.
  template <class T>
  CamFeet feet(const Place<T>& place, std::span<const double> history) const;

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const {
    const Place<T> here = place<T>(motion.node);
    for (const CamFoot& foot : feet(here, state.history)) press(contact(here, foot), motion.node, balance);
  }

  void count_turns(const State& state, std::span<double> scalars, std::span<double> history) const override;
  void switches(const State& state, std::span<Switch> values) const override;
  bool has_fine_forces() const override { return parts_.friction.has_value(); }
  bool has_gaps() const override { return parts_.law.has_value(); }
  bool touches(const State& state) const override;
  void sliding(const State& state, std::span<Vec3> speeds) const override;
  Energies energies(const State& state) const override;
  const std::vector<Channel>& channels() const override { return channels_; }
  void observe(const State& state, std::span<double> values) const override;
  std::vector<Derived> derived() const override { return parts_.derived; }
  Drawing drawing() const override;

  /// Angle between the contact normal and the follower's direction of motion, both in the same axes.
  static double pressure_angle(const Vec3& normal, const Vec3& way);

 private:
  /// Adds the forces of one contact.
  template <class T>
  void press(const Contact<T>& c, const Nodes<T>& node, Balance<T, 2>& balance) const {
    const T load = parts_.law ? parts_.law->force(T(-c.gap), T(-gap_rate(c, node)), balance.contact_homotopy())
                              : balance.constraint(0, c.gap);
    const Vec3T<T> force = c.normal * load;
    balance.force(0, force);
    balance.force(1, Vec3T<T>(-force));
    Vec3T<T> moment_a = cross(c.reach, force), moment_b = -cross(c.arm, force);
    if (parts_.flat) {
      const Vec3T<T> couple = c.turn * T(c.lever * load);
      moment_a += couple;
      moment_b -= couple;
    }
    if (parts_.friction) {
      using std::abs;
      const Vec3T<T> slip = sliding(c, node);
      const Vec3T<T> drag = slip * T(parts_.friction->over_speed(T(dot(slip, slip)), T(abs(load))) * abs(load));
      balance.force(0, Vec3T<T>(-drag));
      balance.force(1, drag);
      moment_a -= cross(c.touch, drag);
      moment_b += cross(touch_from_b(c), drag);
    }
    balance.moment(0, rotate_back(node[0].R, moment_a));
    balance.moment(1, rotate_back(node[1].R, moment_b));
  }

  /// Maximum number of simultaneous contacts.
  std::size_t places() const { return parts_.several ? CamFeet::most : 1; }

  template <class T>
  Vec3T<T> touch_from_b(const Contact<T>& c) const {
    return c.touch - c.reach + c.arm;
  }

  /// Velocity of B's body relative to A's at the point that is at `from_a` from A and at `from_b` from B.
  template <class T>
  static Vec3T<T> velocity(const Nodes<T>& node, const Vec3T<T>& from_a, const Vec3T<T>& from_b) {
    const auto& [a, b] = node;
    return b.v + cross(rotate(b.R, b.W), from_b) - a.v - cross(rotate(a.R, a.W), from_a);
  }

  template <class T>
  T gap_rate(const Contact<T>& c, const Nodes<T>& node) const {
    const auto& [a, b] = node;
    const T rate = dot(c.normal, velocity(node, c.reach, c.arm));
    if (!parts_.flat) return rate;
    return rate + c.lever * dot(c.turn, Vec3T<T>(rotate(b.R, b.W) - rotate(a.R, a.W)));
  }

  /// Sliding velocity of the follower over the cam.
  template <class T>
  Vec3T<T> sliding(const Contact<T>& c, const Nodes<T>& node) const {
    const Vec3T<T> v = velocity(node, c.touch, touch_from_b(c));
    return v - c.normal * dot(c.normal, v);
  }

  /// Magnitude of the friction force at a contact.
  double friction(const Contact<double>& c, const Nodes<double>& node, double force) const {
    const double square = sliding(c, node).squaredNorm();
    return parts_.friction->over_speed(square, std::abs(force)) * std::abs(force) * std::sqrt(square);
  }

  /// The place s of a foot, which is known within a turn, counted on from that of the last step; within two turns.
  static double counted(double s, std::span<const double> history);
  /// Switches at the joints of the profile. Only the first derivative of its place is used.
  void joint_switches(const Contact<Taylor>& deepest, const State& state, std::span<Switch> values) const;

  double load(const Contact<double>& c, const State& state, double rate) const {
    return parts_.law ? parts_.law->force(-c.gap, -rate, 0) : state.multipliers[0] - state.penalty * c.gap;
  }

  CamParts parts_;
  std::vector<double> joints_;  ///< of the profile (CamCurve::joints)
  std::vector<Channel> channels_;
};

template <class T>
Cam::Place<T> Cam::place(const Nodes<T>& node) const {
  const auto& [a, b] = node;
  Place<T> p;
  p.u = rotate(a.R, Vec3(parts_.axes.col(0)));
  p.v = rotate(a.R, Vec3(parts_.axes.col(1)));
  p.axis = rotate(a.R, Vec3(parts_.axes.col(2)));
  p.center = rotate(a.R, parts_.center);
  p.arm = rotate(b.R, parts_.point);
  p.reach = b.x + p.arm - a.x;
  const Vec3T<T> from_center = p.reach - p.center;
  p.along = dot(from_center, p.axis);
  p.x = dot(from_center, p.u);
  p.y = dot(from_center, p.v);
  if (!parts_.flat) return p;
  p.face = rotate(b.R, parts_.face);
  p.fx = dot(p.face, p.u);
  p.fy = dot(p.face, p.v);
  p.square = p.fx * p.fx + p.fy * p.fy;
  using std::sqrt;
  const T scale = T(1) / sqrt(p.square);
  p.mx = p.fx * scale;
  p.my = p.fy * scale;
  return p;
}

template <class T>
CamFeet Cam::feet(const Place<T>& place, std::span<const double> history) const {
  const CamProfile& profile = *parts_.profile;
  const Vec2 q{value_of(place.x), value_of(place.y)};
  if (parts_.flat) {
    const Vec2 m{value_of(place.mx), value_of(place.my)};
    return parts_.several ? profile.under_face(m, q.dot(m)) : CamFeet{{profile.farthest(m)}, 1};
  }
  if (parts_.several) return profile.under_roller(q, parts_.radius);
  std::optional<double> last;
  if (!parts_.law && history[1] != 0) last = history[0];
  return {{profile.nearest(q, last)}, 1};
}

// On smooth curves distance and support are functions of two and of one variable with known second derivatives. Their Taylor
// polynomials provide the derivatives for dual and Taylor numbers without differentiating the search.
template <class T>
Cam::Contact<T> Cam::contact(const Place<T>& place, const CamFoot& foot) const {
  const CamProfile& profile = *parts_.profile;
  Contact<T> c;
  c.reach = place.reach;
  c.arm = place.arm;
  c.foot = foot;
  const T &x = place.x, &y = place.y;
  if (parts_.flat) {
    const T &mx = place.mx, &my = place.my;
    const Vec2 n{value_of(mx), value_of(my)}, t = turned_left(n);
    const T angle = t[0] * mx + t[1] * my;  // increment from its value, to second order
    const double reach = foot.p.dot(n), aside = foot.p.dot(t), radius = 1 / foot.curvature;
    c.gap = x * mx + y * my - (reach + aside * angle + (0.5 * (radius - reach)) * angle * angle) + profile.inset();
    c.s = angle * (radius / foot.speed);
    c.lever = y * mx - x * my - (aside + (radius - reach) * angle);
    c.normal = place.u * mx + place.v * my;
    c.turn = (cross(place.face, place.v) * place.fx - cross(place.face, place.u) * place.fy) * T(T(1) / place.square);
    const T px = foot.p[0] + (radius * t[0]) * angle - profile.inset() * mx,
            py = foot.p[1] + (radius * t[1]) * angle - profile.inset() * my;
    c.touch = place.center + place.axis * place.along + place.u * px + place.v * py;
    return c;
  }
  const Vec2 q{value_of(x), value_of(y)};
  const double distance = (q - foot.p).dot(foot.n), bend = foot.curvature / (1 + foot.curvature * distance);
  const T dx = x - q[0], dy = y - q[1];
  const T along = foot.t[0] * dx + foot.t[1] * dy;
  c.gap = distance + foot.n[0] * dx + foot.n[1] * dy + (0.5 * bend) * along * along - (parts_.radius - profile.inset());
  const T nx = foot.n[0] + (bend * foot.t[0]) * along, ny = foot.n[1] + (bend * foot.t[1]) * along;
  c.normal = place.u * nx + place.v * ny;
  c.touch = c.reach - c.normal * parts_.radius;
  c.s = along * (1 / (foot.speed * (1 + foot.curvature * distance)));
  c.lever = T(0);
  return c;
}

}  // namespace engrane::elements::cams
