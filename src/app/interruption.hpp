// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

namespace engrane::app {

/// Installs handlers for SIGINT and SIGTERM: from now on they request a stop after the current step.
void heed_interruptions();

/// Whether such a signal ends the process immediately. Before the first step nothing is lost by that, as long as the results
/// are in no open file, and waiting could take long: the rank of the constraints is found without a chance to stop.
void leave_at_once(bool nothing_to_lose);

/// Whether a signal has requested a stop.
bool was_interrupted();
/// Whether any rank has been requested to stop. Collective, so that all ranks stop at the same step.
bool were_interrupted(MPI_Comm comm, int ranks);

}  // namespace engrane::app
