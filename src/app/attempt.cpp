// SPDX-License-Identifier: BSD-3-Clause
#include "app/attempt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <utility>
#include <vector>

#include "app/interruption.hpp"
#include "app/selection.hpp"
#include "app/terminal.hpp"
#include "base/memory.hpp"
#include "deck/cards/cards.hpp"
#include "model/function_failure.hpp"
#include "solve/constraints/diagnosis.hpp"
#include "solve/run/buckling.hpp"
#include "user/routine.hpp"

namespace engrane::app {

using namespace output;
using namespace solve;

namespace {

/// Factors with more bytes than this are announced before they are computed.
constexpr double worth_announcing = 1e9;
/// Runs are repeated for a vibration that steps have lost if it takes no more than so many times their number to follow it.
constexpr double most_more_steps = 15;
/// Least ratio of the next tolerance to the present one: estimates of coarse runs are coarse.
constexpr double most_at_once = 0.01;

/// The text of the first rank that has one; empty when none has. Collective.
std::string first_text(std::string text, MPI_Comm comm, int rank, int ranks) {
  int teller = text.empty() ? ranks : rank;
  MPI_Allreduce(MPI_IN_PLACE, &teller, 1, MPI_INT, MPI_MIN, comm);
  if (teller == ranks) return {};
  return text_of_rank(teller, std::move(text), comm);
}

/// Adds the last failures of user routines and formulas, on any rank, to the text of a failure. Collective.
std::string with_causes(std::string failure, MPI_Comm comm, int rank, int ranks) {
  const std::string routine = first_text(user::last_failure(), comm, rank, ranks);
  const std::string function = first_text(last_function_failure(), comm, rank, ranks);
  if (failure.empty()) return failure;
  if (!routine.empty()) {
    // a routine that reports an error may have given finite numbers: what it says replaces the general sentence
    const std::string general = std::string(" ") + gives_not_finite;
    if (const auto at = failure.find(general); at != std::string::npos)
      failure.replace(at, general.size(), ": the user routine " + routine);
    else
      failure += ". The user routine " + routine;
  }
  if (function.empty()) return failure;
  // what a formula without a value was part of is not finite either, and not to blame
  const bool consequence = failure.find("finite") != std::string::npos || failure.find("nan") != std::string::npos;
  return consequence ? function + "; hence " + failure : failure + ". Note that " + function;
}

/// Extremes and means over time are taken from so many parts of each controlled step.
constexpr int parts_of_steps = 4;

/// The instants at which checks ask for values.
std::vector<double> times_of(const std::vector<deck::CheckCard>& checks) {
  std::vector<double> times;
  for (const deck::CheckCard& check : checks)
    if (check.time) times.push_back(*check.time);
  return times;
}

/// Clears failures of user routines and formulas that were reported or belong to rejected attempts of a step.
void forget_failures() {
  user::forget_failures();
  forget_function_failures();
}

}  // namespace

Attempt::Attempt(const Task& task, const Trial& trial, std::optional<Companion>& companion)
    : task_(task),
      trial_(trial),
      companion_(companion),
      context_(task.reading.model, trial.options, task.comm),
      observer_(context_.assembler, moves(task.reading.model), select_histories(task.reading.model)),
      schedule_(task.reading.model.commands.stepping, task.reading.model.commands.archive),
      fast_turns_(task.reading.model, trial.options),
      linked_turns_(task.reading.model),
      stability_(context_),
      energies_(context_, observer_),
      last_time_(task.reading.model.commands.stepping.start) {
  MPI_Comm_rank(task.comm, &rank_);
  MPI_Comm_size(task.comm, &ranks_);
  const std::vector<deck::CheckCard>& checks = task.reading.model.commands.checks;
  const bool over_time = std::any_of(checks.begin(), checks.end(), [](const auto& check) { return is_over_time(check); });
  if (schedule_.controlled()) schedule_.ask(times_of(checks), over_time ? parts_of_steps : 1);
}

/// A static start is the same for all schemes, but for the precision that another_scheme() gives it.
bool Attempt::no_scheme_helps() const {
  return !started_ && !task_.resumption && trial_.options.static_start && trial_.options.precision >= precision_of_other_scheme;
}

Verdict Attempt::make() {
  if (!open_results()) return {exit_status::wrong_deck, {}};
  if (task_.reading.is_one_solution()) task_.reading.forget_mesh();
  announce();
  run();
  if ((unsolved_ || wrong_) && trial_.settled) return settle(trial_, failure_, rank_);
  if (unsolved_ && trial_.complete) return back(trial_, failure_, rank_);
  if (unsolved_ && trial_.options.scheme_is_free && !no_scheme_helps())
    return another_scheme(task_.reading.model, trial_, failure_, rank_);
  if (std::optional<Trial> next = sharper()) return {exit_status::fine, std::move(next)};
  tell_condition();
  return {finish(), {}};
}

bool Attempt::open_results() {
  leave_at_once(false);
  std::string trouble;
  if (rank_ == 0) try {
      writer_.emplace(task_.reading, observer_, schedule_, task_.options, task_.prefix, task_.resumption, task_.summary);
      writer_->begin(context_, ranks_);
    } catch (const OutputError& e) {
      trouble = e.what();
    }
  int bad = !trouble.empty();
  MPI_Bcast(&bad, 1, MPI_INT, 0, task_.comm);
  if (!bad) return true;
  task_.summary.failure = trouble;
  if (rank_ == 0) std::cerr << "engrane: " << terminal_text(trouble) << '\n';
  return false;
}

void Attempt::announce() {
  if (!task_.options.quiet)  // on every rank, since all foresee together
    context_.solver.announce = [this](const ForeseenFactors& foreseen) {
      if (rank_ != 0 || foreseen.bytes < worth_announcing) return;
      writer_->note(fmt::format("engrane: the factors of {} equations will take about {:.1f} GB; {:.1f} GB are free",
                                context_.numbering.equations(), foreseen.bytes / 1e9, available_memory() / 1e9));
    };
  const std::string& asked = task_.reading.model.commands.analysis.solver.tag;
  if (rank_ == 0 && asked != "AUTO" && context_.solver.package() != asked)
    writer_->note("engrane: on several processes MUMPS solves, not " + asked);
}

void Attempt::run() {
  scheme_ = make_scheme(context_);
  runner_.emplace(context_, *scheme_);
  if (schedule_.controlled())
    observer_.keep_ends();
  else if (trial_.options.ends_even_steps_at_corners())
    observer_.integrate_smoothly();
  const StepCallback seen = [this](const Configuration& solved, const StepReport& step) { return after_step(solved, step); };
  leave_at_once(true);
  try {
    if (const Resumption* resumption = task_.resumption) {
      const Snapshot& memory = resumption->point.memory;
      observer_.load(memory);
      schedule_.load(memory);
      last_time_ = resumption->point.time;
      energies_.resume();
      if (rank_ == 0) writer_->resumed(*resumption);
      complete_ = runner_->resume(memory, seen);
    } else {
      complete_ = runner_->run(seen, [this](const StartReport& start) {
        started_ = true;
        if (rank_ == 0) writer_->started(start);
      });
    }
  } catch (const std::out_of_range& e) {
    // of the restart point: its arrays do not fit this model
    if (!task_.resumption) throw;
    failure_ = fmt::format("cannot restart from {}: {}", task_.resumption->earlier.path(), e.what());
  } catch (const SolutionFailure& e) {
    failure_ = e.what();
    unsolved_ = true;
  } catch (const MemoryShortage& e) {
    failure_ = e.what();
  }
  leave_at_once(false);
}

bool Attempt::after_step(const Configuration& solved, const StepReport& step) {
  leave_at_once(false);
  forget_failures();
  fast_turns_.take(solved);
  linked_turns_.take(solved);
  stability_.take(solved, step.last);
  find_buckling_modes(solved, step);
  // what follows is output, and may have the memory
  if (step.last && task_.reading.is_one_solution() && context_.solver.direct() && !task_.options.condition)
    context_.solver.reset();
  std::optional<Instants> instants;
  if (schedule_.controlled() && step.number > 0) {
    instants.emplace(schedule_, observer_, context_.out_of_plane, last_time_, solved, step);
    instants->observe_inside();
  }
  const auto watch = times_.output();
  const Schedule::Due due = instants ? show_instants(*instants, solved, step) : show(solved, step);
  last_time_ = solved.time;
  write([&] {
    if (companion_ && schedule_.even(solved.time)) companion_->compare(solved.time, observer_);
    writer_->step(solved, step, due, context_.numbering);
    writer_->remember(solved, *runner_, due.restart, false);
  });
  int stop = failure_.empty() ? 0 : 1;
  if (ranks_ > 1) MPI_Bcast(&stop, 1, MPI_INT, 0, task_.comm);
  if (stop == 0) {
    failure_ = energies_.failure(runner_->references(), solved.time, step.last);
    wrong_ = !failure_.empty();
    if (wrong_) stop = 1;
  }
  const bool far_enough = task_.options.until && solved.time >= *task_.options.until && !step.last;
  if (were_interrupted(task_.comm, ranks_) || far_enough) {
    failure_ = fmt::format("interrupted at t = {:.6g}", solved.time);
    wrong_ = false;  // no other run is wanted
    stop = 1;
  }
  return stop == 0;
}

void Attempt::find_buckling_modes(const Configuration& solved, const StepReport& step) {
  const auto& wanted = task_.reading.model.commands.buckling;
  if (!wanted || !(wanted->base.is("END") ? step.last : step.number == 0)) return;
  const std::vector<BucklingMode> modes = find_buckling(context_, solved, wanted->modes);
  std::vector<double> times;
  for (const BucklingMode& mode : modes) times.push_back(mode.load_time);
  observer_.set_buckling_times(std::move(times));
  if (rank_ == 0) writer_->buckling(modes, wanted->modes, solved);
}

Schedule::Due Attempt::show(const Configuration& solved, const StepReport& step) {
  const Schedule::Due due = schedule_.at(solved.time, step.number == 0 ? 0.0 : step.step, step.regular, step.last);
  const bool looked_at = due.sample || due.frame || !task_.reading.model.commands.checks.empty();
  observe(looked_at ? context_.out_of_plane.completed(solved) : solved, step, due);
  return due;
}

Schedule::Due Attempt::show_instants(Instants& instants, const Configuration& solved, const StepReport& step) {
  observe(context_.out_of_plane.completed(solved), step, {});
  if (companion_ && rank_ == 0) companion_->widen(observer_);
  return instants.show([this](double time, const Schedule::Due& due) {
    write([&] {
      if (companion_ && !schedule_.beside_even(time)) companion_->compare(time, observer_);
      writer_->between(time, due);
    });
  });
}

void Attempt::observe(const Configuration& seen, const StepReport& step, const Schedule::Due& due) {
  const int iterations = step.newton ? step.newton->iterations : 0;
  observe::Step observed{step.step, iterations, step.events.size(), step.corner, step.drift && step.corner, step.impulse};
  if (step.course) {
    observed.unstable = step.course->unstable;
    observed.critical_time = step.course->critical_time;
  }
  observer_.observe(seen, observed, due.sample || !context_.model.commands.checks.empty(), due.frame);
  if (context_.redundancy.active() && (step.last || (step.number & (step.number - 1)) == 0))
    observer_.find_not_unique(seen, context_.redundancy.undetermined(seen));
}

template <class Write>
void Attempt::write(const Write& write) {
  if (rank_ != 0 || !failure_.empty()) return;
  try {
    write();
  } catch (const OutputError& e) {
    failure_ = e.what();
    unwritten_ = true;
  }
}

std::optional<Trial> Attempt::sharper() {
  const auto [tolerance, longest] = sharper_steps();
  if (tolerance == 0) return {};
  SolverOptions next = trial_.settled ? *trial_.settled : with_tolerance(task_.reading.model, trial_.options, tolerance);
  next.longest = longest;
  const bool kept = longest == trial_.options.longest && companion_->serves(tolerance);
  if (kept) companion_->succeed(runner_->steps(), next, scheme_->lost_vibrations());
  return Trial{.options = next,
               .complete = trial_.options,
               .keeps_companion = kept,
               .first_steps = first_steps(),
               .differences = differences_};
}

Attempt::Estimates Attempt::estimates() {
  const SolverOptions& wanted = trial_.options;
  ErrorEstimate estimate = companion_->estimate(runner_->steps());
  if (!estimate.trouble.empty()) return {estimate, estimate};
  estimate.follow(trial_.differences);
  if (steps_are_longest()) estimate.steps_reach(wanted.longest);
  if (wanted.longest < solver_options(task_.reading.model).longest) estimate.shortened = wanted.longest;
  Estimates found{estimate, estimate};
  if (const LostVibrations* const lost = scheme_->lost_vibrations()) {
    const LostChannel most = companion_->most_lost(*lost);
    found.stated.include_lost(most.error, most.channel, most.period, wanted.target);
    const double reach = most_more_steps * static_cast<double>(first_steps());
    if (found.stated.vibration > 0 && wanted.end - begun() <= reach * found.stated.follows_vibration())
      found.deciding = found.stated;
  }
  differences_ = trial_.differences;
  // two runs that lose a vibration differ less than those that hold it
  if (found.deciding.vibration == 0) differences_.push_back(estimate.difference());
  return found;
}

std::array<double, 2> Attempt::sharper_steps() {
  if (!companion_ || !complete_) return {0, 0};
  const SolverOptions& wanted = trial_.options;
  double tolerance = 0, longest = wanted.longest;
  if (rank_ == 0) {
    const auto [estimate, stated] = estimates();
    const bool again = trial_.may_repeat && estimate.trouble.empty() && estimate.error > wanted.target;
    const std::string missed = "engrane: " + estimate.miss(wanted.target) + ": again, with ";
    // what is found of a vibration depends on rounding, and with it on the number of processes: steps are not to
    const double follows = estimate.vibration > 0 ? std::stod(fmt::format("{:.1e}", estimate.follows_vibration())) : 0;
    if (again && follows > 0 && follows < wanted.longest) {
      tolerance = trial_.settled ? trial_.settled->tolerance : wanted.tolerance;
      longest = follows;
      writer_->note(fmt::format("{}steps of at most {:.2g}", missed, longest));
    } else if (again && estimate.longest > 0) {
      tolerance = trial_.settled ? trial_.settled->tolerance : wanted.tolerance;
      longest = estimate.longest_for(wanted.target, trial_.differences);
      writer_->note(fmt::format("{}steps of at most {:.2g}", missed, longest));
    } else if (again && estimate.falls) {
      tolerance = std::max(estimate.tolerance_for(wanted.target), most_at_once * wanted.tolerance);
      // what was looser than the setting's own TOL goes on to that
      if (const AccuracyRung* rung = accuracy_rung(task_.reading.model.commands.analysis))
        tolerance = trial_.settled ? rung->tolerance : std::min(tolerance, rung->tolerance);
      writer_->note(fmt::format("{}TOL {:.1g}", missed, tolerance));
    } else {
      writer_->accuracy(stated, wanted.target, trial_.sharper_failed);
    }
  }
  std::array<double, 2> found{tolerance, longest};
  MPI_Bcast(found.data(), 2, MPI_DOUBLE, 0, task_.comm);
  return found;
}

bool Attempt::steps_are_longest() const {
  constexpr double nearly = 1.2;
  const SolverOptions& options = trial_.options;
  return static_cast<double>(runner_->steps()) * options.longest < nearly * (options.end - begun());
}

long Attempt::first_steps() const { return trial_.first_steps > 0 ? trial_.first_steps : runner_->steps(); }

double Attempt::begun() const { return task_.resumption ? task_.resumption->point.time : trial_.options.begin; }

std::string Attempt::looser_before() const {
  if (!task_.resumption || !trial_.complete) return {};
  return fmt::format(
      "the part before t = {:.6g} was solved with a TOL that proved too loose for the rest: its error may be larger than asked "
      "for, and the error of the state there, from which the rest starts, is not in the estimate. Run it again from the start if "
      "that matters",
      task_.resumption->point.time);
}

void Attempt::tell_condition() {
  if (!task_.options.condition) return;
  const std::optional<double> condition = context_.solver.condition();
  if (rank_ != 0) return;
  if (condition)
    writer_->conditioning({*condition, context_.solver.backward_error()});
  else
    writer_->note("engrane: --condition: no linear system was solved whose factors could tell");
}

int Attempt::finish() {
  failure_ = with_causes(std::move(failure_), task_.comm, rank_, ranks_);
  int status = complete_ ? exit_status::fine : exit_status::solution_failed;
  std::string unresolved;
  // positions of a KINEMATIC analysis do not come from a balance of forces
  if (complete_ && context_.options.analysis != SolverOptions::Analysis::kinematics)
    unresolved = explain_unresolved(context_.assembler, runner_->references(), context_.newton.keeps_one_tangent(),
                                    runner_->now(), observer_.energies().handled());
  if (rank_ == 0) {
    try {
      const std::string of_energy = complete_ ? energies_.remark(runner_->references()) : "";
      for (const std::string& remark : {unresolved, of_energy, stability_.remark(), fast_turns_.remark(), linked_turns_.remark(),
                                        complete_ ? looser_before() : "", context_.solver.remark()})
        if (!remark.empty()) writer_->warn(remark);
      if (runner_->started()) writer_->remember(runner_->now(), *runner_, false, true);
      status = writer_->finish(complete_ ? RunStatus::complete : RunStatus::failed, failure_, times_.split(context_.solver));
    } catch (const OutputError& e) {
      failure_ = e.what();
      unwritten_ = true;
      status = exit_status::solution_failed;
    }
    const Options& options = task_.options;
    task_.summary.failure = failure_;
    task_.summary.files = writer_->paths();
    // only now: an attempt that another one replaces keeps its warnings to itself
    std::vector<Diagnostic>& told = task_.summary.diagnostics;
    told.insert(told.end(), writer_->warnings().begin(), writer_->warnings().end());
    if (!failure_.empty()) {
      std::cerr << "engrane: " << terminal_text(failure_) << '\n';
      if (writer_->holds_samples() || !unwritten_)
        std::cerr << "         results up to there are in " << terminal_text(writer_->path()) << '\n';
    } else if (const std::string advice = times_.advice(context_.solver, ranks_); !advice.empty() && !options.quiet)
      std::cerr << advice;
    if (!options.quiet && !options.json && options.decks.size() == 1) std::cout << terminal_text(writer_->closing_lines());
  }
  MPI_Bcast(&status, 1, MPI_INT, 0, task_.comm);
  return status;
}

}  // namespace engrane::app
