// SPDX-License-Identifier: BSD-3-Clause
#include "app/plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "deck/cards/initial_motion.hpp"
#include "model/element_at_rest.hpp"
#include "model/masses.hpp"
#include "model/pulses.hpp"
#include "model/solver_options.hpp"
#include "model/speed_jumps.hpp"
#include "solve/run/restart_jump.hpp"

namespace engrane::app {

namespace {

constexpr double earth = 9.81;  // m/s²

/// Warns about bodies whose radius of gyration does not fit the size of the mechanism.
void look_at_bodies(const Model& model, double extent, Diagnostics& diagnostics) {
  constexpr double too_large = 50, too_small = 2000;
  if (model.nodes.size() < 3) return;  // a single point has no size
  for (const Model::Part& part : model.parts) {
    if (part.type != "INERTIA" && part.type != "RIGID") continue;
    const double radius = radius_of_gyration(model, part);
    if (!(radius > 0)) continue;
    if (radius < too_large * extent && radius * too_small > extent) continue;
    const std::string unit = model.units.label(dimension::length);
    diagnostics.warning(
        part.location,
        fmt::format("the radius of gyration sqrt(J/M) of {} is {:.3g} {}, {} the size of the mechanism, {:.3g} {}", part.name(),
                    radius, unit,
                    radius > extent ? fmt::format("{:.3g} times", radius / extent) : fmt::format("1/{:.3g} of", extent / radius),
                    extent, unit),
        "are J, M and the coordinates in the same units? A moment of inertia in kg mm2 is 1e-6 of one in kg m2");
  }
}

/// A node and its distance from the centre of all nodes.
struct Away {
  double distance = 0;
  std::size_t node = 0;
};

/// The two nodes farthest from the centre, the farthest first. Requires at least two nodes besides the ground.
std::array<Away, 2> farthest_nodes(const Model& model) {
  const std::size_t count = model.nodes.size() - 1;
  // the median is not affected by an outlier
  Vec3 middle;
  std::vector<double> x(count);
  for (int k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < count; ++i) x[i] = model.nodes[i + 1].x[k];
    std::nth_element(x.begin(), x.begin() + static_cast<long>(count / 2), x.end());
    middle[k] = x[count / 2];
  }
  std::array<Away, 2> two;
  for (std::size_t i = 1; i <= count; ++i) {
    const Away one{(model.nodes[i].x - middle).norm(), i};
    if (one.distance >= two[0].distance)
      two = {one, two[0]};
    else if (one.distance > two[1].distance)
      two[1] = one;
  }
  return two;
}

/// Warns about a node at least 300 times as far from the centre as all others. Returns the size of the mechanism without it.
double look_at_nodes(const deck::Deck& deck, const Model& model, Diagnostics& diagnostics) {
  constexpr double far = 300;
  if (model.nodes.size() < 4) return model.extent();
  const auto [away, second] = farthest_nodes(model);
  const double farthest = away.distance, others = second.distance;
  // nodes on one axis that differ by rounding have no distance to compare with
  if (!(others > 1e-12 * farthest) || farthest < far * others) return model.extent();
  const int id = model.nodes[away.node].id;
  for (const deck::Record& record : deck.records)
    if (record.get<deck::NodeCard>() && record.id == id)
      diagnostics.warning(record.location,
                          fmt::format("node {} is {:.4g} {} away from the others, which are within {:.4g}", id, farthest,
                                      model.units.label(dimension::length), others),
                          "are its coordinates in the same unit of length?");
  return 2 * others;
}

/// Warns about gravity of 9.81 in a model in millimetres, or of 9810 in one in metres.
void look_at_gravity(const deck::Deck& deck, const Model& model, double extent, Diagnostics& diagnostics) {
  constexpr double tolerance = 0.03, large = 300, small = 1;
  const auto is = [](double value, double expected) { return std::abs(value - expected) < tolerance * expected; };
  for (const deck::Record& record : deck.records) {
    const auto* card = record.get<deck::GravityCard>();
    if (!card) continue;
    const auto& v = card->acceleration;
    const double g = Vec3(v[0], v[1], v[2]).norm();
    const UnitSystem& units = model.units;
    if (units.given) {
      const double si = g * units.length / (units.time * units.time);
      for (const double slip : {1e-3, 1e3})
        if (is(si, earth * slip))
          diagnostics.warning(record.location,
                              fmt::format("gravity of {:.5g} {} is {} of the earth's", g, units.label(dimension::acceleration),
                                          slip < 1 ? "a thousandth" : "a thousand times that"),
                              fmt::format("in the units of .UNIT it is {:.5g}", earth * units.time * units.time / units.length));
    } else if (model.nodes.size() > 2) {
      if (is(g, earth) && extent > large)
        diagnostics.warning(
            record.location,
            fmt::format("gravity of {:.5g} is in metres, and the nodes are up to {:.5g} apart: millimetres?", g, extent),
            "with lengths in millimetres gravity is 9810; .UNIT says what the numbers are");
      if (is(g, 1000 * earth) && extent < small)
        diagnostics.warning(
            record.location,
            fmt::format("gravity of {:.5g} is in millimetres, and the nodes are only {:.5g} apart: metres?", g, extent),
            "with lengths in metres gravity is 9.81; .UNIT says what the numbers are");
    }
  }
}

/// A corner of a function, or an instant of a smooth pulse, where its value lies outside those at the ends of the step around it.
struct Pulse {
  double time = 0, value = 0;
  double before = 0, after = 0;  ///< times of the ends of the step
};

bool has_steps_by_error(const Model& model) {
  return model.commands.stepping.tolerance || accuracy_rung(model.commands.analysis);
}

/// The largest pulse of a function that lasts less than a step, if there is one.
std::optional<Pulse> missed_pulse(const Function& function, const deck::SteppingCard& stepping) {
  constexpr double small = 0.1;        // of the largest value
  constexpr std::size_t most = 10000;  // corners; more are a measured curve, sampled as it may be
  std::vector<double> times = function.corners(stepping.start, stepping.end, most);
  const std::vector<double> pulses = short_pulses(function, stepping.start, stepping.end, stepping.step);
  times.insert(times.end(), pulses.begin(), pulses.end());
  std::optional<Pulse> found;
  double largest = 0, outside = 0;
  for (const double t : times) {
    const double h = stepping.step, k = std::floor((t - stepping.start) / h);
    const Pulse pulse{t, function.at(t).f, stepping.start + k * h, std::min(stepping.start + (k + 1) * h, stepping.end)};
    const double a = function.at(pulse.before).f, b = function.at(pulse.after).f;
    largest = std::max({largest, std::abs(pulse.value), std::abs(a), std::abs(b)});
    const double beyond = std::max(pulse.value - std::max(a, b), std::min(a, b) - pulse.value);
    if (!std::isfinite(a + b) || beyond <= outside) continue;
    outside = beyond;
    found = pulse;
  }
  return outside > small * largest ? found : std::nullopt;
}

/// Whether steps meet jumps of speeds with a force of their own, as those do that do not end there.
bool has_steps_over_jumps(const Model& model) {
  const SolverOptions options = solver_options(model);
  return options.analysis == SolverOptions::Analysis::dynamics && !has_steps_by_error(model) &&
         !options.ends_even_steps_at_corners();
}

/// "the drive of HINGE 1"
std::string mover_of(const SpeedJump& jump, const Model& model) {
  return jump.drive ? "the drive of " + jump.drive->name() : fmt::format("the support of node {}", model.node(jump.node).id);
}

/// The warning of a speed that jumps at `time`; `cure` ends with the advice to give TOL.
Diagnostic speed_warning(const SpeedJump& jump, const Model& model, double time, const std::string& cure) {
  return {.severity = Severity::warning,
          .location = jump.drive ? jump.drive->location : Location{},
          .message = fmt::format("the speed of {} jumps by {:.4g} {} at t = {:.6g}: the {} there is infinite, and that of a step "
                                 "grows as H falls",
                                 mover_of(jump, model), jump.change, model.units.label(jump.dimension), time,
                                 jump.dimension.length == 0 ? "moment" : "force"),
          .hint = cure + ", or give TOL or SCHEME RADAU: such steps end there, and velocities change as in an impact"};
}

/// Whether a support, or the residual of an element in the reference configuration, differs from zero at `time`.
bool acts_at(const Model& model, double time) {
  for (const Support& support : model.supports)
    if (support.value != 0 && (!support.function || support.function->at(time).f != 0)) return true;
  const Vec3 gravity = model.gravity_at(time);
  std::vector<double> r;
  // loads are the last parts
  return std::any_of(model.parts.rbegin(), model.parts.rend(), [&](const Model::Part& part) {
    const ElementAtRest element(model, part);
    State state = element.view();
    state.time = time;
    state.gravity = gravity;
    r.assign(static_cast<std::size_t>(part.element->layout().slots()), 0.0);
    part.element->residual(state, r);
    return std::any_of(r.begin(), r.end(), [](double slot) { return slot != 0; });
  });
}

}  // namespace

