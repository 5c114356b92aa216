// SPDX-License-Identifier: BSD-3-Clause
#include "elements/control/belt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "elements/common/building.hpp"
#include "elements/joints/joint_measures.hpp"
#include "model/determined_channels.hpp"
#include "model/grip.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements::control {

namespace {

/// Constant dimensions.
struct BeltShape {
  double r1 = 0, r2 = 0;
  double side = 1;                                 ///< 1 open, −1 crossed: sense of rotation of the second pulley
  double reach() const { return r1 - side * r2; }  ///< the free spans are at asin(reach/distance) to the line of centres

  /// Length of belt taken up by one span and half its wraps, up to a constant: L + reach β with L = sqrt(d² − reach²), sin β =
  /// reach/d. Its derivative with respect to d is cos β.
  template <class T>
  T taken(const T& d) const {
    using std::atan2;
    using std::sqrt;
    const T free = sqrt(d * d - reach() * reach());
    return free + reach() * atan2(T(reach()), free);
  }
};

struct BeltLaw {
  double stiffness = 0;  ///< 0: rigid
  double preload = 0;
  double damping = 0;
  std::optional<double> friction;
  bool slips = false;  ///< slips when friction is exceeded
  bool rigid() const { return stiffness == 0; }
};

/// The spans run along the two tangents t₁,₂ = cos β u ∓ sin β n of the pulleys, with u along the line of centres and n = e × u
/// across it. With the pulleys' angles θ measured from the line of centres, the span elongations are
///
///     δ₁,₂ = taken(d) − taken(d₀) ± (r₁ θ_A − s r₂ θ_B)
///
/// Their gradients are the tangents, so that each span pulls with its tension along its own line.
class Belt final : public TemplatedElement<Belt, 2, 13>, public DeterminedChannels {
 public:
  Belt(int id, const std::array<int, 2>& nodes, const joints::JointFrame& frame, const BeltShape& shape, const BeltLaw& law,
       double distance)
      : TemplatedElement(id), frame_(frame), shape_(shape), law_(law), distance_(distance), taken_(shape.taken(distance)) {
    Layout layout;
    layout.nodes.assign(nodes.begin(), nodes.end());
    layout.needs = {NodeNeed::both, NodeNeed::both};
    layout.history = remembered + 2 * Worst::history;
    const Named pull{"PULL", dimension::length, "tension of the second span less that of the first"};
    if (law.slips)
      add_grip(layout, pull);
    else if (law.rigid())
      layout.multipliers = {{pull}};
    else
      layout.switches = {{"first span of the belt tightens", "first span of the belt goes slack"},
                         {"second span of the belt tightens", "second span of the belt goes slack"}};
    set_layout(std::move(layout));
    name_channels();
  }

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const {
    const auto& a = motion.node[0];
    const auto& b = motion.node[1];
    const Runs<T> runs(*this, a, b, state);
    const auto [first, second] = tensions(runs, balance.contact_homotopy(), [&] {
      const GripState grip = grip_of(state);
      const T held = balance.constraint(0, runs.roll - grip.held[0]);
      return grip.mode == GripState::holding ? held : slipping(runs, grip.sense());
    });
    const Vec3T<T> force = runs.tangent[0] * T(-first) - runs.tangent[1] * second;
    const Vec3T<T> moment = runs.turned * (shape_.side * shape_.r2 * (first - second));
    balance.force(0, force);
    balance.force(1, Vec3T<T>(-force));
    balance.moment(0, rotate_back(a.R, Vec3T<T>(cross(runs.pose.gap, force) + moment)));
    balance.moment(1, rotate_back(b.R, Vec3T<T>(-moment)));
  }

  void count_turns(const State& state, std::span<double>, std::span<double> history) const override {
    const Runs<double> runs(*this, state.nodes[0], state.nodes[1], state);
    turn_count::commit(runs.line_angle, state.history.first(2), history.first(2));
    turn_count::commit(runs.turn_angle, state.history.subspan(2), history.subspan(2));
  }

