// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace engrane::app {

/// A private folder for the session files of Open MPI, created before MPI starts and removed at the end.
///
/// Open MPI normally puts them in one folder for all runs of a user on a machine. Each run removes that folder when it believes
/// it is the last. If many runs start and end together, one occasionally finds the folder gone, and MPI_Init fails. A process
/// started by mpiexec or a batch system shares its folder with the other processes of its run, and gets none here. Where the
/// user has set `OMPI_MCA_orte_tmpdir_base`, the private folder is made in that one, since it may be set for many runs. Folders
/// left by killed runs are removed by the next run.
class SessionFolder {
 public:
  SessionFolder();
  ~SessionFolder();
  SessionFolder(const SessionFolder&) = delete;
  SessionFolder& operator=(const SessionFolder&) = delete;

 private:
  std::string path_;   ///< empty if there is none
  std::string users_;  ///< the folder that the user has set; empty if none
  int lock_ = -1;      ///< descriptor of the folder, which is locked during the lifetime of the process
};

}  // namespace engrane::app
