// SPDX-License-Identifier: BSD-3-Clause
// A point attached to two nodes, seen from the first one: bushes and bearings measure their displacement at it.
#pragma once

#include <array>
#include <optional>

#include "elements/common/building.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements {

/// A point attached to both nodes in the reference configuration, and axes attached to the first node.
struct HeldPoint {
  std::array<int, 2> nodes{};
  Vec3 point = Vec3::Zero();
  Vec3 offset_a = Vec3::Zero(), offset_b = Vec3::Zero();  ///< from the nodes to the point, in each node's material axes
  Mat3 axes = Mat3::Identity();                           ///< columns, in the reference configuration

  /// Builds it from a card: `at` is the point, by default node b, or node a if b is the ground.
  static HeldPoint of(const BuildContext& context, const std::array<int, 2>& nodes,
                      const std::optional<std::array<double, 3>>& at, const Mat3& axes) {
    const Vec3 &a = context.nodes.at(nodes[0]), &b = context.nodes.at(nodes[1]);
    const Vec3 point = at ? to_vector(*at) : nodes[1] != 0 ? b : a;
    return {nodes, point, point - a, point - b, axes};
  }

  /// Displacement of b's point relative to a's point, and its rate, in the axes carried by a.
  template <class T>
  struct Shift {
    Mat3T<T> axes;               ///< columns, global components
    Vec3T<T> arm_a, arm_b, gap;  ///< from the nodes to their points, and from a's point to b's, global
    Vec3T<T> spin;               ///< angular velocity of b relative to a, global
    Vec3T<T> value, rate;        ///< components in the axes
  };

  template <class T>
  Shift<T> shift(const Motion<T, 2>& motion) const {
    const auto& a = motion.node[0];
    const auto& b = motion.node[1];
    Shift<T> s;
    for (int c = 0; c < 3; ++c) s.axes.col(c) = rotate(a.R, Vec3(axes.col(c)));
    s.arm_a = rotate(a.R, offset_a);
    s.arm_b = rotate(b.R, offset_b);
    s.gap = b.x + s.arm_b - a.x - s.arm_a;
    s.value = rotate_back(s.axes, s.gap);
    const Vec3T<T> spin_a = rotate(a.R, a.W), spin_b = rotate(b.R, b.W);
    const Vec3T<T> rate = b.v + cross(spin_b, s.arm_b) - a.v - cross(spin_a, Vec3T<T>(s.arm_a + s.gap));
    s.rate = rotate_back(s.axes, rate);
    s.spin = spin_b - spin_a;
    return s;
  }

  /// Adds the resisting force and moment on b's point, both given in the axes. The displacement is measured in axes that turn
  /// with a, so the opposite force acts on a at b's point.
  template <class T>
  static void resist(const Shift<T>& s, const Vec3T<T>& force, const Vec3T<T>& moment, const Motion<T, 2>& motion,
                     Balance<T, 2>& balance) {
    const Vec3T<T> f = rotate(s.axes, force), m = rotate(s.axes, moment);
    balance.force(0, Vec3T<T>(-f));
    balance.force(1, f);
    balance.moment(0, rotate_back(motion.node[0].R, Vec3T<T>(-m - cross(Vec3T<T>(s.arm_a + s.gap), f))));
    balance.moment(1, rotate_back(motion.node[1].R, Vec3T<T>(m + cross(s.arm_b, f))));
  }

  /// Drawing at the point: an axis along the first of the axes.
  Drawing drawing() const;
};

/// Right-handed axes as columns: the first along `axis`, the second on the side of `axis_2`, or any perpendicular if not given.
/// Reports an error at `AXIS` or `AXIS2` if they do not define directions.
std::optional<Mat3> axes_of(const BuildContext& context, const std::array<double, 3>& axis,
                            const std::optional<std::array<double, 3>>& axis_2);

}  // namespace engrane::elements
