// SPDX-License-Identifier: BSD-3-Clause
#include "app/solve_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <optional>
#include <utility>

#include "app/agreement.hpp"
#include "app/attempt.hpp"
#include "app/interruption.hpp"
#include "app/model_difference.hpp"
#include "app/terminal.hpp"
#include "model/function_failure.hpp"
#include "model/plane.hpp"
#include "user/routine.hpp"

namespace engrane::app {

using namespace output;
using namespace solve;

namespace {

/// With ACCURACY a run may be repeated so often with another tolerance, or another scheme.
constexpr int most_repeats = 3;

/// Whether a result is that of this very deck, killed before its first restart point: nothing of it is lost by starting anew.
bool has_not_begun(const RestartFile& earlier, const Reading& reading) {
  return earlier.is_empty() && earlier.deck_text() == deck::canonical_text(reading.deck);
}

/// Opens what `.SAM RESTART` or `--restart` names; nothing if that run had not begun, of which `note` tells. Throws RestartError,
/// also when its model is another than that of `reading`.
std::unique_ptr<Resumption> find_resumption(const Reading& reading, const Options& options, std::string& note) {
  const deck::AnalysisCard& card = reading.model.commands.analysis;
  bool overruled = !options.restart.empty();
  if (overruled && !options.restart_time)
    if (const RestartFile earlier(options.restart); has_not_begun(earlier, reading)) {
      note = fmt::format("{} holds no restart point yet: starting from {}", earlier.path(),
                         card.restart.empty() ? "the beginning" : card.restart + ", as the deck says");
      overruled = false;
    }
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
  if (!reading.model.commands.path && point.time >= reading.model.commands.stepping.end) {
    const std::string newer = earlier.advice_on_newer_partial();
    throw RestartError(fmt::format(
        "{} would be continued from t = {:.10g}, but .SUB ends at TF = {:.10g}: give a later TF, or RESTART with an earlier T{}",
        earlier.path(), point.time, reading.model.commands.stepping.end, newer.empty() ? newer : ". " + newer));
  }
  return std::make_unique<Resumption>(Resumption{std::move(earlier), std::move(point)});
}

/// As find_resumption(), on every rank. Collective: all ranks throw if one does, or if they find other restart points than rank
/// 0.
std::unique_ptr<Resumption> agreed_resumption(const Reading& reading, const Options& options, std::string& note, MPI_Comm comm) {
  std::unique_ptr<Resumption> found;
  Account own;
  try {
    found = find_resumption(reading, options, note);
    ContentHash hash;
    if (found) hash.add(fmt::format("{} {} {}", found->point.time, found->point.samples, found->point.frames));
    own.contents = hash.value();
  } catch (const RestartError& e) {
    own.trouble = e.what();
  }
  const Agreement agreement = agree(std::move(own), comm);
  if (agreement.reached()) return found;
  if (agreement.first_failed) throw RestartError(agreement.trouble);
  throw RestartError(fmt::format(
      "rank {} {}. Every rank reads the results to restart from: keep them on a file system that all nodes see", agreement.rank,
      agreement.failed > 0 ? "cannot read them: " + agreement.trouble : "finds another restart point than rank 0"));
}

/// If the deck lets the program choose the plane, a resumed run continues in the plane it began in, or in space.
void keep_plane(Model& model, const Snapshot& memory) {
  if (!model.commands.analysis.plane.is("AUTO") || !memory.has("plane")) return;
  const int before = static_cast<int>(memory.number("plane"));
  PlaneModel plane;
  if (before >= 0 && !examine_plane(model, before, 1, plane).empty()) return;  // other loads: the difference is told later
  model.plane = std::move(plane);
}

/// Whether `.SUB` has TOL.
bool gives_tolerance(const deck::Deck& deck) {
  return std::any_of(deck.records.begin(), deck.records.end(), [](const deck::Record& record) {
    const deck::SteppingCard* card = record.get<deck::SteppingCard>();
    return card && card->tolerance;
  });
}

/// Runs the companion of the first run. Where TOL chooses the steps, that run begins with a looser TOL than its setting's own,
/// which is needed only for contacts that vibrate within a few of the longest steps. Collective.
Companion first_companion(const Reading& reading, Trial& trial, MPI_Comm comm, bool quiet) {
  const AccuracyRung* rung = accuracy_rung(reading.model.commands.analysis);
  if (rung && trial.options.family == SolverOptions::Family::radau && !gives_tolerance(reading.deck)) {
    const SolverOptions bold = with_tolerance(reading.model, trial.options, rung->first);
    Companion companion(reading, bold, comm, quiet, nullptr, Companion::Span::whole_if_it_follows);
    if (companion.trouble().empty() && companion.follows_tolerance()) {
      trial.settled = std::exchange(trial.options, bold);
      return companion;
    }
  }
  return Companion(reading, trial.options, comm, quiet, nullptr);
}

/// Why the files of the results cannot be made; empty if they can. Collective.
std::string unwritable_place(const std::string& prefix, MPI_Comm comm, int rank) {
  std::string trouble;
  if (rank == 0) try {
      test_places(prefix);
    } catch (const OutputError& e) {
      trouble = e.what();
    }
  return text_of_rank(0, std::move(trouble), comm);
}

/// Why `--until` does not fit the run; empty if it does.
std::string wrong_until(const Options& options, double start) {
  constexpr double start_alone = -1e300;  // as `engrane study` asks for it, which does not know when a deck starts
  if (!options.until || *options.until >= start || *options.until <= start_alone) return {};
  return fmt::format("--until {:.10g} lies before the start of the run, t = {:.10g}", *options.until, start);
}

/// Path of the mesh of the deck that has the name of the results file; empty if none has.
std::string mesh_in_the_way(const Reading& reading, const std::string& prefix) {
  std::error_code error;
  for (const std::filesystem::path& mesh : reading.deck.meshes)
    if (std::filesystem::equivalent(mesh, prefix + ".h5", error)) return mesh.string();
  return {};
}

Verdict solve_once(const Task& task, const Trial& trial, std::optional<Companion>& companion) {
  leave_at_once(true);
  user::forget_failures();  // of another run
  forget_function_failures();
  int rank = 0;
  MPI_Comm_rank(task.comm, &rank);
  if (companion && !companion->trouble().empty() && trial.options.scheme_is_free)
    return another_scheme(task.reading.model, trial, companion->trouble(), rank);
  return Attempt(task, trial, companion).make();
}

}  // namespace

int solve_deck(Reading& reading, const Options& options, const std::string& prefix, MPI_Comm comm, RunSummary& summary) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  heed_interruptions();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of writing, not the end of the program