void warn_of_no_load(const Model& model, Diagnostics& diagnostics) {
  constexpr double most = 100;  // times to look at
  if (!has_cells(model) || solver_options(model).moves()) return;
  const deck::SteppingCard& stepping = model.commands.stepping;
  const double span = stepping.end - stepping.start, steps = std::clamp(std::ceil(span / stepping.step), 1.0, most);
  for (double i = steps; i > 0; --i)
    if (acts_at(model, stepping.start + span * i / steps)) return;
  diagnostics.warning({}, fmt::format("nothing acts on the model up to t = {:g}: all results are zero", stepping.end),
                      "CHA, PRE, STRU ACC, TEMP or DEP of .CLM act, with values and functions NF that are not zero");
}

void warn_of_speed_jumps(const Model& model, Diagnostics& diagnostics) {
  if (!has_steps_over_jumps(model)) return;
  const deck::SteppingCard& stepping = model.commands.stepping;
  std::set<std::string> told;
  for (const double t : model.joints(stepping.start, stepping.end))
    if (const auto jump = speed_jump(model, t); jump && told.insert(mover_of(*jump, model)).second)
      diagnostics.add(speed_warning(*jump, model, t, "round the function off (SPLINE, or STEP of the speed)"));
}

std::optional<Diagnostic> speed_jump_warning(const Model& model, const Snapshot& memory, double time) {
  if (!has_steps_over_jumps(model)) return {};
  const auto jump = speed_jump(model, time, solve::load_speeds(model, memory, time));
  if (!jump) return {};
  return speed_warning(*jump, model, time, "give a function that begins with the speed of the restart point");
}

