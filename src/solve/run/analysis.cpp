// SPDX-License-Identifier: BSD-3-Clause
#include "solve/run/analysis.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "solve/constraints/diagnosis.hpp"
#include "solve/run/events.hpp"
#include "solve/schemes/kinematics.hpp"
#include "solve/schemes/statics.hpp"
#include "solve/schemes/transient.hpp"

namespace engrane::solve {

SolverContext::SolverContext(const Model& m, MPI_Comm comm)
    : model(m),
      numbering(m),
      assembler(m, numbering, comm),
      solver(assembler.matrix(), m.commands.analysis.solver.tag),
      newton(assembler, solver, m.commands.analysis.precision, m.commands.analysis.iterations),
      motion(m, numbering),
      redundancy(assembler, motion),
      start(assembler, solver, motion, redundancy) {
  assembler.penalty = m.commands.analysis.penalty.value_or(0.0);
}

void Analysis::prescribe_step(double from, double to, std::span<double> y) const {
  const auto before = context_.motion.prescribed(from), after = context_.motion.prescribed(to);
  for (std::size_t i = 0; i < after.size(); ++i) y[after[i].slot] = after[i].u - before[i].u;
}

void apply_initial_displacements(const SolverContext& context, Configuration& c) {
  std::vector<double> y(context.motion.size(), 0.0);
  for (const InitialValue& value : context.model.initial)
    if (!value.velocity) y[static_cast<std::size_t>(6 * value.node + value.component)] += value.value;
  for (const auto& p : context.motion.prescribed(c.time)) y[p.slot] = p.u;
  Configuration moved = c;
  context.motion.move(c, y, moved);
  c = std::move(moved);
}

void apply_initial_velocities(const SolverContext& context, Configuration& c) {
  std::vector<double> v = context.motion.velocities(c);
  for (const InitialValue& value : context.model.initial) {
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
  context.motion.set_velocities(v, c);
}

void Analysis::refuse_half_turns(std::span<const double> y, NewtonReport& report) const {
  if (!report.converged) return;
  for (std::size_t i = 1; i < context_.model.nodes.size(); ++i) {
    const double turn = Vec3(y[6 * i + 3], y[6 * i + 4], y[6 * i + 5]).norm();
    if (turn < std::numbers::pi) continue;
    report.converged = false;
    report.reason = fmt::format(
        "node {} turned by {:.4g} degrees in one step; half a turn is the most that can be followed: take a smaller step H, at "
        "most {:.2g} of this one, or see whether a speed is given in the wrong unit",
        context_.model.nodes[i].id, turn * 180 / std::numbers::pi, 0.9 * std::numbers::pi / turn);
    return;
  }
}

void Analysis::multipliers_to_unknowns(const Configuration& c, std::span<double> unknowns) const {
  const auto motion = context_.motion.size();
  for (std::size_t m = 0; m < c.multipliers.size(); ++m)
    unknowns[static_cast<std::size_t>(context_.numbering.equation(static_cast<int>(motion + m)))] =
        c.multipliers[m] / context_.assembler.scale()[m];
}

void Analysis::unknowns_to_multipliers(std::span<const double> unknowns, Configuration& c) const {
  const auto motion = context_.motion.size();
  for (std::size_t m = 0; m < c.multipliers.size(); ++m)
    c.multipliers[m] = context_.assembler.scale()[m] *
                       unknowns[static_cast<std::size_t>(context_.numbering.equation(static_cast<int>(motion + m)))];
}

NewtonReport Analysis::solve(Vec unknowns, Weights weights, const Newton::Apply& apply, Configuration& to) {
  NewtonReport report;
  int iterations = 0;
  // where forces depend linearly on the multipliers once is enough
  for (int pass = 0; pass < 10; ++pass) {
    report = context_.newton.solve(unknowns, weights, apply, to);
    iterations += report.iterations;
    if (!report.converged || !context_.redundancy.active()) break;
    if (const std::string conflict = context_.redundancy.conflict(to); !conflict.empty()) {
      report.converged = false;
      report.conflict = true;
      report.reason = conflict;
      break;
    }
    if (!context_.redundancy.share(to)) break;
    const auto all = context_.assembler.gather(unknowns);
    std::vector<double> shared(all.begin(), all.end());
    multipliers_to_unknowns(to, shared);
    context_.assembler.spread(shared, unknowns);
  }
  report.iterations = iterations;
  return report;
}

std::unique_ptr<Analysis> make_analysis(SolverContext& context) {
  const deck::Tagged& type = context.model.commands.analysis.type;
  if (type.is("DYNAMIC")) return std::make_unique<Transient>(context);
  if (type.is("KINEMATIC")) return std::make_unique<Kinematics>(context);
  return std::make_unique<Statics>(context);
}

namespace {

std::string failure_text(SolverContext& context, const Configuration& tried, const NewtonReport& report, int number, int cuts) {
  std::string text = fmt::format("step {}, t = {:.6g}: ", number, tried.time);
  const std::string cut = cuts == 0 ? "" : fmt::format("; the step was cut {} time{}", cuts, cuts == 1 ? "" : "s");
  if (const std::string element = explain_not_finite(context.assembler, tried); !element.empty())
    text += element;
  else if (report.conflict)
    text += report.reason;
  else if (report.singular)
    return explain_singular(context.assembler, text + report.reason + cut);  // with advice at its end
  else if (const std::string where = explain_residual(context.assembler, tried, report); !where.empty())
    text += report.reason + "; " + where;
  else
    text += report.reason;
  return text + cut;
}

/// One run: the present configuration and the ways it goes on from there.
class Runner {
 public:
  Runner(SolverContext& context, Analysis& analysis, const Observer& observer)
      : context_(context),
        analysis_(analysis),
        observer_(observer),
        stepping_(context.model.commands.stepping),
        locator_(context, analysis),
        now_(context.numbering.reference_configuration(stepping_.start)),
        h_(stepping_.step) {}

  bool run(const std::function<void(const StartReport&)>& started) {
    started(analysis_.start(now_));
    context_.solver.reset();  // the start solved with matrices of other kinds; the steps deserve their own analysis
    context_.assembler.commit(now_);
    if (locator_.active()) locator_.switches().take(now_);
    next_ = now_;
    if (!observer_(now_, step_)) return false;
    const double span = stepping_.end - stepping_.start;
    // a last step shorter than a billionth of the others is the rounding of their sum
    const auto steps = static_cast<long long>(std::ceil(span / stepping_.step * (1 - 1e-9)));
    for (long long k = 1; k <= steps; ++k)
      if (!reach(k == steps ? stepping_.end : stepping_.start + static_cast<double>(k) * stepping_.step)) return false;
    return true;
  }

 private:
  /// Part of H below which reactions would carry visible noise of rounding.
  static constexpr double noisy = 0.1;

  bool reach(double target) {
    int cuts = 0;
    bool renewed = false;
    step_.locating = 0;
    locator_.new_target();
    while (now_.time < target) {
      const double left = target - now_.time;
      if (locator_.active() && left < locator_.shortest()) {
        if (!drift(left, target)) return false;
        continue;
      }
      double size = left;
      if (h_ < 0.99 * size) size /= std::ceil(size / h_ * 0.99);
      NewtonReport report = analysis_.attempt(now_, size, next_);
      EventLocator::Outcome outcome = locator_.inspect(now_, size, report.converged, next_);
      using Kind = EventLocator::Outcome::Kind;
      step_.locating += outcome.attempts;
      size = outcome.step;
      if (outcome.report) report = std::move(*outcome.report);
      if (!report.converged && outcome.kind != Kind::drift) {
        // other constraints may depend on the rest here than did at the start
        if ((report.singular || report.conflict) && !renewed && context_.redundancy.analyse(now_)) {
          renewed = true;
          continue;
        }
        if (cuts == context_.model.commands.analysis.cuts || now_.time + size / 2 == now_.time)
          throw SolutionFailure(failure_text(context_, next_, report, step_.number + 1, cuts));
        ++cuts;
        ++step_.cuts;
        h_ = size / 2;
        continue;
      }
      if (outcome.kind != Kind::drift) {
        if (std::abs(next_.time - target) <= 1e-9 * size) next_.time = target;  // no drift from the sums of h
        analysis_.accept();
        std::swap(now_, next_);
        // the inverse square of a short step enlarges rounding in accelerations and multipliers: they are found anew
        if (locator_.active() && size < noisy * stepping_.step) analysis_.drift(now_, 0);
        h_ = std::min(stepping_.step, 2 * h_);  // back to the asked step as soon as it goes
        step_.newton = &report;
        if (!accepted(size, outcome.kind == Kind::none || now_.time == target)) return false;
      }
      if (outcome.kind != Kind::none && now_.time < target && !drift(outcome.drift, target)) return false;
    }
    return true;
  }

  /// Over an event, and to the target if a step would be too short to get there.
  bool drift(double time, double target) {
    const double left = target - now_.time;
    const bool arrives = left - time < locator_.shortest();
    const double size = arrives ? left : time;
    analysis_.drift(now_, size);
    if (arrives) now_.time = target;
    step_.newton = nullptr;
    return accepted(size, arrives);
  }

  bool accepted(double size, bool regular) {
    context_.assembler.commit(now_);
    step_.events.clear();
    if (locator_.active()) step_.events = locator_.switches().take(now_);
    ++step_.number;
    step_.step = size;
    step_.regular = regular;
    step_.chatter = locator_.chatters();
    const bool go_on = observer_(now_, step_);
    step_.cuts = step_.locating = 0;
    return go_on;
  }

  SolverContext& context_;
  Analysis& analysis_;
  const Observer& observer_;
  const deck::SteppingCard& stepping_;
  EventLocator locator_;
  Configuration now_, next_;
  double h_;
  StepReport step_;
};

}  // namespace

bool run(SolverContext& context, Analysis& analysis, const Observer& observer,
         const std::function<void(const StartReport&)>& started) {
  return Runner(context, analysis, observer).run(started);
}

}  // namespace engrane::solve
