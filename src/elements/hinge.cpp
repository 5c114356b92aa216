// SPDX-License-Identifier: BSD-3-Clause
#include "elements/hinge.hpp"

#include <fmt/format.h>

#include <cmath>

#include "elements/axis_angle.hpp"
#include "elements/building.hpp"
#include "elements/joint_card.hpp"
#include "model/templated_element.hpp"

namespace engrane {

namespace {

/// Five constraints and, when driven, a sixth. Joint axes e1 (the hinge's), e2, e3 turn with A, and so do the components
/// of the multipliers: forces along e1, e2, e3 and moments about e2, e3 that the joint exerts on B.
class Hinge final : public TemplatedElement<Hinge, 2, 18> {
 public:
  struct Geometry {
    std::array<int, 2> nodes;
    Vec3 axis, point, offset_a, offset_b;  ///< offsets from the nodes to the joint point, held in each node's axes
  };
  struct Torsion {
    double stiffness = 0, damping = 0, angle0 = 0;
    bool given() const { return stiffness > 0 || damping > 0; }
  };

  Hinge(int id, const Geometry& geometry, const Drive& drive, const Torsion& torsion)
      : TemplatedElement(id), geometry_(geometry), triad_(geometry.axis), drive_(drive), torsion_(torsion) {
    Layout layout;
    layout.nodes.assign(geometry.nodes.begin(), geometry.nodes.end());
    layout.needs = {NodeNeed::both, NodeNeed::both};
    layout.multipliers = {{"FORCE_1", dimension::length, "force along the axis"},
                          {"FORCE_2", dimension::length, "force along the joint's second axis"},
                          {"FORCE_3", dimension::length, "force along the joint's third axis"},
                          {"MOMENT_2", dimension::angle, "moment about the joint's second axis"},
                          {"MOMENT_3", dimension::angle, "moment about the joint's third axis"}};
    if (drive.given()) layout.multipliers.push_back({"DRIVE_TORQUE", dimension::angle, "torque of the drive"});
    layout.history = turn_count::history;
    set_layout(std::move(layout));
    name_channels();
  }

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const {
    const auto& a = motion.node[0];
    const auto& b = motion.node[1];
    const Vec3T<T> e1 = rotate(a.R, triad_.e1), e2 = rotate(a.R, triad_.e2), e3 = rotate(a.R, triad_.e3);
    const Vec3T<T> arm_a = rotate(a.R, geometry_.offset_a), arm_b = rotate(b.R, geometry_.offset_b);
    const Vec3T<T> gap = b.x + arm_b - a.x - arm_a;
    const Vec3T<T> force = e1 * balance.constraint(0, dot(e1, gap)) + e2 * balance.constraint(1, dot(e2, gap)) +
                           e3 * balance.constraint(2, dot(e3, gap));

    // B's axis has no component across A's; these two and their gradients depend on no angle about the axis
    const Vec3T<T> axis_b = rotate(b.R, triad_.e1);
    const T about_2 = balance.constraint(3, -dot(e3, axis_b)), about_3 = balance.constraint(4, dot(e2, axis_b));
    Vec3T<T> moment = cross(axis_b, e2) * about_3 - cross(axis_b, e3) * about_2;

    if (drive_.given() || torsion_.given()) {
      const AxisAngle<T> turn = axis_angle(triad_, a.R, b.R);
      const T angle = turn_count::total(turn.angle, state.history);
      T torque(0);
      if (drive_.given()) torque += balance.constraint(5, angle - drive_.coordinate(motion.time));
      if (torsion_.given()) {
        const Vec3T<T> spin = rotate(b.R, b.W) - rotate(a.R, a.W);
        torque -= torsion_.stiffness * (angle - torsion_.angle0) + torsion_.damping * dot(turn.gradient, spin);
      }
      moment += turn.gradient * torque;
    }

    balance.force(0, force);
    balance.force(1, Vec3T<T>(-force));
    // A's lever reaches to B's point: the gap closes only at convergence, and the sum of moments must be zero before
    const Vec3T<T> on_a = cross(Vec3T<T>(gap + arm_a), force) + moment, on_b = cross(arm_b, force) + moment;
    balance.moment(0, rotate_back(a.R, on_a));
    balance.moment(1, rotate_back(b.R, Vec3T<T>(-on_b)));
  }

  void commit(const State& state, std::span<double>, std::span<double> history) const override {
    turn_count::commit(turn(state).angle, state.history, history);
  }

  Energies energies(const State& state) const override {
    Energies e;
    const double stretch = angle(state) - torsion_.angle0, rate = speed(state);
    e.potential = 0.5 * torsion_.stiffness * stretch * stretch;
    e.dissipated = torsion_.damping * rate * rate;
    if (drive_.given()) e.external = state.multipliers[5] * drive_.rate(state.time);
    return e;
  }

  const std::vector<Named>& channels() const override { return channels_; }

  void observe(const State& state, std::span<double> values) const override {
    std::array<double, 18> r{};
    residual(state, std::span(r).first(static_cast<std::size_t>(layout().slots())));
    const NodeState& b = state.nodes[1];
    const Vec3 force = -Vec3(r[6], r[7], r[8]);
    const Vec3 moment = -b.R * Vec3(r[9], r[10], r[11]) - cross(Vec3(b.R * geometry_.offset_b), force);
    const Vec3 axis = state.nodes[0].R * triad_.e1;
    std::size_t i = 0;
    values[i++] = angle(state);
    values[i++] = speed(state);
    for (Eigen::Index c = 0; c < 3; ++c) values[i++] = force[c];
    for (Eigen::Index c = 0; c < 3; ++c) values[i++] = moment[c];
    values[i++] = force.dot(axis);
    values[i++] = (force - axis * force.dot(axis)).norm();
    values[i++] = (moment - axis * moment.dot(axis)).norm();
    if (torsion_.given()) values[i++] = -torsion_.stiffness * (angle(state) - torsion_.angle0) - torsion_.damping * speed(state);
    if (drive_.given()) {
      values[i++] = state.multipliers[5];
      values[i++] = state.multipliers[5] * drive_.rate(state.time);
    }
  }

