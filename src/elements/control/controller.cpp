// SPDX-License-Identifier: BSD-3-Clause
#include "elements/control/controller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "deck/cards/cards.hpp"
#include "elements/common/along_motion.hpp"
#include "elements/common/building.hpp"
#include "elements/control/control_law.hpp"
#include "elements/control/joint_coordinate.hpp"
#include "model/determined_channels.hpp"

namespace engrane::elements::control {

namespace {

constexpr int most_scalars = ControlLaw::most_states + 1;

/// The measured coordinate and its reference.
struct ControllerInput {
  Coordinate coordinate;
  bool speed = false;
  double reference = 0;
  const Function* function = nullptr;
};

/// The actuated coordinate and how the command y acts on it.
struct ControllerOutput {
  enum class Kind : unsigned char { effort, speed, position };
  Coordinate coordinate;
  Kind kind = Kind::effort;
  double lag = 0;  ///< time constant of the drive
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  double tracking = 0;  ///< time constant of the anti-windup
};

/// The states x of the law are represented by own unknowns z with x = ż + κ z, κ the pace of the state. Their equations
///
///     (z̈ + κ ż − dx/dt)/κ = 0
///
/// then have a mass like those of the mechanism: the initial z̈ can be computed, and the integrator keeps its order. In
/// statics, where rates vanish, x = κ z and dx/dt = 0 remain. z starts at x/κ and ż at zero; the remaining freedom in z does
/// not affect x.
///
/// A drive adds a last unknown p, the position that it imposes: coordinate − p = 0. It follows the command with a lag τ, by τ
/// p̈ + ṗ = y for a speed and τ² p̈ + 2 τ ṗ + p = y for a position. The constraint force acts on the mechanism only.
class Controller final : public TemplatedElement<Controller, 4, 24 + most_scalars + 1>, public DeterminedChannels {
 public:
  Controller(int id, const ControllerInput& input, const ControllerOutput& output, const ControlLaw& law)
      : Controller(id, input, output, law, Layout{}) {}

  template <class T>
  void evaluate(const Motion<T, 4>& motion, const State& state, Balance<T, 4>& balance) const {
    const auto in = input_.read<T>(motion.node, state);
    const T r = reference<T>(motion.time);
    const T& m = speed_ ? in.rate : in.measured.value;
    const auto x = [&](int i) { return T(motion.scalar_rate[at(i)] + law_.pace[i] * motion.scalar[at(i)]); };
    const T y = law_.command(r, m, x);
    const T limited = limit(y, balance.contact_homotopy());
    for (int i = 0; i < law_.order(); ++i) {
      T rate = law_.b_r[i] * r + law_.b_m[i] * m;
      if (law_.b_v[i] != 0) rate += law_.b_v[i] * in.rate;
      for (int j = 0; j < law_.order(); ++j)
        if (law_.A(i, j) != 0) rate += law_.A(i, j) * x(j);
      if (i == law_.integral && output_law_.tracking > 0) rate += (limited - y) * (1 / output_law_.tracking);
      balance.scalar(i, (motion.scalar_acceleration[at(i)] - rate) * (1 / law_.pace[i]) + motion.scalar_rate[at(i)]);
    }

    const auto out = output_.read<T>(motion.node, state);
    if (output_law_.kind == ControllerOutput::Kind::effort) {
      output_.act(out, limited, motion.node, balance);
      return;
    }
    const std::size_t p = at(law_.order());
    const double lag = output_law_.lag;
    if (output_law_.kind == ControllerOutput::Kind::speed)
      balance.scalar(law_.order(), lag * motion.scalar_acceleration[p] + motion.scalar_rate[p] - limited);
    else
      balance.scalar(law_.order(),
                     lag * lag * motion.scalar_acceleration[p] + 2 * lag * motion.scalar_rate[p] + motion.scalar[p] - limited);
    output_.act(out, balance.constraint(0, out.measured.value - motion.scalar[p]), motion.node, balance);
  }

  void start(std::span<double> scalars, std::span<double>) const override {
    std::fill(scalars.begin(), scalars.end(), 0.0);
    for (int i = 0; i < law_.order(); ++i) scalars[at(i)] = law_.start[i] / law_.pace[i];
  }

