// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace engrane {

/// Bytes of memory that can still be allocated without paging, within the limit of the process's control group (a container, a
/// cluster job) and of the environment variable ENGRANE_MEMORY (GB). Infinite if none of these is known.
double available_memory();

}  // namespace engrane
