// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "output/hdf5_handle.hpp"
#include "output/result_file.hpp"

namespace engrane::output {

/// A run cannot be restarted from a result. The text is a sentence that names the file and the reason.
class RestartError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The result of an earlier run, used for a restart (docs/format.md, /restart).
class RestartFile {
 public:
  /// Opens `prefix.h5` or, if there is none, `prefix.partial.h5`; `prefix` may also be the name of a file. Throws RestartError
  /// if no file is found, or if it is not a result of this format version.
  explicit RestartFile(const std::string& prefix);

  const std::string& path() const { return path_; }
  /// The deck as run, with all defaults filled in.
  std::string deck_text() const;
  std::string model_json() const;
  /// Times of all restart points, ascending.
  std::vector<double> times() const;
  /// Whether the run was killed before it solved anything: it neither ended nor wrote a sample or a restart point.
  bool is_empty() const;
  /// Returns the last restart point not after `time`, or the last of all. Throws RestartError if there is none, naming the
  /// available times.
  RestartPoint load(std::optional<double> time = {}) const;

  /// Sentence on the partial result of a newer run of the same name, which the prefix did not choose, and on how to continue it;
  /// empty if there is none with a restart point.
  std::string advice_on_newer_partial() const;

  hid_t id() const { return file_.id(); }

 private:
  std::string path_;
  hdf5::Handle file_;
};

}  // namespace engrane::output