  /// Also stores where friction and tension were exceeded, for remarks().
  void commit(const State& state, std::span<double> scalars, std::span<double> history) const override {
    count_turns(state, scalars, history);
    const Runs<double> runs(*this, state.nodes[0], state.nodes[1], state);
    const auto [first, second] = tensions(runs, 0, [&] { return pull(runs, state); });
    const double tight = std::max(first, second), slack = std::min(first, second);
    const bool loaded = tight > rounding * law_.stiffness * runs.distance;
    const double grip = law_.friction && loaded ? grip_used(first, second, runs.distance) : 0;
    Worst::at(state.history, 0).with(grip > 1 + beyond ? grip : 0, state.time).write(history, 0);
    // without preload or friction the tensions of a rigid belt are not asked for
    const bool pushes = (law_.preload > 0 || law_.friction) && slack < -beyond * tight;
    Worst::at(state.history, 1).with(pushes ? -slack : 0, state.time).write(history, 1);
  }
  std::vector<std::string> remarks(std::span<const double> history) const override {
    std::vector<std::string> list;
    const Worst grip = Worst::at(history, 0), push = Worst::at(history, 1);
    if (grip.most > 0)
      list.push_back(fmt::format(
          "GRIP_USED passed 1 at t = {:.6g} and was {:.4g} at most, at t = {:.6g}: MU does not hold such a pull, and {}. Results "
          "since then are those of a belt that grips, as with teeth; give more PRELOAD or MU{}",
          grip.since, grip.most, grip.when,
          law_.slips     ? "STICK holds in STATIC and KINEMATIC"
          : law_.rigid() ? "without STICK the belt does not slip"
                         : "an elastic belt does not slip here",
          law_.slips || !law_.rigid() ? "" : ", or STICK"));
    if (push.most > 0)
      list.push_back(fmt::format(
          "SLACK_SIDE fell below 0 at t = {:.6g} and was {:.4g} at least, at t = {:.6g}: a rigid belt keeps its ratio by pushing "
          "there, which no belt can; give more PRELOAD, or K or EA, with which a slack span carries nothing",
          push.since, -push.most, push.when));
    return list;
  }

  void start(std::span<double>, std::span<double> history) const override {
    std::fill(history.begin(), history.end(), 0.0);
    if (law_.slips) GripState::holds_at(Vec3::Zero()).write(layout(), history, 0);
  }
  /// The tight side is the larger of the tensions, BEARING_FORCE the size of FORCE.
  std::vector<Determined> determined() const override { return {{2, {0, 1}}, {3, {0, 1}}, {11, {8, 9, 10}}}; }
  double determine(int channel, double, std::span<const double> sources) const override {
    if (channel == 11) return std::hypot(sources[0], sources[1], sources[2]);
    return channel == 2 ? std::max(sources[0], sources[1]) : std::min(sources[0], sources[1]);
  }
  void grip_limits(const State& state, std::span<double> limits) const override {
    if (!law_.slips) return;
    limits[0] = most_pull(Runs<double>(*this, state.nodes[0], state.nodes[1], state));
  }
  void switches(const State& state, std::span<Switch> values) const override {
    if (law_.rigid()) {
      grip_switches(*this, state, values);
      return;
    }
    const Runs<double> runs(*this, state.nodes[0], state.nodes[1], state);
    for (int i = 0; i < 2; ++i)
      values[static_cast<std::size_t>(i)] = {law_.preload + law_.stiffness * runs.stretch(i),
                                             law_.stiffness * runs.stretch_rate(i),
                                             law_.preload + law_.stiffness * (std::abs(runs.roll) + runs.distance)};
  }

  Energies energies(const State& state) const override {
    const Runs<double> runs(*this, state.nodes[0], state.nodes[1], state);
    Energies e;
    if (law_.rigid()) {
      e.potential = 2 * law_.preload * runs.slack_taken;
      e.dissipated = -slipping(runs, grip_of(state).sense()) * runs.roll_rate;
      return e;
    }
    for (int i = 0; i < 2; ++i) {
      const double elastic = taut(runs.stretch(i), 0);
      e.potential += 0.5 * elastic * elastic / law_.stiffness;
      e.dissipated += (tension(runs.stretch(i), runs.stretch_rate(i), 0) - elastic) * runs.stretch_rate(i);
    }
    return e;
  }

  const std::vector<Channel>& channels() const override { return channels_; }

