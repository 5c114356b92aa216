// SPDX-License-Identifier: BSD-3-Clause
#include "app/session_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

namespace engrane::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* beginning = "engrane-run-";

/// Has something started this process as one of several, or told Open MPI where its folders are?
bool is_placed() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_NAMESPACE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE", "SLURM_PROCID",
                           "OMPI_MCA_orte_tmpdir_base"})
    if (std::getenv(name)) return true;
  return false;
}

/// Opens a folder and locks it; -1 when a living process has locked it. The lock ends with the process, however it ends, and
/// tells the dead from the living in other containers too, where process numbers mean others.
int lock_folder(const std::string& path) {
  const int folder = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (folder < 0 || flock(folder, LOCK_EX | LOCK_NB) == 0) return folder;
  close(folder);
  return -1;
}

/// Takes away what killed runs of this user have left.
void remove_abandoned(const fs::path& where) {
  constexpr std::time_t making = 10;  // seconds in which a folder that was just made gets its lock
  std::error_code error;
  std::vector<std::string> found;
  for (fs::directory_iterator it(where, fs::directory_options::skip_permission_denied, error), end; !error && it != end;
       it.increment(error))
    if (it->path().filename().string().starts_with(beginning)) found.push_back(it->path().string());
  for (const std::string& path : found) {
    struct stat status {};
    if (lstat(path.c_str(), &status) != 0 || !S_ISDIR(status.st_mode) || status.st_uid != geteuid()) continue;
    if (std::time(nullptr) - status.st_mtime < making) continue;
    const int folder = lock_folder(path);
    if (folder < 0) continue;
    fs::remove_all(path, error);
    close(folder);
  }
}

}  // namespace

SessionFolder::SessionFolder() {
  if (is_placed()) return;
  // sockets stand in it, whose paths may have about a hundred characters: a long TMPDIR does not do
  const char* wanted = std::getenv("TMPDIR");
  const std::string where = wanted && *wanted && std::string(wanted).size() < 40 ? wanted : "/tmp";
  remove_abandoned(where);
  std::string path = where + "/" + beginning + "XXXXXX";
  if (!mkdtemp(path.data())) return;
  path_ = path;
  lock_ = lock_folder(path_);
  setenv("OMPI_MCA_orte_tmpdir_base", path_.c_str(), 1);
  // a run by itself needs no daemon beside it and no network to speak over, which take longer to start than all the rest
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  setenv("OMPI_MCA_pml", "ob1", 0);
  setenv("OMPI_MCA_btl", "self", 0);
  // nor collective operations for several: their plugins are loaded one by one
  setenv("OMPI_MCA_coll", "basic,self,libnbc", 0);
}

SessionFolder::~SessionFolder() {
  if (path_.empty()) return;
  unsetenv("OMPI_MCA_orte_tmpdir_base");
  std::error_code error;
  fs::remove_all(path_, error);
  if (lock_ >= 0) close(lock_);
}

}  // namespace engrane::app
