// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/options.hpp"
#include "app/read.hpp"
#include "app/run_summary.hpp"
#include "assembly/petsc.hpp"

namespace engrane::app {

/// Solves a good deck on all ranks of `comm`; rank 0 writes results and listing as `prefix`, speaks, and fills in the summary.
/// Returns the exit status.
int solve_deck(Reading& reading, const Options& options, const std::string& prefix, MPI_Comm comm, RunSummary& summary);

}  // namespace engrane::app