  void observe(const State& state, std::span<double> values) const override {
    const Runs<double> runs(*this, state.nodes[0], state.nodes[1], state);
    const auto [first, second] = tensions(runs, 0, [&] { return pull(runs, state); });
    const Vec3 force = -first * runs.tangent[0] - second * runs.tangent[1];
    const double beta = std::asin(shape_.reach() / runs.distance);
    const double wrap_1 = std::numbers::pi + 2 * beta, wrap_2 = std::numbers::pi - 2 * shape_.side * beta;
    std::size_t i = 0;
    const auto write = [&](double value) { values[i++] = value; };
    write(first);
    write(second);
    write(std::max(first, second));
    write(std::min(first, second));
    write(-shape_.r1 * (first - second));
    write(shape_.side * shape_.r2 * (first - second));
    write(runs.speed_1);
    write(runs.speed_2);
    for (Eigen::Index c = 0; c < 3; ++c) write(force[c]);
    write(force.norm());
    write(runs.distance * std::cos(beta));
    write(wrap_1);
    write(wrap_2);
    if (!law_.rigid()) {
      write(runs.stretch(0));
      write(runs.stretch(1));
    }
    if (law_.friction) write(grip_used(first, second, runs.distance));
  }

  std::vector<Derived> derived() const override {
    const double beta = std::asin(shape_.reach() / distance_), free = distance_ * std::cos(beta);
    std::vector<Derived> all = {
        {"ratio of speeds", shape_.side * shape_.r1 / shape_.r2, dimension::none},
        {"centre distance", distance_, dimension::length},
        {"free span", free, dimension::length},
        {"belt length",
         2 * free + shape_.r1 * (std::numbers::pi + 2 * beta) + shape_.r2 * (std::numbers::pi - 2 * shape_.side * beta),
         dimension::length}};
    if (!law_.rigid()) all.push_back({"stiffness of a span", law_.stiffness, dimension::stiffness});
    return all;
  }

  Drawing drawing() const override { return {fmt::format(R"("shape": "line", "points": {})", json(layout().nodes))}; }

 private:
  /// Directions of the spans and their elongations.
  template <class T>
  struct Runs {
    joints::JointPose<T> pose;
    T distance, slack_taken, roll, taken_rate, roll_rate;
    double line_angle, turn_angle;  ///< in (−π, π]
    T speed_1, speed_2;             ///< of the pulleys, relative to the line of centres
    std::array<Vec3T<T>, 2> tangent;
    Vec3T<T> turned;  ///< gradient of B's angle relative to A

    template <class Node>
    Runs(const Belt& belt, const Node& a, const Node& b, const State& state) : pose(belt.frame_, a, b) {
      using std::atan2;
      using std::sqrt;
      const BeltShape& shape = belt.shape_;
      const Vec3T<T> in_plane = pose.gap - pose.a1 * dot(pose.a1, pose.gap);
      distance = sqrt(dot(in_plane, in_plane));
      const Vec3T<T> u = in_plane * (T(1) / distance), n = cross(pose.a1, u);
      const T sine = shape.reach() / distance, cosine = sqrt(T(1) - sine * sine);
      tangent = {Vec3T<T>(u * cosine - n * sine), Vec3T<T>(u * cosine + n * sine)};
      const T line = atan2(dot(u, pose.a3), dot(u, pose.a2));
      const AxisAngle<T> turn = axis_angle(std::array{pose.a1, pose.a2, pose.a3}, std::array{pose.b1, pose.b2, pose.b3});
      turned = turn.gradient;
      line_angle = value_of(line);
      turn_angle = value_of(turn.angle);
      const double lines = turn_count::turns(line_angle, state.history.first(2)),
                   turns = turn_count::turns(turn_angle, state.history.subspan(2));
      // r₁ θ_A − s r₂ θ_B: relative to A the line of centres turns by −θ_A, and B by θ_B − θ_A
      roll = -shape.reach() * line - shape.side * shape.r2 * turn.angle +
             2 * std::numbers::pi * (-shape.reach() * lines - shape.side * shape.r2 * turns);
      slack_taken = shape.taken(distance) - belt.taken_;

      const Vec3T<T> spin_a = rotate(a.R, a.W), spin_b = rotate(b.R, b.W);
      const Vec3T<T> slip = b.v - a.v - cross(spin_a, pose.gap);
      speed_1 = T(-1) * dot(n, slip) / distance;
      speed_2 = speed_1 + dot(turned, Vec3T<T>(spin_b - spin_a));
      roll_rate = shape.r1 * speed_1 - shape.side * shape.r2 * speed_2;
      taken_rate = cosine * dot(u, slip);
    }
    T stretch(int i) const { return i == 0 ? T(slack_taken + roll) : T(slack_taken - roll); }
    T stretch_rate(int i) const { return i == 0 ? T(taken_rate + roll_rate) : T(taken_rate - roll_rate); }
  };

