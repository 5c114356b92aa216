// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/grips.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "solve/constraints/constraint_factors.hpp"

namespace engrane::solve {

namespace {

/// A grip is at rest if its speed is below this fraction of the speeds that it is the difference of.
constexpr double rounding = 1e-12;
/// Accuracy of positions, over the extent or in radians.
constexpr double place_rounding = 1e-14;
/// Differences below this fraction of their terms are rounding.
constexpr double slack = GripState::slack;
/// A grip that carries more than this fraction of its limit may give way within the next step.
constexpr double near = 0.8;

/// Largest speed and acceleration of any node, or of its rotation: what is rounding beside them counts as zero.
struct Fastest {
  double speed = 0, acceleration = 0;
};

void copy_velocities(const Configuration& from, Configuration& to) {
  for (std::size_t n = 0; n < to.nodes.size(); ++n) {
    to.nodes[n].v = from.nodes[n].v;
    to.nodes[n].W = from.nodes[n].W;
  }
  to.scalar_rates = from.scalar_rates;
}

}  // namespace

Grips::Grips(Assembler& assembler, Redundancy& redundancy, Start& start, const SolverOptions& options)
    : assembler_(assembler),
      redundancy_(redundancy),
      start_(start),
      step_(options.step),
      longest_(options.tolerance > 0 ? options.longest : options.step),
      rest_(place_rounding * assembler.model().extent() / std::max(options.end - options.begin, options.step)) {
  const auto& parts = assembler.model().parts;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const Layout& layout = parts[p].element->layout();
    if (layout.grips.empty()) continue;
    const auto part = static_cast<int>(p);
    places_.push_back({part, assembler.numbering().multiplier_begin(part) + layout.grip_row(), &layout});
    count_ += layout.grips.size();
  }
}

bool Grips::rests(const Seen& grip) { return grip.speed.norm() <= std::max(rounding * grip.speeds, grip.state.rest); }

bool Grips::overloaded(const Seen& grip) { return grip.state.mode == GripState::holding && grip.spare() < 0; }

double Grips::load(const Seen& grip) { return grip.force.norm() / grip.limit; }

double Grips::largest_load(const std::vector<Seen>& grips) {
  double largest = 0;
  for (const Seen& grip : grips)
    if (overloaded(grip)) largest = std::max(largest, load(grip));
  return std::min((1 - slack) * largest, std::numeric_limits<double>::max());
}

bool Grips::dragged(const Seen& grip) {
  return grip.state.mode == GripState::holding && grip.redundant && grip.speed.norm() > slack * grip.speeds;
}

bool Grips::pulled(const Seen& grip) {
  return grip.state.mode == GripState::holding && grip.redundant && grip.acceleration.norm() > slack * grip.accelerations;
}

bool Grips::still(const Seen& now) const {
  return now.acceleration.norm() <= std::max(rounding * now.accelerations, rest_ / step_);
}

bool Grips::turns_back(const Seen& grip) {
  return grip.state.mode == GripState::sliding && grip.speed.dot(grip.state.direction) < -grip.state.rest;
}

bool Grips::stops(const Seen& grip) {
  const Vec3& direction = grip.state.direction;
  const Vec3 aside = grip.speed - direction * direction.dot(grip.speed);
  return turns_back(grip) && (grip.shape.size == 1 || aside.norm() <= GripState::halt * grip.state.speed);
}

std::vector<Grips::Seen> Grips::look(const Configuration& c) const {
  Fastest moving, turning;
  for (const NodeState& node : c.nodes) {
    moving = {std::max(moving.speed, node.v.norm()), std::max(moving.acceleration, node.a.norm())};
    turning = {std::max(turning.speed, node.W.norm()), std::max(turning.acceleration, node.A.norm())};
  }
  std::vector<Seen> grips(count_);
  std::vector<Grip> found;
  std::size_t next = 0;
  for (const Place& place : places_) {
    const std::size_t count = place.layout->grips.size();
    const Element& element = *assembler_.model().parts[static_cast<std::size_t>(place.part)].element;
    found.resize(count);
    find_grips(element, assembler_.view(place.part, c), found);
    int multiplier = place.first;
    for (std::size_t i = 0; i < count; ++i) {
      Seen& seen = grips[next++];
      static_cast<Grip&>(seen) = found[i];
      seen.state.rest = rest_;
      for (std::size_t k = 0; k < static_cast<std::size_t>(found[i].shape.size); ++k, ++multiplier) {
        const bool length = assembler_.numbering().multiplier(multiplier).measure == Measure::length;
        const Fastest& fastest = length ? moving : turning;
        const double lever = found[i].shape.lever[k];
        // where all is at rest the fastest node is rounding, too
        const double rest = place_rounding / slack * (length ? assembler_.model().extent() : 1) / step_;
        seen.redundant = seen.redundant || (assembler_.released(multiplier) && !assembler_.idle(multiplier));
        seen.speeds = std::max(seen.speeds, lever * std::max(fastest.speed, rest));
        seen.accelerations = std::max(seen.accelerations, lever * std::max(fastest.acceleration, rest / step_));
      }
    }
  }
  return grips;
}

