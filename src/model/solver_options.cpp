// SPDX-License-Identifier: BSD-3-Clause
#include "model/solver_options.hpp"

namespace engrane {

namespace {

/// With error control no step is longer than this part of the run, unless the deck says so.
constexpr double longest_part = 0.02;

}  // namespace

SolverOptions solver_options(const deck::AnalysisCard& analysis, const deck::SteppingCard& stepping) {
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
  o.tolerance = o.analysis == Analysis::dynamics ? stepping.tolerance.value_or(0) : 0;
  o.longest = stepping.longest.value_or(longest_part * (o.end - o.begin));
  o.cuts = analysis.cuts;
  o.package = analysis.solver.tag;
  o.precision = analysis.precision;
  o.keep_factors = analysis.tangent.is("KEPT");
  o.iterations = analysis.iterations;
  o.scale = analysis.scale.value_or(0);
  o.energy_error = analysis.energy;
  o.penalty = analysis.penalty.value_or(0);
  o.events = !analysis.events.is("NO");
  if (!analysis.events.values.empty()) o.event_tolerance = analysis.events.values[0];
  return o;
}

}  // namespace engrane