  /// The largest excess of a limit over all steps, and its times, kept in the history behind the turns.
  struct Worst {
    double most = 0, since = 0, when = 0;  ///< 0: never exceeded; first time; time of the largest
    static constexpr int history = 3;

    static std::size_t place(int which) { return static_cast<std::size_t>(remembered + which * history); }
    static Worst at(std::span<const double> all, int which) {
      const auto own = all.subspan(place(which));
      return {own[0], own[1], own[2]};
    }
    /// Values that are larger by rounding only keep the first time.
    Worst with(double excess, double time) const {
      return excess > (1 + 1e-9) * most ? Worst{excess, most > 0 ? since : time, time} : *this;
    }
    void write(std::span<double> all, int which) const {
      const auto own = all.subspan(place(which));
      own[0] = most, own[1] = since, own[2] = when;
    }
  };
  static constexpr int remembered = 2 * turn_count::history;  ///< history entries before those of Worst
  /// A limit counts as exceeded by more than this fraction: iterations and located events leave less.
  static constexpr double beyond = 1e-3;
  /// Of lengths: tensions from shorter stretches are rounding.
  static constexpr double rounding = 1e-12;

  /// Euler–Eytelwein: the tight side carries at most exp(mu wrap) times the slack side.
  double grip_used(double first, double second, double distance) const {
    const double beta = std::asin(shape_.reach() / distance), lesser = std::min(2 * beta, -2 * shape_.side * beta);
    const double tight = std::max(first, second), most = -std::expm1(-*law_.friction * (std::numbers::pi + lesser));
    return tight > 0 ? (tight - std::max(0.0, std::min(first, second))) / (tight * most) : 0;
  }

  GripState grip_of(const State& state) const {
    return law_.slips ? GripState::of(layout(), state.history, 0) : GripState::holds_at(Vec3::Zero());
  }
  /// Largest difference of the tensions with the preload as their mean. Euler–Eytelwein: tight/slack ≤ exp(μ wrap).
  template <class T>
  T most_pull(const Runs<T>& runs) const {
    using std::atan2, std::sqrt;
    const T &d = runs.distance, beta = atan2(T(shape_.reach()), T(sqrt(d * d - shape_.reach() * shape_.reach())));
    const double lesser = -shape_.side * value_of(beta) < value_of(beta) ? -shape_.side : 1;  // for the smaller wrap
    const T turned = *law_.friction * (std::numbers::pi + 2 * lesser * beta);
    const double left = std::exp(-value_of(turned));
    const T part = compose(turned, 1 - left, left, -left);  // as a fraction of the tight side
    return law_.preload * part / (1 - 0.5 * part);
  }
  /// Tension difference of a slipping belt.
  template <class T>
  T slipping(const Runs<T>& runs, int direction) const {
    if (direction == 0) return T(0);
    return -direction * most_pull(runs);
  }
  double pull(const Runs<double>& runs, const State& state) const {
    const GripState grip = grip_of(state);
    return grip.mode == GripState::holding ? state.multipliers[0] - state.penalty * (runs.roll - grip.held[0])
                                           : slipping(runs, grip.sense());
  }

