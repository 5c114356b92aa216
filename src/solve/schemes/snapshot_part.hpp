// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "base/snapshot.hpp"

namespace engrane::solve {

/// Saves what a part has saved in `own` under names that begin with `prefix`, for parts of which a run has several.
inline void save_part(const Snapshot& own, const std::string& prefix, Snapshot& snapshot) {
  for (const auto& [name, values] : own.arrays()) snapshot.put(prefix + name, values);
}

/// Saves a `part` that writes a snapshot of its own, under names with this prefix.
template <class Part>
void save_part(const Part& part, const std::string& prefix, Snapshot& snapshot) {
  Snapshot own;
  part.save(own);
  save_part(own, prefix, snapshot);
}

/// Returns what save_part() has put under `prefix`, under the part's own names.
inline Snapshot part_of(const Snapshot& snapshot, const std::string& prefix) {
  Snapshot own;
  for (const auto& [name, values] : snapshot.arrays())
    if (name.compare(0, prefix.size(), prefix) == 0) own.put(name.substr(prefix.size()), values);
  return own;
}

}  // namespace engrane::solve