  void count_turns(const State& state, std::span<double>, std::span<double> history) const override {
    input_.commit(state, history);
    output_.commit(state, history);
  }

  /// The command reaches a limit, or comes back from it.
  void switches(const State& state, std::span<Switch> values) const override {
    if (values.empty()) return;
    std::array<Motion<Taylor, 2>::Node, 4> nodes;
    for (std::size_t i = 0; i < state.nodes.size(); ++i) nodes[i] = along_motion(state.nodes[i]);
    Taylor m = input_.read<Taylor>(nodes, state).measured.value;
    if (speed_) m = {m.d1, m.d2, 0};
    const Taylor r = reference<Taylor>({state.time, 1, 0});
    const auto x = [&](int i) {
      const double acceleration = state.scalar_accelerations[at(i)];
      return Taylor(law_state(state, i), acceleration + law_.pace[i] * state.scalar_rates[at(i)], 0);
    };
    const Taylor y = law_.command(r, m, x);
    double size = std::abs(law_.d_r * r.value) + std::abs(law_.d_m * m.value);
    for (int i = 0; i < law_.order(); ++i) size += std::abs(law_.c[i] * law_state(state, i));
    values[0] = {output_law_.high - y.value, -y.d1, size + std::abs(output_law_.high)};
    values[1] = {y.value - output_law_.low, y.d1, size + std::abs(output_law_.low)};
  }

  Energies energies(const State& state) const override {
    Energies e;
    e.external = effort(state) * output_.read<double>(state.nodes, state).rate;
    return e;
  }

  const std::vector<Channel>& channels() const override { return channels_; }
  std::vector<Determined> determined() const override {
    return function_ ? std::vector<Determined>{{1}, {2, {0}}} : std::vector<Determined>();
  }
  double determine(int channel, double time, std::span<const double> measured) const override {
    return reference<double>(time) - (channel == 2 ? measured[0] : 0);
  }

  void observe(const State& state, std::span<double> values) const override {
    const auto in = input_.read<double>(state.nodes, state), out = output_.read<double>(state.nodes, state);
    const double r = reference<double>(state.time), m = speed_ ? in.rate : in.measured.value, force = effort(state);
    std::size_t i = 0;
    values[i++] = m;
    values[i++] = r;
    values[i++] = r - m;
    values[i++] = command(state);
    values[i++] = limit(command(state));
    values[i++] = force;
    values[i++] = force * out.rate;
    for (int k = 0; k < law_.order(); ++k) values[i++] = law_state(state, k);
  }

 private:
  static constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }

  // the coordinates append their nodes to the layout in turn, before it is passed to the base
  Controller(int id, const ControllerInput& input, const ControllerOutput& output, const ControlLaw& law, Layout layout)
      : TemplatedElement(id),
        law_(law),
        output_law_(output),
        speed_(input.speed),
        reference_(input.reference),
        function_(input.function),
        input_(input.coordinate, layout),
        output_(output.coordinate, layout) {
    const Coordinate &in = input.coordinate, &out = output.coordinate;
    using Kind = ControllerOutput::Kind;
    const Dimension command = output.kind == Kind::effort     ? out.effort_dimension()
                              : output.kind == Kind::position ? out.dimension()
                                                              : out.rate_dimension();
    for (int i = 0; i < law.order(); ++i)
      layout.scalars.push_back(
          {{fmt::format("STATE_{}", i + 1), command, "state of the law, filtered"}, output.kind == Kind::effort});
    if (output.kind != Kind::effort) {
      layout.scalars.push_back({"POSITION", out.dimension(), "position that the drive imposes"});
      layout.multipliers = {
          {"EFFORT", out.dimension(), out.is_angle() ? "torque of the drive" : "force of the drive", Role::drive}};
    }
    if (std::isfinite(output.low))
      for (const char* limit : {"upper", "lower"})
        layout.switches.push_back(
            {fmt::format("command leaves the {} limit", limit), fmt::format("command reaches the {} limit", limit)});
    set_layout(std::move(layout));
    const Dimension measured = input.speed ? in.rate_dimension() : in.dimension();
    channels_ = {{"MEASURED", measured, "what the controller measures"},
                 {"REFERENCE", measured, "what it ought to be"},
                 {"ERROR", measured, "reference less measured"},
                 {"COMMAND", command, "what the law asks for"},
                 {"LIMITED", command, "the command within its limits"},
                 {"EFFORT", out.effort_dimension(), "force or torque along the output's coordinate"},
                 {"POWER", dimension::power, "power given to the mechanism"}};
    Channel &limited = channels_[4], &effort = channels_[5];
    limited.low = output.low;
    limited.high = output.high;
    if (output.kind == Kind::effort) effort.low = output.low, effort.high = output.high;
    for (int i = 0; i < law.order(); ++i) channels_.push_back({fmt::format("STATE_{}", i + 1), command, "state of the law"});
  }

