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

/// Texts given on the command line, `-D NAME=VALUE`, that override those of the deck; names as in ABRE, including their slash.
using Definitions = std::map<std::string, std::string, std::less<>>;

/// The `ABRE '/name' 'text'` definitions of a deck. A text may use other names; they are resolved when it is used.
class Abbreviations {
 public:
  /// Defines a name; the last definition counts. A text given by overrule() replaces `text`.
  void define(std::string name, std::string text);
  void overrule(Definitions definitions) { overruling_ = std::move(definitions); }

  bool empty() const { return texts_.empty(); }

  /// The longest defined name that `text` starts with; empty if there is none.
  std::string_view longest_at(std::string_view text) const;

  /// The text of a defined name, as given.
  const std::string& text(std::string_view name) const { return texts_.find(name)->second; }

  /// The text of a defined name with all names in it expanded. Cycles and unbounded growth are errors at `where`.
  std::string expand(std::string_view name, const Location& where, Diagnostics& diagnostics) const;

  /// All names, for "did you mean" hints.
  std::vector<std::string> names() const;

 private:
  Definitions texts_, overruling_;
  std::size_t longest_name_ = 0;
};

}  // namespace engrane::deck
