// SPDX-License-Identifier: BSD-3-Clause
#include "elements/bodies/body_inertia.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <utility>

namespace engrane::elements::bodies {

Vec3 BodyInertia::velocity(const NodeState& node) const { return node.v + node.R * cross(node.W, offset); }

double BodyInertia::kinetic_energy(const NodeState& node) const {
  return 0.5 * mass * velocity(node).squaredNorm() + 0.5 * node.W.dot(tensor * node.W);
}

Energies BodyInertia::energies(const State& state) const {
  const NodeState& node = state.nodes[0];
  Energies e;
  e.kinetic = kinetic_energy(node);
  e.add_weight(state, mass, center(node), velocity(node));
  return e;
}

std::vector<Channel> body_channels(const BodyInertia& body) {
  std::vector<Channel> all = {
      {"KINETIC_ENERGY", dimension::energy, "energy of translation and rotation", Channel::Course::smooth, 0}};
  if (!body.turns()) return all;
  const Dimension angular{2, 1, -1, 0};
  const char* letters[3] = {"X", "Y", "Z"};
  for (const char* c : letters) all.push_back({fmt::format("CENTER_{}", c), dimension::length, "centre of mass, global"});
  for (const char* c : letters)
    all.push_back({fmt::format("SPIN_{}", c), dimension::angular_velocity,
                   "angular velocity in the body's axes, which are the global ones in the reference configuration"});
  for (const char* c : letters)
    all.push_back({fmt::format("ANGULAR_MOMENTUM_{}", c), angular, "angular momentum about the centre of mass, global"});
  return all;
}

void observe_body(const BodyInertia& body, const NodeState& node, std::span<double> values) {
  values[0] = body.kinetic_energy(node);
  if (!body.turns()) return;
  const Vec3 center = body.center(node), momentum = body.angular_momentum(node);
  for (Eigen::Index c = 0; c < 3; ++c) {
    const auto i = static_cast<std::size_t>(c);
    values[1 + i] = center[c];
    values[4 + i] = node.W[c];
    values[7 + i] = momentum[c];
  }
}

namespace {

std::string number_of_parts(std::size_t parts) {
  return parts == 1 ? std::string("one body") : fmt::format("{} parts (as many as M has values)", parts);
}

/// Tensor of part i from one moment (for all axes), three (one per axis) or six entries Jxx Jyy Jzz Jxy Jyz Jzx (tensor
/// components: Jxy = −∫xy dm).
Mat3 read_tensor(const std::vector<double>& values, std::size_t each, std::size_t i) {
  Mat3 J = Mat3::Zero();
  const auto v = [&](std::size_t k) { return values[i * each + k]; };
  if (each == 1) J.diagonal().setConstant(v(0));
  if (each == 3) J.diagonal() << v(0), v(1), v(2);
  if (each == 6) J << v(0), v(3), v(5), v(3), v(1), v(4), v(5), v(4), v(2);
  return J;
}

/// The axes of part i's tensor, as columns.
std::optional<Mat3> read_axes(const BuildContext& context, const std::vector<double>& values, std::size_t i) {
  if (values.empty()) return Mat3(Mat3::Identity());
  const double* v = values.data() + (values.size() > 6 ? 6 * i : 0);
  const Vec3 first(v[0], v[1], v[2]), side(v[3], v[4], v[5]);
  const Vec3 third = cross(first, side);
  if (!(third.norm() > 1e-6 * first.norm() * side.norm())) {
    context.error("AXES", "AXES gives one direction only",
                  "two directions that are not parallel: the first axis of J, and one on the side of its second axis");
    return {};
  }
  Mat3 axes;
  axes << first.normalized(), cross(third, first).normalized(), third.normalized();
  return axes;
}

/// (c·c) 1 − c cᵀ: what a unit mass at c adds to the tensor about the origin (parallel-axis theorem).
Mat3 steiner(const Vec3& c) { return c.squaredNorm() * Mat3::Identity() - c * c.transpose(); }

/// Whether J, about the centre of mass, is the tensor of a body. `moved` > 0: magnitude of its shift, J was given about another
/// point.
bool check_tensor(const BuildContext& context, const Mat3& J, const std::string& of_part, double moved) {
  const Vec3 principal = Eigen::SelfAdjointEigenSolver<Mat3>(J, Eigen::EigenvaluesOnly).eigenvalues();
  const double rounding = 1e-12 * std::max(principal.cwiseAbs().maxCoeff(), moved);
  const std::string values = fmt::format("{:.6g}, {:.6g}, {:.6g}", principal[0], principal[1], principal[2]);
  if (principal[0] < -rounding) {
    if (moved > 0)
      context.error(
          "J", fmt::format("J moved to the centre of mass{} has a negative principal value: {}", of_part, values),
          fmt::format("about the point ABOUT it must hold mass times distance squared of the centre, {:.6g}; leave ABOUT "
                      "out if J is about the centre of mass",
                      moved));
    else
      context.error("J", fmt::format("the inertia{} about one axis is negative: the principal values are {}", of_part, values),
                    "moments of inertia are positive, and the products Jxy Jyz Jzx of six values small enough to leave them so");
    return false;
  }
  // ∫(y² + z²) + ∫(z² + x²) ≥ ∫(x² + y²) for any mass, with equality for a disc. Giving a rotor's polar moment alone is a
  // common shortcut, so a single nonzero principal value is not reported.
  if (principal[0] + principal[1] < principal[2] * (1 - 1e-3) && principal[1] > rounding)
    context.diagnostics.warning(context.record.where("J"),
                                fmt::format("no body has the principal inertias {}{}", values, of_part),
                                "the largest is at most the sum of the other two");
  return true;
}

/// Whether each list has as many values as there are parts.
bool check_counts(const BuildContext& context, const BodyParts& parts, std::size_t& each) {
  const std::size_t n = parts.mass.size();
  each = parts.tensor.size() / n;
  if (parts.tensor.size() % n != 0 || (each != 0 && each != 1 && each != 3 && each != 6)) {
    context.error("J", fmt::format("J has {} values for {}", parts.tensor.size(), number_of_parts(n)),
                  fmt::format("give {}1 (the same about all axes), 3 (about x, y, z) or 6: Jxx Jyy Jzz Jxy Jyz Jzx",
                              n == 1 ? "" : "each "));
    return false;
  }
  const auto check = [&](std::string_view keyword, std::size_t count, std::size_t one, const char* what) {
    if (count == 0 || count == one || count == n * one) return true;
    context.error(keyword, fmt::format("{} has {} values for {}", keyword, count, number_of_parts(n)),
                  fmt::format("{} numbers {}{}", one, what, n == 1 ? "" : ", for each part or once for all"));
    return false;
  };
  return check("AXES", parts.axes.size(), 6, "(the first axis of J, and a direction on the side of its second)") &&
         check("ABOUT", parts.about.size(), 3, "(the point about which J is)");
}

}  // namespace

std::optional<BodyInertia> one_body(const BuildContext& context, const BodyParts& parts, const Vec3& node) {
  std::size_t each = 0;
  if (!check_counts(context, parts, each)) return {};
  for (const auto& [keyword, given] : {std::pair("AXES", !parts.axes.empty()), {"ABOUT", !parts.about.empty()}})
    if (given && parts.tensor.empty()) {
      context.error(keyword, fmt::format("{} without J", keyword), fmt::format("give J, or leave {} out", keyword));
      return {};
    }
  BodyInertia body;
  std::vector<Mat3> tensors;
  Vec3 first_moment = Vec3::Zero();
  for (std::size_t i = 0; i < parts.mass.size(); ++i) {
    const auto axes = read_axes(context, parts.axes, i);
    if (!axes) return {};
    Mat3 J = *axes * read_tensor(parts.tensor, each, i) * axes->transpose();
    double moved = 0;
    if (!parts.about.empty()) {
      const double* p = parts.about.data() + (parts.about.size() > 3 ? 3 * i : 0);
      const Vec3 arm = parts.centers[i] - Vec3(p[0], p[1], p[2]);
      J -= parts.mass[i] * steiner(arm);
      moved = parts.mass[i] * arm.squaredNorm();
    }
    const std::string of_part = parts.mass.size() == 1 ? "" : fmt::format(" of part {}", i + 1);
    if (!check_tensor(context, J, of_part, moved)) return {};
    tensors.push_back(J);
    body.mass += parts.mass[i];
    first_moment += parts.mass[i] * parts.centers[i];
  }
  const Vec3 center = body.mass > 0 ? Vec3(parts.mass.size() == 1 ? parts.centers[0] : first_moment / body.mass) : node;
  for (std::size_t i = 0; i < parts.mass.size(); ++i)
    body.tensor += tensors[i] + parts.mass[i] * steiner(parts.centers[i] - center);
  body.offset = center - node;
  return body;
}

}  // namespace engrane::elements::bodies
