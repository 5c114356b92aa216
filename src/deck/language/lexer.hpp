// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.hpp"
#include "deck/language/abbreviations.hpp"

namespace engrane::deck {

/// Why a token cannot be used, and what would help.
struct TokenFault {
  std::string message;
  std::string hint;
};

/// One word of a deck. Its text belongs to the SourceMap or to the Lexer.
struct Token {
  enum class Kind { word, number, text, replacement, end };  ///< text: "…"; replacement: the '…' of ABRE

  Kind kind = Kind::end;
  bool starts_line = false;    ///< the first of its line (a line continued by `$` counts as one)
  bool may_start_row = false;  ///< the first of its line, or the first behind the command word
  int repeat = 1;              ///< `3*0.` stands for three numbers
  double value = 0;            ///< of a number or of arithmetic in parentheses
  std::string_view text;       ///< as written; without quotes for text and replacement
  Location where;
  const TokenFault* fault = nullptr;  ///< reported when the reader comes to it, so that skipped text stays quiet

  bool is_word() const { return kind == Kind::word; }
  bool is_number() const { return kind == Kind::number; }
  bool is_end() const { return kind == Kind::end; }
  bool is_command() const { return is_word() && starts_line && text.size() > 1 && text.front() == '.'; }
  /// As messages name it: `word`, "text".
  std::string quoted() const;
};

/// Cuts the lines of a deck into tokens. Tokens and their texts live as long as the lexer and the SourceMap.
class Lexer {
 public:
  Lexer(const SourceMap& sources, Diagnostics& diagnostics) : sources_(sources), diagnostics_(diagnostics) {}

  /// Replaces the tokens by those of the logical line (continued by `$`) that starts at a line of a file; returns how many
  /// lines of the file it takes. Text right of column `columns` is not read. Never fails: a token that makes no sense
  /// carries its fault.
  int read(int file, int first_line, int columns, const Abbreviations& abbreviations, std::vector<Token>& tokens);

 private:
  const SourceMap& sources_;
  Diagnostics& diagnostics_;
  std::deque<std::string> composed_;  ///< lines that do not stand in a file as they are read
  std::deque<TokenFault> faults_;
};

}  // namespace engrane::deck
