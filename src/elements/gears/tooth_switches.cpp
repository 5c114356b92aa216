// SPDX-License-Identifier: BSD-3-Clause
// Where the forces of ToothContact are not smooth.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "elements/gears/tooth_contact.hpp"
#include "math/angle.hpp"

namespace engrane::elements::gears {

void ToothContact::set_corners() {
  const auto add = [&](TurnCorners set) {
    if (set.corners.count() > 0) corners_.push_back(std::move(set));
  };
  const TransmissionError& error = law_.error;
  const auto of_wheel = [&](const Function& function, const char* of, std::size_t wheel) {
    add({LawCorners(function), of, wheel, 1 / degree, -law_.mesh.contact[wheel] / degree});
  };
  if (error.kind == TransmissionError::Kind::table) of_wheel(*error.function, "ERR", 0);
  if (error.wheel[0].pitch) of_wheel(*error.wheel[0].pitch, "PITCHA", 0);
  if (error.wheel[1].pitch) of_wheel(*error.wheel[1].pitch, "PITCHB", 1);

  const double pitches = geometry_.teeth / whole_turn, place = law_.mesh.phase / whole_turn;
  // slices of helical teeth pass each corner in turn, with a part of the load: hardly a corner of their sum
  const bool at_once = options_.slices == 1 || geometry_.helix == 0;
  if (law_.course.kind == MeshStiffness::Kind::table && at_once)
    add({LawCorners(*law_.course.function), "STIFF", 0, pitches, place});
  std::vector<double> starts;
  for (const ToothRelief::Ramp& r : law_.relief.ramps)
    if (r.exponent < 2) starts.push_back(law_.relief.start(r) / law_.relief.base_pitch);
  for (const int flank : {1, -1})
    add({LawCorners(starts, 1), flank == 1 ? "relief of front flanks" : "relief of back flanks", 0, flank * pitches,
         flank * place + law_.relief.flank, flank});
}

std::vector<SwitchNames> ToothContact::switch_names() const {
  std::vector<SwitchNames> list;
  const auto add_corner = [&](const std::string& where) {
    list.push_back({where + " touches", where + " parts"});
    if (law_.onset > 0) list.push_back({where + " is in full contact", where + " begins to part"});
  };
  for (const char* side : {"front", "back"}) {
    if (!parts()) break;
    const std::string flank = side + std::string(" flank");
    if (law_.relief.active())
      for (int i = 1; i <= law_.most_pairs(); ++i) add_corner(fmt::format("{}, pair {},", flank, i));
    if (options_.slices > 1)
      for (int i = 1; i <= options_.slices; ++i) add_corner(fmt::format("{}, slice {},", flank, i));
    if (corner_at_middle()) add_corner(flank);
    if (!limits_damping()) continue;
    list.push_back({flank + " damps in full", flank + " damps no more than it may"});
    list.push_back({flank + " presses again", flank + " presses no more"});
  }
  if (turns_load())
    list.push_back({"load changes to the front flank", "load changes to the back flank", true, elastic() ? -1 : 0});
  for (const TurnCorners& set : corners_) set.corners.name(list, set.of);
  return list;
}

double ToothContact::size_of_gap(const ContactReport& report, const State& state) const {
  // u_m is a difference of angles that are known to the rounding error of a radian
  return geometry_.radius + law_.backlash + std::abs(state.scalars[2]) + std::abs(report.approach - state.scalars[2]);
}

bool ToothContact::touches(const ContactReport& report, const State& state) const {
  const double half = 0.5 * law_.onset, size = size_of_gap(report, state);
  return Switch{report.front + half, 0, size}.unclear() || Switch{report.back + half, 0, size}.unclear();
}

void ToothContact::switches(const ContactReport& report, const State& state, std::span<Switch> values) const {
  if (!elastic()) {
    // elements know neither the rates of multipliers nor what iterations leave of them
    if (turns_load()) values[0] = {state.multipliers[0], std::numeric_limits<double>::quiet_NaN(), 0};
    return;
  }
  const Function::Jet error_a = law_.error.of_a(state.scalars[0], law_.mesh),
                      error_b = law_.error.of_b(state.scalars[1], law_.mesh);
  const double turn_a = state.scalar_rates[0], turn_b = state.scalar_rates[1];
  const double rate = state.scalar_rates[2] + error_a.d1 * turn_a + error_b.d1 * turn_b;
  const double acceleration = state.scalar_accelerations[2] + error_a.d1 * state.scalar_accelerations[0] +
                              error_b.d1 * state.scalar_accelerations[1] + error_a.d2 * turn_a * turn_a +
                              error_b.d2 * turn_b * turn_b;
  const double half = 0.5 * law_.onset, size = size_of_gap(report, state), k = report.stiffness_factor * law_.stiffness;
  std::size_t next = 0;
  const auto put_corner = [&](double pressed, double speed, double magnitude) {
    values[next++] = {pressed + half, speed, magnitude};
    if (half > 0) values[next++] = {pressed - half, speed, magnitude};
  };
  for (const double sign : {1.0, -1.0}) {
    if (!parts()) break;
    const bool front = sign > 0;
    const double pressed = front ? report.front : report.back, speed = sign * rate;
    if (law_.relief.active()) {
      const double z = geometry_.teeth;
      auto pairs = law_.pair_depths(z * state.scalars[0] + law_.mesh.phase, pressed, !front);
      pairs.resize(static_cast<std::size_t>(law_.most_pairs()));
      for (const ToothLaw::PairDepth& pair : pairs)
        put_corner(pair.weighted, pair.by_depth * speed + pair.by_phase * z * turn_a, pair.by_depth > 0 ? size : 0);
    }
    if (options_.slices > 1)
      for (const ContactReport::Slice& slice : report.slices) put_corner(front ? slice.front : slice.back, speed, size);
    if (corner_at_middle()) put_corner(pressed, speed, size);
    if (!limits_damping()) continue;
    const Function::Jet flank = law_.flank(pressed);
    const double damper = law_.damping * speed, change = sign * law_.damping * acceleration;
    for (const double part : {1 - ToothLaw::limit_rounding, 1 + ToothLaw::limit_rounding})
      values[next++] = pressed > half ? Switch{part * k * flank.f + damper, part * k * flank.d1 * speed + change,
                                               k * pressed + std::abs(damper)}
                                      : Switch{};
  }
  if (turns_load()) {
    const double of_damping = std::abs(state.scalar_rates[2]) + geometry_.radius * std::abs(turn_a);
    values[next++] = {report.load, k * law_.deflection(report.approach).d1 * rate + law_.damping * state.scalar_accelerations[2],
                      k * size + law_.damping * of_damping};
  }
  for (const TurnCorners& set : corners_) {
    // whole turns do count: the sign of such a switch is opposite behind each corner and repeats after two periods
    const double psi = state.scalars[set.wheel] + whole_turn * std::remainder(state.history[set.wheel], 2),
                 turned = set.slope * psi;
    const Taylor x{set.offset + turned, set.slope * state.scalar_rates[set.wheel],
                   set.slope * state.scalar_accelerations[set.wheel]};
    const std::span<Switch> own = values.subspan(next, set.corners.count());
    next += set.corners.switches(x, state.time, std::abs(set.offset) + std::abs(turned), own);
    if (set.flank != 0 && (set.flank > 0 ? report.front : report.back) <= 0) std::fill(own.begin(), own.end(), Switch{});
  }
}

}  // namespace engrane::elements::gears
