// SPDX-License-Identifier: BSD-3-Clause
#include "elements/common/spring_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "model/function_failure.hpp"
#include "model/user_function.hpp"

namespace engrane::elements {

namespace {

/// The formula of D and V that a keyword refers to; nullptr, with an error, if the function is not such a formula.
const Expression* find_formula(const BuildContext& context, const std::string& keyword, int id) {
  const auto it = context.functions.find(id);
  if (it == context.functions.end()) {
    context.diagnostics.missing(".FCT", context.record.where(keyword), fmt::format("function {} does not exist", id),
                                fmt::format("declare it with .FCT I {} EXPR \"...\", a formula of D, V and T", id));
    return nullptr;
  }
  if (!it->second) return nullptr;  // its error has been reported already
  if (!it->second->law())
    context.error(keyword, fmt::format("function {} is no formula of D or V", id),
                  "LAW TABLE takes a function of one variable, LAW EXPR a formula such as \"2E4*D*(1 + 0.3*V)\"");
  return it->second->law();
}

/// By how much a force jumps upwards where the rate passes through 0, as dry friction does; 0 if it does not.
template <class F>
double jump_at_rest(const F& force) {
  constexpr double slow = 1e-20, slower = 1e-24, same = 1e-3;
  const double jump = force(slow) - force(-slow), nearer = force(slower) - force(-slower);
  return std::isfinite(jump) && jump > 0 && std::abs(nearer - jump) < same * jump ? jump : 0;
}

/// Warns about a law that is meant as dry friction: bodies cannot stick by it.
void warn_of_friction(const BuildContext& context, const std::string& keyword, double jump) {
  if (jump > 0)
    context.diagnostics.warning(
        context.record.where(keyword),
        fmt::format("the force jumps by {} with the sign of the rate: no motion satisfies this law at rest, and the run fails or "
                    "creeps in tiny steps",
                    number(jump)),
        "FRICTION of a joint with STICK comes to rest and holds; TANH(V/v) in the formula instead of SIGN(V) slides slowly");
}

/// Warns about a damper that drives: the power that it takes, force times rate, is negative at a point of its table.
void warn_of_drive(const BuildContext& context, const std::string& keyword, const Function& law) {
  constexpr double infinity = std::numeric_limits<double>::infinity(), rounding = 1e-12;
  constexpr std::size_t most = 100000;
  const std::vector<double> rates = law.corners(-infinity, infinity, most);
  double greatest = 0, worst = 0, worst_rate = 0;
  for (const double rate : rates) {
    const double force = law.at(rate).f;
    greatest = std::max(greatest, std::abs(force));
    if (force * rate < worst) worst = force * rate, worst_rate = rate;
  }
  if (!(worst < 0) || std::abs(law.at(worst_rate).f) <= rounding * greatest) return;
  context.diagnostics.warning(
      context.record.where(keyword),
      fmt::format("the damper supplies power: at a rate of {} its force is {}", number(worst_rate), number(law.at(worst_rate).f)),
      "a damper takes power where its force and its rate have the same sign: see to the signs of the function");
}

/// The bridge across the play nearest to elongation 0: a piece between corners without force.
SpringLaw::Bridge bridge_of(const Function& law) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr std::size_t most = 20;
  std::vector<double> ends = law.corners(-infinity, infinity, most);
  if (ends.size() < 2) return {};
  // the first and the last piece go on without end
  const double beyond = ends.back() - ends.front();
  ends.insert(ends.begin(), ends.front() - beyond);
  ends.push_back(ends.back() + beyond);
  const std::size_t last = ends.size() - 2;
  std::vector<Function::Jet> pieces;
  for (std::size_t i = 0; i <= last; ++i) pieces.push_back(law.at(std::midpoint(ends[i], ends[i + 1])));
  SpringLaw::Bridge bridge;
  for (std::size_t i = 0; i <= last; ++i) {
    if (pieces[i].f != 0 || pieces[i].d1 != 0) continue;
    const double stiffness = std::max(i > 0 ? pieces[i - 1].d1 : 0, i < last ? pieces[i + 1].d1 : 0);
    const double relaxed = std::midpoint(ends[std::max<std::size_t>(i, 1)], ends[std::min(i + 1, last)]);
    if (stiffness > 0 && (bridge.stiffness == 0 || std::abs(relaxed) < std::abs(bridge.relaxed))) bridge = {stiffness, relaxed};
  }
  return bridge;
}

}  // namespace

