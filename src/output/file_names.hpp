// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace engrane::output {

/// Names of a run's files. A complete result is never replaced by a partial one. If a complete result with the same name
/// exists, the files of this run are called `prefix.partial.*` until the run is complete; then they take over the name.
class OutputName {
 public:
  /// Chooses the names according to what is at `prefix.h5`.
  explicit OutputName(std::string prefix);

  std::string path(std::string_view extension) const { return stem() + std::string(extension); }
  std::string final_path(std::string_view extension) const { return prefix_ + std::string(extension); }
  bool partial() const { return partial_; }

 private:
  std::string stem() const { return partial_ ? prefix_ + ".partial" : prefix_; }
  std::string prefix_;
  bool partial_ = false;
};

/// Whether the file at `path` must be kept until a complete result replaces it. True for a complete result and for a file not
/// written by this program; false for a partial result, an empty file, and if there is no file.
bool worth_keeping(const std::string& path);

/// Whether the files of a run with this prefix can be made, judged before the run: the folder exists and files can be made in
/// it, no folder bears a name that is needed, and the names are not too long. Throws OutputError if not. Leaves nothing behind.
void test_places(const std::string& prefix);

/// Prevents a second run from writing the same files: holds an advisory lock on a file during its lifetime.
class FileLock {
 public:
  FileLock() = default;
  /// Throws OutputError if another process holds the lock. Locks nothing if the file system has no locks or there is no such
  /// file.
  explicit FileLock(const std::string& path);
  /// Opens or creates a file and locks it before anything else is done with it. Throws OutputError, which calls the file
  /// `shown_as`.
  static FileLock create(const std::string& path, const std::string& shown_as);
  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;

  /// Waits until everything written to the file is on the disk. Throws OutputError, which calls the file `path`.
  void sync(const std::string& path) const;

 private:
  int descriptor_ = -1;
};

/// Copies the contents of one file to another, which must exist. Throws OutputError, which calls the file `shown_as`.
void copy_contents(const std::string& from, const std::string& to, const std::string& shown_as);

/// Atomically renames `from` to `to`, replacing any file of that name. Throws OutputError.
void rename_over(const std::string& from, const std::string& to);

/// Exchanges the names of two files, atomically if the system supports it. Throws OutputError.
void exchange_names(const std::string& a, const std::string& b);
/// As above, for systems without such a call. A file with the name `a` exists at every moment, unless the system has no hard
/// links either.
void exchange_names_by_links(const std::string& a, const std::string& b);

/// Atomically replaces a text file, so that no reader sees a partial one. Throws OutputError.
void replace_text(const std::string& path, std::string_view text);

}  // namespace engrane::output
