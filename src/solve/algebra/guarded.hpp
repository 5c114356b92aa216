// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <petscsys.h>

#include <exception>
#include <utility>

namespace engrane::solve {

/// Runs the body of a callback of PETSc, whose frames no exception may cross: one is kept in `failure`, and PETSc is told to
/// stop. Whoever called PETSc throws it again.
template <class Body>
PetscErrorCode guarded(std::exception_ptr& failure, const Body& body) {
  try {
    return body();
  } catch (...) {
    failure = std::current_exception();
    return PETSC_ERR_LIB;
  }
}

/// Throws what a callback has kept, once.
inline void rethrow(std::exception_ptr& failure) {
  if (failure) std::rethrow_exception(std::exchange(failure, nullptr));
}

}  // namespace engrane::solve
