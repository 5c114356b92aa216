// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/read.hpp"

namespace engrane::app {

/// Options of the command line.
struct Options {
  enum class Task { run, check, help, make_template, manual, schema, completion, man } task = Task::run;
  std::vector<std::string> decks;
  Wishes wishes;            ///< `-D`, `--card` and `--result`, for every deck
  bool allow_user = false;  ///< `check` may load user libraries from anywhere
  bool json = false;        ///< print only a machine-readable summary on standard output
  std::string prefix;       ///< of the results, or a folder for them; empty: name of the deck, in the working directory
  std::string card;         ///< for help and template; empty: the overview
  std::string usage;        ///< for man: the text of --help
  std::vector<std::string> tasks, words;  ///< for completion: subcommands, and options of a run
  bool quiet = false;                     ///< no progress, advice or summary
  bool condition = false;                 ///< list the condition number of the last linear system
  std::optional<double> until;            ///< stop after the first step that ends at this time or later
  std::string restart;                    ///< prefix of results to restart from, overrides the deck; empty: as the deck says
  std::optional<double> restart_time;
};

/// Exit statuses of the program.
namespace exit_status {
inline constexpr int fine = 0, wrong_deck = 1, solution_failed = 2, our_error = 3, check_failed = 4;
}

/// Parses the command line; PETSc's own options (`-snes_…`, `-ksp_…`, `-mat_…`, `-log_view` …) are left to PETSc. If no value
/// is returned, the program must exit at once with `status` (help, version, or a wrong command line).
std::optional<Options> parse_command_line(int argc, char** argv, bool talk, int& status);

/// Prefix of the results of one deck. This is the prefix given by `-o`, or the name of the deck in the folder given by `-o`
/// (`-o results/`, or any existing folder if there are several decks), or the name of the deck in the working directory.
std::string results_prefix(const Options& options, const std::string& deck);

}  // namespace engrane::app
