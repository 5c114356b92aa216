// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/kinematics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "solve/constraints/constraint_factors.hpp"
#include "solve/constraints/diagnosis.hpp"

namespace engrane::solve {

StartReport Kinematics::start(Configuration& c) {
  StartReport report;
  apply_initial_displacements(context_, c);
  context_.start.assemble(c, report);
  c = outside_of_steps(std::move(c));  // rates are not those of the turn that led here
  refuse_free_motion(c);
  apply_initial_velocities(context_, c);
  context_.start.fit_velocities(c, Assembler::Metric::geometric, report);
  context_.start.balance_accelerations(c, 12, &report);
  return report;
}

void Kinematics::refuse_free_motion(const Configuration& c) {
  if (const std::string free = explain_free_motion(context_.assembler, c, context_.redundancy.mobility()); !free.empty())
    throw SolutionFailure(free);
  driven_ = true;
}

void Kinematics::take_over(Configuration& c) {
  Scheme::take_over(c);
  if (driven_) return;
  // a run of another kind may have moved what nothing drives, and its frictions may have held it
  context_.redundancy.analyse(c);
  refuse_free_motion(c);
}

void Kinematics::save(Snapshot& snapshot) const { snapshot.put("kinematics/driven", driven_ ? 1 : 0); }

void Kinematics::load(const Snapshot& snapshot) {
  driven_ = snapshot.has("kinematics/driven") && snapshot.number("kinematics/driven") != 0;
}

int Kinematics::solve(Configuration& to) {
  StartReport assembly;
  context_.start.assemble(to, assembly, false);
  context_.start.fit_velocities(to, Assembler::Metric::geometric, assembly, false);
  context_.start.balance_accelerations(to);
  return assembly.position_iterations;
}

Kinematics::Sizes Kinematics::sizes(const Configuration& c) const {
  const double extent = context_.model.extent();
  Sizes s;
  const auto v = context_.motion.velocities(c), a = context_.motion.accelerations(c);
  for (std::size_t i = 0; i < 6 * c.nodes.size(); ++i) {
    const double size = i % 6 < 3 ? extent : 1.0;
    s.velocity = std::max(s.velocity, std::abs(v[i]) / size);
    s.acceleration = std::max(s.acceleration, std::abs(a[i]) / size);
  }
  // steady motion has no accelerations but those of rounding
  constexpr double rounding = 100 * std::numeric_limits<double>::epsilon();
  s.acceleration = std::max(s.acceleration, rounding * s.velocity * s.velocity);
  s.force = context_.start.noise_of_missing_inertia(c) / extent;
  const Eigen::VectorXd weight = constraint_sizes(context_.assembler) / extent;
  for (std::size_t m = 0; m < c.multipliers.size(); ++m)
    s.force = std::max(s.force, std::abs(c.multipliers[m]) * weight[static_cast<Eigen::Index>(m)]);
  return s;
}

Outcome Kinematics::attempt(const Configuration& from, double h, Configuration& to) {
  constexpr double suspicious = 1e4;  // growth in a step above which a neighbouring position is checked
  constexpr double grown = 10;        // growth in a step above which a position may be close to a singular one
  constexpr double unknown = 1e-3;    // fraction of a force at which its rounding makes it unknown
  constexpr double singular = 100;    // growth over the neighbouring position that no motion through it has
  constexpr double beside = 1e-6;     // of a step
  Outcome outcome;
  NewtonReport& report = outcome.newton;
  // along the motion known so far: close enough to stay on the same branch of assembly
  const auto v = context_.motion.velocities(from), a = context_.motion.accelerations(from);
  std::vector<double> y(context_.motion.size());
  const auto predict = [&](double length, Configuration& c) {
    c = from;
    c.time = from.time + length;
    c.h = length;
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = length * (v[i] + 0.5 * length * a[i]);
    prescribe_step(from.time, c.time, y);
    context_.motion.move(from, y, c);
  };
  predict(h, to);
  report.converged = true;
  refuse_half_turns(y, report);
  if (!report.converged) context_.newton.refuse_last();
  if (!report.converged) return outcome;
  std::string failure;
  try {
    report.iterations = solve(to);
  } catch (const SolutionFailure& e) {
    failure = e.what();
  }
  const Sizes before = sizes(from), now = failure.empty() ? sizes(to) : Sizes{};
  if (failure.empty() && !now.beyond(before, suspicious)) {
    if (!now.beyond(before, grown)) return outcome;
    // close to a singular position the rounding of positions is amplified in positions, velocities, accelerations and forces in
    // turn, and may be all there is in the forces
    const double enlarged = context_.start.amplification(to);
    if (!(std::pow(enlarged, 4) * std::numeric_limits<double>::epsilon() > unknown)) return outcome;
    throw SolutionFailure(
        fmt::format("too close to a singular position at t = {:.6g} (bars in line, or a drive at a dead point): rounding of "
                    "positions is enlarged so much that accelerations and forces are not known. Choose steps that do not end "
                    "so close to it, or drive another joint",
                    to.time));
  }
  // In a singular position (bars in line, a dead point) the equations do not determine how the motion goes on. A little farther
  // on they do; the limit is the same where there is one.
  Configuration near, farther;
  try {
    predict(h * (1 + 0.1), farther);
    report.iterations += solve(farther);
    if (failure.empty() && context_.start.amplification(to) < singular * context_.start.amplification(farther)) return outcome;
    predict(h * (1 + beside), near);
    report.iterations += solve(near);
  } catch (const SolutionFailure&) {
    // it fails at other positions too: this one is not singular
    if (failure.empty()) return outcome;
    report.converged = false;
    report.conflict = true;
    report.reason = failure;
    return outcome;
  }
  // a shorter step would only come closer to it
  if (sizes(near).beyond(sizes(farther), singular))
    throw SolutionFailure(fmt::format(
        "singular position at t = {:.6g}: bars are in line, or a drive is at a dead point, and speeds or forces grow without "
        "bound. Choose steps that do not land on it, or drive another joint",
        to.time));
  near.time = to.time;
  near.h = h;
  to = std::move(near);
  return outcome;
}

}  // namespace engrane::solve
