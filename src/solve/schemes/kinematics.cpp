// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/kinematics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "model/masses.hpp"
#include "solve/constraints/constraint_factors.hpp"
#include "solve/constraints/diagnosis.hpp"

namespace engrane::solve {

StartReport Kinematics::start(Configuration& c) {
  StartReport report;
  apply_initial_displacements(context_, c);
  context_.start.assemble(c, report);
  c = at_start_of_step(std::move(c));  // rates are not those of the turn that led here
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

void Kinematics::accept() { from_ = std::exchange(to_, {}); }

void Kinematics::save(Snapshot& snapshot) const { snapshot.put("kinematics/driven", driven_ ? 1 : 0); }

void Kinematics::load(const Snapshot& snapshot) {
  driven_ = snapshot.has("kinematics/driven") && snapshot.number("kinematics/driven") != 0;
}

int Kinematics::solve(Configuration& to) {
  const int iterations = context_.start.close_again(to);
  context_.start.project_velocities(to, Assembler::Metric::geometric);
  context_.start.balance_accelerations(to);
  return iterations;
}

Kinematics::Kinematics(SolverContext& context) : Scheme(context) {
  MassProperties all;
  for (const Model::Part& part : context.model.parts) all.add(mass_properties(context.model, part));
  inertia_ = all.mass * context.model.extent() * context.model.extent() + all.inertia.trace();
}

Kinematics::Sizes Kinematics::sizes(const Configuration& c, double enlarged) const {
  const double extent = context_.model.extent();
  Sizes s;
  const auto v = context_.motion.velocities(c), a = context_.motion.accelerations(c);
  for (std::size_t i = 0; i < 6 * c.nodes.size(); ++i) {
    const double size = i % 6 < 3 ? extent : 1.0;
    s.velocity = std::max(s.velocity, std::abs(v[i]) / size);
    s.acceleration = std::max(s.acceleration, std::abs(a[i]) / size);
  }
  // steady motion has no accelerations but those of rounding, and what nothing loads has no other forces
  constexpr double rounding = 100 * std::numeric_limits<double>::epsilon();
  s.acceleration = std::max(s.acceleration, std::pow(enlarged, 3) * rounding * s.velocity * s.velocity);
  s.force = std::pow(enlarged, 4) * (context_.start.noise_of_missing_inertia(c) + rounding * inertia_ * s.velocity * s.velocity) /
            extent;
  const Eigen::VectorXd weight = constraint_sizes(context_.assembler) / extent;
  for (std::size_t m = 0; m < c.multipliers.size(); ++m)
    s.force = std::max(s.force, std::abs(c.multipliers[m]) * weight[static_cast<Eigen::Index>(m)]);
  return s;
}

std::vector<double> Kinematics::predict(const Configuration& from, double length, Configuration& c) const {
  const auto v = context_.motion.velocities(from), a = context_.motion.accelerations(from);
  std::vector<double> y(v.size());
  c = from;
  c.time = from.time + length;
  c.h = length;
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = length * (v[i] + 0.5 * length * a[i]);
  context_.motion.prescribe_increment(from.time, c.time, y);
  context_.motion.move(from, y, c);
  return y;
}

int Kinematics::follow(const Configuration& from, double length, Configuration& c) {
  predict(from, length, c);
  return solve(c);
}

Outcome Kinematics::attempt(const Configuration& from, double h, Configuration& to) {
  constexpr double unknown = 1e-3;  // fraction of a force at which its rounding makes it unknown
  constexpr double closer = 1.1;    // growth of amplification in a step towards a singular position
  Outcome outcome;
  NewtonReport& report = outcome.newton;
  report.converged = true;
  refuse_half_turns(predict(from, h, to), report);
  if (!report.converged) context_.newton.refuse_last();
  if (!report.converged) return outcome;
  std::string failure;
  try {
    report.iterations = solve(to);
  } catch (const SolutionFailure& e) {
    failure = e.what();
  }
  if (!from_) from_.emplace(context_.assembler, from);
  const Regularity &before = *from_, &now = to_.emplace(context_.assembler, to);
  // close to a singular position the rounding of positions is amplified in positions, velocities, accelerations and forces in
  // turn, and may be all there is in the forces
  const double amplified = now.amplification();
  const bool doubtful = !(std::pow(amplified, 4) * std::numeric_limits<double>::epsilon() <= unknown) &&
                        !(amplified <= closer * before.amplification());
  if (doubtful && (!failure.empty() || blurred(from, h, to, unknown))) {
    if (reach_limit(from, h, before.amplification(), to, report)) {
      to_.reset();
      return outcome;
    }
    if (failure.empty()) failure = "close to a singular position (bars in line, or a drive at a dead point) forces are not known";
  }
  if (!failure.empty()) {
    report.converged = false;
    report.conflict = true;
    report.reason = failure;
  } else if (!before.same_side(now)) {
    refuse_other_branch(from, h, before, report);
  } else {
    refuse_leap(from, h, to, report);
  }
  return outcome;
}

bool Kinematics::blurred(const Configuration& from, double h, const Configuration& to, double part) {
  Configuration between, again;
  try {
    follow(from, 0.4 * h, between);
    follow(between, 0.6 * h, again);
  } catch (const SolutionFailure&) {
    return true;
  }
  const Sizes size = sizes(to);
  Configuration difference = to;
  const auto minus = [](std::vector<double> x, const std::vector<double>& y) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] -= y[i];
    return x;
  };
  context_.motion.set_velocities(minus(context_.motion.velocities(to), context_.motion.velocities(again)), difference);
  context_.motion.set_accelerations(minus(context_.motion.accelerations(to), context_.motion.accelerations(again)), difference);
  difference.multipliers = minus(to.multipliers, again.multipliers);
  return sizes(difference).beyond(size, part);
}

