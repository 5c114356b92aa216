// SPDX-License-Identifier: BSD-3-Clause
// Gear pairs of every kind, as cards with the places of their wheels.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "elements/gears/gear_pair.hpp"
#include "elements/suite.hpp"

namespace engrane::gear_cases {

using namespace elements::gears;

constexpr double deg = std::numbers::pi / 180;

inline std::array<double, 3> components(const Vec3& v) { return {v[0], v[1], v[2]}; }

/// A card and where its wheels are: node 1 (or data.nodes[0]) at x_a, node 2 at x_b.
struct Case {
  std::string name;
  GearData data;
  Vec3 x_a, x_b;

  std::unique_ptr<Element> build(const Mat3& Q, const suite::BuildOptions& options = {}) const {
    GearData turned = data;
    turned.axis = components(Q * Vec3(data.axis[0], data.axis[1], data.axis[2]));
    if (data.axis_b) turned.axis_b = components(Q * Vec3((*data.axis_b)[0], (*data.axis_b)[1], (*data.axis_b)[2]));
    return suite::build(gear_pair_type(), turned, {{0, Vec3::Zero()}, {data.nodes[0], Q * x_a}, {data.nodes[1], Q * x_b}},
                        options);
  }

  /// The same pair with the wheels named the other way round.
  Case swapped() const {
    const auto element = build(Mat3::Identity());
    const auto& pair = dynamic_cast<const GearPair&>(*element);
    Case s = *this;
    std::swap(s.data.nodes[0], s.data.nodes[1]);
    std::swap(s.data.teeth[0], s.data.teeth[1]);
    if (s.data.cone) std::swap((*s.data.cone)[0], (*s.data.cone)[1]);
    if (s.data.helix.size() == 1) {
      const auto& d = pair.design();
      s.data.helix.push_back(paper_helix(d.helix[1], d.cone[1]) / deg);
    }
    if (s.data.helix.size() == 2) std::swap(s.data.helix[0], s.data.helix[1]);
    s.data.axis = components(pair.frames().xi.col(0));
    if (s.data.axis_b) s.data.axis_b = components(pair.frames().mu.col(0));
    std::swap(s.x_a, s.x_b);
    return s;
  }

