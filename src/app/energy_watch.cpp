// SPDX-License-Identifier: BSD-3-Clause
#include "app/energy_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/masses.hpp"
#include "model/user_function.hpp"

namespace engrane::app {

using namespace solve;

namespace {

/// Whether an energy is negligible: no more than the work of the residual forces of a machine at rest, or than the kinetic energy
/// of all masses that cover a billionth of the extent in the time of the analysis.
bool counts_as_none(double energy, const SolverContext& context, const References& references) {
  const Model& model = context.model;
  const double extent = model.extent();
  if (energy <= 1e-6 * references.largest_force() * extent) return true;
  MassProperties all;
  for (const Model::Part& part : model.parts) all.add(mass_properties(model, part));
  const double speed = 1e-9 * extent / (context.options.end - context.options.begin);
  return energy <= 0.5 * (all.mass + all.inertia.trace() / (extent * extent)) * speed * speed;
}

/// How user routines may cause an error of the energy balance, to follow a message; empty if the model has none.
std::string routine_to_blame(const Model& model) {
  if (std::none_of(model.functions.begin(), model.functions.end(),
                   [](const auto& function) { return dynamic_cast<const UserFunction*>(function.second.get()) != nullptr; }))
    return {};
  return ". A LAW USER has the same effect if the energy that its routine returns depends on the time: it is then left unset";
}

/// A warning if the equilibria of a run are not on one path; empty if they are.
std::string jump_remark(const SolverContext& context, const References& references, const observe::EnergyBalance& balance) {
  constexpr double small = 1e-3;
  const observe::Jump& jump = balance.jump;
  const double energy = std::abs(jump.lost);
  // a rigid structure cannot snap: its works differ only because drives turn far within a step
  if (balance.handled() <= small * energy) return {};
  if (energy <= small * balance.handled() || counts_as_none(energy, context, references)) return {};
  const std::string begin = fmt::format("{:.6g}", jump.begin), end = fmt::format("{:.6g}", jump.end);
  const std::string when = begin == end ? "at t = " + begin : fmt::format("between t = {} and {}", begin, end),
                    unit = context.model.units.label(dimension::energy);
  const bool follows = context.options.path.follow;
  // .PATH reached this equilibrium along a curved path; and iterations are known to go astray only across gaps
  if (jump.lost < 0 && (follows || std::none_of(context.model.parts.begin(), context.model.parts.end(),
                                                [](const Model::Part& part) { return part.element->has_gaps(); })))
    return {};
  if (jump.lost < 0)
    return fmt::format(
        "{} the structure came to an equilibrium that it cannot reach by itself, as on the far side of a contact: {:.3g} {} of "
        "energy appeared from nothing{}",
        when, energy, unit, begin == end ? "" : ". Smaller steps H may avoid it");
  return fmt::format(
      "{} the structure snapped to a distant equilibrium: {:.3g} {} of energy went into a motion that statics leave out. "
      "{}{}TYPE "
      "DYNAMIC follows the motion",
      when, energy, unit, begin == end ? "" : "Smaller steps H show at which load; ",
      follows ? "" : ".PATH follows the equilibria in between; ");
}

}  // namespace

bool EnergyWatch::judges() const {
  return context_.options.analysis == SolverOptions::Analysis::dynamics && context_.options.energy_error > 0;
}

std::string EnergyWatch::failure(const References& references, double time, bool last) {
  constexpr int most_steps = 10;
  const observe::EnergyBalance& balance = observer_.energies();
  const double handled = balance.handled(), before = std::exchange(handled_, handled);
  const double allowed = context_.options.energy_error, off = std::abs(balance.error());
  if (!judges() || off <= allowed * handled || counts_as_none(off / allowed, context_, references)) {
    steps_off_ = 0;
    return {};
  }
  ++steps_off_;
  // Where a machine begins to move, the first steps handle most of the energy so far, and the error of their work is of its size:
  // it tells nothing until energies no longer double from step to step, unless it stays.
  if (handled > 2 * before && steps_off_ < most_steps && !last) return {};
  const std::string unit = context_.model.units.label(dimension::energy);
  return fmt::format(
      "the energy balance is off by {:.4g} {} at t = {:.6g}, more than {}the {:.4g} {} that were in the machine or passed "
      "through it: the results went wrong some time before this. Take a smaller {}{}{}; ENERGY 0 in .SAM lets the run continue",
      balance.error(), unit, time, allowed == 1 ? "" : fmt::format("{:g} of ", allowed), handled, unit,
      context_.options.tolerance > 0 ? "TOL or HMAX" : "step H",
      context_.options.family == SolverOptions::Family::newmark || context_.options.damping > 0.99
          ? ", or a scheme with damping (RHO below 1): without it, rounding errors in the constraints grow"
          : "",
      routine_to_blame(context_.model));
}

std::string EnergyWatch::remark(const References& references) const {
  constexpr double much = 0.05;
  const observe::EnergyBalance& balance = observer_.energies();
  const double off = balance.largest_error;
  if (balance.jump.lost != 0) return jump_remark(context_, references, balance);
  if (!judges() || off <= much * balance.handled() || counts_as_none(off, context_, references)) return {};
  return fmt::format(
      "the energy balance was off by up to {:.3g} {}, {:.0f} % of what was in the machine or passed through it: "
      "results may be as wrong. A smaller {} would tell{}",
      off, context_.model.units.label(dimension::energy), 100 * off / balance.handled(),
      context_.options.tolerance > 0 ? "TOL" : "step H", routine_to_blame(context_.model));
}

}  // namespace engrane::app
