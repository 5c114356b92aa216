// SPDX-License-Identifier: BSD-3-Clause
#include "app/solve_deck.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <optional>

#include "app/layout.hpp"
#include "app/model_difference.hpp"
#include "app/model_json.hpp"
#include "app/schedule.hpp"
#include "app/selection.hpp"
#include "app/summary.hpp"
#include "app/terminal.hpp"
#include "app/times.hpp"
#include "app/version.hpp"
#include "model/function_failure.hpp"
#include "output/checks.hpp"
#include "output/listing.hpp"
#include "output/progress.hpp"
#include "output/restart_file.hpp"
#include "solve/constraints/start_report.hpp"
#include "solve/run/runner.hpp"
#include "user/routine.hpp"

namespace engrane::app {

using namespace output;
using namespace solve;

namespace {

volatile std::sig_atomic_t interrupted = 0;
void interrupt(int) { interrupted = 1; }

/// Checks of the deck, each tied to its channel. The reader has made sure that the channels exist.
Checks resolve_checks(const Model& model, const observe::Observer& observer) {
  std::vector<Checks::Resolved> all;
  for (const deck::CheckCard& card : model.commands.checks) {
    const std::string owner = card.element ? fmt::format("element/{}", *card.element)
                              : card.node  ? fmt::format("node/{}", *card.node)
                                           : std::string("run");
    all.push_back({card, static_cast<std::size_t>(observer.channel(owner, card.quantity))});
  }
  return Checks(std::move(all));
}

/// An earlier run, and the point of it that this run continues from.
struct Resumption {
  RestartFile earlier;
  RestartPoint point;
};

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
  if (point.time >= reading.model.commands.stepping.end)
    throw RestartError(fmt::format(
        "{} would be continued from t = {:.10g}, but .SUB ends at TF = {:.10g}: give a later TF, or RESTART with an earlier T",
        earlier.path(), point.time, reading.model.commands.stepping.end));
  return std::make_unique<Resumption>(std::move(earlier), std::move(point));
}

/// More events than this are counted only.
constexpr long most_listed_events = 100;

/// Everything that rank 0 writes during a run.
class Writer {
 public:
  /// `resumed`: what this run continues from, or nullptr.
  Writer(const Reading& reading, const observe::Observer& observer, const Schedule& schedule, const Options& options,
         const std::string& prefix, const Resumption* resumed, RunSummary& summary)
      : reading_(reading),
        options_(options),
        summary_(summary),
        observer_(observer),
        schedule_(schedule),
        results_(make_results(prefix, results_layout(reading, observer, schedule.expected_samples()), resumed)),
        listing_(results_.name()),
        checks_(resolve_checks(reading.model, observer)),
        progress_(reading.model.commands.stepping.start, reading.model.commands.stepping.end,
                  options.quiet ? Progress::Style::silent : Progress::suitable()) {}

  void begin(const SolverContext& context, int ranks) {
    const Model& model = reading_.model;
    std::string deck = summary_.deck;
    for (const auto& [name, text] : summary_.definitions) deck += fmt::format(" -D {}={}", name.substr(1), text);
    listing_.write(listing_header({version, library_versions(), model.title, deck, describe_analysis(model),
                                   fmt::format("{} process{}", ranks, ranks == 1 ? "" : "es")}));
    listing_.write(listing_section("What was built"));
    listing_.write(listing_built(summarize(model, context.numbering)));
    listing_.write(describe_geometry(model));
    listing_.write(listing_warnings(reading_.diagnostics, reading_.sources));
    if (const std::string text = reading_.assumptions(); !text.empty()) {
      listing_.write(fmt::format("\n  {}\n", text));
      progress_.note("engrane: " + text);
    }
    if (const std::string text = left_out_histories(model); !text.empty()) {
      listing_.write(fmt::format("\n  {}\n", text));
      progress_.note("engrane: " + text);
    }
    listing_.write(listing_section("Start"));
  }

  void resumed(const Resumption& from) {
    checks_.load(from.point.memory);
    const std::vector<double>& counts = from.point.memory.array("writer/counts");
    steps_ = static_cast<long>(counts.at(0));
    iterations_ = static_cast<long>(counts.at(1));
    cuts_ = static_cast<long>(counts.at(2));
    locating_ = static_cast<long>(counts.at(3));
    event_count_ = static_cast<long>(counts.at(4));
    marked_ = observer_.not_unique().size();
    results_.mark_not_unique(observer_.not_unique());
    listing_.write(fmt::format("  restarted from {} at t = {:.10g}\n", from.earlier.path(), from.point.time));
    if (reading_.model.commands.archive.newton) listing_.write(listing_section("Newton iterations"));
  }

