// SPDX-License-Identifier: BSD-3-Clause
#include "app/standard_output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>

#include "app/options.hpp"

namespace engrane::app {

void open_standard_files() {
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(file, F_GETFD) < 0 && open("/dev/null", O_RDWR) < 0) return;  // the lowest free number is this one
}

int after_standard_output(int status) {
  const bool lost = std::cout.bad() || std::ferror(stdout) != 0;
  errno = 0;
  if (std::fflush(stdout) == 0 && !lost) return status;
  int reason = errno;
  // what stdio could not write it may have dropped, and the reason with it
  if (reason == 0 && write(STDOUT_FILENO, "\n", 1) < 0) reason = errno;
  // PetscFinalize and the end of the program flush what is left once more: PETSc would report the error in 30 lines
  if (const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC); nowhere >= 0) {
    dup2(nowhere, STDOUT_FILENO);
    close(nowhere);
  }
  std::fflush(stdout);
  std::clearerr(stdout);
  std::cout.clear();
  if (reason == EPIPE) return status;
  std::fprintf(stderr, "engrane: cannot write standard output: %s\n",
               reason != 0 ? std::strerror(reason) : "an earlier part of it was lost");
  return status == exit_status::fine ? exit_status::wrong_deck : status;
}

}  // namespace engrane::app
