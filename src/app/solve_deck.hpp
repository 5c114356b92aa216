// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/options.hpp"
#include "app/read.hpp"
#include "assembly/petsc.hpp"

namespace engrane::app {

/// Solves a good deck on all ranks of `comm`; rank 0 writes results and listing and speaks. Returns the exit status.
int solve_deck(const Reading& reading, const Options& options, MPI_Comm comm);

}  // namespace engrane::app
