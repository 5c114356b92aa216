// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "base/snapshot.hpp"
#include "model/model.hpp"
#include "model/solver_options.hpp"

namespace engrane::app {

/// A run to make, and what those before it have told.
struct Trial {
  SolverOptions options;
  bool may_repeat = true;                      ///< when the error is too large
  std::optional<SolverOptions> complete = {};  ///< of a run that came to its end, but with too large an error
  std::string sharper_failed = {};             ///< how one with a sharper tolerance than this failed
  std::optional<SolverOptions> settled = {};   ///< the setting's own, where `options` begin with a looser tolerance
  bool keeps_companion = false;                ///< that of the run before tells the error of this one too
};

/// What came of a run: its exit status, or what to try instead.
struct Verdict {
  int status = 0;
  std::optional<Trial> again;
};

/// Puts what ACCURACY of a deck has come to into a restart point, so that the run can be continued to the bit.
void save_choice(const Model& model, const SolverOptions& found, Snapshot& snapshot);
/// Takes it back into the options of a deck that asks for the same.
void load_choice(const Snapshot& snapshot, SolverOptions& options);

/// Generalised-alpha where Radau fails: at positions in which the rank of the constraints falls, for one. It begins with the
/// setting's own TOL.
Verdict another_scheme(const Model& model, Trial trial, const std::string& why, int rank);

/// On to the setting's own tolerance, where a run that began with a looser one does not get to its end.
Verdict settle(const Trial& failed, const std::string& why, int rank);

/// Back to the last run that came to its end, where one with a sharper tolerance fails: a result that is less accurate than was
/// asked for is better than half of one.
Verdict back(const Trial& failed, const std::string& why, int rank);

}  // namespace engrane::app