  /// Elastic tension; a slack span carries no compression, or the fraction `contact_homotopy` of it while statics searches for
  /// the taut spans (State::contact_homotopy).
  template <class T>
  T taut(const T& stretch, double contact_homotopy) const {
    const T tension = law_.preload + law_.stiffness * stretch;
    return value_of(tension) > 0 ? tension : T(contact_homotopy * tension);
  }
  /// The damping is proportional to the tension, C at the preload, so that it vanishes in a slack span.
  template <class T>
  T tension(const T& stretch, const T& rate, double contact_homotopy) const {
    const T elastic = taut(stretch, contact_homotopy);
    if (law_.damping == 0) return elastic;
    const T factor = T(1) + law_.damping / law_.preload * rate;
    return value_of(factor) > 0 ? T(elastic * factor) : T(0);
  }
  /// Tensions of the two spans. `contact_homotopy`: see taut(). `pull` returns the force along the gradient of `roll` if the belt
  /// is rigid.
  template <class T, class Pull>
  std::array<T, 2> tensions(const Runs<T>& runs, double contact_homotopy, Pull pull) const {
    if (!law_.rigid())
      return {tension(runs.stretch(0), runs.stretch_rate(0), contact_homotopy),
              tension(runs.stretch(1), runs.stretch_rate(1), contact_homotopy)};
    const T half = T(pull()) * 0.5;
    return {T(law_.preload - half), T(law_.preload + half)};
  }

  void name_channels() {
    channels_ = {{"TENSION_1", dimension::force, "of the span on the side of AXIS x (line from A to B)"},
                 {"TENSION_2", dimension::force, "of the other span"},
                 {"TIGHT_SIDE", dimension::force, "the larger tension"},
                 {"SLACK_SIDE", dimension::force, "the smaller tension; negative: a rigid belt would be slack"},
                 {"TORQUE_1", dimension::moment, "of the belt on A about AXIS"},
                 {"TORQUE_2", dimension::moment, "of the belt on B about AXIS"},
                 {"SPEED_1", dimension::angular_velocity, "of A, seen from the line of centres"},
                 {"SPEED_2", dimension::angular_velocity, "of B, seen from the line of centres"},
                 {"FORCE_X", dimension::force, "force of the belt on B, global"},
                 {"FORCE_Y", dimension::force, "force of the belt on B, global"},
                 {"FORCE_Z", dimension::force, "force of the belt on B, global"},
                 {"BEARING_FORCE", dimension::force, "size of the force of the belt on either pulley", Channel::Course::size},
                 {"SPAN", dimension::length, "length of a free span"},
                 {"WRAP_1", dimension::angle, "angle that the belt wraps round A"},
                 {"WRAP_2", dimension::angle, "angle that the belt wraps round B"}};
    if (!law_.rigid()) {
      channels_.push_back({"STRETCH_1", dimension::length, "stretch of the first span beyond its preload"});
      channels_.push_back({"STRETCH_2", dimension::length, "stretch of the second span beyond its preload"});
    }
    if (law_.friction)
      channels_.push_back({"GRIP_USED", dimension::none, "difference of the tensions over the most that friction holds; 1 slips",
                           Channel::Course::ratio});
  }

