// SPDX-License-Identifier: BSD-3-Clause
// The inertia of a rigid body carried by one node: shared by INERTIA and RIGID.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "model/registry.hpp"

namespace engrane {

/// Mass, its centre relative to the node, and the inertia tensor about that centre; vectors and tensor in the node's
/// material axes, which are the global ones in the reference configuration.
struct BodyInertia {
  double mass = 0;
  Vec3 offset = Vec3::Zero();
  Mat3 tensor = Mat3::Zero();

  /// Does the node's rotation matter?
  bool turns() const { return !offset.isZero(0) || !tensor.isZero(0); }

  Mat3 about_node() const { return tensor + mass * (offset.squaredNorm() * Mat3::Identity() - offset * offset.transpose()); }

  /// Force (global) and moment about the node (material) with which the body resists its acceleration and gravity.
  template <class T>
  struct Resistance {
    Vec3T<T> force, moment;
  };

  /// Newton's and Euler's equations. The centre of mass has the acceleration a + R(A×s + W×(W×s)), s the offset.
  template <class T, class Node>
  Resistance<T> resistance(const Node& node, const Vec3& gravity) const {
    const Vec3T<T> s = offset.template cast<T>();
    const Vec3T<T> own = cross(node.A, s) + cross(node.W, cross(node.W, s));
    const Vec3T<T> force = (node.a + rotate(node.R, own) - gravity.template cast<T>()) * T(mass);
    const Vec3T<T> spin = rotate(tensor, node.W);
    const Vec3T<T> moment = cross(s, rotate_back(node.R, force)) + rotate(tensor, node.A) + cross(node.W, spin);
    return {force, moment};
  }

  Vec3 center(const NodeState& node) const { return node.x + node.R * offset; }
  Vec3 momentum(const NodeState& node) const { return mass * (node.v + node.R * cross(node.W, offset)); }
  /// About the centre of mass, global components.
  Vec3 angular_momentum(const NodeState& node) const { return node.R * (tensor * node.W); }
  Energies energies(const NodeState& node, const Vec3& gravity) const;
};

/// Names and values of the channels of a body: where its centre is, how it spins, its momenta and kinetic energy.
std::vector<Named> body_channels(const BodyInertia& body);
void observe_body(const BodyInertia& body, const NodeState& node, std::span<double> values);

/// The tensor from one moment (the same about all axes), three principal ones (about the global axes) or six entries
/// Jxx Jyy Jzz Jxy Jyz Jzx (the tensor's: Jxy = −∫xy dm). Errors and warnings at `J`.
std::optional<Mat3> inertia_tensor(const BuildContext& context, const std::vector<double>& values);

}  // namespace engrane
