// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <petscsnes.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace engrane {

/// A call to PETSc, MUMPS or MPI failed for a reason that is not the user's: a bug in this program or a fault of the machine.
struct PetscFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws PetscFailure with PETSc's message if a call failed.
void check_petsc(PetscErrorCode code);

/// Collective: returns the text of the given rank on all ranks.
std::string text_of_rank(int rank, std::string text, MPI_Comm comm);

/// Owns a PETSc object: `Owned<Mat> A; check_petsc(MatCreate(comm, A.out()));`
template <class Handle>
class Owned {
 public:
  Owned() = default;
  Owned(Owned&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Owned() { destroy(); }

  operator Handle() const { return handle_; }  // NOLINT(google-explicit-constructor): stands in for the handle
  Handle* out() {
    destroy();
    return &handle_;
  }

 private:
  void destroy() {
    if (!handle_) return;
    auto object = reinterpret_cast<PetscObject>(handle_);
    (void)PetscObjectDereference(object);
    handle_ = nullptr;
  }
  Handle handle_ = nullptr;
};

/// Registers a new event in PETSc's log.
PetscLogEvent log_event(const char* name);

/// Attributes the time of its own lifetime to an event.
class LoggedTime {
 public:
  explicit LoggedTime(PetscLogEvent event) : event_(event) { (void)PetscLogEventBegin(event_, 0, 0, 0, 0); }
  ~LoggedTime() { (void)PetscLogEventEnd(event_, 0, 0, 0, 0); }
  LoggedTime(const LoggedTime&) = delete;
  LoggedTime& operator=(const LoggedTime&) = delete;

 private:
  PetscLogEvent event_;
};

/// Initialises PETSc and MPI, and finalises them. PETSc's error messages are kept for check_petsc() instead of being printed.
class PetscSession {
 public:
  PetscSession(int& argc, char**& argv);
  ~PetscSession();
  PetscSession(const PetscSession&) = delete;
  PetscSession& operator=(const PetscSession&) = delete;
};

}  // namespace engrane
