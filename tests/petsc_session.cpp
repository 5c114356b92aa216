// SPDX-License-Identifier: BSD-3-Clause
// PETSc and MPI around all tests of this binary.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include "assembly/petsc.hpp"

namespace {

class Session : public testing::Environment {
 public:
  void SetUp() override {
    // processes that end at the same time remove each other's folder of Open MPI: each has its own
    std::string folder = "/tmp/engrane-test-XXXXXX";
    if (mkdtemp(folder.data())) {
      folder_ = folder;
      setenv("OMPI_MCA_orte_tmpdir_base", folder_.c_str(), 1);
    }
    session_ = std::make_unique<engrane::PetscSession>(argc_, argv_);
  }
  void TearDown() override {
    session_.reset();
    std::error_code error;
    if (!folder_.empty()) std::filesystem::remove_all(folder_, error);
  }

 private:
  char name_[12] = "engrane";
  char* words_[2] = {name_, nullptr};
  char** argv_ = words_;
  int argc_ = 1;
  std::unique_ptr<engrane::PetscSession> session_;
  std::string folder_;
};

[[maybe_unused]] const auto* registered = testing::AddGlobalTestEnvironment(new Session);

}  // namespace