bool Kinematics::reach_limit(const Configuration& from, double h, double amplification, Configuration& to, NewtonReport& report) {
  constexpr int count = 4;
  constexpr double fair = 200;     // amplification with which rounding leaves six digits of a force
  constexpr double bounded = 1.5;  // growth from the second to the first; the inverse of a distance doubles
  constexpr std::array<double, count> value = {4, -6, 4, -1};  // of the cubic through four values, one farther on
  constexpr std::array<double, count> integral = {55.0 / 24, -59.0 / 24, 37.0 / 24, -9.0 / 24};  // from the first on (Adams)
  constexpr double way = 0.04;  // motion in between, over the extent or in radians: its fourth power is the error
  // amplification is the inverse of the distance from the singular position
  const double apart =
      std::min({h * amplification / fair, way / sizes(from).velocity, (from.time + h - context_.options.begin) / count});
  std::array<Configuration, count> earlier;
  try {
    for (int k = 0; k < count; ++k) report.iterations += follow(from, h - (k + 1) * apart, earlier[static_cast<std::size_t>(k)]);
  } catch (const SolutionFailure&) {
    return false;
  }
  const Configuration& first = earlier[0];
  std::vector<double> y(context_.motion.size()), v(y.size()), a(y.size()), multipliers(first.multipliers.size());
  for (std::size_t k = 0; k < count; ++k) {
    const auto v_k = context_.motion.velocities(earlier[k]), a_k = context_.motion.accelerations(earlier[k]);
    for (std::size_t i = 0; i < y.size(); ++i) {
      y[i] += apart * integral[k] * v_k[i];
      v[i] += value[k] * v_k[i];
      a[i] += value[k] * a_k[i];
    }
    for (std::size_t m = 0; m < multipliers.size(); ++m) multipliers[m] += value[k] * earlier[k].multipliers[m];
  }
  to = first;
  to.time = from.time + h;
  to.h = h;
  context_.motion.prescribe_increment(first.time, to.time, y);
  context_.motion.move(first, y, to);
  context_.motion.set_velocities(v, to);
  context_.motion.set_accelerations(a, to);
  to.multipliers = std::move(multipliers);
  // a shorter step would only come closer to it
  const double enlarged = Regularity(context_.assembler, first).amplification();
  if (sizes(first, enlarged).beyond(sizes(earlier[1], enlarged), bounded) || !fits_constraints(to))
    throw SolutionFailure(fmt::format(
        "singular position at t = {:.6g}: bars are in line, or a drive is at a dead point, and speeds or forces grow without "
        "bound. Choose steps that do not land on it, or drive another joint",
        to.time));
  return true;
}

