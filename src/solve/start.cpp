// SPDX-License-Identifier: BSD-3-Clause
#include "solve/start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "solve/blame.hpp"

namespace engrane {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

double largest(const std::vector<double>& v) {
  double m = 0;
  for (const double x : v) m = std::isnan(x) ? x : std::max(m, std::abs(x));
  return m;
}

}  // namespace

Start::Start(Assembler& assembler, LinearSolver& solver, const MotionSlots& motion, Redundancy& redundancy)
    : assembler_(assembler), solver_(solver), motion_(motion), redundancy_(redundancy) {
  *right_.out() = assembler.new_vector();
  *solution_.out() = assembler.new_vector();
}

bool Start::solve(std::vector<double>& right, std::vector<double>& solution) {
  assembler_.spread(right, right_);
  if (!solver_.solve(right_, solution_)) return false;
  const auto all = assembler_.gather(solution_);
  solution.assign(all.begin(), all.end());
  return true;
}

std::vector<int> Start::imposed(bool velocity) const {
  std::vector<int> equations;
  for (const InitialValue& value : assembler_.model().initial) {
    if (value.velocity != velocity || !value.imposed) continue;
    if (const int e = assembler_.numbering().equation(6 * value.node + value.component); e >= 0) equations.push_back(e);
  }
  return equations;
}

void Start::verify_imposed(const Configuration& c, std::span<const double> wished, bool velocity) const {
  const auto v = motion_.velocities(c);
  for (const int e : imposed(velocity)) {
    const Unknown& u = assembler_.numbering().unknown(e);
    const auto slot = static_cast<std::size_t>(u.slot);
    const NodeState& node = c.nodes[static_cast<std::size_t>(u.node)];
    // a displacement is compared where the node stands; turns are left to the joints' own angles
    const double is = velocity ? v[slot] : u.item < 3 ? node.x[u.item] : wished[slot];
    const double size = velocity ? largest(v) : assembler_.model().extent();
    if (std::abs(is - wished[slot]) <= 1e-6 * size) continue;
    throw SolutionFailure(
        fmt::format("the initial {} of {} is imposed, but the joints do not allow it: they make it {:.6g} "
                    "instead of {:.6g}",
                    velocity ? "velocity" : "position", assembler_.numbering().describe(e), is, wished[slot]));
  }
}

void Start::assemble(Configuration& c, StartReport& report, bool initial) {
  const double extent = assembler_.model().extent();
  const std::vector<NodeState> begun = c.nodes;
  if (initial) {
    const Configuration given = c;
    redundancy_.analyse(given);
    try {
      close(c, report, initial);
    } catch (const SolutionFailure&) {
      // where the parts do not quite fit, constraints that repeat one another look independent: look again less sharply
      c = given;
      if (!redundancy_.analyse(given, 1e-4, true)) throw;
      close(c, report, initial);
    }
    // joints that repeat one another do so exactly only where the mechanism is closed
    if (redundancy_.analyse(c)) close(c, report, initial);
    report.redundant = redundancy_.mobility().redundant();
    report.mobility = describe_mobility(assembler_, c, redundancy_.mobility());
  } else {
    close(c, report, initial);
  }
  std::vector<double> wished(motion_.size(), 0.0);
  for (std::size_t i = 0; i < begun.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) wished[6 * i + k] = begun[i].x[static_cast<Eigen::Index>(k)];
  if (initial) verify_imposed(c, wished, false);
  for (std::size_t i = 1; i < c.nodes.size(); ++i) {
    c.nodes[i].T.setIdentity();
    const double move = (c.nodes[i].x - begun[i].x).norm();
    const double turn = std::acos(std::clamp(((begun[i].R.transpose() * c.nodes[i].R).trace() - 1) / 2, -1.0, 1.0));
    if (std::max(move / extent, turn) > std::max(report.largest_move / extent, report.largest_turn))
      report.moved_most = fmt::format("node {}", assembler_.model().nodes[i].id);
    report.largest_move = std::max(report.largest_move, move);
    report.largest_turn = std::max(report.largest_turn, turn);
  }
}

void Start::close(Configuration& c, StartReport& report, bool initial) {
  const Numbering& numbering = assembler_.numbering();
  const double extent = assembler_.model().extent();
  const auto motion_size = motion_.size();
  const std::vector<int> held = initial ? imposed(false) : std::vector<int>{};
  std::vector<double> phi, rate, second;
  for (report.position_iterations = 0;; ++report.position_iterations) {
    assembler_.constraint_rates(c, phi, rate, second);
    std::vector<double> right(static_cast<std::size_t>(numbering.equations()), 0.0), step;
    double open = 0;
    for (std::size_t e = 0; e < right.size(); ++e) {
      const Unknown& u = numbering.unknown(static_cast<int>(e));
      if (!u.multiplier || assembler_.released(u.slot - static_cast<int>(motion_size))) continue;
      right[e] = phi[static_cast<std::size_t>(u.slot) - motion_size];
      open = std::max(open, std::abs(right[e]) / (u.measure == Measure::length ? extent : 1.0));
    }
    if (open <= 32 * epsilon) break;
    if (report.position_iterations == 50 || !std::isfinite(open)) throw SolutionFailure(explain_open(phi));
    assembler_.projection(c, Assembler::Metric::geometric, held);
    if (!solve(right, step))
      throw SolutionFailure(explain_singular(assembler_, "the constraints of the mechanism contradict or repeat one another"));
    // a step far outside where the constraints are nearly linear would jump to another way of assembling
    double length = 0;
    std::vector<double> y(motion_size, 0.0);
    motion_.scatter(step, y);
    for (std::size_t i = 0; i < 6 * c.nodes.size(); ++i)
      length = std::max(length, std::abs(y[i]) / (i % 6 < 3 ? 0.25 * extent : 0.5));
    if (length > 1)
      for (double& v : y) v /= length;
    Configuration moved = c;
    motion_.move(c, y, moved);
    c = std::move(moved);
    if (length < 4 * epsilon && open < 1e-11) break;  // closed as far as rounding lets it
  }
  if (const std::string conflict = redundancy_.conflict(c); !conflict.empty()) throw SolutionFailure(conflict);
}

