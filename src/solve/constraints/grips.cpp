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
    const Element& element = *assembler_.model().part(place.part).element;
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
    for (const GripState& state : unfollowed_grips(*assembler_.model().part(place.part).element)) grips[next++].state = state;
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

void Grips::Settling::changed(std::size_t i, bool cannot) {
  std::fill(cannot_hold.begin(), cannot_hold.end(), false);
  cannot_hold[i] = cannot;
  aims[i] = Aim();
  last = i;
}

Grips::Settling Grips::first_decisions(const Configuration& c) const {
  Settling all;
  all.grips = all.given = look(c);
  all.at_rest.resize(count_);
  all.turned.resize(count_);
  all.cannot_hold.resize(count_);
  all.aims.resize(count_);
  const double most_loaded = largest_load(all.given);
  for (std::size_t i = 0; i < count_; ++i) {
    Seen& grip = all.grips[i];
    GripState& state = grip.state;
    all.turned[i] = turns_back(grip);
    all.at_rest[i] = state.mode == GripState::free ? rests(grip) : stops(grip) || state.mode == GripState::holding;
    if (dragged(grip)) {
      state = GripState::slides_towards(grip.speed, state.held);
      all.at_rest[i] = false;
    } else if (overloaded(grip) && load(grip) >= most_loaded) {
      state = GripState::slides_towards(-grip.force, state.held);  // friction opposes sliding
    } else if (all.at_rest[i] && state.mode != GripState::holding) {
      state = GripState::holds_at(state.held + grip.place);
    } else if (state.mode == GripState::free || turns_back(grip)) {
      state = GripState::slides_towards(grip.speed, state.held);
      if (grip.shape.size > 1) state.speed = grip.speed.norm();
    }
  }
  return all;
}

std::vector<Grips::Seen> Grips::find_slips(const Settling& all, Configuration& c) {
  std::vector<Seen> slipping = all.grips;
  bool stopping = false;
  for (std::size_t i = 0; i < count_; ++i) {
    if (all.grips[i].state.mode != GripState::holding || all.given[i].state.mode == GripState::holding) continue;
    slipping[i] = all.given[i];
    stopping = true;
  }
  if (!stopping) return all.given;
  const Configuration moving = without_stopping(c, slipping);
  copy_velocities(moving, c);
  return look(moving);
}

bool Grips::turns_again(const Settling& all, std::size_t i, const Seen& now) const {
  const GripState& state = all.grips[i].state;
  return all.at_rest[i] && state.mode == GripState::sliding && !all.aims[i].tried && !still(now) &&
         now.acceleration.dot(state.direction) < 0;
}

double Grips::least_load(const Settling& all, const std::vector<Seen>& now) const {
  for (std::size_t i = 0; i < count_; ++i)
    if (turns_again(all, i, now[i])) return std::numeric_limits<double>::infinity();
  return largest_load(now);
}

bool Grips::change(Settling& all, std::size_t i, const Seen& now, double least) const {
  GripState& state = all.grips[i].state;
  bool gives_way = false;
  if (state.mode == GripState::holding) {
    gives_way = overloaded(now) && load(now) >= least;
    if (pulled(now)) {  // its speed was gained only after its event
      state = GripState::slides_towards(now.acceleration, state.held);
    } else if (dragged(now)) {
      state = GripState::slides_towards(now.speed, state.held);
    } else if (gives_way && now.redundant && all.turned[i]) {
      // a drive turns it back: how it and the drive share the load says nothing of where it slides
      state = GripState::slides_towards(all.grips[i].speed, state.held);
      all.at_rest[i] = false;
    } else if (gives_way) {
      state = GripState::slides_towards(-now.force, state.held);
    } else {
      return false;
    }
  } else if (turns_again(all, i, now)) {
    // Where friction does not act along its coordinate, as that of skew flanks on bearings, what gives way may slide with the
    // force that held it.
    state = all.cannot_hold[i] ? GripState::slides_towards(-state.direction, state.held)
                               : GripState::holds_at(state.held + now.place);
  } else {
    return false;
  }
  all.changed(i, gives_way);
  return true;
}

bool Grips::change(Settling& all, const std::vector<Seen>& now, bool together) const {
  const double least = together ? least_load(all, now) : 0;
  bool changed = false;
  for (std::size_t i = 0; i < count_ && (together || !changed); ++i)
    if (all.at_rest[i] && change(all, i, now[i], least)) changed = true;
  return changed;
}

bool Grips::aim(Settling& all, const std::vector<Seen>& now) const {
  bool changed = false;
  for (std::size_t i = 0; i < count_; ++i)
    if (all.at_rest[i] && all.grips[i].state.mode == GripState::sliding && aim(all.grips[i], now[i], all.aims[i])) changed = true;
  return changed;
}

void Grips::settle(Configuration& c, bool massless) {
  assembler_.count_turns(c);  // a place of rest may be that of the last count
  Settling all = first_decisions(c);
  const std::vector<Seen> slips = find_slips(all, c);
  // At first what comes to rest is changed at once, and then the most loaded gives way, as it would under a growing load: where
  // friction is less once it slides, the others may hold. Later one grip is changed at a time, always the first in the deck: a
  // rule that returns to no combination except equivalent ones. Directions are adjusted once nothing else is wrong.
  const std::size_t together = 3 + 2 * count_, most = 3 + 20 * count_;
  for (std::size_t pass = 0, aimed = 0; pass < most && aimed < most;) {
    write(all.grips, c);
    const Configuration before = c;
    try {
      fit(c, massless);
    } catch (const SolutionFailure&) {
      // What sticks pushes in a direction that may let no forces balance.
      const std::size_t i = first_that_holds(all);
      if (i == count_ || ++pass == most) throw;
      c = before;
      Seen& grip = all.grips[i];
      grip.state = GripState::slides_towards(all.turned[i] ? grip.speed : Vec3::UnitX(), grip.state.held);
      all.changed(i, true);
      continue;
    }
    const std::vector<Seen> now = look(c);
    if (const std::size_t blocked = unstoppable(slips, now, before, c); blocked < count_) {
      copy_velocities(before, c);
      GripState& state = all.grips[blocked].state;
      state = GripState::slides_towards(slips[blocked].speed, state.held);
      all.at_rest[blocked] = false;
      all.changed(blocked, all.cannot_hold[blocked]);
      ++pass;
    } else if (change(all, now, pass < together)) {
      ++pass;
    } else if (aim(all, now)) {
      ++aimed;
    } else {
      return;
    }
  }
  throw SolutionFailure(
      fmt::format("t = {:.6g}: no combination of sticking and sliding contacts satisfies the equations; {} is one of them. "
                  "Check whether contacts jam one another",
                  c.time, name(all.last)));
}

std::size_t Grips::first_that_holds(const Settling& all) {
  std::size_t i = 0;
  while (i < all.grips.size() && !(all.at_rest[i] && all.grips[i].state.mode == GripState::holding)) ++i;
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
