// SPDX-License-Identifier: BSD-3-Clause
#include "app/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <utility>
#include <vector>

#include "app/options.hpp"
#include "app/terminal.hpp"

namespace engrane::app {

namespace {

std::vector<double> what_is_asked(const SolverOptions& own) {
  return {own.target, static_cast<double>(own.family), own.damping, own.tolerance, own.precision, own.event_tolerance};
}

}  // namespace

void save_choice(const Model& model, const SolverOptions& found, Snapshot& snapshot) {
  if (found.target == 0) return;
  const SolverOptions own = solver_options(model);
  snapshot.put("dial/asked", what_is_asked(own));
  snapshot.put("dial/found", {static_cast<double>(found.family), found.damping, found.tolerance, found.precision,
                              found.event_tolerance, found.longest / own.longest});
}

void load_choice(const Snapshot& snapshot, SolverOptions& options) {
  if (options.target == 0 || !snapshot.has("dial/asked") || snapshot.array("dial/asked") != what_is_asked(options)) return;
  const std::vector<double>& found = snapshot.array("dial/found");
  options.family = static_cast<SolverOptions::Family>(found.at(0));
  options.damping = found.at(1);
  options.tolerance = found.at(2);
  options.precision = found.at(3);
  options.event_tolerance = found.at(4);
  options.longest *= found.at(5);
}

Verdict another_scheme(const Model& model, Trial trial, const std::string& why, int rank) {
  if (rank == 0) std::cerr << "engrane: the run fails, again with SCHEME CHUNG: " << terminal_text(why) << '\n';
  SolverOptions& options = trial.options;
  const SolverOptions own = solver_options(model);
  options.family = SolverOptions::Family::chung;
  options.scheme_is_free = false;
  options.damping = 0.8;
  options.precision = precision_of_other_scheme;
  options.tolerance = std::min(options.tolerance, own.tolerance);
  options.event_tolerance = std::min(options.event_tolerance, own.event_tolerance);
  return {exit_status::fine, std::move(trial)};
}

Verdict settle(const Trial& failed, const std::string& why, int rank) {
  if (rank == 0)
    std::cerr << fmt::format("engrane: with TOL {:.1g} the run fails: {}; again, with TOL {:.1g}\n", failed.options.tolerance,
                             terminal_text(why), failed.settled->tolerance);
  return {exit_status::fine, Trial{.options = *failed.settled}};
}

Verdict back(const Trial& failed, const std::string& why, int rank) {
  const std::string text = fmt::format("with TOL {:.1g} the run fails: {}", failed.options.tolerance, why);
  if (rank == 0) std::cerr << fmt::format("engrane: {}; back to TOL {:.1g}\n", terminal_text(text), failed.complete->tolerance);
  return {exit_status::fine, Trial{.options = *failed.complete, .may_repeat = false, .sharper_failed = text}};
}

}  // namespace engrane::app
