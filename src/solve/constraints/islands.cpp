// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/islands.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace engrane::solve {

namespace {

using Vector = Eigen::VectorXd;

/// An island on its way to a position where its constraints are closed again.
struct Returning {
  enum class State { stays, closes, closed } state = State::stays;
  double open = 0, before = 0;
  bool slow = false;  ///< whether the last iteration that says so has hardly closed it
};

/// `most` becomes the larger one, and remains NaN once it is.
void raise_to(double value, double& most) {
  if (!std::isnan(most) && !(value <= most)) most = value;
}

}  // namespace

Islands::Islands(const Assembler& assembler) {
  const Numbering& numbering = assembler.numbering();
  motion_slots_ = static_cast<std::size_t>(numbering.motion_slots());
  of_slot_.resize(static_cast<std::size_t>(numbering.slots()));
  std::iota(of_slot_.begin(), of_slot_.end(), std::size_t{0});
  for (std::size_t i = 0; i < 6 * assembler.model().nodes.size(); ++i) of_slot_[i] = i - i % 6;
  const auto leader_of = [&](std::size_t i) {
    while (of_slot_[i] != i) i = of_slot_[i] = of_slot_[of_slot_[i]];
    return i;
  };
  for (int p = 0; p < numbering.parts(); ++p) {
    const auto slots = numbering.part_slots(p);
    const std::size_t count = assembler.model().part(p).element->layout().multipliers.size();
    if (count == 0) continue;
    const std::size_t leader = leader_of(static_cast<std::size_t>(slots.back()));
    for (std::size_t i = 0; i < slots.size(); ++i)  // what is held joins nothing
      if (i + count >= slots.size() || numbering.equation(slots[i]) >= 0)
        of_slot_[leader_of(static_cast<std::size_t>(slots[i]))] = leader;
  }
  std::vector<std::size_t> leaders(of_slot_.size()), number(of_slot_.size(), of_slot_.size());
  for (std::size_t i = 0; i < leaders.size(); ++i) leaders[i] = leader_of(i);
  for (std::size_t i = 0; i < leaders.size(); ++i) {
    std::size_t& mine = number[leaders[i]];
    if (mine == number.size()) mine = count_++;
    of_slot_[i] = mine;
  }
}

bool move_along(Assembler& assembler, const MotionSlots& motion, const Islands& islands, const ConstraintFactors& here,
                Configuration& c, double tolerance) {
  // Near a regular position an iteration closes a gap by orders of magnitude. Near a singular one it goes half the way back to
  // it, and a quarter of the gap remains: such an island comes to rest almost where it began.
  constexpr double hardly = 0.05, above_rounding = 1e-12;
  using State = Returning::State;
  const auto island_of_row = [&](Eigen::Index i) { return islands.of_slot(here.motions().slot[static_cast<std::size_t>(i)]); };
  const auto largest_of_each = [&](const Vector& way) {
    std::vector<double> largest(islands.count(), 0.0);
    for (Eigen::Index i = 0; i < way.size(); ++i) raise_to(std::abs(way[i]), largest[island_of_row(i)]);
    return largest;
  };
  // any generic direction will do
  Vector wish(here.rows());
  for (Eigen::Index i = 0; i < wish.size(); ++i) wish[i] = std::sin(1.0 + 2.3 * static_cast<double>(i * i % 1009));
  const Vector way = here.possible_motion(wish);
  const std::vector<double> way_of = largest_of_each(way);
  std::vector<Returning> ways(islands.count());
  for (const int m : here.dependent())
    if (const std::size_t k = islands.of_multiplier(m); way_of[k] > 1e-6) ways[k].state = State::closes;
  const auto any = [&](State state) {
    return std::any_of(ways.begin(), ways.end(), [&](const Returning& one) { return one.state == state; });
  };

  const Configuration start = c;
  std::vector<double> y(motion.size(), 0.0);
  const auto move = [&](const ConstraintFactors& factors, Vector by, auto&& factor_of) {
    for (Eigen::Index i = 0; i < by.size(); ++i) {
      const std::size_t k = island_of_row(i);
      by[i] = ways[k].state == State::closes ? by[i] * factor_of(k) : 0;
    }
    std::fill(y.begin(), y.end(), 0.0);
    factors.to_slots(by, y);
    Configuration moved = c;
    motion.move(c, y, moved);
    c = at_start_of_step(std::move(moved));
  };
  // returns those that did not close, all at once
  const auto return_to_start = [&] {
    const auto stays = [&](std::size_t slot) { return ways[islands.of_slot(slot)].state == State::stays; };
    const std::size_t scalars = 6 * c.nodes.size();
    for (std::size_t n = 0; n < c.nodes.size(); ++n)
      if (stays(6 * n)) c.nodes[n] = start.nodes[n];
    for (std::size_t i = 0; i < c.scalars.size(); ++i)
      if (stays(scalars + i)) c.scalars[i] = start.scalars[i];
    for (std::size_t i = 0; i < c.remainders.size(); ++i)
      if (stays(i)) c.remainders[i] = start.remainders[i];
  };

  move(here, way, [&](std::size_t k) { return 0.02 / way_of[k]; });
  std::optional<ConstraintFactors> factors;
  bool renewed = false;
  for (int iteration = 0; iteration < 12 && any(State::closes); ++iteration) {
    const std::vector<double> phi = assembler.violations(c);
    const Vector relative = relative_open(assembler, phi);
    for (Returning& one : ways) one.before = std::exchange(one.open, 0.0);
    for (Eigen::Index m = 0; m < relative.size(); ++m)
      raise_to(relative[m], ways[islands.of_multiplier(static_cast<int>(m))].open);
    // factors are reused while the gaps shrink a hundredfold each time
    bool renew = !factors;
    bool failed = false;
    for (Returning& one : ways) {
      if (one.state != State::closes) continue;
      if (renewed && one.before > above_rounding) one.slow = one.open > hardly * one.before;
      if (!std::isfinite(one.open) || (one.open < 1e-13 && one.slow)) {
        one.state = State::stays;
        failed = true;
      } else if (one.open < 1e-13) {
        one.state = State::closed;
      } else if (one.open > 1e-2 * one.before) {
        renew = true;
      }
    }
    if (!any(State::closes)) break;
    if (failed) return_to_start();
    if (renew) factors.emplace(assembler, c, ConstraintColumns::gradients, tolerance);
    renewed = renew;
    const Vector by = factors->closing_motion(phi);
    const std::vector<double> by_of = largest_of_each(by);
    for (std::size_t k = 0; k < ways.size(); ++k)
      if (ways[k].state == State::closes && !(by_of[k] < 0.05)) ways[k].state = State::stays;
    move(*factors, by, [](std::size_t) { return 1.0; });
    return_to_start();
    for (std::size_t k = 0; k < ways.size(); ++k)
      if (Returning& one = ways[k]; one.state == State::closes && by_of[k] < 1e-14 && one.open < 1e-11 && !one.slow)
        one.state = State::closed;
  }
  for (Returning& one : ways)
    if (one.state == State::closes) one.state = State::stays;
  return_to_start();
  return any(State::closed);
}

}  // namespace engrane::solve