bool Kinematics::fits_constraints(const Configuration& c) const {
  constexpr double fair = 1e-4;
  std::vector<double> phi, rate, second;
  context_.assembler.constraint_rates(c, phi, rate, second);
  const Sizes size = sizes(c);
  return relative_open(context_.assembler, rate).maxCoeff() <= fair * size.velocity &&
         relative_open(context_.assembler, second).maxCoeff() <= fair * (size.acceleration + size.velocity * size.velocity);
}

void Kinematics::refuse_other_branch(const Configuration& from, double h, const Regularity& side, NewtonReport& report) {
  constexpr double narrow = 1e-4;  // of the step: how closely the singular position is looked for
  constexpr double part = 0.4;     // of what is left; in the middle, symmetric mechanisms are just there
  Configuration last = from, next;
  const auto crosses = [&](double length) {
    report.iterations += follow(last, length, next);
    return !side.same_side(Regularity(context_.assembler, next));
  };
  double here = 0, beyond = 1;
  try {
    while (beyond - here > narrow) {
      const double at = here + part * (beyond - here);
      if (crosses((at - here) * h)) {
        beyond = at;
      } else {
        here = at;
        last = std::move(next);
      }
    }
    // what seemed to lie beyond may have been on another branch
    if (crosses((beyond - here) * h)) return;
  } catch (const SolutionFailure&) {
    // the motion ends on the way
  }
  report.converged = false;
  report.reason =
      "the step leads to another branch of assembly: a loop is folded the other way (the determinant of the constraints has "
      "changed its sign), and the motion does not go there. Take a smaller step H";
  context_.newton.refuse_last();
}

bool Kinematics::fits_together(const Configuration& a, const Configuration& b) const {
  constexpr double fair = 0.1;   // of a node's own velocity: sines do up to steps of some 30 degrees
  constexpr double rest = 1e-6;  // of the largest velocity
  const double half = 0.5 * (b.time - a.time), extent = context_.model.extent();
  const auto v_a = context_.motion.velocities(a), v_b = context_.motion.velocities(b);
  const auto a_a = context_.motion.accelerations(a), a_b = context_.motion.accelerations(b);
  const double still = rest * std::max(sizes(a).velocity, sizes(b).velocity);
  for (std::size_t i = 0; i < 6 * a.nodes.size(); i += 3) {
    const double unit = i % 6 == 0 ? extent : 1.0;  // places, then rotations
    double off = 0, size = still * unit;
    for (std::size_t k = i; k < i + 3; ++k) {
      off = std::max(off, std::abs(v_b[k] - v_a[k] - half * (a_a[k] + a_b[k])));
      size = std::max({size, std::abs(v_a[k]), std::abs(v_b[k])});
    }
    if (off > fair * size) return false;
  }
  return true;
}

void Kinematics::follow_closely(const Configuration& from, double length, double part, Configuration& c, NewtonReport& report) {
  constexpr double first = 0.4;      // in the middle, symmetric mechanisms may be in a singular position
  constexpr double shortest = 1e-3;  // a drive with a corner never fits
  report.iterations += follow(from, length, c);
  if (part < shortest || fits_together(from, c)) return;
  Configuration between;
  follow_closely(from, first * length, first * part, between, report);
  follow_closely(between, (1 - first) * length, (1 - first) * part, c, report);
}

void Kinematics::refuse_leap(const Configuration& from, double h, const Configuration& to, NewtonReport& report) {
  constexpr double same = 1e-4;
  if (fits_together(from, to)) return;
  Configuration closely;
  bool arrives = true;
  try {
    follow_closely(from, h, 1, closely, report);
    const Sizes size = sizes(to);
    Configuration difference = to;
    auto v = context_.motion.velocities(to);
    const auto v_closely = context_.motion.velocities(closely);
    for (std::size_t i = 0; i < v.size(); ++i) v[i] -= v_closely[i];
    context_.motion.set_velocities(v, difference);
    arrives = sizes(difference).velocity <= same * size.velocity;
    for (std::size_t n = 0; n < to.nodes.size(); ++n)
      arrives = arrives && (to.nodes[n].x - closely.nodes[n].x).norm() <= same * context_.model.extent();
  } catch (const SolutionFailure&) {
    arrives = false;  // the motion ends on the way
  }
  if (arrives) return;
  report.converged = false;
  report.reason =
      "the step leads to another branch of assembly: followed in smaller parts, the motion ends elsewhere, or on the way. Take a "
      "smaller step H";
  context_.newton.refuse_last();
}

}  // namespace engrane::solve