  template <class T>
  T reference(const T& time) const {
    return function_ ? T(reference_ * engrane::evaluate(*function_, time)) : T(reference_);
  }
  /// The command within its limits. While statics searches, the fraction `passing` of what exceeds them passes
  /// (State::contact_homotopy): a command at its limit resists no motion, even where the equilibrium lies within the limits.
  template <class T>
  T limit(const T& y, double passing = 0) const {
    const double bound = std::clamp(value_of(y), output_law_.low, output_law_.high);
    if (bound == value_of(y)) return y;
    return passing > 0 ? T(bound + passing * (y - bound)) : T(bound);
  }

  double law_state(const State& state, int i) const { return state.scalar_rates[at(i)] + law_.pace[i] * state.scalars[at(i)]; }
  double command(const State& state) const {
    const auto in = input_.read<double>(state.nodes, state);
    return law_.command(reference<double>(state.time), speed_ ? in.rate : in.measured.value,
                        [&](int i) { return law_state(state, i); });
  }
  double effort(const State& state) const {
    if (output_law_.kind == ControllerOutput::Kind::effort) return limit(command(state));
    const double open = output_.read<double>(state.nodes, state).measured.value - state.scalars[at(law_.order())];
    return state.multipliers[0] - state.penalty * open;
  }

  ControlLaw law_;
  ControllerOutput output_law_;
  bool speed_;
  double reference_;
  const Function* function_;
  PlacedCoordinate input_, output_;
  std::vector<Channel> channels_;
};

std::optional<ControllerInput> read_input(const ControllerData& data, const BuildContext& context) {
  const auto coordinate = find_coordinate(context, "IN", data.input, "COORDINATE", data.coordinate);
  ControllerInput input;
  if (!find_function(context, data.function, input.function) || !coordinate) return {};
  input.coordinate = *coordinate;
  input.speed = data.quantity.is("SPEED");
  const double unit = coordinate->is_angle() && !input.speed ? degree : 1;
  // a function alone is the reference itself
  input.reference = data.reference ? *data.reference * unit : data.function != 0 ? 1 : 0;
  return input;
}

std::optional<ControllerOutput> read_output(const ControllerData& data, const BuildContext& context) {
  const auto coordinate = find_coordinate(context, "OUT", data.output, "ALONG", data.along);
  if (!coordinate) return {};
  ControllerOutput output;
  output.coordinate = *coordinate;
  if (data.drive.given()) {
    if (!data.lag) {
      context.error("DRIVE", "a drive without a lag", "TAU is the time in which it follows its command");
      return {};
    }
    output.kind = data.drive.is("SPEED") ? ControllerOutput::Kind::speed : ControllerOutput::Kind::position;
    output.lag = *data.lag;
  } else if (data.lag) {
    context.error("TAU", "TAU without DRIVE",
                  "a force or torque follows the command at once; DRIVE SPEED TAU t imposes a motion");
    return {};
  }
  if (!data.limits.empty()) {
    output.low = data.limits[0];
    output.high = data.limits[1];
    if (output.low >= output.high) {
      context.error("LIMITS", fmt::format("the lower limit {} is not below the upper {}", output.low, output.high),
                    "LIMITS low high");
      return {};
    }
  }
  return output;
}

/// Whether the card gives exactly one complete law.
bool check_law(const ControllerData& data, const BuildContext& context) {
  const bool transfer = !data.numerator.empty() || !data.denominator.empty();
  for (const char* keyword : {"KP", "KI", "KD", "TF", "I0", "TT"})
    if (transfer && context.record.given(keyword)) {
      context.error(keyword, fmt::format("{} belongs to a PID law, and NUM and DEN give a transfer function", keyword),
                    "keep one of the two");
      return false;
    }
  if (!transfer) {
    if (!data.states.empty()) {
      context.error("STATES", "STATES belong to a transfer function", "I0 starts the integral of a PID");
      return false;
    }
    if (data.proportional == 0 && data.integral == 0 && data.derivative == 0) {
      context.error("KP", "a controller without a law", "give KP, KI, KD, or NUM and DEN");
      return false;
    }
    const bool winds_up = data.integral != 0 && !data.limits.empty();
    const auto idle = [&](const char* keyword, bool given, const char* without, const char* what) {
      if (given) context.error(keyword, fmt::format("{} without {}", keyword, without), what);
      return given;
    };
    if (idle("TF", data.filter && data.derivative == 0, "KD", "it filters the derivative: give KD, or leave TF out") ||
        idle("I0", data.integral_start && data.integral == 0, "KI", "the integral starts with it: give KI, or leave I0 out") ||
        idle("TT", data.tracking && !winds_up, data.integral == 0 ? "KI" : "LIMITS",
             "in that time the integral tracks a limited command: it needs KI and LIMITS"))
      return false;
    if (data.derivative != 0 && !data.filter && data.proportional == 0) {
      context.error("KD", "the derivative has no filter", "give its time constant TF; the default, KD/(10 KP), needs KP");
      return false;
    }
    if (winds_up && !data.tracking && data.proportional == 0) {
      context.error("LIMITS", "the integral of a limited command would wind up",
                    "give the time TT in which it tracks the limit; the default, KP/KI, needs KP");
      return false;
    }
    return true;
  }
  const auto& num = data.numerator;
  const auto& den = data.denominator;
  if (num.empty() || den.empty()) {
    context.error(num.empty() ? "DEN" : "NUM", "half a transfer function", "NUM and DEN give it together");
    return false;
  }
  if (den.front() == 0) {
    context.error("DEN", "the highest power has the coefficient 0", "leave it out");
    return false;
  }
  if (num.size() > den.size()) {
    context.error("NUM", fmt::format("the numerator has degree {}, the denominator {}", num.size() - 1, den.size() - 1),
                  "no more powers above than below the line: add a lag to the denominator");
    return false;
  }
  if (den.size() > ControlLaw::most_states + 1) {
    context.error("DEN", fmt::format("degree {}", den.size() - 1), fmt::format("at most {}", ControlLaw::most_states));
    return false;
  }
  if (!data.states.empty() && data.states.size() != den.size() - 1) {
    context.error("STATES", fmt::format("{} states for a denominator of degree {}", data.states.size(), den.size() - 1));
    return false;
  }
  return true;
}

/// Start time of the run, at which a law that starts in a steady state takes its reference.
double start_time(const BuildContext& context) {
  double start = 0;
  if (context.records)
    for (const deck::Record& record : *context.records)
      if (const auto* stepping = record.get<deck::SteppingCard>()) start = stepping->start;
  return start;
}

bool is_kinematic(const BuildContext& context) {
  if (!context.records) return false;
  return std::any_of(context.records->begin(), context.records->end(), [](const deck::Record& record) {
    const auto* analysis = record.get<deck::AnalysisCard>();
    return analysis && analysis->type.is("KINEMATIC");
  });
}

std::unique_ptr<Element> build(const ControllerData& data, BuildContext& context) {
  const auto input = read_input(data, context);
  auto output = read_output(data, context);
  if (!check_law(data, context) || !input || !output) return nullptr;
  if (is_kinematic(context)) {
    context.error("I", "a controller in a kinematic analysis, which knows no forces and no states",
                  "run it with .SAM TYPE DYNAMIC or STATIC, or leave the controller out");
    return nullptr;
  }
  const double begin = input->reference * (input->function ? input->function->at(start_time(context)).f : 1);
  if (!data.denominator.empty())
    return std::make_unique<Controller>(
        context.record.id, *input, *output,
        ControlLaw::transfer_function(data.numerator, data.denominator, begin, !input->speed, data.states));
  ControlLaw::Pid gains{data.proportional, data.integral, data.derivative, 0, data.integral_start.value_or(0)};
  if (data.derivative != 0) gains.filter = data.filter ? *data.filter : std::abs(data.derivative / (10 * data.proportional));
  if (data.integral != 0 && !data.limits.empty())
    output->tracking = data.tracking ? *data.tracking : std::abs(data.proportional / data.integral);
  return std::make_unique<Controller>(context.record.id, *input, *output, ControlLaw::pid(gains, begin, !input->speed));
}

}  // namespace

