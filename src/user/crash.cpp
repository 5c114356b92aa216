// SPDX-License-Identifier: BSD-3-Clause
#include "user/crash.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>

namespace engrane::user {

namespace {

constexpr int watched[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
struct sigaction before[std::size(watched)];

void say(const char* text) {
  const std::size_t length = std::strlen(text);
  if (write(STDERR_FILENO, text, length) < 0) return;  // nothing else can be done here
}

void crashed(int signal) {
  if (current_routine) {
    say("engrane: the user routine ");
    say(current_routine);
    say(" of ");
    say(current_library);
    say(" crashed: compile it with -g (and -fcheck=all in Fortran, -fsanitize=address in C) to see where\n");
    current_routine = nullptr;
  }
  for (std::size_t i = 0; i < std::size(watched); ++i)
    if (watched[i] == signal) sigaction(signal, &before[i], nullptr);
  // returning repeats the faulting instruction, and the previous handler takes over
}

/// Output that the routine wrote before it ended the program often says why, and _exit() drops what is still buffered.
void flush_output() {
  std::fflush(nullptr);
  // FLUSH of all units; the units of gfortran are otherwise flushed after the last exit handler
  if (void* flush = dlsym(RTLD_DEFAULT, "_gfortran_flush_i4")) reinterpret_cast<void (*)(int*)>(flush)(nullptr);
}

/// Exit handler. STOP and exit(0) would otherwise end the program as if all had gone well. Ending without MPI_Finalize and with
/// an error status makes mpiexec end the other ranks, as after a crash.
void ended() {
  if (!current_routine) return;
  flush_output();
  say("engrane: the user routine ");
  say(current_routine);
  say(" of ");
  say(current_library);
  say(" ended the program (STOP or exit): return an error status instead, -3 where x is outside the valid range or a positive "
      "number of your own\n");
  _exit(status_of_ended);
}

}  // namespace

void watch_for_crashes() {
  static const bool installed = [] {
    struct sigaction action {};
    action.sa_handler = crashed;
    for (std::size_t i = 0; i < std::size(watched); ++i) sigaction(watched[i], &action, &before[i]);
    static_cast<void>(std::atexit(ended));  // without memory for it, crashes are still reported
    static_cast<void>(std::at_quick_exit(ended));
    return true;
  }();
  static_cast<void>(installed);
}

}  // namespace engrane::user
