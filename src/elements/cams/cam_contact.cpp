// SPDX-License-Identifier: BSD-3-Clause
#include "elements/cams/cam_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "elements/common/along_motion.hpp"
#include "elements/common/building.hpp"
#include "math/angle.hpp"

namespace engrane::elements::cams {

Cam::Cam(int id, CamParts parts) : TemplatedElement(id), parts_(std::move(parts)) {
  Layout layout;
  layout.nodes.assign(parts_.nodes.begin(), parts_.nodes.end());
  // the force on an edge or a roller exerts no moment if its point is the node itself
  layout.needs = {NodeNeed::both, parts_.flat || !parts_.point.isZero(0) ? NodeNeed::both : NodeNeed::translation};
  layout.history = 2;
  if (parts_.law) {
    for (std::size_t k = 0; k < places(); ++k) {
      const std::string where = k == 0 ? "" : k == 1 ? " at a second place" : " at a third place";
      layout.switches.push_back({"follower touches" + where, "follower parts" + where});
      if (parts_.law->damped()) layout.switches.push_back({"follower presses again" + where, "follower presses no more" + where});
    }
  } else {
    layout.multipliers.push_back({"NORMAL_FORCE", dimension::length, "normal force of the cam on the follower"});
    // friction goes with its magnitude
    if (parts_.friction) layout.switches.push_back({"cam pushes the follower", "cam pulls the follower", true, 0});
  }
  const CamCurve& curve = parts_.profile->curve();
  joints_ = curve.joints();
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    // accelerations that a spline demands have corners at its points, those of a motion may jump
    const std::string passes = curve.motion()
                                   ? fmt::format("cam passes the joint of the motion at {:.6g} degrees", joints_[k] / degree)
                                   : fmt::format("cam passes point {} of its profile", k + 1);
    layout.switches.push_back({passes, passes, !curve.motion()});
  }
  layout.slides = parts_.friction ? static_cast<int>(places()) : 0;
  set_layout(std::move(layout));
  const bool roller = !parts_.flat && parts_.radius > 0;
  channels_ = {
      {"NORMAL_FORCE", dimension::force, "of the cam on the follower; positive pushes it away"},
      {"FORCE_X", dimension::force, "force on the follower, global"},
      {"FORCE_Y", dimension::force, "force on the follower, global"},
      {"FORCE_Z", dimension::force, "force on the follower, global"},
      // without a law it is what the constraint is left open by at the ends of steps
      {"GAP", dimension::length, "between follower and profile; negative: pressed together",
       parts_.law ? Channel::Course::smooth : Channel::Course::step},
      {"CAM_ANGLE", dimension::angle, "parameter of the profile at the contact: of a motion the cam's turn, within a turn"},
      {"CONTACT_ANGLE", dimension::angle, "polar angle of the contact point in the cam"},
      {"RADIUS_OF_CURVATURE", dimension::length, "of the profile at the contact; negative in a hollow", Channel::Course::ratio},
      {"POWER", dimension::power, "power that the follower takes from the cam"}};
  if (curve.motion()) {
    const bool arm = parts_.guide.kind == CamGuide::Kind::arm;
    channels_.push_back({"LIFT", arm ? dimension::angle : dimension::length, "lift of the motion at the contact"});
  }
  if (parts_.guide.kind != CamGuide::Kind::none)
    channels_.push_back(
        {"PRESSURE_ANGLE", dimension::angle, "between the contact's normal and the follower's way", Channel::Course::size});
  channels_.push_back(
      roller ? Channel{"ROLLER_SPEED", dimension::angular_velocity, "of the roller in the follower, as it rolls"}
             : Channel{"SLIDING_SPEED", dimension::velocity, "of the follower over the profile", Channel::Course::size});
  if (parts_.friction) channels_.push_back({"FRICTION_FORCE", dimension::force, "size of the friction", Channel::Course::size});
  if (parts_.law) channels_.push_back({"SPRING_ENERGY", dimension::energy, "energy stored in the contact"});
  if (parts_.law || parts_.friction)
    channels_.push_back({"POWER_LOST", dimension::power, "by damping and friction", Channel::Course::size});
  if (parts_.several) {
    channels_[0].help = "normal force at the deepest contact; positive pushes the follower away";
    channels_.push_back({"NORMAL_FORCE_2", dimension::force, "normal force at the second deepest contact"});
    channels_.push_back({"NORMAL_FORCE_3", dimension::force, "normal force at the third deepest contact"});
  }
}