  /// Gives the results what the run could be restarted from: with a batch, where the deck asks for it, and at the end.
  void remember(const Configuration& c, const Runner& runner, bool kept, bool last) {
    if (!kept && !last && !results_.due()) return;
    Snapshot memory;
    runner.save(memory);
    observer_.save(memory);
    schedule_.save(memory);
    checks_.save(memory);
    memory.put("writer/counts", {static_cast<double>(steps_), static_cast<double>(iterations_), static_cast<double>(cuts_),
                                 static_cast<double>(locating_), static_cast<double>(event_count_)});
    results_.restart_point(c.time, std::move(memory), kept);
    if (results_.due()) results_.flush();
  }

  void started(const StartReport& start) {
    listing_.write(describe_start(reading_.model, start));
    listing_.write(start.mobility);
    for (const std::string& remark : start.remarks) progress_.note("engrane: assembly: " + remark);
    if (start.redundant > 0)
      progress_.note(
          fmt::format("engrane: {} redundant constraint{}: how some reactions share a load is not unique (see the listing)",
                      start.redundant, start.redundant == 1 ? "" : "s"));
    if (reading_.model.commands.archive.newton) listing_.write(listing_section("Newton iterations"));
  }

  void step(const Configuration& c, const StepReport& step, const Schedule::Due& due, const Numbering& numbering) {
    const bool last = c.time >= reading_.model.commands.stepping.end;
    if (!checks_.empty()) checks_.observe(c.time, observer_.values(), step.regular);
    if (observer_.not_unique().size() != marked_) {
      marked_ = observer_.not_unique().size();
      results_.mark_not_unique(observer_.not_unique());
    }
    if (due.sample) results_.sample(c.time, observer_.values());
    if (due.frame) {
      results_.frame(c.time, frame_values(reading_.model, observer_));
      const observe::EnergyBalance& e = observer_.energies();
      energies_.push_back({c.time, e.kinetic, e.potential, e.external_work, e.dissipated, e.error()});
    }
    summary_.time = c.time;
    ++steps_;
    cuts_ += step.cuts;
    locating_ += step.locating;
    note_events(c, step);
    if (step.newton) {
      iterations_ += step.newton->iterations;
      if (reading_.model.commands.archive.newton) write_newton(c, step, numbering);
    }
    progress_.update(c.time, step.step, step.number);
    if (!last) return;
    progress_.finish();
    collect_remarks(c, numbering);
  }

  /// Ends listing and results; returns the exit status.
  int finish(RunStatus status, const std::string& failure, const TimeSplit& times) {
    progress_.finish();
    const UnitSystem& units = reading_.model.units;
    listing_.write(listing_section("Energies"));
    listing_.write(listing_energies(thinned_energies(), units));
    std::vector<ReactionRow> reactions;
    for (const observe::Reaction& r : observer_.reactions())
      reactions.push_back({reading_.model.nodes[static_cast<std::size_t>(r.node)].id, r.force, r.torque});
    if (!reactions.empty()) {
      listing_.write(listing_section("Reactions at the end"));
      listing_.write(listing_reactions(reactions, units));
    }
    if (marked_ > 0) {
      listing_.write(listing_section("Not unique"));
      listing_.write(listing_not_unique(results_.layout().history, observer_.not_unique()));
    }
    if (event_count_ > 0) {
      listing_.write(listing_section("Events"));
      listing_.write(events_);
      if (event_count_ > most_listed_events) listing_.write(fmt::format("  and {} more\n", event_count_ - most_listed_events));
      listing_.write(fmt::format("  {} in all, located by {} attempts beyond those of the steps\n", event_count_, locating_));
    }
    if (!remarks_.empty()) {
      listing_.write(listing_section("Remarks"));
      listing_.write(remarks_);
    }
    int exit = exit_status::fine;
    if (!failure.empty()) {
      listing_.write(listing_section("The run failed"));
      listing_.write("  " + failure + "\n");
      exit = exit_status::solution_failed;
    }
    std::vector<CheckResult> results = checks_.results();
    const auto first_wanted = results.end() - static_cast<std::ptrdiff_t>(reading_.wanted);
    summary_.results.assign(first_wanted, results.end());
    results.erase(first_wanted, results.end());
    if (!results.empty()) {
      results_.checks(results);
      const std::string table = listing_checks(results);
      listing_.write(listing_section("Checks"));
      listing_.write(table);
      if (failure.empty()) {
        if (!options_.json) std::cout << terminal_text(table);
        for (const CheckResult& r : results)
          if (!r.passed) exit = exit_status::check_failed;
      }
    }
    if (!summary_.results.empty()) {
      const std::string table = wanted_table();
      listing_.write(listing_section("Results asked for"));
      listing_.write(table);
      if (!options_.json) std::cout << terminal_text(table);
    }
    summary_.checks = std::move(results);
    summary_.energies = observer_.energies();
    listing_.write(listing_section("Effort"));
    listing_.write(fmt::format("  {} steps, {} Newton iterations ({:.2f} per step), {} failed attempts\n", steps_ - 1,
                               iterations_, steps_ > 1 ? static_cast<double>(iterations_) / static_cast<double>(steps_ - 1) : 0.0,
                               cuts_));
    listing_.write(listing_times(times));
    results_.finish(status);
    listing_.finish(status == RunStatus::complete);
    summary_.steps = std::max(0L, steps_ - 1);
    summary_.iterations = iterations_;
    summary_.cuts = cuts_;
    summary_.events = event_count_;
    summary_.seconds = times.total;
    return exit;
  }

