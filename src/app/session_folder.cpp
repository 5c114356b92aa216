// SPDX-License-Identifier: BSD-3-Clause
#include "app/session_folder.hpp"

#include <cstdlib>
#include <filesystem>

namespace engrane::app {

namespace {

/// Has something started this process as one of several, or told Open MPI where its folders are?
bool is_placed() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_NAMESPACE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE", "SLURM_PROCID",
                           "OMPI_MCA_orte_tmpdir_base"})
    if (std::getenv(name)) return true;
  return false;
}

}  // namespace

SessionFolder::SessionFolder() {
  if (is_placed()) return;
  // sockets stand in it, whose paths may have about a hundred characters: a long TMPDIR does not do
  const char* wanted = std::getenv("TMPDIR");
  std::string path = wanted && *wanted && std::string(wanted).size() < 40 ? wanted : "/tmp";
  path += "/engrane-XXXXXX";
  if (!mkdtemp(path.data())) return;
  path_ = path;
  setenv("OMPI_MCA_orte_tmpdir_base", path_.c_str(), 1);
  // a run by itself needs no daemon beside it and no network to speak over, which take longer to start than all the rest
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  setenv("OMPI_MCA_pml", "ob1", 0);
  setenv("OMPI_MCA_btl", "self", 0);
}

SessionFolder::~SessionFolder() {
  if (path_.empty()) return;
  unsetenv("OMPI_MCA_orte_tmpdir_base");
  std::error_code error;
  std::filesystem::remove_all(path_, error);
}

}  // namespace engrane::app
