// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace engrane::app {

/// A folder of this process's own for what Open MPI keeps beside a run, made before MPI starts and removed at the end.
///
/// Open MPI puts it into one folder for all runs of a user on a machine, and each run removes that folder when it thinks it is
/// the last: of many that start and end together one now and then finds it gone, and MPI_Init fails. A process that mpiexec or a
/// batch system started shares its folder with the others of its run and gets none. What the user has set stays. Folders of
/// runs that were killed are removed by the next one that comes by.
class SessionFolder {
 public:
  SessionFolder();
  ~SessionFolder();
  SessionFolder(const SessionFolder&) = delete;
  SessionFolder& operator=(const SessionFolder&) = delete;

 private:
  std::string path_;  ///< empty: there is none
  int lock_ = -1;     ///< descriptor of the folder, locked as long as the process lives
};

}  // namespace engrane::app
