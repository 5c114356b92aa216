// SPDX-License-Identifier: BSD-3-Clause
// What elements have to tell of a whole run.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace engrane {

/// An element that may warn its user at the end of a run, from what it remembers. Implemented beside Element.
class RemarksOnRun {
 public:
  virtual ~RemarksOnRun() = default;
  /// Sentences without the element's name, each a warning; `history` as committed last.
  virtual std::vector<std::string> remarks(std::span<const double> history) const = 0;
};

}  // namespace engrane
