// SPDX-License-Identifier: BSD-3-Clause
#include "app/linked_turns.hpp"

#include <fmt/format.h>

#include <set>

#include "math/angle.hpp"
#include "math/rotation.hpp"
#include "model/linear_statics.hpp"

namespace engrane::app {

namespace {

/// Angle, in radians, from which on the error of displacements of the first order is told: two hundredths.
constexpr double small = 0.2;

}  // namespace

LinkedTurns::LinkedTurns(const Model& model) : model_(model) {
  // rotations of linear statics add up, whatever their size
  if (!model.commands.analysis.displacements.is("SMALL") || is_linear_statics(model)) return;
  std::set<int> led;
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const Model::Part& part = model.parts[p];
    if ((part.type == "RIGID_LINK" || part.type == "MEAN_LINK") && led.insert(part.nodes[0]).second) links_.push_back(p);
  }
}

void LinkedTurns::take(const Configuration& c) {
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const double angle = rotation_log(c.nodes[static_cast<std::size_t>(model_.parts[links_[i]].nodes[0])].R).norm();
    if (!(angle > angle_)) continue;
    angle_ = angle;
    time_ = c.time;
    farthest_ = i;
  }
}

std::string LinkedTurns::remark() const {
  if (!(angle_ > small)) return {};
  const Model::Part& part = model_.parts[links_[farthest_]];
  return fmt::format(
      "node {} of {} turned by {:.3g} degrees at t = {:.6g}: with DISPLACEMENTS SMALL the mesh follows it to first order only, "
      "and not beyond half a turn. Displacements there are off by about {:.0f} %: take DISPLACEMENTS LARGE",
      model_.nodes[static_cast<std::size_t>(part.nodes[0])].id, part.name(), angle_ / degree, time_, 50 * angle_ * angle_);
}

}  // namespace engrane::app