std::string Start::explain_open(const std::vector<double>& phi) const {
  const Numbering& numbering = assembler_.numbering();
  const double extent = assembler_.model().extent();
  double worst = -1, value = 0;
  int equation = -1;
  for (int e = 0; e < numbering.equations(); ++e) {
    const Unknown& u = numbering.unknown(e);
    if (!u.multiplier) continue;
    const double v = phi[static_cast<std::size_t>(u.slot) - motion_.size()];
    const double relative = std::abs(v) / (u.measure == Measure::length ? extent : 1.0);
    if (!(relative <= worst)) {
      worst = relative;
      value = v;
      equation = e;
    }
  }
  const bool length = equation >= 0 && numbering.unknown(equation).measure == Measure::length;
  return fmt::format("the mechanism does not close: {} stays open by {:.3g} {}",
                     equation >= 0 ? numbering.describe(equation) : "a constraint", std::abs(value),
                     assembler_.model().units.label(length ? dimension::length : dimension::angle));
}

void Start::fit_velocities(Configuration& c, Assembler::Metric metric, StartReport& report, bool initial) {
  const Numbering& numbering = assembler_.numbering();
  std::vector<double> v = motion_.velocities(c);
  for (const auto& p : motion_.prescribed(c.time)) v[p.slot] = p.v;
  motion_.set_velocities(v, c);
  std::vector<double> phi, rate, second, change;
  assembler_.constraint_rates(c, phi, rate, second);
  if (largest(rate) == 0) return;
  std::vector<double> right(static_cast<std::size_t>(numbering.equations()), 0.0);
  for (std::size_t e = 0; e < right.size(); ++e) {
    const Unknown& u = numbering.unknown(static_cast<int>(e));
    if (u.multiplier && !assembler_.released(u.slot - numbering.motion_slots()))
      right[e] = rate[static_cast<std::size_t>(u.slot) - motion_.size()];
  }
  const std::vector<double> wished = v;
  assembler_.projection(c, metric, initial ? imposed(true) : std::vector<int>{});
  if (!solve(right, change))
    throw SolutionFailure(explain_singular(assembler_, "no velocities fit the constraints and drives at the start"));
  std::vector<double> delta(motion_.size(), 0.0);
  motion_.scatter(change, delta);
  for (std::size_t i = 0; i < v.size(); ++i) v[i] += delta[i];
  motion_.set_velocities(v, c);
  if (redundancy_.active()) {
    const double asked = largest(rate);
    assembler_.constraint_rates(c, phi, rate, second);
    if (const std::string conflict = redundancy_.rate_conflict(c, rate, std::max(asked, largest(v))); !conflict.empty())
      throw SolutionFailure(conflict);
  }
  delta.resize(6 * c.nodes.size());  // scalars follow: their change says nothing
  report.largest_velocity_change = largest(delta);
  if (initial) verify_imposed(c, wished, true);
}

void Start::balance_accelerations(Configuration& c, int most_iterations) {
  const Numbering& numbering = assembler_.numbering();
  std::vector<double> a = motion_.accelerations(c);
  for (const auto& p : motion_.prescribed(c.time)) a[p.slot] = p.a;
  motion_.set_accelerations(a, c);
  std::vector<double> phi, rate, second, change;
  double before = std::numeric_limits<double>::infinity();
  // linear but for forces that follow the multipliers (|λ| of the separating force), hence a short iteration
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const std::vector<double> r = assembler_.slot_residual(c);
    assembler_.constraint_rates(c, phi, rate, second);
    std::vector<double> right(static_cast<std::size_t>(numbering.equations()), 0.0);
    for (std::size_t e = 0; e < right.size(); ++e) {
      const Unknown& u = numbering.unknown(static_cast<int>(e));
      const int m = u.slot - numbering.motion_slots();
      if (!u.multiplier)
        right[e] = -r[static_cast<std::size_t>(u.slot)];
      else if (assembler_.released(m))
        right[e] = assembler_.released_value(m) - c.multipliers[static_cast<std::size_t>(m)];
      else
        right[e] = second[static_cast<std::size_t>(m)];
    }
    const double size = largest(right);
    if (!std::isfinite(size)) throw SolutionFailure("the forces at the start are not finite");
    if (size == 0 || (iteration > 1 && size >= 0.5 * before)) {
      if (!redundancy_.share(c)) return;
      before = std::numeric_limits<double>::infinity();
      continue;
    }
    before = size;
    assembler_.projection(c, Assembler::Metric::dynamic);
    if (!solve(right, change))
      throw SolutionFailure(explain_singular(assembler_, "the accelerations at the start are not determined"));
    for (std::size_t e = 0; e < right.size(); ++e) {
      const Unknown& u = numbering.unknown(static_cast<int>(e));
      if (u.multiplier)
        c.multipliers[static_cast<std::size_t>(u.slot) - motion_.size()] += change[e];
      else
        a[static_cast<std::size_t>(u.slot)] += change[e];
    }
    motion_.set_accelerations(a, c);
  }
  redundancy_.share(c);
}

}  // namespace engrane
