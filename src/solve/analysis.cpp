// SPDX-License-Identifier: BSD-3-Clause
#include "solve/analysis.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "solve/blame.hpp"
#include "solve/kinematics.hpp"
#include "solve/statics.hpp"
#include "solve/transient.hpp"

namespace engrane {

Workbench::Workbench(const Model& m, MPI_Comm comm)
    : model(m),
      numbering(m),
      assembler(m, numbering, comm),
      solver(assembler.matrix(), m.commands.analysis.solver.tag),
      newton(assembler, solver, m.commands.analysis.precision, m.commands.analysis.iterations),
      motion(m, numbering),
      start(assembler, solver, motion) {
  assembler.penalty = m.commands.analysis.penalty.value_or(0.0);
}

void Analysis::prescribe_step(double from, double to, std::span<double> y) const {
  const auto before = bench_.motion.prescribed(from), after = bench_.motion.prescribed(to);
  for (std::size_t i = 0; i < after.size(); ++i) y[after[i].slot] = after[i].u - before[i].u;
}

void Analysis::apply_initial_displacements(Configuration& c) const {
  std::vector<double> y(bench_.motion.size(), 0.0);
  for (const InitialValue& value : bench_.model.initial)
    if (!value.velocity) y[static_cast<std::size_t>(6 * value.node + value.component)] += value.value;
  for (const auto& p : bench_.motion.prescribed(c.time)) y[p.slot] = p.u;
  Configuration moved = c;
  bench_.motion.move(c, y, moved);
  c = std::move(moved);
}

void Analysis::apply_initial_velocities(Configuration& c) const {
  std::vector<double> v = bench_.motion.velocities(c);
  for (const InitialValue& value : bench_.model.initial) {
    if (!value.velocity) continue;
    if (value.component < 3) {
      v[static_cast<std::size_t>(6 * value.node + value.component)] = value.value;
    } else {
      // given about global axes; the state holds material components
      const NodeState& node = c.nodes[static_cast<std::size_t>(value.node)];
      const Vec3 spin = node.R.transpose() * Vec3::Unit(value.component - 3) * value.value;
      for (int i = 0; i < 3; ++i) v[static_cast<std::size_t>(6 * value.node + 3 + i)] += spin[i];
    }
  }
  bench_.motion.set_velocities(v, c);
}

void Analysis::refuse_half_turns(std::span<const double> y, NewtonReport& report) const {
  if (!report.converged) return;
  for (std::size_t i = 1; i < bench_.model.nodes.size(); ++i) {
    const double turn = Vec3(y[6 * i + 3], y[6 * i + 4], y[6 * i + 5]).norm();
    if (turn < std::numbers::pi) continue;
    report.converged = false;
    report.reason = fmt::format("node {} turned by {:.0f} degrees in one step; half a turn is the most that can be followed",
                                bench_.model.nodes[i].id, turn * 180 / std::numbers::pi);
    return;
  }
}

void Analysis::multipliers_to_unknowns(const Configuration& c, std::span<double> unknowns) const {
  const auto motion = bench_.motion.size();
  for (std::size_t m = 0; m < c.multipliers.size(); ++m)
    unknowns[static_cast<std::size_t>(bench_.numbering.equation(static_cast<int>(motion + m)))] =
        c.multipliers[m] / bench_.assembler.scale()[m];
}

void Analysis::unknowns_to_multipliers(std::span<const double> unknowns, Configuration& c) const {
  const auto motion = bench_.motion.size();
  for (std::size_t m = 0; m < c.multipliers.size(); ++m)
    c.multipliers[m] =
        bench_.assembler.scale()[m] * unknowns[static_cast<std::size_t>(bench_.numbering.equation(static_cast<int>(motion + m)))];
}

std::unique_ptr<Analysis> make_analysis(Workbench& bench) {
  const deck::Tagged& type = bench.model.commands.analysis.type;
  if (type.is("DYNAMIC")) return std::make_unique<Transient>(bench);
  if (type.is("KINEMATIC")) return std::make_unique<Kinematics>(bench);
  return std::make_unique<Statics>(bench);
}

namespace {

/// Lets every element keep what it remembers of an accepted configuration.
void commit(Workbench& bench, Configuration& c) {
  std::vector<double> history = c.history;
  const auto& parts = bench.model.parts;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const Layout& layout = parts[p].element->layout();
    if (layout.history == 0) continue;
    const int part = static_cast<int>(p);
    parts[p].element->commit(
        bench.assembler.view(part, c),
        std::span(c.scalars).subspan(static_cast<std::size_t>(bench.numbering.scalar_begin(part)), layout.scalars.size()),
        std::span(history).subspan(static_cast<std::size_t>(bench.numbering.history_begin(part)),
                                   static_cast<std::size_t>(layout.history)));
  }
  c.history = std::move(history);
}

std::string failure_text(Workbench& bench, const Configuration& tried, const NewtonReport& report, int number, int cuts) {
  std::string text = fmt::format("step {}, t = {:.6g}: ", number, tried.time);
  if (const std::string element = explain_not_finite(bench.assembler, tried); !element.empty())
    text += element;
  else if (report.singular)
    text = explain_singular(bench.assembler, text + report.reason);
  else if (const std::string where = explain_residual(bench.assembler, tried, report); !where.empty())
    text += report.reason + "; " + where;
  else
    text += report.reason;
  if (cuts > 0) text += fmt::format("; the step was cut {} time{}", cuts, cuts == 1 ? "" : "s");
  return text;
}

}  // namespace

bool run(Workbench& bench, Analysis& analysis, const Observer& observer, const std::function<void(const StartReport&)>& started) {
  const auto& stepping = bench.model.commands.stepping;
  const int most_cuts = bench.model.commands.analysis.cuts;
  Configuration now = bench.numbering.reference_configuration(stepping.start);
  started(analysis.start(now));
  bench.solver.reset();  // the start solved with matrices of other kinds; the steps deserve their own analysis
  commit(bench, now);
  StepReport step;
  if (!observer(now, step)) return false;

  const double span = stepping.end - stepping.start;
  // a last step shorter than a billionth of the others is the rounding of their sum
  const auto steps = static_cast<long long>(std::ceil(span / stepping.step * (1 - 1e-9)));
  Configuration next = now;
  double h = stepping.step;
  for (long long k = 1; k <= steps; ++k) {
    const double target = k == steps ? stepping.end : stepping.start + static_cast<double>(k) * stepping.step;
    step.cuts = 0;
    while (now.time < target) {
      double size = target - now.time;
      if (h < 0.99 * size) size /= std::ceil(size / h * 0.99);
      const NewtonReport report = analysis.attempt(now, size, next);
      if (!report.converged) {
        if (step.cuts == most_cuts || now.time + size / 2 == now.time)
          throw SolutionFailure(failure_text(bench, next, report, step.number + 1, step.cuts));
        ++step.cuts;
        h = size / 2;
        continue;
      }
      if (std::abs(next.time - target) <= 1e-9 * size) next.time = target;  // no drift from the sums of h
      analysis.accept();
      std::swap(now, next);
      commit(bench, now);
      ++step.number;
      step.step = size;
      step.newton = &report;
      if (!observer(now, step)) return false;
      h = std::min(stepping.step, 2 * h);  // back to the asked step as soon as it goes
    }
  }
  return true;
}

}  // namespace engrane
