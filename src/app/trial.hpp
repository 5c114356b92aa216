// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/snapshot.hpp"
#include "model/model.hpp"
#include "model/solver_options.hpp"

namespace engrane::app {

/// A run to make, and what is known from earlier attempts.
struct Trial {
  SolverOptions options;
  bool may_repeat = true;                      ///< if the estimated error is too large
  std::optional<SolverOptions> complete = {};  ///< of a completed run whose error was too large
  std::string sharper_failed = {};             ///< how a run with a sharper tolerance than this one failed
  std::optional<SolverOptions> settled = {};   ///< with the ACCURACY setting's own TOL, if `options` start with a looser one
  bool keeps_companion = false;                ///< reuse the companion of the previous run
  long first_steps = 0;                        ///< of the first run with an estimate; 0: none yet
  std::vector<double> differences = {};        ///< of earlier runs from their companions (ErrorEstimate::difference())
};

/// Outcome of a run: its exit status, or what to try instead.
struct Verdict {
  int status = 0;
  std::optional<Trial> again;
};

/// Saves the options that ACCURACY has led to in a restart point, so that a continued run is identical bit for bit.
void save_choice(const Model& model, const SolverOptions& found, Snapshot& snapshot);
/// Restores these options if the deck asks for the same ones.
void load_choice(const Snapshot& snapshot, SolverOptions& options);

/// PREC of the runs that another_scheme() makes.
inline constexpr double precision_of_other_scheme = 1e-9;

/// Switches to generalised-alpha where Radau fails, for instance at positions where the constraints lose rank. Starts with at
/// most the setting's own TOL.
Verdict another_scheme(const Model& model, Trial trial, const std::string& why, int rank);

/// Continues with the setting's own tolerance if a run that started with a looser one fails.
Verdict settle(const Trial& failed, const std::string& why, int rank);

/// Goes back to the options of the last completed run if one with a sharper tolerance fails: a complete result with a larger
/// error than requested is better than an incomplete one.
Verdict back(const Trial& failed, const std::string& why, int rank);

}  // namespace engrane::app
