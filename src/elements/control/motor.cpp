// SPDX-License-Identifier: BSD-3-Clause
#include "elements/control/motor.hpp"

#include <fmt/format.h>

#include "elements/common/along_motion.hpp"
#include "elements/common/building.hpp"
#include "elements/common/law_corners.hpp"
#include "elements/control/joint_coordinate.hpp"

namespace engrane::elements::control {

namespace {

/// Torque of a motor's shaft as a function of speed: a function, or the straight line from the stall torque to the no-load
/// speed.
struct MotorCurve {
  const Function* function = nullptr;
  double stall = 0, free = 1;

  template <class T>
  T torque(const T& speed) const {
    return function ? evaluate(*function, speed) : T(stall) - speed * (stall / free);
  }
};

/// Effort r s(t) T(r q̇) along a coordinate q, with the torque curve T of the shaft, its ratio r and a function s of time.
class Motor final : public TemplatedElement<Motor, 2, 12> {
 public:
  Motor(int id, const Coordinate& coordinate, const MotorCurve& curve, double ratio, const Function* supply)
      : Motor(id, coordinate, curve, ratio, supply, Layout{}) {}

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const {
    const auto reading = coordinate_.read<T>(motion.node, state);
    const T supplied = supply_ ? engrane::evaluate(*supply_, motion.time) : T(1);
    const T effort = curve_.torque(T(reading.rate * ratio_)) * supplied * ratio_;
    coordinate_.act(reading, effort, motion.node, balance);
  }

  void count_turns(const State& state, std::span<double>, std::span<double> history) const override {
    coordinate_.commit(state, history);
  }

  /// The shaft's speed passes a corner of the curve.
  void switches(const State& state, std::span<Switch> values) const override {
    if (values.empty()) return;
    const Taylor turned = coordinate_.read<Taylor>(along_motion(state), state).measured.value * ratio_;
    corners_.switches({turned.d1, turned.d2, 0}, state.time, std::abs(turned.d1), values);
  }
  bool has_gaps() const override { return false; }

  Energies energies(const State& state) const override {
    const Output now = output(state);
    Energies e;
    e.external = now.torque * now.speed;
    return e;
  }

  const std::vector<Channel>& channels() const override { return channels_; }

  void observe(const State& state, std::span<double> values) const override {
    const Output now = output(state);
    values[0] = now.speed;
    values[1] = now.torque;
    values[2] = now.torque * ratio_;
    values[3] = now.torque * now.speed;
  }

 private:
  // the coordinate appends its nodes to the layout before it is passed to the base
  Motor(int id, const Coordinate& coordinate, const MotorCurve& curve, double ratio, const Function* supply, Layout layout)
      : TemplatedElement(id), coordinate_(coordinate, layout), curve_(curve), ratio_(ratio), supply_(supply) {
    if (curve.function) corners_ = LawCorners(*curve.function);
    corners_.name(layout.switches, "CURVE");
    set_layout(std::move(layout));
    const char* torque = coordinate.is_angle() ? "TORQUE" : "FORCE";
    channels_ = {{"SPEED", coordinate.rate_dimension(), "of the motor's shaft"},
                 {torque, coordinate.effort_dimension(), "of the motor's shaft"},
                 {"EFFORT", coordinate.effort_dimension(), "along the joint's coordinate: RATIO times that of the shaft"},
                 {"POWER", dimension::power, "power given to the mechanism"}};
  }

  struct Output {
    double speed, torque;  ///< of the shaft
  };
  Output output(const State& state) const {
    const double speed = ratio_ * coordinate_.read<double>(state.nodes, state).rate;
    return {speed, curve_.torque(speed) * (supply_ ? supply_->at(state.time).f : 1.0)};
  }

  PlacedCoordinate coordinate_;
  MotorCurve curve_;
  LawCorners corners_;  ///< of the curve
  double ratio_;
  const Function* supply_;
  std::vector<Channel> channels_;
};

/// The torque curve of the card; returns nothing, with an error, if it is invalid.
std::optional<MotorCurve> find_curve(const MotorData& data, const BuildContext& context) {
  MotorCurve curve;
  if (data.curve != 0) {
    if (data.stall || data.free) {
      context.error(data.stall ? "STALL" : "FREE", "CURVE and STALL with FREE both give the torque", "give one of them");
      return {};
    }
    curve.function = context.function(data.curve, "CURVE");
    if (!curve.function) return {};
    return curve;
  }
  if (!data.stall || !data.free) {
    context.error(data.stall  ? "STALL"
                  : data.free ? "FREE"
                              : "JOINT",
                  "a motor needs its torque as a function of its speed",
                  "CURVE f, a function of .FCT, or STALL t FREE w, the ends of a straight line");
    return {};
  }
  curve.stall = *data.stall;
  curve.free = *data.free;
  return curve;
}

std::unique_ptr<Element> build(const MotorData& data, BuildContext& context) {
  const auto coordinate = find_coordinate(context, "JOINT", data.joint, "COORDINATE", data.coordinate);
  const auto curve = find_curve(data, context);
  const Function* supply = nullptr;
  const bool found = find_function(context, data.function, supply);
  if (data.ratio == 0) {
    context.error("RATIO", "RATIO 0 takes the motor off its joint",
                  "the shaft's turns for one of the joint; negative: it turns the other way");
    return nullptr;
  }
  if (!coordinate || !curve || !found) return nullptr;
  return std::make_unique<Motor>(context.record.id, *coordinate, *curve, data.ratio, supply);
}

}  // namespace

ElementType motor_type() {
  deck::Card<MotorData> card("MOTOR", {"MOTEUR"}, "Motor on a joint, with its torque as a function of its speed");
  card.numbered()
      .chapter("Control and computation elements")
      .describe(
          "Acts along a coordinate of a joint: with a torque on an angle, with a force on a slide. CURVE is a function of the "
          "shaft's speed in radians, or lengths, per unit of time. The slope of the curve acts as a damper. A motor whose motion "
          "is known is DRIVE in the joint; one with feedback is a CONTROLLER. The rotor's inertia is an INERTIA of the node that "
          "it turns.")
      .example("I 9 MOTOR JOINT 3  STALL 8.  FREE 300.")
      .example("I 9 MOTOR JOINT 3  CURVE 1  RATIO 20  NF 2");
  card.add("JOINT", &MotorData::joint, "number of the joint (or sensor) that it turns or pushes")
      .synonyms({"LIAISON"})
      .refers(deck::Reference::element)
      .required();
  card.add("COORDINATE", &MotorData::coordinate, "which of the joint's coordinates, as its channel is named; default: the first")
      .synonyms({"COORDONNEE"});
  card.add("CURVE", &MotorData::curve, "function f: torque (or force) of the shaft at its speed")
      .synonyms({"COURBE"})
      .refers(deck::Reference::function)
      .at_least(0);
  card.add("STALL", &MotorData::stall, "torque (or force) of the shaft at rest").synonyms({"BLOCAGE"});
  card.add("FREE", &MotorData::free, "speed of the shaft without load").synonyms({"VIDE", "NO_LOAD"}).positive();
  card.add("RATIO", &MotorData::ratio, "turns of the shaft for one of the joint; negative: it turns the other way")
      .synonyms({"RAPPORT"});
  card.add("NF", &MotorData::function, "function of time that multiplies the torque: switches it on and off")
      .refers(deck::Reference::function)
      .at_least(0);
  return element_type(card, build, 1);
}

}  // namespace engrane::elements::control
