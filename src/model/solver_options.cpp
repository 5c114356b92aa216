// SPDX-License-Identifier: BSD-3-Clause
#include "model/solver_options.hpp"

#include <algorithm>

namespace engrane {

namespace {

/// With error control no step is longer than this part of the run, unless the deck says so.
constexpr double longest_part = 0.02;
/// Of the tolerance of a step: what iterations leave of forces, and how sharply events are met. Where a force jumps the error of
/// an event's instant is one of velocities, as large a part of what a step changes; that of all forces is the most it can be.
constexpr double share_of_newton = 0.01, share_of_path = 1e-3, share_of_event = 0.5, event_of_fixed_steps = 1e-6;
/// Events are met within this part of a step however loose its tolerance is: a drift to one is a hundredth of a step at most, and
/// is to be certain to end before it for its error to be known.
constexpr double bluntest_event = 1e-3;

}  // namespace

const AccuracyRung* accuracy_rung(const deck::AnalysisCard& analysis) {
  if (!analysis.type.is("DYNAMIC")) return nullptr;
  for (const AccuracyRung& rung : accuracy_rungs)
    if (analysis.accuracy.is(rung.name)) return &rung;
  return nullptr;
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
  // iterations with kept factors need not be better than their step; those with exact tangents are, by the last of them
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