ElementType controller_type() {
  deck::Card<ControllerData> card("CONTROLLER", {"REGULATEUR"},
                                  "Drives a force, a torque or a motion by a PID law or a transfer function");
  card.numbered()
      .chapter("Control and computation elements")
      .describe(
          "It measures the coordinate of a joint or SENSOR (IN), compares it with the reference and acts along the coordinate of "
          "a joint or SENSOR (OUT): with a force or torque, or, with DRIVE, by imposing its motion. The reference is REF times "
          "the function NF, or the function alone (radians). The law is KP e + KI (integral of e) + KD (derivative of e), the "
          "derivative through a filter of time constant TF; or the transfer function NUM/DEN, coefficients from the highest "
          "power down.")
      .example("I 9 CONTROLLER IN 3  NF 1  KP 200  KI 50  KD 12  TF 2D-3  OUT 3  LIMITS -80 80")
      .example("I 9 CONTROLLER IN 20  REF 0.5  NUM 40 8  DEN 1 30  OUT 20")
      .example("I 9 CONTROLLER IN 4  REF 30  KP 5  OUT 3  DRIVE SPEED TAU 0.01");
  card.add("IN", &ControllerData::input, "number of the joint or SENSOR that is measured")
      .synonyms({"ENTREE"})
      .refers(deck::Reference::element)
      .required();
  card.add("COORDINATE", &ControllerData::coordinate, "which of its coordinates, as its channel is named; default: the first")
      .synonyms({"COORDONNEE"});
  card.add("QUANTITY", &ControllerData::quantity, "what of it")
      .synonyms({"GRANDEUR"})
      .option({"VALUE", {"VALEUR"}, "the coordinate itself"})
      .option({"SPEED", {"VITESSE"}, "its rate"});
  card.add("REF", &ControllerData::reference, "reference; degrees for an angle, radians per time for its rate")
      .synonyms({"REFERENCE"});
  card.add("NF", &ControllerData::function,
           "function of time that multiplies REF; alone it is the reference, in radians for an angle")
      .refers(deck::Reference::function)
      .at_least(0);
  card.add("KP", &ControllerData::proportional, "gain of the error");
  card.add("KI", &ControllerData::integral, "gain of its integral");
  card.add("KD", &ControllerData::derivative, "gain of its derivative");
  card.add("TF", &ControllerData::filter, "time constant of the derivative's filter; default: KD/(10 KP)")
      .unit(dimension::time)
      .positive();
  card.add("I0", &ControllerData::integral_start, "part of the command that the integral starts with");
  card.add("TT", &ControllerData::tracking, "time in which the integral tracks a limited command; default: KP/KI")
      .unit(dimension::time)
      .positive();
  card.add("NUM", &ControllerData::numerator, "numerator, from the highest power of s down").synonyms({"NUMERATEUR"});
  card.add("DEN", &ControllerData::denominator, "denominator, from the highest power of s down").synonyms({"DENOMINATEUR"});
  card.add("STATES", &ControllerData::states, "states of the transfer function at the start").synonyms({"ETATS"});
  card.add("LIMITS", &ControllerData::limits, "lowest and highest command").synonyms({"LIMITES"}).values(2, 2);
  card.add("OUT", &ControllerData::output, "number of the joint or SENSOR along which it acts")
      .synonyms({"SORTIE"})
      .refers(deck::Reference::element)
      .required();
  card.add("ALONG", &ControllerData::along, "which of its coordinates; default: the first").synonyms({"SELON"});
  card.add("DRIVE", &ControllerData::drive, "imposes the motion of the coordinate instead of a force")
      .synonyms({"MOTEUR"})
      .option({"SPEED", {"VITESSE"}, "the command is the speed"})
      .option({"POSITION", {}, "the command is the position"});
  card.add("TAU", &ControllerData::lag, "time constant with which the drive follows the command")
      .unit(dimension::time)
      .positive();
  return element_type(card, build, 1);
}

}  // namespace engrane::elements::control