void Grips::write(const std::vector<Seen>& grips, Configuration& c) {
  std::vector<int> idle;
  std::size_t next = 0;
  for (const Place& place : places_) {
    const auto history = std::span(c.history).subspan(static_cast<std::size_t>(assembler_.numbering().history_begin(place.part)),
                                                      static_cast<std::size_t>(place.layout->history));
    int multiplier = place.first;
    for (std::size_t i = 0; i < place.layout->grips.size(); ++i) {
      Seen grip = grips[next++];
      grip.state.rest = rest_;
      grip.state.write(*place.layout, history, i);
      for (int k = 0; k < grip.shape.size; ++k, ++multiplier) {
        if (grip.state.mode == GripState::holding) continue;
        idle.push_back(multiplier);
        c.multipliers[static_cast<std::size_t>(multiplier)] = 0;
      }
    }
  }
  assembler_.set_idle(idle);
}

bool Grips::violated(const Configuration& c) const {
  if (!any()) return false;
  const std::vector<Seen> grips = look(c);
  return std::any_of(grips.begin(), grips.end(), [](const Seen& grip) {
    return grip.state.mode == GripState::free || turns_back(grip) || overloaded(grip) || dragged(grip);
  });
}

bool Grips::strained(const Configuration& c) const {
  if (!any()) return false;
  const std::vector<Seen> grips = look(c);
  return std::any_of(grips.begin(), grips.end(), [](const Seen& grip) {
    return grip.state.mode == GripState::holding && grip.force.norm() > near * grip.limit;
  });
}

void Grips::let_go(Configuration& c) {
  if (!any()) return;
  std::vector<Seen> grips = look(c);
  std::size_t next = 0;
  for (const Place& place : places_)
    for (const GripState& state : unfollowed_grips(*assembler_.model().parts[static_cast<std::size_t>(place.part)].element))
      grips[next++].state = state;
  write(grips, c);
  redundancy_.analyse(c);
}

void Grips::fit(Configuration& c, bool massless) {
  redundancy_.analyse(c);
  start_.project_velocities(c, Assembler::Metric::mass);
  std::optional<MasslessMotions> none;
  if (massless) none.emplace(assembler_, c);
  start_.balance_accelerations(c, 12, nullptr, none ? &*none : nullptr);
}

bool Grips::aim(Seen& grip, const Seen& now, Aim& aim) const {
  constexpr double step = 1e-3, aligned = 1e-9;
  if (grip.shape.size == 1 || aim.found || still(now)) return false;
  Vec3& direction = grip.state.direction;
  const Vec3& a = now.acceleration;
  const Vec3 beside = a - direction * direction.dot(a);
  if (aim.tried) aim.slope = std::max(aim.slope, (a - aim.acceleration).norm() / (direction - aim.direction).norm());
  // friction that barely gives way makes the acceleration depend on the direction much more than on the pull
  aim.found = beside.norm() <= aligned * std::max(a.norm(), aim.slope);
  if (aim.found) return false;
  aim.direction = direction;
  aim.acceleration = a;
  direction = (direction + (aim.tried ? Vec3(a / aim.slope) : Vec3(beside.normalized() * step))).normalized();
  aim.tried = true;
  return true;
}

Configuration Grips::without_stopping(const Configuration& c, const std::vector<Seen>& grips) {
  Configuration moving = c;
  write(grips, moving);
  try {
    redundancy_.analyse(moving);
    start_.project_velocities(moving, Assembler::Metric::mass);
  } catch (const SolutionFailure&) {
    copy_velocities(c, moving);
  }
  return moving;
}

