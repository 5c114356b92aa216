// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace engrane::user {

/// User routine running on this thread; nullptr if none. Volatile, since a signal handler reads them.
inline constinit thread_local const char* volatile current_routine = nullptr;
inline constinit thread_local const char* volatile current_library = nullptr;

/// Marks a user routine as running during its lifetime, so that a crash in it can be told from one in engrane.
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

/// Installs signal handlers that report a crash inside a user routine by name and then restore the previous handlers.
void watch_for_crashes();

}  // namespace engrane::user
