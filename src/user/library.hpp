// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "user/engrane_user.h"

namespace engrane::user {

/// A fault in the user's input, and how to correct it.
struct Fault {
  std::string message;
  std::string hint;

  bool good() const { return message.empty(); }
};

/// A shared library with user routines, kept loaded until the process ends.
class Library {
 public:
  /// Loads the library a deck calls `name`: tries `name`, `name.so`, `libname` and `libname.so`, first in `folder` (that of the
  /// deck), then in the folders of the environment variable ENGRANE_USER_PATH (separated by colons). The linker's own search
  /// path is not used, so that a deck has one meaning everywhere. On failure returns nullptr and sets `fault`.
  static std::shared_ptr<const Library> open(const std::string& name, const std::string& folder, Fault& fault);

  /// From now on open() loads only libraries in or below `folder` or a folder of ENGRANE_USER_PATH; anything else is a fault.
  /// Loading a library runs code in it.
  static void trust_only_neighbours();
  /// Full paths of the files that open() has loaded, in order of loading.
  static std::vector<std::string> loaded();

  /// Finds a routine by its name as spelt in the deck or as mangled by Fortran compilers: in lower case, with a trailing
  /// underscore. On failure returns nullptr and a fault that lists the library's routines.
  engrane_routine* routine(const std::string& name, Fault& fault) const;

  /// Sorted names of the functions defined by the library itself, as spelt in Fortran and C sources: without the trailing
  /// underscore.
  std::vector<std::string> functions() const;

  const std::string& file() const { return file_; }  ///< file name without its folders

 private:
  Library(void* handle, std::string file) : handle_(handle), file_(std::move(file)) {}
  void* handle_;
  std::string file_;
};

}  // namespace engrane::user