  const std::string& path() const { return results_.path(); }
  /// Results, their index and the listing, as they are called now.
  std::vector<std::string> paths() const {
    const std::string stem = path().substr(0, path().size() - std::string_view(".h5").size());
    return {path(), stem + ".xdmf", stem + ".lst"};
  }
  void note(const std::string& text) { progress_.note(text); }

 private:
  std::string wanted_table() const {
    std::string table;
    for (const CheckResult& r : summary_.results)
      table += fmt::format("  {}: {}\n", r.text, r.remark.empty() ? fmt::format("{:.10g}", r.value) : r.remark);
    return table;
  }
  void note_events(const Configuration& c, const StepReport& step) {
    for (const Event& e : step.events) {
      if (++event_count_ > most_listed_events) continue;
      const Model::Part& part = reading_.model.parts[static_cast<std::size_t>(e.part)];
      const SwitchNames& names = part.element->layout().switches[static_cast<std::size_t>(e.index)];
      events_ +=
          fmt::format("  t = {:<14.9g} {} {}: {}\n", c.time, part.type, part.element->id(), e.rises ? names.rises : names.falls);
    }
    if (!step.chatter) return;
    const std::string text =
        fmt::format("t = {:.6g}: events come too thick to be met one by one; some steps pass over them", c.time);
    events_ += "  warning: " + text + "\n";
    progress_.note("engrane: " + text);
  }
  /// What elements remember of the run and its user should know.
  void collect_remarks(const Configuration& c, const Numbering& numbering) {
    for (int p = 0; p < numbering.parts(); ++p) {
      const Model::Part& part = reading_.model.parts[static_cast<std::size_t>(p)];
      const auto size = static_cast<std::size_t>(part.element->layout().history);
      for (const std::string& remark :
           part.element->remarks(std::span(c.history).subspan(static_cast<std::size_t>(numbering.history_begin(p)), size))) {
        const std::string text = fmt::format("{} {}: {}", part.type, part.element->id(), remark);
        remarks_ += "  warning: " + text + "\n";
        progress_.note("engrane: " + text);
      }
    }
  }
  void write_newton(const Configuration& c, const StepReport& step, const Numbering& numbering) {
    std::vector<IterationRow> rows;
    for (const NewtonRow& r : step.newton->rows)
      rows.push_back({step.number, c.time, r.iteration, r.force, r.moment, r.length, r.angle, r.correction,
                      r.worst >= 0 ? numbering.describe(r.worst) : ""});
    listing_.write(listing_newton(rows, step.number == 1));
  }
  /// About twenty rows are enough to see a trend; the file has them all.
  std::vector<EnergyRow> thinned_energies() const {
    std::vector<EnergyRow> rows;
    const std::size_t every = std::max<std::size_t>(1, (energies_.size() + 19) / 20);
    for (std::size_t i = 0; i < energies_.size(); ++i)
      if (i % every == 0 || i + 1 == energies_.size()) rows.push_back(energies_[i]);
    return rows;
  }

  static Results make_results(const std::string& prefix, ResultsLayout layout, const Resumption* resumed) {
    if (resumed) return {prefix, std::move(layout), resumed->earlier, resumed->point};
    return {prefix, std::move(layout)};
  }

