// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/scheme.hpp"

#include <fmt/format.h>

#include <numbers>

#include "math/angle.hpp"
#include "solve/schemes/arc_length.hpp"
#include "solve/schemes/kinematics.hpp"
#include "solve/schemes/radau.hpp"
#include "solve/schemes/statics.hpp"
#include "solve/schemes/transient.hpp"

namespace engrane::solve {

void apply_initial_displacements(const SolverContext& context, Configuration& c) {
  std::vector<double> y(context.motion.size(), 0.0);
  for (const InitialValue& value : context.model.initial)
    if (!value.velocity) y[static_cast<std::size_t>(6 * value.node + value.component)] += value.value;
  for (const auto& p : context.motion.prescribed(c.time)) y[p.slot] = p.u;
  context.motion.move(MotionSlots::Origin(c), y, c);
}

void apply_initial_velocities(const SolverContext& context, Configuration& c) {
  std::vector<double> v = context.motion.velocities(c);
  for (const InitialValue& value : context.model.initial) {
    if (!value.velocity) continue;
    if (value.component < 3) {
      v[static_cast<std::size_t>(6 * value.node + value.component)] += value.value;
    } else {
      // given about global axes; the state holds material components
      const NodeState& node = c.nodes[static_cast<std::size_t>(value.node)];
      const Vec3 spin = node.R.transpose() * Vec3::Unit(value.component - 3) * value.value;
      for (int i = 0; i < 3; ++i) v[static_cast<std::size_t>(6 * value.node + 3 + i)] += spin[i];
    }
  }
  for (const InitialSpin& spin : context.model.initial_spins) {
    const NodeState& node = c.nodes[static_cast<std::size_t>(spin.node)];
    const Vec3 velocity = spin.omega.cross(node.x - spin.point), turning = node.R.transpose() * spin.omega;
    for (int i = 0; i < 3; ++i) {
      v[static_cast<std::size_t>(6 * spin.node + i)] += velocity[i];
      v[static_cast<std::size_t>(6 * spin.node + 3 + i)] += turning[i];
    }
  }
  context.motion.set_velocities(v, c);
}

void Scheme::refuse_half_turns(std::span<const double> y, NewtonReport& report) const {
  if (!report.converged || context_.motion.adds_rotations()) return;
  for (std::size_t i = 1; i < context_.model.nodes.size(); ++i) {
    const double turn = Vec3(y[6 * i + 3], y[6 * i + 4], y[6 * i + 5]).norm();
    if (turn < std::numbers::pi) continue;
    report.converged = false;
    // far more than speeds in a wrong unit would make
    constexpr double undetermined = 1e4;
    report.reason = fmt::format(
        "node {} turned by {:.4g} degrees in one step; half a turn is the most that can be followed: take a smaller step H, at "
        "most {:.2g} of this one, or see whether a speed is given in the wrong unit{}",
        context_.model.nodes[i].id, turn / degree, 0.9 * std::numbers::pi / turn,
        turn < undetermined ? ""
                            : ". So large a turn also comes of a dead position, as of bars in line, where speeds are not "
                              "determined: choose steps that do not land on it, or drive another joint");
    return;
  }
}

NewtonReport Scheme::foresee(std::span<const double> v, double h) const {
  std::vector<double> coasting(v.begin(), v.end());
  for (double& y : coasting) y *= h;
  NewtonReport report;
  report.converged = true;
  refuse_half_turns(coasting, report);
  return report;
}

bool Scheme::refuse_conflict(const Configuration& to, NewtonReport& report) const {
  const std::string conflict = context_.redundancy.conflict(to);
  if (conflict.empty()) return false;
  report.converged = false;
  report.conflict = true;
  report.reason = conflict;
  return true;
}

NewtonReport Scheme::solve(Vec unknowns, Weights weights, const Newton::Apply& apply, Configuration& to, bool keep,
                           Border* border) {
  NewtonReport report;
  int iterations = 0;
  // once is enough where forces depend linearly on the multipliers
  constexpr int most_passes = 10;
  for (int pass = 1; pass <= most_passes; ++pass) {
    report = context_.newton.solve(unknowns, weights, keep, apply, to, border);
    iterations += report.iterations;
    if (!report.converged || !context_.redundancy.active()) break;
    if (refuse_conflict(to, report)) break;
    if (!context_.redundancy.share(to, pass == most_passes)) break;
    const auto all = context_.assembler.gather(unknowns);
    std::vector<double> shared(all.begin(), all.end());
    context_.assembler.multipliers_to_unknowns(to, shared);
    context_.assembler.spread(shared, unknowns);
  }
  report.iterations = iterations;
  return report;
}

std::unique_ptr<Scheme> make_scheme(SolverContext& context) {
  switch (context.options.analysis) {
    case SolverOptions::Analysis::dynamics:
      if (context.options.family == SolverOptions::Family::radau) return std::make_unique<Radau>(context);
      return std::make_unique<Transient>(context);
    case SolverOptions::Analysis::kinematics:
      return std::make_unique<Kinematics>(context);
    case SolverOptions::Analysis::statics:
      break;
  }
  if (context.options.path.follow) return std::make_unique<ArcLength>(context);
  return std::make_unique<Statics>(context);
}

}  // namespace engrane::solve
