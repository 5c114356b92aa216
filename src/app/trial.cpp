// SPDX-License-Identifier: BSD-3-Clause
#include "app/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <utility>

#include "app/options.hpp"
#include "app/terminal.hpp"

namespace engrane::app {

Verdict another_scheme(const Model& model, Trial trial, const std::string& why, int rank) {
  if (rank == 0) std::cerr << "engrane: SCHEME RADAU fails here, again with CHUNG: " << terminal_text(why) << '\n';
  SolverOptions& options = trial.options;
  const SolverOptions own = solver_options(model);
  options.family = SolverOptions::Family::chung;
  options.scheme_is_free = false;
  options.damping = 0.8;
  options.precision = 1e-9;
  options.tolerance = std::min(options.tolerance, own.tolerance);
  options.event_tolerance = std::min(options.event_tolerance, own.event_tolerance);
  return {exit_status::fine, std::move(trial)};
}

Verdict back(const Trial& failed, const std::string& why, int rank) {
  const std::string text = fmt::format("with TOL {:.1g} the run fails: {}", failed.options.tolerance, why);
  if (rank == 0) std::cerr << fmt::format("engrane: {}; back to TOL {:.1g}\n", terminal_text(text), failed.complete->tolerance);
  return {exit_status::fine, Trial{*failed.complete, false, {}, text}};
}

}  // namespace engrane::app
