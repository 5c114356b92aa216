// SPDX-License-Identifier: BSD-3-Clause
// The inertia of a rigid body carried by one node: shared by INERTIA and RIGID.
#pragma once

#include <optional>
#include <vector>

#include "model/registry.hpp"

namespace engrane::elements::bodies {

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
    const Vec3T<T> none(T(0), T(0), T(0));
    if (!turns()) return {(node.a - gravity.template cast<T>()) * T(mass), none};
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
std::vector<Channel> body_channels(const BodyInertia& body);
void observe_body(const BodyInertia& body, const NodeState& node, std::span<double> values);

/// What a card says of the mass of one body, or of the parts that make up one body: entry i of each list is part i.
struct BodyParts {
  std::vector<double> mass;
  std::vector<Vec3> centers;   ///< of mass, in the reference configuration
  std::vector<double> tensor;  ///< 1, 3 or 6 values for each part, as `read_tensor` takes them
  std::vector<double> axes;    ///< six numbers for each part, or for all: first axis of its tensor, side of the second
  std::vector<double> about;   ///< three numbers for each part, or for all: the point of its tensor; default: its centre
};

/// The parts as one body, its offset counted from `node`: the masses' centre, and each tensor turned into the global axes
/// and moved to it (Steiner). Empty, with an error at the keyword, when the parts are none.
std::optional<BodyInertia> one_body(const BuildContext& context, const BodyParts& parts, const Vec3& node);

}  // namespace engrane::elements::bodies
