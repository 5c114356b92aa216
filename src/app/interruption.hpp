// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

namespace engrane::app {

/// From now on SIGINT and SIGTERM are requests to stop after the step that is being made.
void heed_interruptions();

/// Whether such a signal ends the process at once: before the first step, which may take long (the rank of the constraints is
/// found in one piece), nothing is lost by that as long as the results are in no open file.
void leave_at_once(bool nothing_to_lose);

/// Has a signal asked the program to end?
bool was_interrupted();
/// Has any rank been asked to? Collective, so that all stop at the same step.
bool were_interrupted(MPI_Comm comm, int ranks);

}  // namespace engrane::app
