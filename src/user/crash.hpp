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

/// Exit status if a user routine ends the program by STOP or exit(): that of a routine which crashes, 128 + SIGSEGV.
inline constexpr int status_of_ended = 139;

/// Installs signal handlers that report a crash inside a user routine by name and then restore the previous handlers, and an exit
/// handler that reports a routine which ends the program, with an error status.
void watch_for_crashes();

}  // namespace engrane::user
