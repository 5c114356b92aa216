// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace engrane::output {

/// The names of a run's files. A complete result of that name is never replaced by a partial one: while it is there, the
/// run's files are called `prefix.partial.*`, and they take the name over when the run is complete.
class OutputName {
 public:
  /// Looks at `prefix.h5`, and decides.
  explicit OutputName(std::string prefix);

  std::string path(std::string_view extension) const { return stem() + std::string(extension); }
  std::string final_path(std::string_view extension) const { return prefix_ + std::string(extension); }
  bool partial() const { return partial_; }

 private:
  std::string stem() const { return partial_ ? prefix_ + ".partial" : prefix_; }
  std::string prefix_;
  bool partial_ = false;
};

/// Must what is at `path` be kept until something complete replaces it? True for a complete result, and for a file that is
/// none of ours; false for a partial result, and when nothing is there.
bool worth_keeping(const std::string& path);

/// Keeps a second run from writing the same files: holds an advisory lock on a file as long as it lives.
class FileLock {
 public:
  FileLock() = default;
  /// Throws OutputError when another process holds it. Where the file system has no locks, or no such file, it locks nothing.
  explicit FileLock(const std::string& path);
  /// Opens a file, or makes an empty one, and locks it before anything else is done with it. Throws OutputError, which calls
  /// the file `shown_as`.
  static FileLock create(const std::string& path, const std::string& shown_as);
  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;

  /// Waits until what was written to the file is on the disk. Throws OutputError, which calls it `path`.
  void sync(const std::string& path) const;

 private:
  int descriptor_ = -1;
};

/// Makes the contents of one file those of another, which exists. Throws OutputError, which calls it `shown_as`.
void copy_contents(const std::string& from, const std::string& to, const std::string& shown_as);

/// Gives `from` the name `to`, over any file of that name, in one step. Throws OutputError.
void rename_over(const std::string& from, const std::string& to);

/// Lets two files change names, in one step where the system can. Throws OutputError.
void exchange_names(const std::string& a, const std::string& b);
/// The same where the system cannot: at every moment one of the files is called `a`, unless there are no links either.
void exchange_names_by_links(const std::string& a, const std::string& b);

/// Replaces a text file in one step, so that no reader ever sees half of it. Throws OutputError.
void replace_text(const std::string& path, std::string_view text);

}  // namespace engrane::output