void warn_of_idle_initial_values(const deck::Deck& deck, Diagnostics& diagnostics) {
  const bool resumes = std::any_of(deck.records.begin(), deck.records.end(), [](const deck::Record& record) {
    const auto* card = record.get<deck::AnalysisCard>();
    return card && !card->restart.empty();
  });
  if (!resumes) return;
  for (const deck::Record& record : deck.records) {
    const auto* card = record.get<deck::InitialMotionCard>();
    if (!card) continue;
    const std::string what = "the state comes from the restart point (.SAM RESTART), and " + record.schema->name;
    const char* cure = "leave the record out, or run from the start without RESTART";
    if (card->imposed)
      diagnostics.error(record.where("IMPOSED"), what + " cannot be imposed on it", cure);
    else
      diagnostics.warning_once("idle " + record.schema->name, record.location, what + " has no effect", cure);
  }
}

void warn_of_short_pulses(const deck::Deck& deck, const Model& model, Diagnostics& diagnostics) {
  const deck::SteppingCard& stepping = model.commands.stepping;
  if (has_steps_by_error(model) || !(stepping.end - stepping.start > stepping.step)) return;
  std::vector<double> ends;  // of steps, between those at multiples of H
  if (solver_options(model).ends_even_steps_at_corners()) ends = model.corners(stepping.start, stepping.end);
  for (const deck::Record& record : deck.records) {
    if (!record.get<deck::FunctionCard>()) continue;
    const auto function = model.functions.find(record.id);
    if (function == model.functions.end() || !model.of_time.contains(function->second.get())) continue;
    const auto pulse = missed_pulse(*function->second, stepping);
    if (pulse && !std::binary_search(ends.begin(), ends.end(), pulse->time))
      diagnostics.warning(record.location,
                          fmt::format("function {} is {:.4g} at {:.6g}, and the step from {:.6g} to {:.6g} passes over that",
                                      record.id, pulse->value, pulse->time, pulse->before, pulse->after),
                          "take a shorter H, or TOL: steps that follow their error end at corners and pulses of functions");
  }
}

void warn_of_unit_slips(const deck::Deck& deck, const Model& model, Diagnostics& diagnostics) {
  const double extent = look_at_nodes(deck, model, diagnostics);
  look_at_bodies(model, extent, diagnostics);
  look_at_gravity(deck, model, extent, diagnostics);
}

}  // namespace engrane::app