double Grips::energy_of_change(const Configuration& from, const Configuration& to) const {
  const auto& parts = assembler_.model().parts;
  Configuration change = to;
  double energy = 0;
  const auto add = [&](double sign) {
    for (std::size_t p = 0; p < parts.size(); ++p)
      energy += sign * parts[p].element->energies(assembler_.view(static_cast<int>(p), change)).kinetic;
  };
  for (std::size_t n = 0; n < change.nodes.size(); ++n) {
    change.nodes[n].v -= from.nodes[n].v;
    change.nodes[n].W -= from.nodes[n].W;
  }
  for (std::size_t i = 0; i < change.scalar_rates.size(); ++i) change.scalar_rates[i] -= from.scalar_rates[i];
  add(1);
  for (NodeState& node : change.nodes) node.v = node.W = Vec3::Zero();
  std::fill(change.scalar_rates.begin(), change.scalar_rates.end(), 0.0);
  add(-1);
  return energy;
}

std::size_t Grips::unstoppable(const std::vector<Seen>& slips, const std::vector<Seen>& now, const Configuration& before,
                               const Configuration& after) const {
  // What an impulse P stops loses the energy P u/2, and friction has no more than its limit times the length of a step.
  double can_take = 0;
  std::size_t fastest = count_;
  for (std::size_t i = 0; i < count_; ++i) {
    const double speed = slips[i].speed.norm();
    if (now[i].state.mode != GripState::holding || slips[i].state.mode == GripState::holding || speed == 0) continue;
    // what holds beside a dead centre has another normal force, out of all proportion
    can_take += 0.5 * (slips[i].state.mode == GripState::free ? now[i] : slips[i]).limit * longest_ * speed;
    if (fastest == count_ || speed > slips[fastest].speed.norm()) fastest = i;
  }
  return fastest < count_ && energy_of_change(before, after) > can_take ? fastest : count_;
}

