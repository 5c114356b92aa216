// SPDX-License-Identifier: BSD-3-Clause
// PETSc and MPI around all tests of this binary.
#include <gtest/gtest.h>

#include <memory>

#include "assembly/petsc.hpp"

namespace {

class Session : public testing::Environment {
 public:
  void SetUp() override { session_ = std::make_unique<engrane::PetscSession>(argc_, argv_); }
  void TearDown() override { session_.reset(); }

 private:
  char name_[12] = "engrane";
  char* words_[2] = {name_, nullptr};
  char** argv_ = words_;
  int argc_ = 1;
  std::unique_ptr<engrane::PetscSession> session_;
};

[[maybe_unused]] const auto* registered = testing::AddGlobalTestEnvironment(new Session);

}  // namespace
