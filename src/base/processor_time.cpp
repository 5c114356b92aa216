// SPDX-License-Identifier: BSD-3-Clause
#include "base/processor_time.hpp"

#include <ctime>

namespace engrane {

double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace engrane