  joints::JointFrame frame_;
  BeltShape shape_;
  BeltLaw law_;
  double distance_, taken_;  ///< in the reference configuration
  std::vector<Channel> channels_;
};

std::unique_ptr<Element> build(const BeltData& data, BuildContext& context) {
  const auto axis = unit_vector(context, "AXIS", data.axis);
  if (!check_nodes(context, {data.nodes[0], data.nodes[1]}) || !axis) return nullptr;
  const Vec3 gap = context.nodes.at(data.nodes[1]) - context.nodes.at(data.nodes[0]);
  const Vec3 across = gap - *axis * axis->dot(gap);
  const BeltShape shape{data.radii[0], data.radii[1], data.crossed ? -1.0 : 1.0};
  const double distance = across.norm(), least = data.crossed ? shape.r1 + shape.r2 : std::abs(shape.r1 - shape.r2);
  if (std::abs(axis->dot(gap)) > 1e-6 * gap.norm()) {
    context.error("N", fmt::format("the pulleys are {:.6g} apart along their axis", std::abs(axis->dot(gap))),
                  "the nodes must lie in the plane of the belt; join others to them by RIGID");
    return nullptr;
  }
  if (distance <= least || distance <= std::max(shape.r1, shape.r2)) {
    context.error(
        "R",
        fmt::format("the pulleys are {:.6g} apart: no belt runs {} them", distance, data.crossed ? "crossed between" : "between"),
        fmt::format("a distance of more than {:.6g} is needed", std::max({least, shape.r1, shape.r2})));
    return nullptr;
  }
  // R is measured to the middle of the belt: pulleys may overlap by its thickness, so that this is no error
  if (!data.crossed && distance < shape.r1 + shape.r2)
    context.diagnostics.warning(
        context.record.where("R"),
        fmt::format("the pulleys overlap: their radii sum to {:.6g}, and they are {:.6g} apart", shape.r1 + shape.r2, distance),
        "R takes radii, not diameters, and the nodes are the centres; the belt is followed all the same");
  if (data.stiffness && data.rigidity) {
    context.error("EA", "K and EA both give the stiffness of the spans", "keep one of them");
    return nullptr;
  }
  const double free = std::sqrt(distance * distance - shape.reach() * shape.reach());
  BeltLaw law{data.stiffness.value_or(data.rigidity.value_or(0) / free), data.preload, data.damping, data.friction, data.sticks};
  if (law.damping > 0 && law.rigid()) {
    context.error("C", "a rigid belt has no damping", "give the stiffness of the spans, K or EA");
    return nullptr;
  }
  if (law.damping > 0 && law.preload == 0) {
    context.error("C", "damping without a preload", "C holds at the tension PRELOAD, and follows the tension of each span");
    return nullptr;
  }
  if (data.sticks && !(data.friction && data.preload > 0 && law.rigid())) {
    context.error("STICK", "slip needs a rigid belt with friction and preload", "give MU and PRELOAD, and remove K or EA");
    return nullptr;
  }
  joints::JointFrame frame;
  frame.set_axes(*axis, across / distance);
  return std::make_unique<Belt>(context.record.id, data.nodes, frame, shape, law, distance);
}

}  // namespace

ElementType belt_type() {
  deck::Card<BeltData> card("BELT", {"COURROIE"}, "Two pulleys and a belt on them");
  card.numbered()
      .chapter("Flexible joints")
      .describe(
          "The pulleys are at the nodes, with radii R and parallel axes. The belt runs open, or CROSSED, which turns the second "
          "pulley the other way. With K or EA the free spans are elastic, each pulls along its own tangent and a slack one does "
          "not push; the centre distance may change. Without them the belt only holds the ratio of the turns, each span pulling "
          "with PRELOAD and half the difference.")
      .example("I 5 BELT N 1 2  AXIS 0 0 1  R 0.05 0.12  EA 2D5  PRELOAD 300  C 40  MU 0.4")
      .example("I 6 BELT N 1 2  AXIS 0 0 1  R 0.05 0.12  CROSSED");
  card.add("N", &BeltData::nodes, "the two pulleys, a and b; 0 is the ground")
      .synonyms({"NODES", "NOEUDS"})
      .refers(deck::Reference::node)
      .required();
  card.add("AXIS", &BeltData::axis, "axis of the pulleys, in the reference configuration").synonyms({"AXE"}).required();
  card.add("R", &BeltData::radii, "radii of the pulleys, to the middle of the belt")
      .unit(dimension::length)
      .positive()
      .required();
  card.add("CROSSED", &BeltData::crossed, "the belt is crossed").synonyms({"CROISEE"});
  card.add("K", &BeltData::stiffness, "stiffness of one free span").unit(dimension::stiffness).positive();
  card.add("EA", &BeltData::rigidity, "force per strain; the stiffness of a span is EA over its length")
      .unit(dimension::force)
      .positive();
  card.add("C", &BeltData::damping, "damping of one free span at its preload").unit(dimension::damping).at_least(0);
  card.add("PRELOAD", &BeltData::preload, "tension of both spans in the reference configuration")
      .synonyms({"PRECHARGE"})
      .unit(dimension::force)
      .at_least(0);
  card.add("MU", &BeltData::friction, "friction on the pulleys, for the channel GRIP_USED and for STICK").positive();
  card.add("STICK", &BeltData::sticks,
           "a rigid belt slips when its pull exceeds what MU can hold, and grips again when the slip ends")
      .synonyms({"ADHERENCE"});
  return element_type(card, build);
}

}  // namespace engrane::elements::control