  Drawing drawing() const override {
    const int node = geometry_.nodes[0] != 0 ? geometry_.nodes[0] : geometry_.nodes[1];
    return {
        fmt::format(R"("shape": "axis", "node": {}, "center": {}, "axis": {})", node, json(geometry_.point), json(triad_.e1))};
  }

 private:
  AxisAngle<double> turn(const State& state) const { return axis_angle(triad_, state.nodes[0].R, state.nodes[1].R); }
  double angle(const State& state) const { return turn_count::total(turn(state).angle, state.history); }
  double speed(const State& state) const {
    const NodeState &a = state.nodes[0], &b = state.nodes[1];
    return turn(state).gradient.dot(b.R * b.W - a.R * a.W);
  }

  void name_channels() {
    channels_ = {{"ANGLE", dimension::angle, "turn of B from A about the axis, whole turns counted"},
                 {"SPEED", dimension::angular_velocity, "rate of the angle"},
                 {"FORCE_X", dimension::force, "force of the joint on B, global"},
                 {"FORCE_Y", dimension::force, "force of the joint on B, global"},
                 {"FORCE_Z", dimension::force, "force of the joint on B, global"},
                 {"MOMENT_X", dimension::moment, "moment of the joint on B at the joint point, global"},
                 {"MOMENT_Y", dimension::moment, "moment of the joint on B at the joint point, global"},
                 {"MOMENT_Z", dimension::moment, "moment of the joint on B at the joint point, global"},
                 {"AXIAL_FORCE", dimension::force, "force on B along the axis"},
                 {"RADIAL_FORCE", dimension::force, "size of the force on B across the axis"},
                 {"BENDING_MOMENT", dimension::moment, "size of the moment on B across the axis"}};
    if (torsion_.given()) channels_.push_back({"SPRING_TORQUE", dimension::moment, "torque of spring and damper on B"});
    if (drive_.given()) {
      channels_.push_back({"DRIVE_TORQUE", dimension::moment, "torque of the drive on B, the opposite on A"});
      channels_.push_back({"DRIVE_POWER", dimension::power, "power that the drive gives to the mechanism"});
    }
  }

  Geometry geometry_;
  AxisTriad triad_;
  Drive drive_;
  Torsion torsion_;
  std::vector<Named> channels_;
};

std::unique_ptr<Element> build(const HingeData& data, BuildContext& context) {
  const auto axis = unit_vector(context, "AXIS", data.axis);
  Drive drive;
  const bool driven = find_drive(context, {"DRIVE", "NF", "ANGLE", ", in radians"}, data.drive, data.function, drive);
  if (!check_nodes(context, {data.nodes[0], data.nodes[1]})) return nullptr;
  const auto point = joint_point(context, data.nodes, data.at, "hinge", PointRule::one_place);
  if (!axis || !driven || !point) return nullptr;
  const Hinge::Geometry geometry{data.nodes, *axis, *point, *point - context.nodes.at(data.nodes[0]),
                                 *point - context.nodes.at(data.nodes[1])};
  return std::make_unique<Hinge>(context.record.id, geometry, drive,
                                 Hinge::Torsion{data.stiffness, data.damping, data.angle0 * degree});
}

}  // namespace

ElementType hinge_type() {
  deck::Card<HingeData> card("HINGE", {"CHARNIERE"}, "Revolute joint: node b turns about an axis held by node a");
  card.numbered()
      .chapter("Rigid kinematic joints")
      .describe(
          "The joint point is held by both nodes, each in its own axes, so the nodes may be anywhere: AT gives the point "
          "in the reference configuration. Without it the nodes must be in one place, or one of them is the ground "
          "(0) and the point is where the other is. The angle is counted in turns.")
      .example("I 3 HINGE N 3 2  AXIS 0 0 1")
      .example("I 4 HINGE N 0 4  AXIS 0 1 0  DRIVE SPEED NF 1");
  card.add("N", &HingeData::nodes, "the two nodes, a and b; 0 is the ground")
      .synonyms({"NODES", "NOEUDS"})
      .refers(deck::Reference::node)
      .required();
  card.add("AXIS", &HingeData::axis, "direction of the axis, in the reference configuration").synonyms({"AXE"}).required();
  card.add("AT", &HingeData::at, "joint point, in the reference configuration").unit(dimension::length);
  card.add("DRIVE", &HingeData::drive, "imposes the motion by the function NF")
      .synonyms({"MOTEUR"})
      .option({"ANGLE", {}, "the function is the angle, radians"})
      .option({"SPEED", {"VITESSE"}, "the function is the speed, radians per time"});
  card.add("NF", &HingeData::function, "function of time of the drive").refers(deck::Reference::function).at_least(0);
  card.add("K", &HingeData::stiffness, "torsion spring, moment per radian").unit(dimension::torsional_stiffness).at_least(0);
  card.add("C", &HingeData::damping, "torsion damper, moment per radian and time").unit(dimension::torsional_damping).at_least(0);
  card.add("ANGLE0", &HingeData::angle0, "angle at which the spring is relaxed").unit(dimension::angle);
  return element_type(card, build);
}

}  // namespace engrane