void Cam::count_turns(const State& state, std::span<double>, std::span<double> history) const {
  const Place<double> here = place<double>(motion<double>(state).node);
  history[0] = counted(feet(here, state.history).begin()->s, state.history);
  history[1] = 1;
}

double Cam::counted(double s, std::span<const double> history) {
  if (history[1] != 0) s = history[0] + std::remainder(s - history[0], whole_turn);
  return std::remainder(s, 2 * whole_turn);
}

void Cam::joint_switches(const Contact<Taylor>& deepest, const State& state, std::span<Switch> values) const {
  const double s = counted(deepest.foot.s, state.history);
  const bool touches = !parts_.law || deepest.gap.value <= 0;
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    // its zeros are the joint in every turn, in opposite directions
    const double half = 0.5 * (s - joints_[k]);
    values[k] = touches ? Switch{std::sin(half), 0.5 * std::cos(half) * deepest.s.d1, 1} : Switch{};
  }
}

void Cam::switches(const State& state, std::span<Switch> values) const {
  if (values.empty()) return;
  const CamFeet touched = feet(place<double>(motion<double>(state).node), state.history);
  const Place<Taylor> moving = place<Taylor>(along_motion(state));
  const Contact<Taylor> deepest = contact(moving, *touched.begin());
  joint_switches(deepest, state, values.last(joints_.size()));
  if (!parts_.law) {
    if (parts_.friction) values[0] = {state.multipliers[0], std::numeric_limits<double>::quiet_NaN(), 0};
    return;
  }
  const std::size_t each = parts_.law->damped() ? 2 : 1;
  for (std::size_t k = 0; k < places(); ++k) {
    Switch& touches = values[k * each];
    Switch* presses = each == 2 ? &values[k * each + 1] : nullptr;
    if (presses) *presses = {};
    if (k >= touched.count) {
      // open, by an unknown gap
      const double size = touched.begin()->p.norm() + parts_.radius;
      touches = {-size, 0, size};
      continue;
    }
    const CamFoot& foot = touched.begin()[k];
    const Taylor gap = k == 0 ? deepest.gap : contact(moving, foot).gap;
    const double pressed = -gap.value, rate = -gap.d1, growth = -gap.d2;
    touches = {pressed, rate, foot.p.norm() + parts_.radius + parts_.profile->inset()};
    if (presses && pressed > 0)
      *presses = {parts_.law->pressure(pressed, rate), parts_.law->pressure_rate(pressed, rate, growth),
                  parts_.law->pressure_size(pressed, rate)};
  }
}

bool Cam::touches(const State& state) const {
  std::vector<Switch> values(layout().switches.size());
  switches(state, values);
  // a joint does not open
  return std::any_of(values.begin(), values.end() - static_cast<std::ptrdiff_t>(joints_.size()),
                     [](const Switch& s) { return s.unclear(); });
}

void Cam::sliding(const State& state, std::span<Vec3> speeds) const {
  if (speeds.empty()) return;
  const Nodes<double> node = motion<double>(state).node;
  const Place<double> here = place<double>(node);
  std::size_t k = 0;
  for (const CamFoot& foot : feet(here, state.history)) speeds[k++] = sliding(contact(here, foot), node) / parts_.friction->width;
}

Energies Cam::energies(const State& state) const {
  const Nodes<double> node = motion<double>(state).node;
  const Place<double> here = place<double>(node);
  Energies e;
  for (const CamFoot& foot : feet(here, state.history)) {
    const Contact<double> c = contact(here, foot);
    const double rate = gap_rate(c, node), force = load(c, state, rate);
    if (parts_.law && c.gap < 0) {
      e.potential += parts_.law->stored(-c.gap);
      e.dissipated += (parts_.law->force(-c.gap, -rate, 0) - parts_.law->elastic(-c.gap)) * -rate;
    }
    if (parts_.friction) e.dissipated += friction(c, node, force) * sliding(c, node).norm();
  }
  return e;
}

double Cam::pressure_angle(const Vec3& normal, const Vec3& way) { return std::atan2(cross(normal, way).norm(), normal.dot(way)); }

