// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "elements/building.hpp"

namespace engrane {

namespace {

bool is_angle(Measure m) { return m == Measure::angle || m == Measure::pin_a || m == Measure::pin_b; }

Dimension dimension_of(Measure m) {
  switch (m) {
    case Measure::gap_1:
    case Measure::gap_2:
    case Measure::gap_3:
    case Measure::distance:
    case Measure::screw:
      return dimension::length;
    default:
      return dimension::angle;
  }
}

bool is_length(Measure m) { return dimension_of(m) == dimension::length; }

Named multiplier(Measure m) {
  switch (m) {
    case Measure::gap_1:
      return {"FORCE_1", dimension::length, "force along the axis"};
    case Measure::gap_2:
      return {"FORCE_2", dimension::length, "force along the joint's second axis"};
    case Measure::gap_3:
      return {"FORCE_3", dimension::length, "force along the joint's third axis"};
    case Measure::tilt_2:
    case Measure::turn_2:
      return {"MOMENT_2", dimension::angle, "moment about the joint's second axis"};
    case Measure::tilt_3:
    case Measure::turn_3:
      return {"MOMENT_3", dimension::angle, "moment about the joint's third axis"};
    case Measure::distance:
      return {"THRUST", dimension::length, "force that pushes the points apart"};
    case Measure::screw:
      return {"THREAD_FORCE", dimension::length, "force of the thread along the axis"};
    case Measure::pins:
      return {"TORQUE", dimension::angle, "moment across both pins"};
    default:
      return {"MOMENT_1", dimension::angle, "moment about the axis"};
  }
}

}  // namespace

Joint::Joint(int id, JointParts parts) : TemplatedElement(id), parts_(std::move(parts)) {
  Layout layout;
  layout.nodes.assign(parts_.nodes.begin(), parts_.nodes.end());
  layout.needs = {parts_.frame.turns_a ? NodeNeed::both : NodeNeed::translation,
                  parts_.frame.turns_b ? NodeNeed::both : NodeNeed::translation};
  const auto count = [this](Measure m) {
    if (m == Measure::screw) m = Measure::angle;
    if (is_angle(m) && std::find(angles_.begin(), angles_.end(), m) == angles_.end()) angles_.push_back(m);
  };
  for (const JointConstraint& c : parts_.constraints) {
    layout.multipliers.push_back(multiplier(c.measure));
    count(c.measure);
  }
  for (const JointCoordinate& c : parts_.coordinates) {
    if (c.drive.given())
      layout.multipliers.push_back(
          {c.name + "_DRIVE", dimension_of(c.measure), is_length(c.measure) ? "force of the drive" : "torque of the drive"});
    count(c.measure);
  }
  layout.history = turn_count::history * static_cast<int>(angles_.size());
  set_layout(std::move(layout));
  name_channels();
}

int Joint::counted(Measure what) const {
  const auto found = std::find(angles_.begin(), angles_.end(), what == Measure::screw ? Measure::angle : what);
  return found == angles_.end() ? -1 : turn_count::history * static_cast<int>(found - angles_.begin());
}

void Joint::commit(const State& state, std::span<double>, std::span<double> history) const {
  const JointPose<double> pose(parts_.frame, state.nodes[0], state.nodes[1]);
  for (std::size_t i = 0; i < angles_.size(); ++i) {
    const std::size_t at = i * turn_count::history;
    turn_count::commit(measure(angles_[i], parts_.frame, pose, 0).value, state.history.subspan(at, turn_count::history),
                       history.subspan(at, turn_count::history));
  }
}

Joint::Observed Joint::observed(const JointCoordinate& c, const State& state) const {
  const JointPose<double> pose(parts_.frame, state.nodes[0], state.nodes[1]);
  const Measured<double> m = measured(c.measure, pose, state);
  return {m.value, rate(m, pose, state.nodes[0], state.nodes[1])};
}

Energies Joint::energies(const State& state) const {
  Energies e;
  std::size_t row = parts_.constraints.size();
  for (const JointCoordinate& c : parts_.coordinates) {
    const Observed o = observed(c, state);
    e.potential += 0.5 * c.stiffness * (o.value - c.relaxed) * (o.value - c.relaxed);
    e.dissipated += c.damping * o.rate * o.rate;
    if (c.drive.given()) e.external += state.multipliers[row++] * c.drive.rate(state.time);
  }
  return e;
}

void Joint::observe(const State& state, std::span<double> values) const {
  std::array<double, 18> r{};
  residual(state, std::span(r).first(static_cast<std::size_t>(layout().slots())));
  const NodeState& b = state.nodes[1];
  const JointPose<double> pose(parts_.frame, state.nodes[0], b);
  const Vec3 force = -Vec3(r[6], r[7], r[8]);
  const Vec3 moment = parts_.frame.turns_b ? Vec3(-b.R * Vec3(r[9], r[10], r[11]) - cross(pose.arm_b, force)) : Vec3::Zero();

  std::size_t i = 0;
  for (const JointCoordinate& c : parts_.coordinates) {
    const Observed o = observed(c, state);
    values[i++] = o.value;
    values[i++] = o.rate;
  }
  const std::array axes = {pose.a1, pose.a2, pose.a3};
  const auto write = [&](const Vec3& v) {
    for (Eigen::Index c = 0; c < 3; ++c) values[i++] = v[c];
    if (parts_.has_axis)
      for (const Vec3& e : axes) values[i++] = v.dot(e);
  };
  write(force);
  if (parts_.has_moment) write(moment);
  if (parts_.is_bearing) {
    values[i++] = std::hypot(force.dot(axes[1]), force.dot(axes[2]));
    if (parts_.has_moment) values[i++] = std::hypot(moment.dot(axes[1]), moment.dot(axes[2]));
  }
  if (parts_.has_thrust) values[i++] = force.dot(pose.gap) / pose.gap.norm();
  if (!parts_.has_axis) values[i++] = force.norm();
  std::size_t row = parts_.constraints.size();
  for (const JointCoordinate& c : parts_.coordinates) {
    const Observed o = observed(c, state);
    if (c.sprung()) values[i++] = -c.stiffness * (o.value - c.relaxed) - c.damping * o.rate;
    if (c.drive.given()) {
      const double effort = state.multipliers[row++];
      values[i++] = effort;
      values[i++] = effort * c.drive.rate(state.time);
    }
  }
}

Drawing Joint::drawing() const {
  const auto [a, b] = parts_.nodes;
  if (parts_.drawn_axis)
    return {fmt::format(R"("shape": "axis", "node": {}, "center": {}, "axis": {})", a != 0 ? a : b, json(parts_.point),
                        json(parts_.frame.e1))};
  if (a != 0 && b != 0) return {fmt::format(R"("shape": "line", "points": {})", json(layout().nodes))};
  return {};
}

void Joint::name_channels() {
  for (const JointCoordinate& c : parts_.coordinates) {
    const bool length = is_length(c.measure);
    channels_.push_back({c.name, length ? dimension::length : dimension::angle,
                         length ? "position of B from A in the joint" : "turn of B from A, whole turns counted"});
    channels_.push_back({c.rate_name, length ? dimension::velocity : dimension::angular_velocity, "rate of " + c.name});
  }
  const auto name = [this](const std::string& what, Dimension d, const std::string& where) {
    for (const char* c : {"_X", "_Y", "_Z"}) channels_.push_back({what + c, d, where + ", global"});
    if (parts_.has_axis)
      for (const char* c : {"_1", "_2", "_3"}) channels_.push_back({what + c, d, where + ", joint axes"});
  };
  name("FORCE", dimension::force, "force of the joint on B");
  if (parts_.has_moment) name("MOMENT", dimension::moment, "moment of the joint on B at the joint point");
  if (parts_.is_bearing) {
    channels_.push_back({"RADIAL_FORCE", dimension::force, "size of the force on B across the axis"});
    if (parts_.has_moment) channels_.push_back({"BENDING_MOMENT", dimension::moment, "size of the moment on B across the axis"});
  }
  if (parts_.has_thrust) channels_.push_back({"THRUST", dimension::force, "force that pushes the ends apart"});
  if (!parts_.has_axis) channels_.push_back({"FORCE_SIZE", dimension::force, "size of the force of the joint on B"});
  for (const JointCoordinate& c : parts_.coordinates) {
    const bool length = is_length(c.measure);
    const Dimension effort = length ? dimension::force : dimension::moment;
    if (c.sprung()) channels_.push_back({c.name + "_SPRING", effort, "of spring and damper on B"});
    if (c.drive.given()) {
      channels_.push_back({c.name + "_DRIVE", effort, "of the drive on B, the opposite on A"});
      channels_.push_back({c.name + "_POWER", dimension::power, "power that the drive gives to the mechanism"});
    }
  }
}

}  // namespace engrane
