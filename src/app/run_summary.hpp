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

/// Conditioning of the last linear system of a run (`--condition`).
struct Conditioning {
  double condition = 0;       ///< estimated condition number in the 1-norm (largest column sum)
  double backward_error = 0;  ///< of the last solution for which it was computed

  /// Bound on the relative error of the solution, at most 1 (Higham 2002, Accuracy and Stability of Numerical Algorithms, 7.1):
  /// the condition number times the backward error or the machine precision, whichever is larger.
  double error() const;
  std::string describe() const;
};

/// Outcome of one deck, for the summary of several decks and for `--json`. Quantities are in the units of the deck.
struct RunSummary {
  std::string deck;
  deck::Overrides overrides;  ///< `-D` and `--card`
  int status = 0;             ///< exit status of this deck alone
  std::string failure;        ///< why the run stopped; empty if it did not
  std::vector<Diagnostic> diagnostics;
  std::vector<std::string> sources;  ///< paths of the files that the locations of `diagnostics` refer to
  long steps = 0, iterations = 0, cuts = 0, events = 0;
  double time = 0, end = 0;  ///< time reached, and end time of .SUB
  std::optional<ErrorEstimate> accuracy;
  std::optional<Conditioning> conditioning;          ///< only with --condition
  std::vector<solve::CriticalPoint> critical;        ///< along an equilibrium path
  std::vector<double> buckling;                      ///< load times of linearised buckling
  std::optional<observe::StressError> stress_error;  ///< of the last frame
  double seconds = 0;                                ///< wall-clock time
  std::vector<output::CheckResult> checks;           ///< of .CHK
  std::vector<output::CheckResult> results;          ///< of --result: only the computed values matter
  std::optional<observe::EnergyBalance> energies;    ///< at the last step
  std::vector<std::string> files;

  /// Meaning of the status: `complete`, `wrong deck`, …
  std::string outcome() const;
};

/// The worse of two exit statuses. From worst to best: program fault, failed solution, wrong deck, failed check, success.
int worse_status(int a, int b);

/// A table with one line per deck.
std::string summary_table(const std::vector<RunSummary>& runs);

/// All known data of the runs, as one JSON object (docs/format.md).
std::string summary_json(const std::vector<RunSummary>& runs, int status);

}  // namespace engrane::app
