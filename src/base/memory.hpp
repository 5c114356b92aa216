// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace engrane {

/// Bytes that this machine can give to further memory without paging, within the limit of the control group that the process runs
/// in (a container, a job of a cluster) and of ENGRANE_MEMORY (GB) in the environment; infinite where nothing is told.
double available_memory();

}  // namespace engrane