void Grips::settle(Configuration& c, bool massless) {
  assembler_.count_turns(c);  // a place of rest may be that of the last count
  std::vector<Seen> grips = look(c);
  const std::vector<Seen> given = grips;
  // those at rest may hold, or slide in any direction; the others slide on
  std::vector<bool> at_rest(count_), turned(count_);
  const double most_loaded = largest_load(grips);
  for (std::size_t i = 0; i < count_; ++i) {
    Seen& grip = grips[i];
    GripState& state = grip.state;
    turned[i] = turns_back(grip);
    at_rest[i] = state.mode == GripState::free ? rests(grip) : stops(grip) || state.mode == GripState::holding;
    if (dragged(grip)) {
      state = GripState::slides_towards(grip.speed, state.held);
      at_rest[i] = false;
    } else if (overloaded(grip) && load(grip) >= most_loaded) {
      state = GripState::slides_towards(-grip.force, state.held);  // friction opposes sliding
    } else if (at_rest[i] && state.mode != GripState::holding) {
      state = GripState::holds_at(state.held + grip.place);
    } else if (state.mode == GripState::free || turns_back(grip)) {
      state = GripState::slides_towards(grip.speed, state.held);
      if (grip.shape.size > 1) state.speed = grip.speed.norm();
    }
  }
  // At first what comes to rest is changed at once, and then the most loaded gives way, as it would under a growing load: where
  // friction is less once it slides, the others may hold. Later one grip is changed at a time, always the first in the deck: a
  // rule that returns to no combination except equivalent ones. Directions are adjusted once nothing else is wrong.
  const std::size_t together = 3 + 2 * count_, most = 3 + 20 * count_;
  std::size_t last = 0;                // grip that was changed
  std::vector<Seen> slipping = grips;  // but what comes to rest slides on
  bool stopping = false;
  for (std::size_t i = 0; i < count_; ++i) {
    if (grips[i].state.mode != GripState::holding || given[i].state.mode == GripState::holding) continue;
    slipping[i] = given[i];
    stopping = true;
  }
  std::vector<Seen> slips = given;
  if (stopping) {
    const Configuration moving = without_stopping(c, slipping);
    slips = look(moving);
    copy_velocities(moving, c);
  }
  std::vector<Aim> aims(count_);
  std::vector<bool> cannot_hold(count_);  // while the other grips are as they are
  const auto changes = [&](std::size_t i) {
    for (std::size_t k = 0; k < count_; ++k) cannot_hold[k] = cannot_hold[k] && k == i;
    last = i;
    aims[i] = Aim();
  };
  for (std::size_t pass = 0, aimed = 0; pass < most && aimed < most;) {
    write(grips, c);
    const Configuration before = c;
    try {
      fit(c, massless);
    } catch (const SolutionFailure&) {
      // What sticks pushes in a direction that may let no forces balance.
      const std::size_t i = first_that_holds(grips, at_rest);
      if (i == count_ || ++pass == most) throw;
      c = before;
      grips[i].state = GripState::slides_towards(turned[i] ? grips[i].speed : Vec3::UnitX(), grips[i].state.held);
      changes(i);
      cannot_hold[i] = true;
      continue;
    }
    const std::vector<Seen> now = look(c);
    if (const std::size_t blocked = unstoppable(slips, now, before, c); blocked < count_) {
      copy_velocities(before, c);
      grips[blocked].state = GripState::slides_towards(slips[blocked].speed, grips[blocked].state.held);
      at_rest[blocked] = false;
      changes(blocked);
      ++pass;
      continue;
    }
    const auto turns_again = [&](std::size_t i) {
      return at_rest[i] && grips[i].state.mode == GripState::sliding && !aims[i].tried && !still(now[i]) &&
             now[i].acceleration.dot(grips[i].state.direction) < 0;
    };
    double least_load = 0;  // with which a grip gives way
    if (pass < together) {
      least_load = largest_load(now);
      for (std::size_t i = 0; i < count_; ++i)
        if (turns_again(i)) least_load = std::numeric_limits<double>::infinity();
    }
    bool changed = false;
    for (std::size_t i = 0; i < count_ && !(changed && pass >= together); ++i) {
      if (!at_rest[i]) continue;
      GripState& state = grips[i].state;
      const Seen& grip = now[i];
      bool gives_way = false;
      if (state.mode == GripState::holding) {
        gives_way = overloaded(grip) && load(grip) >= least_load;
        if (pulled(grip))  // its speed was gained only after its event
          state = GripState::slides_towards(grip.acceleration, state.held);
        else if (dragged(grip))
          state = GripState::slides_towards(grip.speed, state.held);
        else if (gives_way && grip.redundant && turned[i]) {
          // a drive turns it back: how it and the drive share the load says nothing of where it slides
          state = GripState::slides_towards(grips[i].speed, state.held);
          at_rest[i] = false;
        } else if (gives_way)
          state = GripState::slides_towards(-grip.force, state.held);
        else
          continue;
      } else if (turns_again(i)) {
        // Where friction does not act along its coordinate, as that of skew flanks on bearings, what gives way may slide with
        // the force that held it.
        if (cannot_hold[i])
          state = GripState::slides_towards(-state.direction, state.held);
        else
          state = GripState::holds_at(state.held + grip.place);
      } else {
        continue;
      }
      changed = true;
      changes(i);
      cannot_hold[i] = gives_way;
    }
    if (changed) {
      ++pass;
      continue;
    }
    for (std::size_t i = 0; i < count_; ++i)
      if (at_rest[i] && grips[i].state.mode == GripState::sliding && aim(grips[i], now[i], aims[i])) changed = true;
    if (!changed) return;
    ++aimed;
  }
  throw SolutionFailure(
      fmt::format("t = {:.6g}: no combination of sticking and sliding contacts satisfies the equations; {} is one of them. "
                  "Check whether contacts jam one another",
                  c.time, name(last)));
}

std::size_t Grips::first_that_holds(const std::vector<Seen>& grips, const std::vector<bool>& at_rest) {
  std::size_t i = 0;
  while (i < grips.size() && !(at_rest[i] && grips[i].state.mode == GripState::holding)) ++i;
  return i;
}

std::string Grips::name(std::size_t grip) const {
  for (const Place& place : places_) {
    if (grip < place.layout->grips.size()) return assembler_.model().part(place.part).name();
    grip -= place.layout->grips.size();
  }
  return {};
}

}  // namespace engrane::solve
