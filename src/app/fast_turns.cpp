// SPDX-License-Identifier: BSD-3-Clause
#include "app/fast_turns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "math/rotation.hpp"

namespace engrane::app {

namespace {

/// A fast top with regular precession, m g l/(J ω), precesses too slowly by c θ² with θ radians per step of generalised-α. A fit
/// of c to measurements for small θ, over γ − ½, which is (1 − ρ)/(1 + ρ) of CHUNG and α of HHT and BOSSAK: measured 0.56 for
/// RHO 1 and NEWMARK, 0.59 for RHO 0.8, 0.85 for RHO 0.5, 3.1 for RHO 0; for HHT and BOSSAK, 0.66 and 0.68, the fit is a seventh
/// low (tests/verify/test_fast_turns.py). Above 0.3 rad the error grows more slowly, up to 1.
double error_per_square(const SolverOptions& options) {
  using Family = SolverOptions::Family;
  const double shift = options.family == Family::chung     ? (1 - options.damping) / (1 + options.damping)
                       : options.family == Family::newmark ? 0
                                                           : options.damping;
  return 0.56 + 2.55 * shift * shift;
}
/// Relative error of precession that is warned of, and the one expected with the advised steps.
constexpr double most_error = 0.023, advised_error = 0.006;
/// For Radau IIA, the angles per step in radians that are warned of and advised, whose error is 1e-4 at 1 rad, 1e-3 at 1.5 and
/// 5e-2 at 3.
constexpr double limit_of_radau = 2.5, advised_of_radau = 1;
/// Angle in radians by which an axis must turn during the run. Wheels on flexible shafts wobble by less.
constexpr double turned_axis = 0.01;
/// Part of that by which axis and accelerations must differ with Radau IIA, which is exact where joints lead the axis.
constexpr double unlike = 0.01;

/// Rate of the axis of rotation in space, from the part of dω/dt = R Ẇ across ω. It is smooth where the body spins fast and
/// precesses slowly, and tells of a precession that long steps fail to follow: they leave the axis where it is.
Vec3 rate_of_axis(const NodeState& node) {
  const double speed = node.W.norm();
  if (speed == 0) return Vec3::Zero();
  const Vec3 axis = node.W / speed;
  return node.R * ((node.A - node.A.dot(axis) * axis) / speed);
}

}  // namespace

FastTurns::FastTurns(const Model& model, const SolverOptions& options)
    : model_(model),
      radau_(options.family == SolverOptions::Family::radau),
      error_per_square_(radau_ ? 0 : error_per_square(options)),
      limit_(radau_ ? limit_of_radau : std::sqrt(most_error / error_per_square_)) {
  // axes do not turn in plane motion, and steps with a tolerance follow those that do
  if (options.analysis != SolverOptions::Analysis::dynamics || options.tolerance > 0 || model.plane.active()) return;
  std::vector<bool> known(model.nodes.size(), false);
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const Model::Part& part = model.parts[p];
    for (const int node : part.nodes) {
      const auto i = static_cast<std::size_t>(node);
      if (node == 0 || known[i] || part.element->inertia_at(model.nodes[i].id).isZero(0)) continue;
      known[i] = true;
      bodies_.push_back({node, static_cast<int>(p)});
    }
  }
}

void FastTurns::take(const Configuration& c) {
  for (Body& body : bodies_) {
    const NodeState& node = c.nodes[static_cast<std::size_t>(body.node)];
    const Vec3 rate = rate_of_axis(node);
    if (begun_) {
      const Vec3 turn = body.R * rotation_log(Mat3(body.R.transpose() * node.R));
      const double angle = turn.norm();
      if (angle > limit_) {
        // the axis in one sense, also of a body that turns back
        Vec3 axis = turn / angle;
        if (axis.dot(body.axis) < 0) axis = -axis;
        if (body.first.isZero(0)) body.first = axis;
        body.axis = axis;
        const double sense = (node.R * node.W).dot(axis) < 0 ? -1 : 1;
        body.swing += 0.5 * sense * c.h * (body.rate + rate);
        const Vec3 moved = axis - body.first;
        body.farthest = std::max({body.farthest, moved.norm(), body.swing.norm()});
        body.apart = std::max(body.apart, (moved - body.swing).norm());
        if (angle > body.angle) {
          body.angle = angle;
          body.time = c.time;
          body.step = c.h;
        }
      }
    }
    body.R = node.R;
    body.rate = rate;
  }
  begun_ = true;
}

bool FastTurns::warns_of(const Body& body) const {
  return body.farthest > turned_axis && (!radau_ || body.apart > unlike * body.farthest);
}

std::string FastTurns::remark() const {
  const Body* worst = nullptr;
  for (const Body& body : bodies_)
    if (warns_of(body) && (!worst || body.angle > worst->angle)) worst = &body;
  if (!worst) return {};
  const Model::Part& part = model_.part(worst->part);
  const double angle = worst->angle;
  const std::string error =
      radau_ ? "" : fmt::format(", by about {:.0f} % here", 100 * std::min(1.0, error_per_square_ * angle * angle));
  return fmt::format(
      "{} (node {}) turned by {:.3g} rad in the step to t = {:.6g}, about an axis that turns as well. With more than {:.2g} "
      "rad "
      "per step precession, nutation and gyroscopic moments are wrong{}: take H of at most {:.2g}, or ACCURACY, whose steps "
      "follow their error",
      part.name(), model_.node(worst->node).id, angle, worst->time, limit_, error,
      (radau_ ? advised_of_radau : std::sqrt(advised_error / error_per_square_)) / angle * worst->step);
}

}  // namespace engrane::app