  const Reading& reading_;
  const Options& options_;
  RunSummary& summary_;
  const observe::Observer& observer_;
  const Schedule& schedule_;
  Results results_;
  Listing listing_;
  Checks checks_;
  Progress progress_;
  std::vector<EnergyRow> energies_;
  std::string events_, remarks_;
  std::size_t marked_ = 0;  ///< channels marked as not unique so far
  long steps_ = 0, iterations_ = 0, cuts_ = 0, event_count_ = 0, locating_ = 0;
};

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

/// Why the run must end when its energies say that it is wrong; empty when they do not.
std::string energy_failure(const SolverContext& context, const observe::Observer& observer, const Configuration& c) {
  const double allowed = context.options.energy_error;
  if (context.options.analysis != SolverOptions::Analysis::dynamics || allowed == 0) return {};
  const observe::EnergyBalance& balance = observer.energies();
  // what Newton's iteration leaves of forces in a machine at rest does work too
  const double rounding = 1e-6 * context.newton.largest_force() * context.model.extent();
  if (std::abs(balance.error()) <= allowed * std::max(balance.handled(), rounding)) return {};
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
  observer.observe(c, {step.step, iterations, step.events.size()}, due.sample || !model.commands.checks.empty(), due.frame);
  const bool last = c.time >= model.commands.stepping.end;
  if (context.redundancy.active() && (last || (step.number & (step.number - 1)) == 0))
    observer.find_not_unique(c, context.redundancy.undetermined(c));
}

}  // namespace

bool was_interrupted() { return interrupted != 0; }

int solve_deck(const Reading& reading, const Options& options, const std::string& prefix, MPI_Comm comm, RunSummary& summary) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of writing, not the end of the program

  user::forget_failures();  // those of another deck
  forget_function_failures();
  Times times;
  std::unique_ptr<Resumption> resumption;
  try {
    resumption = find_resumption(reading, options);
  } catch (const RestartError& e) {
    summary.failure = e.what();
    if (rank == 0) std::cerr << "engrane: " << terminal_text(e.what()) << '\n';
    return exit_status::wrong_deck;
  }
  SolverContext context(reading.model, comm);
  observe::Observer observer(context.assembler, moves(reading.model), select_histories(reading.model));
  Schedule schedule(reading.model.commands.stepping, reading.model.commands.archive);
  std::optional<Writer> writer;
  // the other ranks must hear of it when the files cannot be made
  std::string trouble;
  if (rank == 0) try {
      writer.emplace(reading, observer, schedule, options, prefix, resumption.get(), summary);
      writer->begin(context, ranks);
    } catch (const OutputError& e) {
      trouble = e.what();
    }
  int bad = !trouble.empty();
  MPI_Bcast(&bad, 1, MPI_INT, 0, comm);
  if (bad) {
    summary.failure = trouble;
    if (rank == 0) std::cerr << "engrane: " << terminal_text(trouble) << '\n';
    return exit_status::solution_failed;
  }
  if (rank == 0 && context.solver.package() != reading.model.commands.analysis.solver.tag)
    writer->note("engrane: on several processes MUMPS solves, not " + reading.model.commands.analysis.solver.tag);

  std::string failure;
  bool complete = false;
  const auto scheme = make_scheme(context);
  Runner runner(context, *scheme);
  const Observer after_step = [&](const Configuration& c, const StepReport& step) {
    const auto watch = times.output();
    user::forget_failures();  // those of attempts that were cut
    forget_function_failures();
    const Schedule::Due due = schedule.at(c.time, step.number == 0 ? 0.0 : step.step, step.regular);
    observe_step(context, observer, c, step, due);
    int stop = 0;
    if (rank == 0) try {
        writer->step(c, step, due, context.numbering);
        writer->remember(c, runner, due.restart, false);
      } catch (const OutputError& e) {
        failure = e.what();
        stop = 1;
      }
    if (ranks > 1) MPI_Bcast(&stop, 1, MPI_INT, 0, comm);
    if (const std::string wrong = energy_failure(context, observer, c); !wrong.empty() && stop == 0) {
      failure = wrong;
      stop = 1;
    }
    const bool far_enough = options.until && c.time >= *options.until && c.time < reading.model.commands.stepping.end;
    if (asked_to_stop(comm, ranks) || far_enough) {
      failure = fmt::format("interrupted at t = {:.6g}", c.time);
      stop = 1;
    }
    return stop == 0;
  };
  try {
    if (resumption) {
      observer.load(resumption->point.memory);
      schedule.load(resumption->point.memory);
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
  }
  failure = with_causes(std::move(failure), comm, rank, ranks);
  int status = complete ? exit_status::fine : exit_status::solution_failed;
  if (rank == 0) {
    try {
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
  }
  MPI_Bcast(&status, 1, MPI_INT, 0, comm);
  return status;
}

}  // namespace engrane::app
