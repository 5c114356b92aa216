// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "user/engrane_user.h"

namespace engrane::user {

/// What is wrong, and what would be right.
struct Fault {
  std::string message;
  std::string hint;

  bool good() const { return message.empty(); }
};

/// A shared library with user routines, kept loaded until the process ends.
class Library {
 public:
  /// Loads the library a deck calls `name`: that file, or with `.so` behind it, or with `lib` before it too; looked for in
  /// `folder`, that of the deck, then in the folders of the environment variable ENGRANE_USER_PATH (separated by colons). The
  /// linker's own folders are left out, so that one deck does not mean two things. nullptr with a fault.
  static std::shared_ptr<const Library> open(const std::string& name, const std::string& folder, Fault& fault);

  /// From now on open() loads only what lies beside or below `folder` or in a folder of ENGRANE_USER_PATH, and is a fault for
  /// anything else: loading runs what is in a library.
  static void trust_only_neighbours();
  /// The files that open() has loaded, with their folders, in that order.
  static std::vector<std::string> loaded();

  /// The routine of a name as the deck spells it, or as Fortran compilers do: in lower case, with an underscore behind it.
  /// nullptr with a fault that says what the library has.
  engrane_routine* routine(const std::string& name, Fault& fault) const;

  /// Names of the functions the library itself defines, sorted, as Fortran and C sources spell them: without the trailing
  /// underscore.
  std::vector<std::string> functions() const;

  const std::string& file() const { return file_; }  ///< without its folders

 private:
  Library(void* handle, std::string file) : handle_(handle), file_(std::move(file)) {}
  void* handle_;
  std::string file_;
};

}  // namespace engrane::user
