// SPDX-License-Identifier: BSD-3-Clause
#include "app/solve_deck.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <optional>
#include <vector>

#include "app/companion.hpp"
#include "app/instants.hpp"
#include "app/model_difference.hpp"
#include "app/selection.hpp"
#include "app/terminal.hpp"
#include "app/times.hpp"
#include "app/writer.hpp"
#include "base/memory.hpp"
#include "deck/cards/cards.hpp"
#include "model/function_failure.hpp"
#include "model/masses.hpp"
#include "solve/constraints/diagnosis.hpp"
#include "solve/run/buckling.hpp"
#include "user/routine.hpp"

namespace engrane::app {

using namespace output;
using namespace solve;

namespace {

volatile std::sig_atomic_t interrupted = 0;
/// Before the first step is made, which may take long (the rank of the constraints is found in one piece), nothing is lost by
/// leaving at once: the results are in no open file.
volatile std::sig_atomic_t starting = 0;
void interrupt(int) {
  interrupted = 1;
  if (starting == 0) return;
  static constexpr char text[] = "engrane: interrupted at the start, before the first step\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text, sizeof text - 1);
  _exit(exit_status::solution_failed);
}

/// Opens what `.SAM RESTART` names, on every rank. Throws RestartError, also when its model is another than that of `reading`.
std::unique_ptr<Resumption> find_resumption(const Reading& reading, const Options& options) {
  const deck::AnalysisCard& card = reading.model.commands.analysis;
  const bool overruled = !options.restart.empty();
  const std::string& prefix = overruled ? options.restart : card.restart;
  const std::optional<double> time = overruled ? options.restart_time : card.restart_time;
  if (prefix.empty()) return nullptr;
  RestartFile earlier(prefix);
  SourceMap sources;
  Diagnostics diagnostics;
  const deck::Deck before =
      deck::read_text(earlier.path(), earlier.deck_text(), catalogue(element_types()), sources, diagnostics);
  if (const std::string difference = model_difference(before, reading.deck); !difference.empty())
    throw RestartError(
        fmt::format("{} is the result of another model: {}. A restart may change .SUB, .SAM, .SAI, checks, loads and "
                    "functions of time",
                    earlier.path(), difference));
  RestartPoint point = earlier.load(time);
  if (!reading.model.commands.path && point.time >= reading.model.commands.stepping.end)
    throw RestartError(fmt::format(
        "{} would be continued from t = {:.10g}, but .SUB ends at TF = {:.10g}: give a later TF, or RESTART with an earlier T",
        earlier.path(), point.time, reading.model.commands.stepping.end));
  return std::make_unique<Resumption>(std::move(earlier), std::move(point));
}

/// The text of the first rank that has one; empty when none has. Collective.
std::string first_text(std::string text, MPI_Comm comm, int rank, int ranks) {
  int teller = text.empty() ? ranks : rank;
  MPI_Allreduce(MPI_IN_PLACE, &teller, 1, MPI_INT, MPI_MIN, comm);
  if (teller == ranks) return {};
  int size = static_cast<int>(text.size());
  MPI_Bcast(&size, 1, MPI_INT, teller, comm);
  text.resize(static_cast<std::size_t>(size));
  MPI_Bcast(text.data(), size, MPI_CHAR, teller, comm);
  return text;
}

/// The failure with what user routines and formulas, on whichever rank, complained of last. Collective.
std::string with_causes(std::string failure, MPI_Comm comm, int rank, int ranks) {
  const std::string routine = first_text(user::last_failure(), comm, rank, ranks);
  const std::string function = first_text(last_function_failure(), comm, rank, ranks);
  if (failure.empty()) return failure;
  if (!routine.empty()) failure += ". The user routine " + routine;
  if (function.empty()) return failure;
  // what a formula without a value was part of is not finite either, and not to blame
  const bool consequence = failure.find("finite") != std::string::npos || failure.find("nan") != std::string::npos;
  return consequence ? function + "; hence " + failure : failure + ". Note that " + function;
}

/// Has any rank been asked to stop? Collective, so that all stop at the same step.
bool asked_to_stop(MPI_Comm comm, int ranks) {
  int stop = interrupted;
  if (ranks > 1) MPI_Allreduce(MPI_IN_PLACE, &stop, 1, MPI_INT, MPI_MAX, comm);
  return stop != 0;
}

/// The instants at which checks ask for values.
std::vector<double> times_of(const std::vector<deck::CheckCard>& checks) {
  std::vector<double> times;
  for (const deck::CheckCard& check : checks)
    if (check.time) times.push_back(*check.time);
  return times;
}

/// Energy that is as good as none: of a billionth of the extent, covered by all masses in the time of the analysis.
double unnoticed_energy(const Model& model, const SolverOptions& options) {
  MassProperties all;
  for (const Model::Part& part : model.parts) all.add(mass_properties(model, part));
  const double extent = model.extent(), speed = 1e-9 * extent / (options.end - options.begin);
  return 0.5 * (all.mass + all.inertia.trace() / (extent * extent)) * speed * speed;
}

/// Why the run must end when its energies say that it is wrong; empty when they do not.
std::string energy_failure(const SolverContext& context, const observe::Observer& observer, const Configuration& c) {
  const double allowed = context.options.energy_error;
  if (context.options.analysis != SolverOptions::Analysis::dynamics || allowed == 0) return {};
  const observe::EnergyBalance& balance = observer.energies();
  // what Newton's iteration leaves of forces in a machine at rest does work too
  const double rounding = 1e-6 * context.newton.largest_force() * context.model.extent();
  if (std::abs(balance.error()) <= allowed * std::max(balance.handled(), rounding)) return {};
  if (std::abs(balance.error()) <= allowed * unnoticed_energy(context.model, context.options)) return {};
  const std::string unit = context.model.units.label(dimension::energy);
  return fmt::format(
      "the energy balance is off by {:.4g} {} at t = {:.6g}, more than the {:.4g} {} that were in the machine or passed through "
      "it: "
      "the results went wrong some time before this. Take a smaller step H{}; ENERGY 0 in .SAM lets the run continue",
      balance.error(), unit, c.time, balance.handled(), unit,
      context.options.family == SolverOptions::Family::newmark || context.options.damping > 0.99
          ? ", or a scheme with damping (RHO below 1): without it, rounding errors in the constraints grow"
          : "");
}

/// Lets the observer see an accepted step; what is not unique is looked for at the start, after 1, 2, 4, … steps and at the end.
void observe_step(SolverContext& context, observe::Observer& observer, const Configuration& c, const StepReport& step,
                  const Schedule::Due& due) {
  const Model& model = context.model;
  const int iterations = step.newton ? step.newton->iterations : 0;
  observe::Step seen{step.step, iterations, step.events.size(), step.corner};
  if (step.course) {
    seen.unstable = step.course->unstable;
    seen.critical_time = step.course->critical_time;
  }
  observer.observe(c, seen, due.sample || !model.commands.checks.empty(), due.frame);
  if (context.redundancy.active() && (step.last || (step.number & (step.number - 1)) == 0))
    observer.find_not_unique(c, context.redundancy.undetermined(c));
}

/// Bytes of factors that a run speaks of before it takes them.
constexpr double worth_announcing = 1e9;
/// With ACCURACY a run may be repeated so often with another tolerance, or another scheme.
constexpr int most_repeats = 3;
/// Part of the tolerance that the next has at least: estimates of coarse runs are coarse.
constexpr double most_at_once = 0.01;

/// ACCURACY FAST begins with so much looser steps, where it is TOL that chooses them and the deck does not give it.
constexpr double bolder = 4;

/// A run to make, and what those before it have told.
struct Trial {
  SolverOptions options;
  bool may_repeat = true;                 ///< when the error is too large
  std::optional<SolverOptions> complete;  ///< of a run that came to its end, but with too large an error
  std::string sharper_failed;             ///< how one with a sharper tolerance than this failed
};

/// What came of a run: its exit status, or what to try instead.
struct Verdict {
  int status = 0;
  std::optional<Trial> again;
};

/// Generalised-alpha where Radau fails: at positions in which the rank of the constraints falls, for one. It begins with the
/// setting's own TOL.
Verdict another_scheme(const Model& model, Trial trial, const std::string& why, int rank) {
  if (rank == 0) std::cerr << "engrane: SCHEME RADAU fails here, again with CHUNG: " << terminal_text(why) << '\n';
  SolverOptions& options = trial.options;
  const SolverOptions own = solver_options(model);
  options.family = SolverOptions::Family::chung;
  options.scheme_is_free = false;
  options.damping = 0.8;
  options.precision = 1e-9;
  options.tolerance = std::min(options.tolerance, own.tolerance);
  options.event_tolerance = std::min(options.event_tolerance, own.event_tolerance);
  return {exit_status::fine, std::move(trial)};
}

/// Back to the last run that came to its end, where one with a sharper tolerance fails: a result that is less accurate than was
/// asked for is better than half of one.
Verdict back(const Trial& failed, const std::string& why, int rank) {
  const std::string text = fmt::format("with TOL {:.1g} the run fails: {}", failed.options.tolerance, why);
  if (rank == 0) std::cerr << fmt::format("engrane: {}; back to TOL {:.1g}\n", terminal_text(text), failed.complete->tolerance);
  return {exit_status::fine, Trial{*failed.complete, false, {}, text}};
}

/// `.SUB` says TOL.
bool gives_tolerance(const deck::Deck& deck) {
  return std::any_of(deck.records.begin(), deck.records.end(), [](const deck::Record& record) {
    const deck::SteppingCard* card = record.get<deck::SteppingCard>();
    return card && card->tolerance;
  });
}

/// Runs the companion that `options` ask for, the first time. FAST then takes longer steps than its own where TOL chooses them:
/// what those are made for are contacts that vibrate within a few of the longest steps. Collective.
std::optional<Companion> first_companion(const Reading& reading, SolverOptions& options, MPI_Comm comm, bool quiet) {
  std::optional<Companion> companion;
  const bool fast = options.target >= accuracy_rungs.front().target && options.family == SolverOptions::Family::radau;
  if (fast && !gives_tolerance(reading.deck)) {
    const SolverOptions bold = with_tolerance(reading.model, options, bolder * options.tolerance);
    companion.emplace(reading, bold, comm, quiet);
    if (companion->trouble().empty() && companion->follows_tolerance()) {
      options = bold;
      return companion;
    }
  }
  companion.emplace(reading, options, comm, quiet);
  return companion;
}

Verdict solve_once(Reading& reading, const Options& options, const Trial& trial, std::optional<Companion>& companion,
                   const Resumption* resumption, const std::string& prefix, MPI_Comm comm, RunSummary& summary) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  starting = 1;
  user::forget_failures();  // those of another run
  forget_function_failures();
  Times times;
  const SolverOptions& wanted = trial.options;
  if (companion && !companion->trouble().empty() && wanted.scheme_is_free)
    return another_scheme(reading.model, trial, companion->trouble(), rank);
  SolverContext context(reading.model, wanted, comm);
  observe::Observer observer(context.assembler, moves(reading.model), select_histories(reading.model));
  Schedule schedule(reading.model.commands.stepping, reading.model.commands.archive);
  if (schedule.controlled()) schedule.ask(times_of(reading.model.commands.checks));
  std::optional<Writer> writer;
  starting = 0;  // files are open
  // the other ranks must hear of it when the files cannot be made
  std::string trouble;
  if (rank == 0) try {
      writer.emplace(reading, observer, schedule, options, prefix, resumption, summary);
      writer->begin(context, ranks);
    } catch (const OutputError& e) {
      trouble = e.what();
    }
  int bad = !trouble.empty();
  MPI_Bcast(&bad, 1, MPI_INT, 0, comm);
  if (bad) {
    summary.failure = trouble;
    if (rank == 0) std::cerr << "engrane: " << terminal_text(trouble) << '\n';
    return {exit_status::solution_failed, {}};
  }
  if (reading.is_one_solution()) reading.forget_mesh();
  if (!options.quiet)  // on every rank, since all foresee together
    context.solver.announce = [&](const ForeseenFactors& foreseen) {
      if (rank != 0 || foreseen.bytes < worth_announcing) return;
      writer->note(fmt::format("engrane: the factors of {} equations will take about {:.1f} GB; {:.1f} GB are free",
                               context.numbering.equations(), foreseen.bytes / 1e9, available_memory() / 1e9));
    };
  const std::string& asked = reading.model.commands.analysis.solver.tag;
  if (rank == 0 && asked != "AUTO" && context.solver.package() != asked)
    writer->note("engrane: on several processes MUMPS solves, not " + asked);

