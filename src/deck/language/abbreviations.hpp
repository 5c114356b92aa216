// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostics.hpp"

namespace engrane::deck {

/// Texts that the command line gives instead of those of the deck, `-D NAME=VALUE`; names as in ABRE, with their slash.
using Definitions = std::map<std::string, std::string, std::less<>>;

/// The `ABRE '/name' 'text'` definitions of a deck. A text may use other names; they are looked up when it is used.
class Abbreviations {
 public:
  /// Defines a name (again: the last text counts), with the text of a definition that overrules the deck where there is one.
  void define(std::string name, std::string text);
  void overrule(Definitions definitions) { overruling_ = std::move(definitions); }

  bool empty() const { return texts_.empty(); }

  /// The longest defined name that `text` starts with, or nothing.
  std::string_view longest_at(std::string_view text) const;

  /// The text of a defined name, as given.
  const std::string& text(std::string_view name) const { return texts_.find(name)->second; }

  /// The text of a defined name with all names in it replaced. Cycles and runaway growth are errors at `where`.
  std::string expand(std::string_view name, const Location& where, Diagnostics& diagnostics) const;

  /// All names, for "did you mean".
  std::vector<std::string> names() const;

 private:
  Definitions texts_, overruling_;
  std::size_t longest_name_ = 0;
};

}  // namespace engrane::deck
