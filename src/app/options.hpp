// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/read.hpp"

namespace engrane::app {

/// What the command line asks for.
struct Options {
  enum class Task { run, check, help, make_template, manual, schema, completion, man } task = Task::run;
  std::vector<std::string> decks;
  Wishes wishes;            ///< `-D`, `--card` and `--result`, for every deck
  bool allow_user = false;  ///< `check` may load user libraries from anywhere
  bool json = false;        ///< a summary for programs, alone on standard output
  std::string prefix;       ///< of the results, or a folder for them; empty: the deck's name in the working directory
  std::string card;         ///< of help and template; empty: the overview
  std::string usage;        ///< of man: what --help prints
  std::vector<std::string> tasks, words;  ///< of completion: subcommands, and options of a run
  bool quiet = false;                     ///< no progress
  bool condition = false;                 ///< the listing gives the condition of the last linear system
  std::optional<double> until;            ///< the run is interrupted at the first step that ends then or later
  std::string restart;  ///< prefix of the results to restart from, whatever the deck says; empty: what the deck says
  std::optional<double> restart_time;
};

/// Exit statuses of the program.
namespace exit_status {
inline constexpr int fine = 0, wrong_deck = 1, solution_failed = 2, our_error = 3, check_failed = 4;
}

/// Reads the command line; PETSc's own options (`-snes_…`, `-ksp_…`, `-mat_…`, `-log_view` …) are left to PETSc.
/// Without a value the program is to end at once with `status` (help, version, or a wrong command line).
std::optional<Options> parse_command_line(int argc, char** argv, bool talk, int& status);

/// Where the results of one deck go: the prefix of `-o`, or the deck's name in the folder that it names (`-o results/`, or any
/// folder when there are several decks), or the deck's name in the working directory.
std::string results_prefix(const Options& options, const std::string& deck);

}  // namespace engrane::app