void Cam::observe(const State& state, std::span<double> values) const {
  const Nodes<double> node = motion<double>(state).node;
  const Place<double> here = place<double>(node);
  const CamFeet touched = feet(here, state.history);
  std::array<double, CamFeet::most> forces{};
  double drag = 0;
  std::size_t at = 0;
  for (const CamFoot& foot : touched) {
    const Contact<double> c = contact(here, foot);
    forces[at] = load(c, state, gap_rate(c, node));
    if (parts_.friction) drag += friction(c, node, forces[at]);
    ++at;
  }
  const Contact<double> c = contact(here, *touched.begin());
  std::array<double, 13> r{};
  residual(state, std::span(r).first(sweep().slots()));
  const auto on_b = [&](int slot) {
    return slot < 0 ? Vec3(Vec3::Zero()) : Vec3(-Eigen::Map<const Vec3>(&r[static_cast<std::size_t>(slot)]));
  };
  const Vec3 force_b = on_b(sweep().translation(1)), moment_b = on_b(sweep().rotation(1));
  const NodeState &a = state.nodes[0], &b = state.nodes[1];

  std::size_t i = 0;
  const auto put = [&](double value) { values[i++] = value; };
  put(forces[0]);
  for (Eigen::Index k = 0; k < 3; ++k) put(force_b[k]);
  put(c.gap);
  const CamProfile& profile = *parts_.profile;
  const double s = std::remainder(c.foot.s, whole_turn);
  put(s < 0 ? s + whole_turn : s);
  const Vec2 touch = c.foot.p - profile.inset() * c.foot.n;
  put(std::atan2(touch[1], touch[0]));
  put(1 / c.foot.curvature - profile.inset());
  put(force_b.dot(b.v) + moment_b.dot(b.W));
  if (const CamMotion* motion = profile.curve().motion()) put(motion->at(c.foot.s).f);
  if (parts_.guide.kind == CamGuide::Kind::slide) put(pressure_angle(c.normal, Vec3(b.R * parts_.guide.direction)));
  if (parts_.guide.kind == CamGuide::Kind::arm) {
    // direction in which the arm moves the follower's point when it swings away from the cam
    const Vec3 way = cross(Vec3(a.R * parts_.axes.col(2)), Vec3(b.R * Vec3(parts_.point - parts_.guide.pivot)));
    put(pressure_angle(c.normal, Vec3(c.normal.dot(way) < 0 ? -way : way)));
  }
  const Vec3 slip = sliding(c, node);
  if (!parts_.flat && parts_.radius > 0) {
    // the roller's rim moves with the cam: its speed relative to the follower, about the cam's axis
    const Vec3 axis = a.R * parts_.axes.col(2);
    put(slip.dot(cross(axis, c.normal)) / parts_.radius);
  } else {
    put(slip.norm());
  }
  if (parts_.friction) put(drag);
  const Energies e = energies(state);
  if (parts_.law) put(e.potential);
  if (parts_.law || parts_.friction) put(e.dissipated);
  for (std::size_t k = 1; k < places(); ++k) put(forces[k]);
}

Drawing Cam::drawing() const {
  const auto [a, b] = parts_.nodes;
  const Vec3 axis = parts_.axes.col(2);
  const CamProfile& profile = *parts_.profile;
  const auto round = [](const Vec3& v) { return fmt::format("[{:.7g}, {:.7g}, {:.7g}]", v[0], v[1], v[2]); };
  std::string outline;
  const std::size_t count = std::clamp<std::size_t>(2 * profile.curve().pieces(), 240, 2000);
  for (std::size_t k = 0; k < count; ++k) {
    const CamFoot foot = profile.at(whole_turn * static_cast<double>(k) / static_cast<double>(count));
    const Vec2 p = foot.p - profile.inset() * foot.n;
    outline += (k > 0 ? ", " : "") + round(parts_.place + p[0] * parts_.axes.col(0) + p[1] * parts_.axes.col(1));
  }
  Drawing shapes{fmt::format(R"("shape": "plate", "node": {}, "axis": {}, "hollow": {}, "outline": [{}])", a, json(axis),
                             parts_.inside, outline)};
  if (!parts_.flat && parts_.radius > 0)
    shapes.push_back(fmt::format(R"("shape": "roller", "node": {}, "center": {}, "axis": {}, "radius": {})", b,
                                 json(parts_.follower), json(axis), parts_.radius));
  return shapes;
}

}  // namespace engrane::elements::cams
