// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/error_estimate.hpp"
#include "base/diagnostics.hpp"
#include "deck/read/reader.hpp"
#include "observe/energies.hpp"
#include "observe/fields.hpp"
#include "output/results_layout.hpp"
#include "solve/schemes/path_point.hpp"

namespace engrane::app {

/// How well the last linear system of a run determines its solution (`--condition`).
struct Conditioning {
  double condition = 0;       ///< estimate, in the norm of the largest sum of a column
  double backward_error = 0;  ///< of the last solution that was judged

  /// A bound on the relative error of the solution (Higham 2002, Accuracy and Stability of Numerical Algorithms, 7.1): how far
  /// a change of the matrix in the last digit, or by the backward error, moves it. At most 1.
  double error() const;
  std::string describe() const;
};

/// What came of one deck, for the summary of several and for `--json`. Quantities in the units of the deck.
struct RunSummary {
  std::string deck;
  deck::Overrides overrides;  ///< `-D` and `--card`
  int status = 0;             ///< exit status of this deck alone
  std::string failure;        ///< why the run stopped; empty when it did not
  std::vector<Diagnostic> diagnostics;
  std::vector<std::string> sources;  ///< paths of the files that locations of `diagnostics` count from
  long steps = 0, iterations = 0, cuts = 0, events = 0;
  double time = 0, end = 0;  ///< reached, and asked for by .SUB
  std::optional<ErrorEstimate> accuracy;
  std::optional<Conditioning> conditioning;          ///< where --condition asks for it
  std::vector<solve::CriticalPoint> critical;        ///< along a path of equilibria
  std::vector<double> buckling;                      ///< load times of linearised buckling
  std::optional<observe::StressError> stress_error;  ///< of the last frame
  double seconds = 0;                                ///< of the clock on the wall
  std::vector<output::CheckResult> checks;           ///< of .CHK
  std::vector<output::CheckResult> results;          ///< of --result: only what was computed counts
  std::optional<observe::EnergyBalance> energies;    ///< at the last step
  std::vector<std::string> files;

  /// `complete`, `wrong deck`, …: what the status means.
  std::string outcome() const;
};

/// The worst of two exit statuses: a fault of the program, a failed solution, a wrong deck, a failed check, all fine.
int worse_status(int a, int b);

/// A table, a line for each deck.
std::string summary_table(const std::vector<RunSummary>& runs);

/// All that is known of the runs, as one JSON object (docs/format.md).
std::string summary_json(const std::vector<RunSummary>& runs, int status);

}  // namespace engrane::app
