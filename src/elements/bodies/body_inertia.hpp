// SPDX-License-Identifier: BSD-3-Clause
// Inertia of a rigid body carried by one node, used by INERTIA and RIGID.
#pragma once

#include <optional>
#include <vector>

#include "model/registry.hpp"

namespace engrane::elements::bodies {

/// Mass, centre of mass relative to the node, and inertia tensor about that centre. Vector and tensor are in the node's
/// material axes, which coincide with the global axes in the reference configuration.
struct BodyInertia {
  double mass = 0;
  Vec3 offset = Vec3::Zero();
  Mat3 tensor = Mat3::Zero();

  /// Whether the inertia forces depend on the node's rotation.
  bool turns() const { return !offset.isZero(0) || !tensor.isZero(0); }

  Mat3 about_node() const { return tensor + mass * (offset.squaredNorm() * Mat3::Identity() - offset * offset.transpose()); }

  /// Inertia and gravity: resisting force (global) and moment about the node (material).
  template <class T>
  struct Resistance {
    Vec3T<T> force, moment;
  };

  /// Newton–Euler equations. The acceleration of the centre of mass is a + R(A×s + W×(W×s)), s the offset.
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
  /// Of the centre of mass, global components.
  Vec3 velocity(const NodeState& node) const;
  Vec3 momentum(const NodeState& node) const { return mass * velocity(node); }
  /// About the centre of mass, global components.
  Vec3 angular_momentum(const NodeState& node) const { return node.R * (tensor * node.W); }
  double kinetic_energy(const NodeState& node) const;
  /// Of a body on the first node of the state.
  Energies energies(const State& state) const;
};

/// Channels of a body and their values: position of the centre of mass, angular velocity, momenta and kinetic energy.
std::vector<Channel> body_channels(const BodyInertia& body);
void observe_body(const BodyInertia& body, const NodeState& node, std::span<double> values);

/// Card data of the mass of one body, or of the parts that form one body: entry i of each list belongs to part i.
struct BodyParts {
  std::vector<double> mass;
  std::vector<Vec3> centers;   ///< centres of mass in the reference configuration
  std::vector<double> tensor;  ///< 1, 3 or 6 values per part, as in `read_tensor`
  std::vector<double> axes;    ///< six numbers per part, or once for all: first axis of the tensor, side of the second
  std::vector<double> about;   ///< three numbers per part, or once for all: reference point of the tensor; default: its centre
};

/// Combines the parts into one body, with its offset from `node`. Each tensor is rotated to the global axes and moved to the
/// common centre of mass (parallel-axis theorem). Returns nothing, with an error at the keyword, if the data are invalid.
std::optional<BodyInertia> one_body(const BuildContext& context, const BodyParts& parts, const Vec3& node);

}  // namespace engrane::elements::bodies
