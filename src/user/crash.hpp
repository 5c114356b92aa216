// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace engrane::user {

/// What runs on this thread; nullptr: nothing of the user's. Volatile, for the handler of a signal reads them.
inline constinit thread_local const char* volatile current_routine = nullptr;
inline constinit thread_local const char* volatile current_library = nullptr;

/// Says while it lives which routine is running, so that a crash inside it can be told from one of ours.
class Running {
 public:
  Running(const char* routine, const char* library) noexcept {
    current_library = library;
    current_routine = routine;
  }
  ~Running() { current_routine = nullptr; }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
};

/// From now on a crash inside a routine is reported with its name before whoever handled such signals so far handles it.
void watch_for_crashes();

}  // namespace engrane::user
