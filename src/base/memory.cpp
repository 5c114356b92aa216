// SPDX-License-Identifier: BSD-3-Clause
#include "base/memory.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>

namespace engrane {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The number in a file; infinite if there is no such file or it holds a word, such as "max".
double number_in(const char* file) {
  std::ifstream in(file);
  double value = 0;
  return in >> value ? value : unlimited;
}

double free_on_machine() {
  std::ifstream in("/proc/meminfo");
  for (std::string line; std::getline(in, line);)
    if (line.rfind("MemAvailable:", 0) == 0) return 1024 * std::stod(line.substr(13));
  return unlimited;
}

/// Limit set by the user, in bytes.
double allowed() {
  const char* text = std::getenv("ENGRANE_MEMORY");
  char* end = nullptr;
  const double gigabytes = text ? std::strtod(text, &end) : 0;
  return text && end != text && *end == '\0' && gigabytes > 0 ? 1e9 * gigabytes : unlimited;
}

}  // namespace

double available_memory() {
  const double limit = number_in("/sys/fs/cgroup/memory.max");
  const double used = limit < unlimited ? number_in("/sys/fs/cgroup/memory.current") : 0;
  return std::min({free_on_machine(), used < unlimited ? std::max(0.0, limit - used) : limit, allowed()});
}

}  // namespace engrane
