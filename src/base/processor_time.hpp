// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace engrane {

/// Processor time that this process has used, in seconds. Unlike the time of a clock it leaves out other programs.
double processor_time();

}  // namespace engrane
