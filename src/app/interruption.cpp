// SPDX-License-Identifier: BSD-3-Clause
#include "app/interruption.hpp"

#include <unistd.h>

#include <csignal>

#include "app/options.hpp"

namespace engrane::app {

namespace {

volatile std::sig_atomic_t interrupted = 0, leaving = 0;

void interrupt(int) {
  interrupted = 1;
  if (leaving == 0) return;
  static constexpr char text[] = "engrane: interrupted at the start, before the first step\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text, sizeof text - 1);
  _exit(exit_status::solution_failed);
}

}  // namespace

void heed_interruptions() {
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
}

void leave_at_once(bool nothing_to_lose) { leaving = nothing_to_lose ? 1 : 0; }

bool was_interrupted() { return interrupted != 0; }

bool were_interrupted(MPI_Comm comm, int ranks) {
  int stop = interrupted;
  if (ranks > 1) MPI_Allreduce(MPI_IN_PLACE, &stop, 1, MPI_INT, MPI_MAX, comm);
  return stop != 0;
}

}  // namespace engrane::app
