// SPDX-License-Identifier: BSD-3-Clause
#include "elements/body_inertia.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>

namespace engrane {

Energies BodyInertia::energies(const NodeState& node, const Vec3& gravity) const {
  const Vec3 speed = node.v + node.R * cross(node.W, offset);
  Energies e;
  e.kinetic = 0.5 * mass * speed.squaredNorm() + 0.5 * node.W.dot(tensor * node.W);
  e.potential = -mass * gravity.dot(center(node));
  return e;
}

std::vector<Named> body_channels(const BodyInertia& body) {
  std::vector<Named> all = {{"KINETIC_ENERGY", dimension::energy, "of translation and rotation"}};
  if (!body.turns()) return all;
  const Dimension angular{2, 1, -1, 0};
  const char* letters[3] = {"X", "Y", "Z"};
  for (const char* c : letters) all.push_back({fmt::format("CENTER_{}", c), dimension::length, "centre of mass, global"});
  for (const char* c : letters)
    all.push_back({fmt::format("SPIN_{}", c), dimension::angular_velocity,
                   "angular velocity in the body's axes, which are the global ones in the reference configuration"});
  for (const char* c : letters)
    all.push_back({fmt::format("ANGULAR_MOMENTUM_{}", c), angular, "about the centre of mass, global"});
  return all;
}

void observe_body(const BodyInertia& body, const NodeState& node, std::span<double> values) {
  values[0] = body.energies(node, Vec3::Zero()).kinetic;
  if (!body.turns()) return;
  const Vec3 center = body.center(node), momentum = body.angular_momentum(node);
  for (Eigen::Index c = 0; c < 3; ++c) {
    const auto i = static_cast<std::size_t>(c);
    values[1 + i] = center[c];
    values[4 + i] = node.W[c];
    values[7 + i] = momentum[c];
  }
}

std::optional<Mat3> inertia_tensor(const BuildContext& context, const std::vector<double>& values) {
  if (values.empty()) return Mat3(Mat3::Zero());
  Mat3 J = Mat3::Zero();
  if (values.size() == 1) {
    J.diagonal().setConstant(values[0]);
  } else if (values.size() == 3) {
    J.diagonal() << values[0], values[1], values[2];
  } else if (values.size() == 6) {
    J << values[0], values[3], values[5], values[3], values[1], values[4], values[5], values[4], values[2];
  } else {
    context.error("J", fmt::format("J has {} values", values.size()),
                  "give 1 (the same about all axes), 3 (about x, y, z) or 6: Jxx Jyy Jzz Jxy Jyz Jzx");
    return {};
  }
  const Vec3 principal = Eigen::SelfAdjointEigenSolver<Mat3>(J, Eigen::EigenvaluesOnly).eigenvalues();
  const double rounding = 1e-12 * principal.cwiseAbs().maxCoeff();
  if (principal[0] < -rounding) {
    context.error("J", fmt::format("the inertia about one axis is negative: the principal values are {:.6g}, {:.6g}, {:.6g}",
                                   principal[0], principal[1], principal[2]));
    return {};
  }
  // ∫(y² + z²) + ∫(z² + x²) ≥ ∫(x² + y²) for any mass; a disc meets it with equality. A rotor given by its polar
  // moment alone is a usual shortcut, so a single nonzero principal value passes without a word.
  if (principal[0] + principal[1] < principal[2] * (1 - 1e-3) && principal[1] > rounding)
    context.diagnostics.warning(
        context.record.where("J"),
        fmt::format("no body has the principal inertias {:.6g}, {:.6g}, {:.6g}", principal[0], principal[1], principal[2]),
        "the largest is at most the sum of the other two");
  return J;
}

}  // namespace engrane
