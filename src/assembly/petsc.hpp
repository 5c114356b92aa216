// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <petscsnes.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace engrane {

/// PETSc, MUMPS or MPI said no where nothing the user did should make them: a fault of ours or of the machine.
struct PetscFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws PetscFailure with PETSc's own words when a call failed.
void check_petsc(PetscErrorCode code);

/// The text that one rank has, on all. Collective.
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

/// A new event of PETSc's log.
PetscLogEvent log_event(const char* name);

/// Its time is counted as that of an event, for as long as this lives.
class LoggedTime {
 public:
  explicit LoggedTime(PetscLogEvent event) : event_(event) { (void)PetscLogEventBegin(event_, 0, 0, 0, 0); }
  ~LoggedTime() { (void)PetscLogEventEnd(event_, 0, 0, 0, 0); }
  LoggedTime(const LoggedTime&) = delete;
  LoggedTime& operator=(const LoggedTime&) = delete;

 private:
  PetscLogEvent event_;
};

/// Starts PETSc and MPI, and ends them. PETSc's errors are kept for check_petsc() instead of printed.
class PetscSession {
 public:
  PetscSession(int& argc, char**& argv);
  ~PetscSession();
  PetscSession(const PetscSession&) = delete;
  PetscSession& operator=(const PetscSession&) = delete;
};

}  // namespace engrane
