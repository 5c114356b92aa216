// SPDX-License-Identifier: BSD-3-Clause
// Results of joints: names of the channels and, in the same order, their values.
#include <algorithm>
#include <array>
#include <cmath>

#include "elements/joints/joint.hpp"
#include "elements/joints/measure_names.hpp"

namespace engrane::elements::joints {

namespace {

bool rubs_along(const JointFriction& f) { return f.kind != Rubbing::journal && f.kind != Rubbing::ball; }
bool rubs_round(const JointFriction& f) { return f.kind != Rubbing::guide && f.kind != Rubbing::drum && f.radius > 0; }

}  // namespace

int Joint::sliding_channel(const JointFriction& f) const {
  if (f.law.rests || f.collar > 0 || (f.kind != Rubbing::journal && f.kind != Rubbing::guide)) return -1;
  const Measure along = f.kind == Rubbing::guide ? Measure::gap_1 : f.turn;
  for (std::size_t k = 0; k < parts_.coordinates.size(); ++k)
    if (parts_.coordinates[k].measure == along && parts_.coordinates[k].drive.given()) return 2 * static_cast<int>(k) + 1;
  return -1;
}

void Joint::name_channels() {
  for (const JointCoordinate& c : parts_.coordinates) {
    const bool length = is_length(c.measure);
    channels_.push_back({c.names.value, length ? dimension::length : dimension::angle,
                         length ? "position of B from A in the joint" : "turn of B from A, whole turns counted"});
    channels_.push_back({c.names.rate, length ? dimension::velocity : dimension::angular_velocity, "rate of " + c.names.value});
  }
  const auto name = [this](const std::string& what, Dimension d, const std::string& where) {
    for (const char* c : {"_X", "_Y", "_Z"}) channels_.push_back({what + c, d, where + ", global"});
    if (parts_.has_axis)
      for (const char* c : {"_1", "_2", "_3"}) channels_.push_back({what + c, d, where + ", joint axes"});
  };
  const auto size_of = [this](int component, int count) {
    sizes_.push_back({static_cast<int>(channels_.size()), {}});
    for (int c = 0; c < count; ++c) sizes_.back().sources.push_back(component + c);
  };
  const int force = static_cast<int>(channels_.size()), moment = force + (parts_.has_axis ? 6 : 3);
  constexpr int across = 4;  // of the joint's axes, behind the global ones and the axis itself
  name("FORCE", dimension::force, "force of the joint on B");
  if (parts_.has_moment) name("MOMENT", dimension::moment, "moment of the joint on B at the joint point");
  if (parts_.has_axial) channels_.push_back({"AXIAL_FORCE", dimension::force, "force on B along the axis"});
  if (parts_.is_bearing) {
    size_of(force + across, 2);
    channels_.push_back({"RADIAL_FORCE", dimension::force, "size of the force on B across the axis", Channel::Course::size});
    if (parts_.has_moment) {
      size_of(moment + across, 2);
      channels_.push_back(
          {"BENDING_MOMENT", dimension::moment, "size of the moment on B across the axis", Channel::Course::size});
    }
  }
  if (parts_.has_thrust) channels_.push_back({"THRUST", dimension::force, "force that pushes the ends apart"});
  if (!parts_.has_axis) {
    size_of(force, 3);
    channels_.push_back({"FORCE_SIZE", dimension::force, "size of the force of the joint on B", Channel::Course::size});
  }
  if (parts_.has_bend) channels_.push_back({"BEND", dimension::angle, "angle between the shafts", Channel::Course::size});
  if (!parts_.normal_channel.empty())
    channels_.push_back({parts_.normal_channel, is_length(parts_.constraints[0].measure) ? dimension::force : dimension::moment,
                         multiplier(parts_.constraints[0].measure).help});
  for (std::size_t k = 0; k < parts_.coordinates.size(); ++k) {
    const JointCoordinate& c = parts_.coordinates[k];
    const bool length = is_length(c.measure);
    const Dimension effort = length ? dimension::force : dimension::moment;
    if (c.sprung()) channels_.push_back({c.names.spring, effort, "of spring and damper on B"});
    if (c.drive.given()) {
      channels_.push_back({c.names.drive, effort, "of the drive on B, the opposite on A"});
      channels_.push_back({c.names.power, dimension::power, "power that the drive gives to the mechanism"});
    }
    if (c.stop.given()) {
      channels_.push_back({c.names.stop, effort, "of the stops on B; positive pushes the coordinate up"});
      if (c.stop.two_sided()) gaps_.push_back({static_cast<int>(channels_.size()), {static_cast<int>(2 * k)}});
      channels_.push_back({c.names.gap, length ? dimension::length : dimension::angle, "to the nearer stop; negative: pressed"});
    }
  }
  for (std::size_t i = 0; i < parts_.friction.size(); ++i) {
    const JointFriction& f = parts_.friction[i];
    const int pressing = static_cast<int>(channels_.size()), rate = sliding_channel(f);
    const auto follows_from_speed = [&] {
      if (rate >= 0) rubs_.push_back({{static_cast<int>(channels_.size()), {pressing, rate}}, i});
    };
    channels_.push_back({"PRESSING_FORCE" + f.suffix, dimension::force,
                         "sum of the forces that press the rubbing surfaces together", Channel::Course::size});
    follows_from_speed();
    if (rubs_along(f))
      channels_.push_back({"FRICTION_FORCE" + f.suffix, dimension::force, "size of the friction force", Channel::Course::size});
    if (rubs_round(f))
      channels_.push_back(
          {"FRICTION_MOMENT" + f.suffix, dimension::moment, "size of the friction moment", Channel::Course::size});
    follows_from_speed();
    channels_.push_back({"FRICTION_POWER" + f.suffix, dimension::power, "power lost in friction", Channel::Course::size});
  }
}

void Joint::observe(const State& state, std::span<double> values) const {
  const JointPose<double> pose(parts_.frame, state.nodes[0], state.nodes[1]);
  const auto [force, moment] = load_on_b(state, pose);
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
  if (parts_.has_axial) values[i++] = force.dot(axes[0]);
  if (parts_.is_bearing) {
    values[i++] = std::hypot(force.dot(axes[1]), force.dot(axes[2]));
    if (parts_.has_moment) values[i++] = std::hypot(moment.dot(axes[1]), moment.dot(axes[2]));
  }
  if (parts_.has_thrust) values[i++] = force.dot(pose.gap) / pose.gap.norm();
  if (!parts_.has_axis) values[i++] = force.norm();
  if (parts_.has_bend) values[i++] = std::atan2(cross(pose.a1, pose.b1).norm(), pose.a1.dot(pose.b1));
  if (!parts_.normal_channel.empty()) values[i++] = state.multipliers[0];
  std::size_t row = parts_.constraints.size();
  for (const JointCoordinate& c : parts_.coordinates) {
    const Observed o = observed(c, state);
    if (c.sprung()) values[i++] = c.spring(o.value, o.rate, state.time, 0);
    if (c.drive.given()) {
      const double effort = state.multipliers[row++];
      values[i++] = effort;
      values[i++] = effort * c.drive.rate(state.time);
    }
    if (c.stop.given()) {
      values[i++] = c.stop.push(o.value, o.rate, 0);
      values[i++] = c.stop.gap(o.value);
    }
  }
  const Report report = rubbed(state);
  for (std::size_t f = 0; f < report.size(); ++f) {
    values[i++] = report[f].normal;
    if (rubs_along(parts_.friction[f])) values[i++] = report[f].force.norm();
    if (rubs_round(parts_.friction[f])) values[i++] = report[f].moment.norm();
    values[i++] = report[f].power;
  }
}

bool Joint::has_fine_forces() const {
  const auto reverses = [this](const JointFriction& f) { return !f.law.rests && sliding_channel(f) < 0; };
  return std::any_of(parts_.friction.begin(), parts_.friction.end(), reverses);
}

std::vector<Joint::Determined> Joint::determined() const {
  std::vector<Determined> all = gaps_;
  all.insert(all.end(), sizes_.begin(), sizes_.end());
  for (const Rub& rub : rubs_) all.push_back(rub.by);
  for (std::size_t k = 0; k < parts_.coordinates.size(); ++k)
    if (parts_.coordinates[k].drive.given())
      for (const int i : {0, 1}) all.push_back({static_cast<int>(2 * k) + i});
  return all;
}

double Joint::determine(int channel, double time, std::span<const double> sources) const {
  const auto owner = [this](int of) -> const JointCoordinate& { return parts_.coordinates[static_cast<std::size_t>(of / 2)]; };
  for (const Determined& gap : gaps_)
    if (gap.channel == channel) return owner(gap.sources[0]).stop.gap(sources[0]);
  const auto is_asked = [channel](const Determined& size) { return size.channel == channel; };
  if (std::any_of(sizes_.begin(), sizes_.end(), is_asked))
    return Eigen::Map<const Eigen::VectorXd>(sources.data(), static_cast<Eigen::Index>(sources.size())).norm();
  for (const Rub& rub : rubs_)
    if (rub.by.channel == channel) {
      const JointFriction& f = parts_.friction[rub.friction];
      const double lever = f.kind == Rubbing::guide ? 1 : f.radius, N = sources[0], speed = lever * std::abs(sources[1]);
      const double drag = f.law.over_speed(speed * speed, N) * N * speed;
      return drag * (channels_[static_cast<std::size_t>(channel)].dimension == dimension::power ? speed : lever);
    }
  const JointCoordinate& driven = owner(channel);
  return channel % 2 == 1 ? driven.drive.rate(time) : driven.drive.coordinate(time) + driven_origin(driven);
}

}  // namespace engrane::elements::joints
