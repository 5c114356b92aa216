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

/// Why a token is invalid, and how to correct it.
struct TokenFault {
  std::string message;
  std::string hint;
};

/// One token of a deck. Its text is owned by the SourceMap or the Lexer.
struct Token {
  enum class Kind { word, number, text, replacement, end };  ///< text: "…"; replacement: the '…' of ABRE

  Kind kind = Kind::end;
  bool starts_line = false;    ///< first token of its line (a line continued by `$` counts as one)
  bool may_start_row = false;  ///< first token of its line, or the first after the command word
  int repeat = 1;              ///< `3*0.` stands for three numbers
  double value = 0;            ///< of a number, or of arithmetic in parentheses
  std::string_view text;       ///< as written; without quotes if text or replacement
  Location where;
  const TokenFault* fault = nullptr;  ///< reported only when the reader takes the token, so that skipped text causes no errors

  bool is_word() const { return kind == Kind::word; }
  bool is_number() const { return kind == Kind::number; }
  bool is_end() const { return kind == Kind::end; }
  bool is_command() const { return is_word() && starts_line && text.size() > 1 && text.front() == '.'; }
  /// The token as quoted in messages: `word`, "text".
  std::string quoted() const;
};

/// Splits the lines of a deck into tokens. Tokens and their texts live as long as the lexer and the SourceMap.
class Lexer {
 public:
  Lexer(const SourceMap& sources, Diagnostics& diagnostics) : sources_(sources), diagnostics_(diagnostics) {}

  /// Replaces `tokens` with those of the logical line (continued by `$`) that starts at a line of a file. Returns the number of
  /// lines of the file it comprises. Text beyond column `columns` is ignored. Never fails: an invalid token carries its fault.
  int read(int file, int first_line, int columns, const Abbreviations& abbreviations, std::vector<Token>& tokens);

 private:
  const SourceMap& sources_;
  Diagnostics& diagnostics_;
  std::deque<std::string> composed_;  ///< logical lines that differ from the text in the file
  std::deque<TokenFault> faults_;
};

}  // namespace engrane::deck
