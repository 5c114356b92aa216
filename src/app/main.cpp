// SPDX-License-Identifier: BSD-3-Clause
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string_view>

#include "app/agreement.hpp"
#include "app/check.hpp"
#include "app/interruption.hpp"
#include "app/options.hpp"
#include "app/read.hpp"
#include "app/session_folder.hpp"
#include "app/solve_deck.hpp"
#include "app/standard_output.hpp"
#include "app/terminal.hpp"
#include "app/version.hpp"
#include "assembly/petsc.hpp"
#include "base/foreign.hpp"
#include "deck/manual/manual.hpp"
#include "output/hdf5_handle.hpp"
#include "user/library.hpp"

namespace engrane::app {

namespace {

/// Tasks that need no model.
int print_about_cards(const Options& options) {
  const deck::Catalogue all = catalogue(element_types());
  if (options.task == Options::Task::manual) {
    std::cout << deck::manual_markdown(all);
    return exit_status::fine;
  }
  if (options.task == Options::Task::schema) {
    std::cout << deck::json_schema(all);
    return exit_status::fine;
  }
  if (options.task == Options::Task::completion) {
    std::cout << deck::bash_completion(all, options.tasks, options.words);
    return exit_status::fine;
  }
  if (options.task == Options::Task::man) {
    std::cout << deck::man_page(all, version, options.usage);
    return exit_status::fine;
  }
  if (options.card.empty()) {
    std::cout << deck::help_overview(all);
    return exit_status::fine;
  }
  if (options.task == Options::Task::help) {
    if (const std::string text = deck::help_for(all, options.card); !text.empty()) {
      std::cout << text;
      return exit_status::fine;
    }
  }
  const deck::Schema* card = all.find(options.card);
  if (!card) {
    std::vector<std::string> names;
    for (const auto* list : {&all.commands, &all.elements})
      for (const deck::Schema* schema : *list) names.push_back(schema->name);
    const std::string near = nearest(options.card, names);
    std::cerr << "engrane: there is no card " << options.card
              << (near.empty() ? "; `engrane help` lists all" : "; did you mean " + near + "?") << '\n';
    return exit_status::wrong_deck;
  }
  std::cout << deck::template_card(*card);
  return exit_status::fine;
}

/// Creates the missing part of the folder for the results. Errors are reported by whoever writes there.
void make_folder(const std::string& prefix) {
  std::error_code error;
  if (const auto folder = std::filesystem::path(prefix).parent_path(); !folder.empty())
    std::filesystem::create_directories(folder, error);
}

/// Checks or solves one deck.
int perform_on(const std::string& deck, const Options& options, bool talk, RunSummary& run) {
  if (options.task == Options::Task::check && !options.allow_user) user::Library::trust_only_neighbours();
  Reading reading = read_deck(deck, options.wishes);
  if (talk) reading.diagnostics.print(std::cerr, reading.sources);
  run.diagnostics = reading.diagnostics.all();
  for (Diagnostic& d : run.diagnostics)
    if (d.location.known() && reading.sources.foreign(d.location.file)) d.message = without_quotes(d.message);
  for (int file = 0; file < reading.sources.size(); ++file) run.sources.push_back(reading.sources.path(file));
  bool agreed = false;
  run.failure = deck_disagreement(deck, reading, PETSC_COMM_WORLD, agreed);
  if (talk && !run.failure.empty()) std::cerr << "engrane: " << terminal_text(run.failure) << '\n';
  if (!agreed) return exit_status::wrong_deck;
  if (run.diagnostics.empty()) reading.sources = {};  // no more lines of the deck will be shown
  run.time = reading.model.commands.stepping.start;
  run.end = reading.model.commands.stepping.end;
  if (options.task == Options::Task::check) return talk ? print_model(reading, std::cout) : exit_status::fine;
  const std::string prefix = results_prefix(options, deck);
  if (talk && prefix != options.prefix) make_folder(prefix);
  return solve_deck(reading, options, prefix, PETSC_COMM_WORLD, run);
}

/// Does what the command line asks for; `talk`: this rank prints. Returns the exit status.
int perform(const Options& options, bool talk) {
  if (options.task != Options::Task::run && options.task != Options::Task::check)
    return talk ? print_about_cards(options) : exit_status::fine;
  std::vector<RunSummary> runs;
  int status = exit_status::fine;
  for (const std::string& deck : options.decks) {
    RunSummary& run = runs.emplace_back();
    run.deck = deck;
    run.overrides = options.wishes.overrides;
    run.status = perform_on(deck, options, talk, run);
    status = worse_status(status, run.status);
    if (was_interrupted()) break;
  }
  if (options.task == Options::Task::check || !talk) return status;
  if (options.json)
    std::cout << summary_json(runs, status);
  else if (options.decks.size() > 1 && !options.quiet)
    std::cout << summary_table(runs);
  return status;
}

}  // namespace

}  // namespace engrane::app

int main(int argc, char** argv) {
  using namespace engrane;
  using namespace engrane::app;
  int status = exit_status::our_error;
  open_standard_files();
  try {
    // help and the like need neither MPI nor PETSc, which take a while to start; checking a deck needs the solver
    {
      const char* of_several = std::getenv("OMPI_COMM_WORLD_RANK");
      const bool first = !of_several || std::string_view(of_several) == "0";
      const auto early = parse_command_line(argc, argv, first, status);
      if (!early) return after_standard_output(status);
      if (early->task != Options::Task::run && early->task != Options::Task::check)
        return after_standard_output(perform(*early, true));
    }
    output::hdf5::prepare();  // before MPI
    const SessionFolder folder;
    PetscSession session(argc, argv);
    int rank = 0;
    MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
    try {
      if (const auto options = parse_command_line(argc, argv, rank == 0, status)) status = perform(*options, rank == 0);
    } catch (const std::exception& e) {
      // a fault of one rank must not leave the others waiting
      std::fprintf(stderr, "engrane: internal error: %s\n", e.what());
      int size = 1;
      MPI_Comm_size(PETSC_COMM_WORLD, &size);
      if (size > 1) MPI_Abort(PETSC_COMM_WORLD, exit_status::our_error);
      status = exit_status::our_error;
    }
    status = after_standard_output(status);  // before PetscFinalize, which flushes it too
  } catch (const std::exception& e) {
    std::fprintf(stderr, "engrane: internal error: %s\n", e.what());
  }
  return status;
}
