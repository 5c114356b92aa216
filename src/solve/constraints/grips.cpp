// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/grips.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "solve/constraints/constraint_factors.hpp"

namespace engrane::solve {

namespace {

/// A speed closer to zero than this part of the speeds it is the difference of is rest.
constexpr double rounding = 1e-12;
/// A force beyond what holds by this part of it is rounding.
constexpr double slack = 1e-9;
/// A grip that bears more than this part of what it holds may give way within the next step.
constexpr double near = 0.8;

/// The largest speed and acceleration of any node, or of its turning: what is rounding beside them is none.
struct Fastest {
  double speed = 0, acceleration = 0;
};

GripState::Mode towards(double value) { return value < 0 ? GripState::backward : GripState::forward; }

}  // namespace

Grips::Grips(Assembler& assembler, Redundancy& redundancy, Start& start)
    : assembler_(assembler), redundancy_(redundancy), start_(start) {
  const auto& parts = assembler.model().parts;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const Layout& layout = parts[p].element->layout();
    if (layout.grips == 0) continue;
    const auto part = static_cast<int>(p);
    places_.push_back({part, layout.grips, assembler.numbering().multiplier_begin(part) + layout.first_grip()});
    count_ += static_cast<std::size_t>(layout.grips);
  }
}

bool Grips::rests(const Seen& grip) { return std::abs(grip.speed) <= rounding * grip.speeds; }

bool Grips::overloaded(const Seen& grip) {
  return grip.state.mode == GripState::holding && std::abs(grip.force) > (1 + slack) * grip.limit;
}

bool Grips::dragged(const Seen& grip) {
  return grip.state.mode == GripState::holding && grip.redundant && std::abs(grip.speed) > slack * grip.speeds;
}

bool Grips::pulled(const Seen& grip) {
  return grip.state.mode == GripState::holding && grip.redundant && std::abs(grip.acceleration) > slack * grip.accelerations;
}

bool Grips::turns_back(const Seen& grip) { return grip.state.slides() && grip.speed * grip.state.direction() < 0; }

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
    const auto count = static_cast<std::size_t>(place.count);
    const Element& element = *assembler_.model().parts[static_cast<std::size_t>(place.part)].element;
    found.resize(count);
    find_grips(element, assembler_.view(place.part, c), found);
    for (std::size_t i = 0; i < count; ++i) {
      const int multiplier = place.first + static_cast<int>(i);
      const bool length = multiplier_unknown(assembler_.numbering(), multiplier).measure == Measure::length;
      const Fastest& fastest = length ? moving : turning;
      Seen& seen = grips[next++];
      static_cast<Grip&>(seen) = found[i];
      seen.redundant = assembler_.released(multiplier) && !assembler_.idle(multiplier);
      seen.speeds = std::max(seen.speeds, fastest.speed);
      seen.accelerations = std::max(seen.accelerations, fastest.acceleration);
    }
  }
  return grips;
}

void Grips::write(const std::vector<Seen>& grips, Configuration& c) {
  std::vector<int> idle;
  std::size_t next = 0;
  for (const Place& place : places_) {
    const auto size =
        static_cast<std::size_t>(assembler_.model().parts[static_cast<std::size_t>(place.part)].element->layout().history);
    const auto history =
        std::span(c.history).subspan(static_cast<std::size_t>(assembler_.numbering().history_begin(place.part)), size);
    for (int i = 0; i < place.count; ++i) {
      const GripState& state = grips[next++].state;
      state.write(history, place.count, i);
      if (state.mode == GripState::holding) continue;
      idle.push_back(place.first + i);
      c.multipliers[static_cast<std::size_t>(place.first + i)] = 0;
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
    return grip.state.mode == GripState::holding && std::abs(grip.force) > near * grip.limit;
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
  StartReport unused;
  start_.fit_velocities(c, Assembler::Metric::mass, unused, false);
  std::optional<MasslessMotions> none;
  if (massless) none.emplace(assembler_, c);
  start_.balance_accelerations(c, 12, nullptr, none ? &*none : nullptr);
}

void Grips::settle(Configuration& c, bool massless) {
  std::vector<Seen> grips = look(c);
  // those at rest may hold or slide either way; the others slide on
  std::vector<bool> at_rest(count_);
  for (std::size_t i = 0; i < count_; ++i) {
    Seen& grip = grips[i];
    GripState& state = grip.state;
    at_rest[i] = state.mode == GripState::free ? rests(grip) : turns_back(grip) || state.mode == GripState::holding;
    if (dragged(grip)) {
      state.mode = towards(grip.speed);
      at_rest[i] = false;
    } else if (overloaded(grip)) {
      state.mode = towards(-grip.force);  // friction is against sliding
    } else if (at_rest[i] && state.mode != GripState::holding) {
      state = {GripState::holding, state.held + grip.place};
    } else if (state.mode == GripState::free) {
      state.mode = towards(grip.speed);
    }
  }
  // All that is wrong is changed at once first, then one at a time, always the first in the deck: a rule that comes back to no
  // combination but those of equal right.
  const std::size_t together = 3 + count_, most = 3 + 20 * count_;
  std::size_t last = 0;  // that was changed
  for (std::size_t pass = 0; pass < most; ++pass) {
    write(grips, c);
    fit(c, massless);
    const std::vector<Seen> now = look(c);
    bool changed = false;
    for (std::size_t i = 0; i < count_ && !(changed && pass >= together); ++i) {
      if (!at_rest[i]) continue;
      GripState& state = grips[i].state;
      const Seen& grip = now[i];
      if (state.mode == GripState::holding) {
        if (pulled(grip))  // what speed it has is that of the time past its event
          state.mode = towards(grip.acceleration);
        else if (dragged(grip))
          state.mode = towards(grip.speed);
        else if (overloaded(grip))
          state.mode = towards(-grip.force);
        else
          continue;
      } else if (grip.acceleration * state.direction() < 0) {
        state = {GripState::holding, state.held + grip.place};
      } else {
        continue;
      }
      changed = true;
      last = i;
    }
    if (!changed) return;
  }
  throw SolutionFailure(
      fmt::format("t = {:.6g}: no combination of sticking and sliding contacts satisfies the equations; {} is one of them. "
                  "Check whether contacts jam one another",
                  c.time, name(last)));
}

std::string Grips::name(std::size_t grip) const {
  for (const Place& place : places_) {
    if (grip < static_cast<std::size_t>(place.count)) {
      const Model::Part& part = assembler_.model().parts[static_cast<std::size_t>(place.part)];
      return fmt::format("{} {}", part.type, part.element->id());
    }
    grip -= static_cast<std::size_t>(place.count);
  }
  return {};
}

}  // namespace engrane::solve
