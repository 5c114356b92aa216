// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/joint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "elements/common/building.hpp"
#include "elements/common/slide_switches.hpp"
#include "elements/joints/measure_names.hpp"
#include "model/grip.hpp"

namespace engrane::elements::joints {

namespace {

/// Whether the measure depends on B's second or third axis.
bool looks_across_b(Measure m) {
  switch (m) {
    case Measure::gap_1:
    case Measure::gap_2:
    case Measure::gap_3:
    case Measure::tilt_2:
    case Measure::tilt_3:
    case Measure::distance:
    case Measure::radius:
    case Measure::azimuth:
      return false;
    default:
      return true;
  }
}

/// Adds the grip of one joint friction, with names for its constraints.
void name_grip(Layout& layout, const JointFriction& f) {
  const GripShape shape = f.shape();
  const std::array coordinates = f.coordinates();
  std::vector<Named> named;
  for (std::size_t k = 0; k < static_cast<std::size_t>(shape.size); ++k) {
    const Measure m = coordinates[k];
    const std::string axis = f.kind == Rubbing::ball ? std::to_string(k + 1)
                             : m == Measure::gap_2   ? "2"
                             : m == Measure::gap_3   ? "3"
                                                     : "";
    named.push_back({(is_length(m) ? "GRIP_FORCE" : "GRIP_MOMENT") + (axis.empty() ? f.suffix : "_" + axis), dimension_of(m),
                     "friction at rest"});
  }
  add_grip(layout, named, shape);
}

/// Rate of a measure from the nodes' velocities, by its gradient.
template <class T>
T rate_of(const Measured<T>& m, const JointRates<T>& rates) {
  T sum(0);
  if (m.pushes) sum += dot(m.force, rates.slip);
  if (m.turns) sum += dot(m.moment, rates.spin);
  return sum;
}

}  // namespace

template <class T>
Measured<T> Joint::measured(Measure what, const JointPose<T>& pose, const State& state) const {
  const int at = counted(what);
  if (at < 0) return measure(what, parts_.frame, pose);
  const auto committed = state.history.subspan(static_cast<std::size_t>(at), turn_count::history);
  Measured<T> m = measure(what, parts_.frame, pose);
  if (what == Measure::screw) {
    const double angle = value_of(measure(Measure::angle, parts_.frame, pose).value);
    m.value -= parts_.frame.lead * 2 * std::numbers::pi * turn_count::turns(angle, committed);
  } else {
    m.value += 2 * std::numbers::pi * turn_count::turns(value_of(m.value), committed);
  }
  return m;
}

template <class T, class Node>
JointRates<T> Joint::rates_of(const JointPose<T>& pose, const Node& a, const Node& b) const {
  const auto spin = [](bool turns, const Node& node) {
    return turns ? Vec3T<T>(rotate(node.R, node.W)) : Vec3T<T>(T(0), T(0), T(0));
  };
  const Vec3T<T> spin_a = spin(parts_.frame.turns_a, a), spin_b = spin(parts_.frame.turns_b, b);
  return {b.v + cross(spin_b, pose.arm_b) - a.v - cross(spin_a, Vec3T<T>(pose.arm_a + pose.gap)), spin_b - spin_a};
}

template <class T>
void Joint::act(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance, Report* report) const {
  const auto& a = motion.node[0];
  const auto& b = motion.node[1];
  const JointFrame& frame = parts_.frame;
  const JointPose<T> pose(frame, a, b, whole_b_);
  Vec3T<T> force(T(0), T(0), T(0)), moment(T(0), T(0), T(0));
  const auto add = [&](const Measured<T>& m, const T& amount) {
    if (m.pushes) force += m.force * amount;
    if (m.turns) moment += m.moment * amount;
  };

  int row = 0;
  Vec3T<T> normal;
  for (const JointConstraint& c : parts_.constraints) {
    const Measured<T> m = measured(c.measure, pose, state);
    if (row == 0 && !parts_.friction.empty()) normal = m.force;
    add(m, balance.constraint(row++, m.value - c.value));
  }
  if (moves_) {
    const Vec3T<T> carried = force, carried_moment = moment;
    const JointRates<T> rates = has_rates_ ? rates_of<T>(pose, a, b) : JointRates<T>();
    for (const JointCoordinate& c : parts_.coordinates) {
      if (!c.sprung() && !c.drive.given() && !c.stop.given()) continue;
      const Measured<T> m = measured(c.measure, pose, state);
      if (c.drive.given()) add(m, balance.constraint(row++, m.value - c.drive.coordinate(motion.time) - driven_origin(c)));
      if (!c.sprung() && !c.stop.given()) continue;
      const T speed = rate_of(m, rates);
      if (c.sprung()) add(m, c.spring(m.value, speed, state.time, balance.contact_homotopy()));
      if (c.stop.given()) add(m, c.stop.push(m.value, speed, balance.contact_homotopy()));
    }
    std::size_t grip = 0;
    for (const JointFriction& f : parts_.friction) {
      const bool turns = f.kind != Rubbing::guide && f.kind != Rubbing::ball && f.radius > 0;
      const Measured<T> turn = turns ? measured(f.turn, pose, state) : Measured<T>();
      const JointRub<T> found = f.law.rests ? rest(f, grip++, pose, carried, carried_moment, turn, normal, rates, state, balance)
                                            : rub(f, pose, carried, carried_moment, turn, normal, rates);
      force += found.force;
      moment += found.moment;
      if constexpr (std::is_same_v<T, double>)
        if (report) report->push_back(found);
    }
  }

  balance.force(0, force);
  balance.force(1, Vec3T<T>(-force));
  // A's lever reaches to B's point, whatever the gap, so that the moments balance
  if (frame.turns_a)
    balance.moment(
        0, rotate_back(a.R, Vec3T<T>(cross(pose.has_arm_a ? Vec3T<T>(pose.gap + pose.arm_a) : pose.gap, force) + moment)));
  if (frame.turns_b)
    balance.moment(1,
                   rotate_back(b.R, Vec3T<T>(pose.has_arm_b ? Vec3T<T>(-cross(pose.arm_b, force) - moment) : Vec3T<T>(-moment))));
}

template <class T>
JointRub<T> Joint::rest(const JointFriction& f, std::size_t grip, const JointPose<T>& pose, const Vec3T<T>& force,
                        const Vec3T<T>& moment, const Measured<T>& turn, const Vec3T<T>& normal, const JointRates<T>& rates,
                        const State& state, Balance<T, 2>& balance) const {
  const GripState now = GripState::of(layout(), state.history, grip);
  const GripShape shape = f.shape();
  const std::array coordinates = f.coordinates();
  const int row = layout().grip_row(grip);
  std::array<Measured<T>, 3> along;
  Vec3T<T> u(T(0), T(0), T(0)), held = u;
  const bool ball = f.kind == Rubbing::ball;
  std::optional<JointPose<T>> turned;
  if (ball) turned = since_rest(pose, now.held);
  for (int k = 0; k < shape.size; ++k) {
    const auto i = static_cast<std::size_t>(k);
    along[i] = coordinates[i] == f.turn && !ball ? turn : measured(coordinates[i], ball ? *turned : pose, state);
    held[k] = balance.constraint(row + k, ball ? along[i].value : T(along[i].value - now.held[k]));
    // a ball slides by its spin: the rotation since the place of rest must not enter the gradient
    if (ball && now.mode == GripState::sliding) along[i].set_moment(i == 0 ? pose.a1 : i == 1 ? pose.a2 : pose.a3);
    u[k] = rate_of(along[i], rates) * shape.lever[i];
  }
  if (now.mode == GripState::free) return rub(f, pose, force, moment, turn, normal, rates);
  if (!f.along_line()) return rub_towards(f, now, pressing(f, pose, force, moment), along, u, held);
  const double lead = parts_.frame.lead;
  JointRub<T> found = rub_in_direction(f, now.sense(), pose, force, moment, turn, lead, rates);
  if (now.mode == GripState::holding) rub_along(f, pose, turn, lead, held[0], found);
  return found;
}

template <class T>
void Joint::evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const {
  act<T>(motion, state, balance, nullptr);
}

Joint::~Joint() = default;

/// Without friction a multiplier acts along its constraint's gradient, which needs no differentiation, and only the difference
/// of the nodes' positions matters: nine derivative lanes instead of eighteen.
void Joint::tangent(const State& state, Weights weights, std::span<double> r, std::span<double> k) const {
  if (!parts_.friction.empty()) return TemplatedElement::tangent(state, weights, r, k);
  constexpr std::size_t places = 0, turns_a = 3, turns_b = 6;
  using D = Dual<9>;
  Motion<D, 2> moved = motion<D>(state);
  sweep().seed_translation(moved.node[1], weights, places);
  if (parts_.frame.turns_a) sweep().seed_rotation(moved.node[0], state.nodes[0], weights, turns_a);
  if (parts_.frame.turns_b) sweep().seed_rotation(moved.node[1], state.nodes[1], weights, turns_b);
  Balance<D, 2> balance(state);
  act(moved, state, balance, nullptr);

  const std::size_t n = sweep().slots(), first = sweep().first_multiplier();
  const auto moves = [&](std::size_t node, int slot) { return layout().nodes[node] != 0 && slot >= 0; };
  const int place_a = sweep().translation(0), turn_a = sweep().rotation(0), place_b = sweep().translation(1),
            turn_b = sweep().rotation(1);
  std::fill(k.begin(), k.end(), 0.0);
  sweep().each_row(balance, [&](std::size_t row, const D& value) {
    r[row] = value.value;
    const auto copy = [&](int slot, std::size_t lane, double sign) {
      double* to = &k[row * n + static_cast<std::size_t>(slot)];
      for (std::size_t c = 0; c < 3; ++c) to[c] = sign * value.d[lane + c];
    };
    if (moves(0, place_a)) copy(place_a, places, -1);
    if (moves(0, turn_a)) copy(turn_a, turns_a, 1);
    if (moves(1, place_b)) copy(place_b, places, 1);
    if (moves(1, turn_b)) copy(turn_b, turns_b, 1);
  });
  if (weights.multipliers == 0) return;

  const NodeState &a = state.nodes[0], &b = state.nodes[1];
  const JointPose<double> pose(parts_.frame, a, b, whole_b_);
  std::size_t column = first;
  const auto write = [&](int slot, const Vec3& v) {
    for (Eigen::Index c = 0; c < 3; ++c) k[static_cast<std::size_t>(slot + c) * n + column] = weights.multipliers * v[c];
  };
  const auto put = [&](Measure what) {
    const Measured<double> m = measure(what, parts_.frame, pose);
    write(place_a, m.force);
    write(place_b, -m.force);
    if (turn_a >= 0) write(turn_a, a.R.transpose() * (cross(Vec3(pose.gap + pose.arm_a), m.force) + m.moment));
    if (turn_b >= 0) write(turn_b, b.R.transpose() * (-cross(pose.arm_b, m.force) - m.moment));
    ++column;
  };
  for (const JointConstraint& c : parts_.constraints) put(c.measure);
  for (const JointCoordinate& c : parts_.coordinates)
    if (c.drive.given()) put(c.measure);
}

Joint::Joint(int id, JointParts parts) : TemplatedElement(id), parts_(std::move(parts)) {
  Layout layout;
  layout.nodes.assign(parts_.nodes.begin(), parts_.nodes.end());
  layout.needs = {parts_.frame.turns_a ? NodeNeed::both : NodeNeed::translation,
                  parts_.frame.turns_b ? NodeNeed::both : NodeNeed::translation};
  const auto count = [this](Measure m) {
    if (m == Measure::screw) m = Measure::angle;
    if (is_turn(m) && std::find(angles_.begin(), angles_.end(), m) == angles_.end()) angles_.push_back(m);
  };
  for (const JointConstraint& c : parts_.constraints) {
    layout.multipliers.push_back(multiplier(c.measure));
    count(c.measure);
    whole_b_ = whole_b_ || looks_across_b(c.measure);
  }
  for (const JointCoordinate& c : parts_.coordinates) {
    if (c.drive.given())
      layout.multipliers.push_back({c.names.drive, dimension_of(c.measure),
                                    is_length(c.measure) ? "force of the drive" : "torque of the drive", Role::drive});
    count(c.measure);
    const bool acts = c.drive.given() || c.sprung() || c.stop.given();
    moves_ = moves_ || acts;
    has_rates_ = has_rates_ || c.sprung() || c.stop.given();
    whole_b_ = whole_b_ || (acts && looks_across_b(c.measure));
    c.stop.name_switches(layout.switches, c.names.value + ": ");
    c.law.name_switches(layout.switches, c.names.value + ": ");
  }
  for (const JointFriction& f : parts_.friction)
    if (f.radius > 0 && f.kind != Rubbing::guide && f.kind != Rubbing::ball) count(f.turn);
  if (!parts_.friction.empty()) moves_ = has_rates_ = whole_b_ = true;
  has_gaps_ = !layout.switches.empty();
  // in the plane |N| has a corner where the guide presses on its other side
  sides_ = !parts_.friction.empty() && parts_.friction[0].kind == Rubbing::guide && parts_.friction[0].length == 0 &&
           !parts_.friction[0].law.rests;
  if (sides_)
    for (const int across : {0, 1})
      layout.switches.push_back({"guide presses on one side", "guide presses on the other", true, across});
  for (const JointFriction& f : parts_.friction)
    if (!f.law.rests) {
      name_slide(layout, f.suffix.empty() ? "" : f.suffix + ": ", f.along_line());
      slide_along_line_.push_back(f.along_line() ? 1 : 0);
    }
  for (const JointFriction& f : parts_.friction)
    if (f.law.rests) {
      name_grip(layout, f);
      has_gaps_ = true;
    }
  layout.history += turn_count::history * static_cast<int>(angles_.size());
  set_layout(std::move(layout));
  name_channels();
}

int Joint::counted(Measure what) const {
  if (!is_turn(what) && what != Measure::screw) return -1;
  const auto found = std::find(angles_.begin(), angles_.end(), what == Measure::screw ? Measure::angle : what);
  return found == angles_.end() ? -1 : turn_count::history * static_cast<int>(found - angles_.begin());
}

void Joint::count_turns(const State& state, std::span<double>, std::span<double> history) const {
  const JointPose<double> pose(parts_.frame, state.nodes[0], state.nodes[1]);
  for (std::size_t i = 0; i < angles_.size(); ++i) {
    const std::size_t at = i * turn_count::history;
    turn_count::commit(measure(angles_[i], parts_.frame, pose).value, state.history.subspan(at, turn_count::history),
                       history.subspan(at, turn_count::history));
  }
  // a ball that is not at rest: the place where it stops is measured from the current orientation
  std::size_t grip = 0;
  for (const JointFriction& f : parts_.friction) {
    if (!f.law.rests) continue;
    GripState now = GripState::of(layout(), state.history, grip++);
    if (f.kind != Rubbing::ball || now.mode == GripState::holding) continue;
    Mat3 turned;
    const std::array from{pose.a1, pose.a2, pose.a3}, to{pose.b1, pose.b2, pose.b3};
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) turned(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = from[r].dot(to[c]);
    now.held = rotation_log(turned);
    now.write(layout(), history, grip - 1);
  }
}

void Joint::commit(const State& state, std::span<double> scalars, std::span<double> history) const {
  count_turns(state, scalars, history);
  const std::vector<GripShape>& shapes = layout().grips;
  bool turns = false;  // whether any direction of sliding can change
  for (std::size_t i = 0; i < shapes.size(); ++i)
    turns = turns || (shapes[i].size > 1 && GripState::of(layout(), state.history, i).mode == GripState::sliding);
  if (!turns) return;
  std::vector<Grip> grips(shapes.size());
  find_grips(*this, state, grips);
  for (std::size_t i = 0; i < grips.size(); ++i) {
    if (grips[i].shape.size == 1) continue;
    GripState next = GripState::of(layout(), history, i);
    follow(next, grips[i].speed);
    next.write(layout(), history, i);
  }
}

Joint::Observed Joint::observed(const JointCoordinate& c, const State& state) const {
  const JointPose<double> pose(parts_.frame, state.nodes[0], state.nodes[1]);
  const Measured<double> m = measured(c.measure, pose, state);
  return {m.value, rate_of(m, rates_of<double>(pose, state.nodes[0], state.nodes[1]))};
}

Joint::Load Joint::load_on_b(const State& state, const JointPose<double>& pose) const {
  std::array<double, 20> r{};
  residual(state, std::span(r).first(sweep().slots()));
  const auto at_b = [&](int slot) { return Vec3(Eigen::Map<const Vec3>(&r[static_cast<std::size_t>(slot)])); };
  const Vec3 force = -at_b(sweep().translation(1));
  if (!parts_.frame.turns_b) return {force, Vec3::Zero()};
  return {force, Vec3(-state.nodes[1].R * at_b(sweep().rotation(1)) - cross(pose.arm_b, force))};
}

Joint::Report Joint::rubbed(const State& state) const {
  Report report;
  if (parts_.friction.empty()) return report;
  Balance<double, 2> balance(state);
  act<double>(motion<double>(state), state, balance, &report);
  return report;
}

void Joint::switches(const State& state, std::span<Switch> values) const {
  if (values.empty()) return;
  const auto nodes = along_motion(state);
  const JointPose<Taylor> pose(parts_.frame, nodes[0], nodes[1]);
  for (const JointCoordinate& c : parts_.coordinates) {
    if (!c.stop.given() && !c.law.has_corners()) continue;
    const Taylor q = measured(c.measure, pose, state).value;
    values = values.subspan(c.stop.switches(q.value, q.d1, q.d2, values));
    values = values.subspan(c.law.switches(q - c.relaxed, state.time, std::abs(q.value) + std::abs(c.relaxed), values));
  }
  if (sides_) {
    const double across_2 = state.multipliers[0], across_3 = state.multipliers[1], unknown = std::nan("");
    // in space N hardly ever passes zero, and never changes its sign
    const double size = std::hypot(across_2, across_3);
    values[0] = {across_3 == 0 ? across_2 : size, unknown, 0};
    values[1] = {across_2 == 0 ? across_3 : size, unknown, 0};
    values = values.subspan(2);
  }
  values = slide_switches(*this, state, values, [this](std::size_t i) { return slide_along_line_[i] != 0; });
  grip_switches(*this, state, values);
}

void Joint::sliding(const State& state, std::span<Vec3> speeds) const {
  const Report report = rubbed(state);
  std::size_t next = 0;
  for (std::size_t i = 0; i < report.size(); ++i)
    if (!parts_.friction[i].law.rests) speeds[next++] = report[i].sliding / parts_.friction[i].law.width;
}

void Joint::grip_limits(const State& state, std::span<double> limits) const {
  const Report report = rubbed(state);
  std::size_t next = 0;
  for (std::size_t i = 0; i < report.size(); ++i)
    if (parts_.friction[i].law.rests) limits[next++] = report[i].limit;
}

Energies Joint::energies(const State& state) const {
  Energies e;
  std::size_t row = parts_.constraints.size();
  for (const JointCoordinate& c : parts_.coordinates) {
    const Observed o = observed(c, state);
    const Energies spring = c.law.energies(o.value - c.relaxed, o.rate, state.time);
    e.potential += spring.potential + c.stop.stored(o.value);
    e.dissipated += spring.dissipated + c.stop.lost(o.value, o.rate);
    if (c.drive.given()) e.external += state.multipliers[row++] * c.drive.rate(state.time);
  }
  for (const JointRub<double>& r : rubbed(state)) e.dissipated += r.power;
  return e;
}

std::vector<Coordinate> Joint::coordinates() const {
  std::vector<Coordinate> all;
  for (const JointCoordinate& c : parts_.coordinates)
    all.push_back({c.names.value, parts_.nodes, parts_.frame, c.measure, parts_.point});
  return all;
}

std::vector<Derived> Joint::derived() const {
  const auto [a, b] = parts_.nodes;
  constexpr double rounding = 1e-12;  // of places
  std::vector<Derived> found;
  const auto add = [&](int node, const Vec3& arm, const char* name) {
    if (node != 0 && arm.norm() > rounding * parts_.point.norm()) found.push_back({name, arm.norm(), dimension::length});
  };
  add(a, parts_.frame.arm_a, "distance of the joint from the first node");
  add(b, parts_.frame.arm_b, "distance of the joint from the second node");
  return found;
}

Drawing Joint::drawing() const {
  const auto [a, b] = parts_.nodes;
  if (parts_.drawn_axis)
    return {fmt::format(R"("shape": "axis", "node": {}, "center": {}, "axis": {})", a != 0 ? a : b, json(parts_.point),
                        json(parts_.frame.e1))};
  if (a != 0 && b != 0) return {fmt::format(R"("shape": "line", "points": {})", json(layout().nodes))};
  return {};
}

}  // namespace engrane::elements::joints
