// SPDX-License-Identifier: BSD-3-Clause
#include "model/solver_options.hpp"

#include <algorithm>

namespace engrane {

namespace {

/// Default maximum step with error control, as a fraction of the run.
constexpr double longest_part = 0.02;
/// Fractions of the step tolerance: force residual of the Newton iteration with Radau IIA and in statics, and localisation of
/// events. If a force jumps, an error in the instant of the event is a velocity error of the same fraction of the step's
/// velocity change. It is largest if all forces jump.
constexpr double share_of_newton = 0.01, share_of_path = 1e-3, share_of_event = 0.5, event_of_fixed_steps = 1e-6;
/// Upper limit of the event tolerance, as a fraction of the step, however loose TOL is. The drift step to an event is at most a
/// hundredth of a step, and must certainly end before the event for its error to be known.
constexpr double bluntest_event = 1e-3;

/// Whether a check is of a result that bends where the load of teeth or of a cam changes its sign: a force, moment or power other
/// than the load itself.
bool bends(const deck::CheckCard& check, const Model& model) {
  if (check.run) return check.quantity.starts_with("GROUND_");
  if (check.node) return check.quantity.starts_with('F') || check.quantity.starts_with('M');  // reactions
  const auto is_asked = [&](const Channel& channel) { return channel.name == check.quantity && channel.dimension.mass != 0; };
  return check.quantity != "NORMAL_FORCE" && std::any_of(model.parts.begin(), model.parts.end(), [&](const Model::Part& part) {
           const std::vector<Channel>& all = part.element->channels();
           return part.element->id() == check.element && std::any_of(all.begin(), all.end(), is_asked);
         });
}

/// Without `.CHK` every result is asked for.
bool asks_for_bends(const Model& model) {
  const auto& checks = model.commands.checks;
  return checks.empty() || std::any_of(checks.begin(), checks.end(), [&](const auto& check) { return bends(check, model); });
}

}  // namespace

const AccuracyRung* accuracy_rung(const deck::AnalysisCard& analysis) {
  if (!analysis.type.is("DYNAMIC")) return nullptr;
  for (const AccuracyRung& rung : accuracy_rungs)
    if (analysis.accuracy.is(rung.name)) return &rung;
  return nullptr;
}

void settle_tolerance(const deck::Deck& deck, Commands& commands, Diagnostics& diagnostics) {
  deck::SteppingCard& stepping = commands.stepping;
  const AccuracyRung* rung = accuracy_rung(commands.analysis);
  if (!stepping.tolerance && rung) stepping.tolerance = rung->tolerance;
  const bool idle = stepping.tolerance && commands.analysis.type.is("KINEMATIC");
  for (const deck::Record& record : deck.records) {
    if (!record.get<deck::SteppingCard>()) continue;
    if (stepping.longest && !stepping.tolerance)
      diagnostics.error(record.where("HMAX"), "HMAX limits steps that TOL or ACCURACY chooses, and neither is given",
                        "give one of them, or leave HMAX out");
    if (idle) diagnostics.warning(record.where("TOL"), "TOL has no effect on a " + commands.analysis.type.tag + " analysis");
  }
  if (idle) stepping.tolerance.reset();
}

double event_tolerance_for(double tolerance) { return std::min(share_of_event * tolerance, bluntest_event); }

SolverOptions solver_options(const Model& model) {
  const deck::AnalysisCard& analysis = model.commands.analysis;
  const deck::SteppingCard& stepping = model.commands.stepping;
  using Analysis = SolverOptions::Analysis;
  using Family = SolverOptions::Family;
  SolverOptions o;
  o.analysis = analysis.type.is("DYNAMIC")     ? Analysis::dynamics
               : analysis.type.is("KINEMATIC") ? Analysis::kinematics
                                               : Analysis::statics;
  o.family = analysis.scheme.is("NEWMARK")  ? Family::newmark
             : analysis.scheme.is("HHT")    ? Family::hht
             : analysis.scheme.is("BOSSAK") ? Family::bossak
             : analysis.scheme.is("RADAU")  ? Family::radau
                                            : Family::chung;
  o.damping = o.family == Family::chung ? analysis.rho.value_or(0.8) : analysis.alpha.value_or(0.05);
  o.static_start = analysis.start.is("STATIC");
  o.begin = stepping.start;
  o.end = stepping.end;
  o.step = stepping.step;
  o.tolerance = o.analysis == Analysis::kinematics ? 0 : stepping.tolerance.value_or(0);
  o.longest = stepping.longest.value_or(longest_part * (o.end - o.begin));
  o.cuts = analysis.cuts;
  o.package = analysis.solver.tag;
  // with kept factors, iterations need only match the error of the step; with exact tangents, the last iteration exceeds it
  // anyway
  double of_step = 1e-9;
  if (o.tolerance > 0 && o.analysis == Analysis::dynamics && o.family == Family::radau)
    of_step = std::clamp(share_of_newton * o.tolerance, 1e-12, 1e-5);
  else if (o.tolerance > 0 && o.analysis == Analysis::statics)
    of_step = std::clamp(share_of_path * o.tolerance, 1e-12, of_step);
  o.precision = analysis.precision.value_or(of_step);
  if (const AccuracyRung* rung = accuracy_rung(analysis)) {
    o.target = rung->target;
    o.scheme_is_free = analysis.scheme_is_free;
  }
  o.keep_factors = analysis.tangent.is("KEPT");
  o.iterations = analysis.iterations;
  o.scale = analysis.scale.value_or(0);
  o.energy_error = analysis.energy;
  o.penalty = analysis.penalty.value_or(0);
  o.events = !analysis.events.is("NO");
  o.bends = o.tolerance > 0 && asks_for_bends(model);
  o.event_tolerance = !analysis.events.values.empty() ? analysis.events.values[0]
                      : o.tolerance > 0               ? event_tolerance_for(o.tolerance)
                                                      : event_of_fixed_steps;
  if (const auto& path = model.commands.path) {
    o.path.follow = true;
    o.path.steps = path->steps.value_or(0);
    o.path.node = path->node ? std::max(0, model.node_index(*path->node)) : 0;
    o.path.component = path->component.value_or(1) - 1;
    o.path.displacement = path->displacement.value_or(0);
    o.path.branch = path->branch.value_or(0);
    o.path.amplitude = path->amplitude.value_or(0);
  }
  return o;
}

}  // namespace engrane
