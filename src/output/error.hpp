// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace engrane::output {

/// A result file cannot be written: disk full, no permission, or in use by another run. The text is a sentence that names the
/// file and the reason.
class OutputError : public std::runtime_error {
 public:
  OutputError(const std::string& path, const std::string& reason)
      : std::runtime_error("Cannot write " + path + ": " + reason + ".") {}
};

}  // namespace engrane::output