  std::string failure;
  bool complete = false, unsolved = false;
  const auto scheme = make_scheme(context);
  Runner runner(context, *scheme);
  Configuration whole;
  double last_time = reading.model.commands.stepping.start;
  if (schedule.controlled()) observer.keep_ends();
  const Observer after_step = [&](const Configuration& solved, const StepReport& step) {
    starting = 0;
    user::forget_failures();  // those of attempts that were cut
    forget_function_failures();
    // the configuration with its forces out of the plane, where somebody looks
    const auto in_space = [&](const Configuration& found, bool seen) -> const Configuration& {
      if (!seen || !context.out_of_plane.active()) return found;
      whole = found;
      context.out_of_plane.find(whole);
      return whole;
    };
    if (const auto& wanted_modes = reading.model.commands.buckling;
        wanted_modes && (wanted_modes->base.is("END") ? step.last : step.number == 0)) {
      const std::vector<BucklingMode> modes = find_buckling(context, solved, wanted_modes->modes);
      std::vector<double> found;
      for (const BucklingMode& mode : modes) found.push_back(mode.load_time);
      observer.set_buckling_times(std::move(found));
      if (rank == 0) writer->buckling(modes, solved);
    }
    // what follows is output, and may have the memory
    if (step.last && reading.is_one_solution() && context.solver.direct() && !options.condition) context.solver.reset();
    const bool checked = !reading.model.commands.checks.empty();
    const auto seen = [&](const Configuration& found) -> const Configuration& { return in_space(found, true); };
    std::optional<Instants> instants;
    if (schedule.controlled() && step.number > 0) {
      instants.emplace(schedule, observer, seen, last_time, solved, step);
      instants->observe_inside();
    }
    const auto watch = times.output();
    Schedule::Due due;
    if (instants) {
      observe_step(context, observer, in_space(solved, true), step, {});
      due = instants->show([&](double time, const Schedule::Due& now) {
        if (rank == 0 && failure.empty()) try {
            if (companion && !schedule.beside_even(time)) companion->compare(time, observer);
            writer->between(time, now);
          } catch (const OutputError& e) {
            failure = e.what();
          }
      });
    } else {
      due = schedule.at(solved.time, step.number == 0 ? 0.0 : step.step, step.regular, step.last);
      observe_step(context, observer, in_space(solved, due.sample || due.frame || checked), step, due);
    }
    last_time = solved.time;
    int stop = failure.empty() ? 0 : 1;
    if (rank == 0 && stop == 0) try {
        if (companion && schedule.even(solved.time)) companion->compare(solved.time, observer);
        writer->step(solved, step, due, context.numbering);
        writer->remember(solved, runner, due.restart, false);
      } catch (const OutputError& e) {
        failure = e.what();
        stop = 1;
      }
    if (ranks > 1) MPI_Bcast(&stop, 1, MPI_INT, 0, comm);
    if (const std::string wrong = energy_failure(context, observer, solved); !wrong.empty() && stop == 0) {
      failure = wrong;
      stop = 1;
    }
    const bool far_enough = options.until && solved.time >= *options.until && !step.last;
    if (asked_to_stop(comm, ranks) || far_enough) {
      failure = fmt::format("interrupted at t = {:.6g}", solved.time);
      stop = 1;
    }
    return stop == 0;
  };
  starting = 1;
  try {
    if (resumption) {
      observer.load(resumption->point.memory);
      schedule.load(resumption->point.memory);
      last_time = resumption->point.time;
      if (rank == 0) writer->resumed(*resumption);
      complete = runner.resume(resumption->point.memory, after_step);
    } else {
      complete = runner.run(after_step, [&](const StartReport& start) {
        if (rank == 0) writer->started(start);
      });
    }
  } catch (const std::out_of_range& e) {
    // of the restart point: its arrays do not fit this model
    if (!resumption) throw;
    failure = fmt::format("cannot restart from {}: {}", resumption->earlier.path(), e.what());
  } catch (const SolutionFailure& e) {
    failure = e.what();
    unsolved = true;
  } catch (const MemoryShortage& e) {
    failure = e.what();
  }
  starting = 0;
  if (unsolved && trial.complete) return back(trial, failure, rank);
  if (unsolved && wanted.scheme_is_free) return another_scheme(reading.model, trial, failure, rank);
  if (companion && complete) {
    double tolerance = 0;
    if (rank == 0) {
      const ErrorEstimate estimate = companion->estimate(runner.steps());
      if (trial.may_repeat && estimate.trouble.empty() && estimate.error > wanted.target) {
        tolerance = std::max(estimate.tolerance_for(wanted.target), most_at_once * wanted.tolerance);
        // what was tried beyond the setting's own TOL goes back to that
        tolerance = std::min(tolerance, tolerance_of(reading.model.commands.analysis).value_or(tolerance));
        writer->note(
            fmt::format("engrane: the error is estimated to be {:.2g} of the range of {}, more than the {:g} asked for: again, "
                        "with TOL {:.1g}",
                        estimate.error, estimate.channel, wanted.target, tolerance));
      } else {
        writer->accuracy(estimate, wanted.target, trial.sharper_failed);
      }
    }
    MPI_Bcast(&tolerance, 1, MPI_DOUBLE, 0, comm);
    if (tolerance > 0) return {exit_status::fine, Trial{with_tolerance(reading.model, wanted, tolerance), true, wanted, {}}};
  }
  if (options.condition) {
    const std::optional<double> condition = context.solver.condition();
    if (rank == 0 && condition) writer->conditioning({*condition, context.solver.backward_error()});
    if (rank == 0 && !condition) writer->note("engrane: --condition: no linear system was solved whose factors could tell");
  }
  failure = with_causes(std::move(failure), comm, rank, ranks);
  int status = complete ? exit_status::fine : exit_status::solution_failed;
  std::string unresolved;
  if (complete) unresolved = explain_unresolved(context.assembler, context.newton, runner.now(), observer.energies().handled());
  if (rank == 0) {
    try {
      if (!unresolved.empty()) writer->warn(unresolved);
      if (const std::string remark = context.solver.remark(); !remark.empty()) writer->warn(remark);
      if (runner.started()) writer->remember(runner.now(), runner, false, true);
      status = writer->finish(complete ? RunStatus::complete : RunStatus::failed, failure, times.split(context.solver));
    } catch (const OutputError& e) {
      failure = e.what();
      status = exit_status::solution_failed;
    }
    summary.failure = failure;
    summary.files = writer->paths();
    if (!failure.empty())
      std::cerr << "engrane: " << terminal_text(failure) << "\n         results up to there are in " << writer->path() << '\n';
    else if (const std::string advice = times.advice(context.solver, ranks); !advice.empty() && !options.quiet)
      std::cerr << advice;
    if (!options.quiet && !options.json && options.decks.size() == 1) std::cout << terminal_text(writer->closing_lines());
  }
  MPI_Bcast(&status, 1, MPI_INT, 0, comm);
  return {status, {}};
}

/// The mesh of the deck that bears the name of the results; empty when none does.
std::string mesh_in_the_way(const Reading& reading, const std::string& prefix) {
  std::error_code error;
  for (const std::filesystem::path& mesh : reading.deck.meshes)
    if (std::filesystem::equivalent(mesh, prefix + ".h5", error)) return mesh.string();
  return {};
}

}  // namespace

