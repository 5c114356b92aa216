// SPDX-License-Identifier: BSD-3-Clause
#include "user/crash.hpp"

#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <cstring>

namespace engrane::user {

namespace {

constexpr int watched[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL};
struct sigaction before[4];

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
  for (std::size_t i = 0; i < 4; ++i)
    if (watched[i] == signal) sigaction(signal, &before[i], nullptr);
  // returning repeats the faulting instruction, and the previous handler takes over
}

}  // namespace

void watch_for_crashes() {
  static const bool installed = [] {
    struct sigaction action {};
    action.sa_handler = crashed;
    for (std::size_t i = 0; i < 4; ++i) sigaction(watched[i], &action, &before[i]);
    return true;
  }();
  static_cast<void>(installed);
}

}  // namespace engrane::user
