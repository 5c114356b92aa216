// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <vector>

namespace engrane::deck {

/// The line in which each number of a command was given. Ascending numbers, the usual case, are kept in a sorted vector.
class NumbersGiven {
 public:
  /// Returns the line in which the number was given before; if it is new, records it and returns nothing.
  std::optional<int> add(int number, int line) {
    if (ascending_.empty() || number > ascending_.back().number) {
      ascending_.push_back({number, line});
      return {};
    }
    const auto found = std::lower_bound(ascending_.begin(), ascending_.end(), number,
                                        [](const Given& given, int wanted) { return given.number < wanted; });
    if (found->number == number) return found->line;
    const auto [entry, fresh] = others_.try_emplace(number, line);
    return fresh ? std::nullopt : std::optional<int>(entry->second);
  }

 private:
  struct Given {
    int number;
    int line;
  };
  std::vector<Given> ascending_;
  std::unordered_map<int, int> others_;
};

}  // namespace engrane::deck