  const auto refuse = [&](std::string why) {
    summary.failure = std::move(why);
    if (rank == 0) std::cerr << "engrane: " << terminal_text(summary.failure) << '\n';
    return exit_status::wrong_deck;
  };
  if (const std::string mesh = text_of_rank(0, mesh_in_the_way(reading, prefix), comm); !mesh.empty())
    return refuse(fmt::format("the results would take the place of the mesh {}: -o gives them another name", mesh));
  if (std::string trouble = unwritable_place(prefix, comm, rank); !trouble.empty()) return refuse(std::move(trouble));
  leave_at_once(true);
  std::unique_ptr<Resumption> resumption;
  try {
    std::string note;
    resumption = agreed_resumption(reading, options, note, comm);
    if (rank == 0 && !note.empty()) std::cerr << "engrane: " << terminal_text(note) << '\n';
  } catch (const RestartError& e) {
    return refuse(e.what());
  }
  const double start = resumption ? resumption->point.time : reading.model.commands.stepping.start;
  if (std::string wrong = wrong_until(options, start); !wrong.empty()) return refuse(std::move(wrong));
  if (resumption) keep_plane(reading.model, resumption->point.memory);
  const Task task{reading, options, prefix, resumption.get(), summary, comm};
  Trial trial{.options = solver_options(reading.model)};
  if (resumption) load_choice(resumption->point.memory, trial.options);
  const bool estimates = trial.options.target > 0 && trial.options.tolerance > 0;
  std::optional<Companion> companion;
  std::vector<double> differences;  // of earlier runs from their companions, by channel
  for (int repeats = 0;; ++repeats) {
    if (estimates && repeats == 0 && !resumption) companion.emplace(first_companion(reading, trial, comm, options.quiet));
    if (estimates && !companion) {
      companion.emplace(reading, trial.options, comm, options.quiet, resumption.get());
      companion->remember(differences);
    }
    trial.may_repeat = trial.may_repeat && repeats < most_repeats;
    Verdict verdict = solve_once(task, trial, companion);
    // "nothing was solved" does not hold for a run whose files could be opened the first time only
    if (!verdict.again)
      return repeats > 0 && verdict.status == exit_status::wrong_deck ? exit_status::solution_failed : verdict.status;
    const double tolerance = std::exchange(trial, std::move(*verdict.again)).options.tolerance;
    if (trial.keeps_companion) continue;
    differences.clear();
    if (companion && trial.options.tolerance < tolerance) differences = companion->differences();
    companion.reset();
  }
}

}  // namespace engrane::app
