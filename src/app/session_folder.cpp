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

constexpr const char* setting = "OMPI_MCA_orte_tmpdir_base";

bool is_one_of_several() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_NAMESPACE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE", "SLURM_PROCID"})
    if (std::getenv(name)) return true;
  return false;
}

/// The value of an environment variable; empty if it is not set.
std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// Opens and locks a folder; returns -1 if a running process holds the lock. The lock is released however the process ends. It
/// also identifies running processes in other containers, where process numbers are different.
int lock_folder(const std::string& path) {
  const int folder = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (folder < 0 || flock(folder, LOCK_EX | LOCK_NB) == 0) return folder;
  close(folder);
  return -1;
}

/// Removes folders left by killed runs of this user.
void remove_abandoned(const fs::path& where) {
  constexpr std::time_t making = 10;  // seconds that a new folder may take to get its lock
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
  if (is_one_of_several()) return;
  // the folder holds sockets, whose paths are limited to about a hundred characters
  constexpr std::size_t longest = 40;
  users_ = environment(setting);
  if (users_.size() >= longest) return;
  const std::string temporary = environment("TMPDIR");
  std::string where = users_;
  if (where.empty()) where = temporary.empty() || temporary.size() >= longest ? "/tmp" : temporary;
  std::error_code error;
  fs::create_directories(where, error);
  remove_abandoned(where);
  std::string path = where + "/" + beginning + "XXXXXX";
  if (!mkdtemp(path.data())) return;
  path_ = path;
  lock_ = lock_folder(path_);
  setenv(setting, path_.c_str(), 1);
  // a single process needs neither a daemon nor a network, which would take longer to start than everything else
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  setenv("OMPI_MCA_pml", "ob1", 0);
  setenv("OMPI_MCA_btl", "self", 0);
  // nor collective operations for several processes, whose plugins are loaded one by one
  setenv("OMPI_MCA_coll", "basic,self,libnbc", 0);
  // locations of displays and PCI devices are not used, and finding them takes a seventh of the start
  // (docs/decisions/0025-start-up.md)
  setenv("HWLOC_COMPONENTS", "-gl,-opencl,-pci,-linuxio,-x86", 0);
}

SessionFolder::~SessionFolder() {
  if (path_.empty()) return;
  users_.empty() ? unsetenv(setting) : setenv(setting, users_.c_str(), 1);
  std::error_code error;
  fs::remove_all(path_, error);
  if (lock_ >= 0) close(lock_);
}

}  // namespace engrane::app