std::optional<SpringLaw> SpringLaw::of(const BuildContext& context, const SpringLawData& data, double stiffness, double damping,
                                       double first, double scale, const std::string& suffix) {
  SpringLaw law;
  law.k1 = stiffness;
  law.damping = damping;
  if (data.law.given() && stiffness != 0) {
    context.error("LAW" + suffix, fmt::format("K{0} and LAW{0} both give the spring's force", suffix),
                  fmt::format("give K{0} or LAW{0}; LAW{0} POLY k1 k2 k3 starts with the stiffness", suffix));
    return {};
  }
  if (data.damping_law != 0 && damping != 0) {
    context.error("CLAW" + suffix, fmt::format("C{0} and CLAW{0} both give the damper's force", suffix),
                  fmt::format("give C{0} or CLAW{0}", suffix));
    return {};
  }
  if (data.law.is("TABLE") || data.law.is("EXPR")) {
    const double id = data.law.values[0];
    if (id != std::floor(id) || !(id > 0 && id < 1e9)) {
      context.error("LAW" + suffix, fmt::format("{} is not the number of a function", number(id)),
                    fmt::format("LAW{} {} f, where .FCT declares f", suffix, data.law.tag));
      return {};
    }
    if (data.law.is("EXPR")) {
      law.formula = find_formula(context, "LAW" + suffix, static_cast<int>(id));
      if (!law.formula) return {};
      law.formula_id_ = static_cast<int>(id);
      law.corners = LawCorners(*law.formula);
      double most = 0;
      for (const double stretch : {0.0, scale, -scale})
        most = std::max(most, jump_at_rest([&](double rate) { return law.formula->law(stretch, rate, 0).value; }));
      warn_of_friction(context, "LAW" + suffix, most);
      if (!law.formula->uses_time())
        law.of_formula_ = std::make_shared<PanelIntegral>([f = law.formula](double e) { return f->law(e, 0, 0).value; },
                                                          [f = law.formula](double e) { return f->rounding(0, e); });
    } else {
      law.of_stretch = context.function(static_cast<int>(id), "LAW" + suffix);
      if (!law.of_stretch) return {};
      law.corners = LawCorners(*law.of_stretch);
      law.bridge = bridge_of(*law.of_stretch);
    }
  } else if (data.law.is("USER")) {
    std::vector<user::Arguments> samples{{first, 0, 0}};
    for (const double part : {-1.0, -0.313, 0.171, 0.477, 1.0})
      samples.push_back({first + part * scale, 0.7 * (part + 0.1) * scale, 0});
    law.user = user_routine(context, "LAW" + suffix, data.law.values[0], user::Kind::force, {scale, scale, 1}, samples);
    if (!law.user) return {};
    law.user_stores_ = law.user->gives(3, samples[0]);
  } else if (data.law.given()) {
    const std::vector<double>& k = data.law.values;
    law.k1 = k[0];
    if (k.size() > 1) law.k2 = k[1];
    if (k.size() > 2) law.k3 = k[2];
  }
  if (data.damping_law != 0) {
    law.of_rate = context.function(data.damping_law, "CLAW" + suffix);
    if (!law.of_rate) return {};
    law.corners_of_rate = LawCorners(*law.of_rate);
    warn_of_friction(context, "CLAW" + suffix, jump_at_rest([&](double rate) { return law.of_rate->at(rate).f; }));
    warn_of_drive(context, "CLAW" + suffix, *law.of_rate);
  }
  return law;
}

void SpringLaw::name_switches(std::vector<SwitchNames>& names, const std::string& before) const {
  corners.name(names, before + "LAW");
  corners_of_rate.name(names, before + "CLAW");
}

std::size_t SpringLaw::switches(const Taylor& stretch, double time, double size, std::span<Switch> values) const {
  const std::size_t first = corners.switches(stretch, time, size, values);
  const Taylor rate(stretch.d1, stretch.d2, 0);
  return first + corners_of_rate.switches(rate, time, std::abs(rate.value), values.subspan(first));
}

Expression::Law SpringLaw::of_both(double stretch, double rate, double time) const {
  if (formula) {
    const Expression::Law y = formula->law(stretch, rate, time);
    for (const double value : {y.value, y.by_elongation, y.by_rate})
      if (!std::isfinite(value)) {
        const bool whole = !std::isfinite(y.value);
        note_function_failure(whole ? 0 : 1, fmt::format("{}function {} {} at D = {:.10g}, V = {:.10g}, T = {:.10g}",
                                                         whole ? "" : "a derivative of ", formula_id_, describe_not_finite(value),
                                                         stretch, rate, time));
        break;
      }
    return y;
  }
  const user::Results y = user->at({stretch, rate, time});
  return {y[0], y[1], y[2]};
}

Energies SpringLaw::energies(double stretch, double rate, double time) const {
  Energies e;
  e.dissipated = viscous(rate) * rate;
  if (!formula && !user) {
    e.potential = stored(stretch);
    return e;
  }
  e.dissipated += of_both(stretch, rate, time).value * rate;
  if (!of_formula_ && !user_stores_) return e;
  e.potential = of_formula_ ? (*of_formula_)(stretch) : user->at({stretch, 0, time})[3];
  e.dissipated -= of_both(stretch, 0, time).value * rate;
  return e;
}

}  // namespace engrane::elements
