// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/petsc.hpp"

#include <string>

namespace engrane {

namespace {

std::string last_message;

/// Keeps the message of the original error. PETSc calls again with PETSC_ERROR_REPEAT while it unwinds.
PetscErrorCode keep_message(MPI_Comm, int line, const char* function, const char* file, PetscErrorCode code, PetscErrorType type,
                            const char* message, void*) {
  if (type == PETSC_ERROR_INITIAL) {
    last_message = message ? message : "";
    last_message +=
        " [in " + std::string(function ? function : "?") + ", " + (file ? file : "?") + ":" + std::to_string(line) + "]";
  }
  return code;
}

}  // namespace

void check_petsc(PetscErrorCode code) {
  if (code == 0) return;
  throw PetscFailure("PETSc error " + std::to_string(static_cast<int>(code)) + ": " + last_message);
}

std::string text_of_rank(int rank, std::string text, MPI_Comm comm) {
  int size = static_cast<int>(text.size());
  MPI_Bcast(&size, 1, MPI_INT, rank, comm);
  text.resize(static_cast<std::size_t>(size));
  MPI_Bcast(text.data(), size, MPI_CHAR, rank, comm);
  return text;
}

PetscLogEvent log_event(const char* name) {
  PetscLogEvent event = -1;
  check_petsc(PetscLogEventRegister(name, PETSC_OBJECT_CLASSID, &event));
  return event;
}

PetscSession::PetscSession(int& argc, char**& argv) {
  check_petsc(PetscInitialize(&argc, &argv, nullptr, nullptr));
  check_petsc(PetscPushErrorHandler(keep_message, nullptr));
  check_petsc(PetscPopSignalHandler());  // this program handles signals itself: it closes the results first
}

PetscSession::~PetscSession() {
  (void)PetscPopErrorHandler();
  (void)PetscFinalize();
}

}  // namespace engrane