bool was_interrupted() { return interrupted != 0; }

int solve_deck(Reading& reading, const Options& options, const std::string& prefix, MPI_Comm comm, RunSummary& summary) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of writing, not the end of the program

  if (const std::string mesh = mesh_in_the_way(reading, prefix); !mesh.empty()) {
    summary.failure = fmt::format("the results would take the place of the mesh {}: -o gives them another name", mesh);
    if (rank == 0) std::cerr << "engrane: " << terminal_text(summary.failure) << '\n';
    return exit_status::wrong_deck;
  }
  starting = 1;
  std::unique_ptr<Resumption> resumption;
  try {
    resumption = find_resumption(reading, options);
  } catch (const RestartError& e) {
    summary.failure = e.what();
    if (rank == 0) std::cerr << "engrane: " << terminal_text(e.what()) << '\n';
    return exit_status::wrong_deck;
  }
  Trial trial{solver_options(reading.model), true, {}, {}};
  const bool estimates = trial.options.target > 0 && trial.options.tolerance > 0 && !resumption;
  std::optional<Companion> companion;
  for (int repeats = 0;; ++repeats) {
    if (estimates && repeats == 0) companion = first_companion(reading, trial.options, comm, options.quiet);
    if (estimates && !companion) companion.emplace(reading, trial.options, comm, options.quiet);
    trial.may_repeat = trial.may_repeat && repeats < most_repeats;
    Verdict verdict = solve_once(reading, options, trial, companion, resumption.get(), prefix, comm, summary);
    if (!verdict.again) return verdict.status;
    companion.reset();
    trial = std::move(*verdict.again);
  }
}

}  // namespace engrane::app