  Case scaled(double length) const {
    Case s = *this;
    s.x_a *= length;
    s.x_b *= length;
    *s.data.normal_module *= length;
    return s;
  }
};

/// B is put where it belongs when A is at x_a with axle `axis` and the contact in the half plane of `toward`.
inline Case placed(std::string name, GearData data, const Vec3& x_a, const Vec3& axis, const Vec3& toward) {
  GearDesign d;
  d.teeth = {data.teeth[0], data.teeth[1]};
  d.normal_module = *data.normal_module;
  if (data.cone) d.cone = {(*data.cone)[0] * deg, (*data.cone)[1] * deg};
  if (data.internal) d.cone[data.teeth[0] > data.teeth[1] ? 0 : 1] = std::numbers::pi;
  if (!data.helix.empty()) d.helix[0] = paper_helix(data.helix[0] * deg, d.cone[0]);
  d.helix[1] = data.helix.size() > 1 ? paper_helix(data.helix[1] * deg, d.cone[1]) : -d.helix[0];
  Mat3 mu;
  mu.col(0) = axis.normalized();
  mu.col(1) = (toward - toward.dot(mu.col(0)) * mu.col(0)).normalized();
  mu.col(2) = mu.col(0).cross(mu.col(1));
  data.nodes = {1, 2};
  data.axis = components(axis);
  const Mat3 xi = mu * wheel_to_wheel(d);
  if (!data.cone && !data.internal) data.axis_b = components(xi.col(0));
  return {std::move(name), data, x_a, x_a + d.radius(0) * mu.col(1) - d.radius(1) * xi.col(1)};
}

inline GearData wheels(int z_a, int z_b, double module) {
  GearData data;
  data.teeth = {z_a, z_b};
  data.normal_module = module;
  return data;
}

inline Case spur() { return placed("spur", wheels(13, 29, 0.05), {0, 0, 0}, {0.3, -0.2, 0.9}, {1, 1, 0}); }

inline Case helical() {
  GearData data = wheels(21, 34, 0.04);
  data.helix = {23};
  return placed("helical", data, {0.1, -0.4, 0.2}, {0, 0.5, 1}, {1, 0, 0});
}

inline Case internal() {
  GearData data = wheels(17, 51, 0.04);
  data.helix = {-12};
  data.internal = true;
  return placed("internal", data, {0.3, 0.1, 0.2}, {1, 0.2, -0.3}, {0, 1, 0});
}

inline Case ring_first() {
  GearData data = wheels(51, 17, 0.04);
  data.helix = {18, 18};
  data.internal = true;
  return placed("ring gear as wheel A", data, {0.3, 0.1, 0.2}, {1, 0.2, -0.3}, {0, 1, 0});
}

inline Case bevel() {
  GearData data = wheels(50, 10, 0.04);
  data.cone = {-std::atan(5) / deg, -std::atan(0.2) / deg};
  return placed("bevel", data, {0.2, 0, 0.1}, {0, 1, 0}, {0, 0, 1});
}

inline Case spiral_bevel() {
  GearData data = wheels(14, 39, 0.05);
  const auto cones = cones_of_shaft_angle(80 * deg, {14, 39});
  data.cone = {cones[0] / deg, cones[1] / deg};
  data.helix = {-35};
  return placed("spiral bevel", data, {0.2, 0, 0.1}, {0.2, 1, 0.4}, {1, 0, 1});
}

inline Case crossed() {
  GearData data = wheels(19, 31, 0.05);
  data.helix = {40, 35};
  return placed("crossed helical", data, {-0.2, 0.3, 0.1}, {0.5, -0.4, 1}, {1, 0, 0});
}

inline Case hypoid() {
  GearData data = wheels(11, 43, 0.05);
  data.cone = {19, 68};
  data.helix = {-50, 31.5};
  return placed("hypoid", data, {0.1, 0.2, -0.1}, {1, 0, 0.3}, {0, 1, 0.2});
}

inline Case worm() {
  GearData data = wheels(2, 30, 0.05);
  data.helix = {90 - 9.46232221, 9.46232221};
  return placed("worm", data, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
}

inline std::vector<Case> all_cases() {
  return {spur(), helical(), internal(), ring_first(), bevel(), spiral_bevel(), crossed(), hypoid(), worm()};
}

/// Swapping the wheels changes the sign of φ₃, and of nothing else.
inline void carry_over(const suite::StateBuffer& state, suite::StateBuffer& swapped) {
  for (const auto member :
       {&suite::StateBuffer::scalars, &suite::StateBuffer::scalar_rates, &suite::StateBuffer::scalar_accelerations}) {
    swapped.*member = state.*member;
    std::swap((swapped.*member)[0], (swapped.*member)[1]);
  }
  swapped.multipliers = {state.multipliers[0], state.multipliers[1], -state.multipliers[2]};
}

inline suite::Subject subject(const Case& c) {
  suite::Subject s;
  s.name = c.name;
  s.nodes = {{1, c.x_a}, {2, c.x_b}};
  s.build = [c](const Mat3& Q) { return c.build(Q); };
  s.build_swapped = [c] { return c.swapped().build(Mat3::Identity()); };
  s.carry = carry_over;
  s.force = 5;
  s.skip[suite::Check::ideal] = "the separating force is not the gradient of a constraint: SuiteWithoutSeparation";
  return s;
}

/// Puts u_m where the approach of the teeth is x, and keeps ψ_A.
inline void approach(const GearPair& pair, suite::StateBuffer& state, double x) {
  state.scalars[2] = x - pair.teeth().error.of_a(state.scalars[0], pair.teeth().mesh).f;
}

}  // namespace engrane::gear_cases
