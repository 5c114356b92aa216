// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.hpp"
#include "deck/language/abbreviations.hpp"

namespace engrane::deck {

/// One word of a deck.
struct Token {
  enum class Kind { word, number, text, replacement, end };  ///< text: "…"; replacement: the '…' of ABRE

  Kind kind = Kind::end;
  std::string text;            ///< as written; without quotes for text and replacement
  double value = 0;            ///< of a number or of arithmetic in parentheses
  int repeat = 1;              ///< `3*0.` stands for three numbers
  bool starts_line = false;    ///< the first of its line (a line continued by `$` counts as one)
  bool may_start_row = false;  ///< the first of its line, or the first behind the command word
  Location where;
  std::string fault;  ///< why it cannot be used; reported when the reader comes to it, so that skipped text stays quiet
  std::string hint;

  bool is_word() const { return kind == Kind::word; }
  bool is_number() const { return kind == Kind::number; }
  bool is_end() const { return kind == Kind::end; }
  bool is_command() const { return is_word() && starts_line && text.size() > 1 && text.front() == '.'; }
};

/// Where the bytes of a logical line come from.
struct LogicalLine {
  struct Origin {
    int line;
    int column;
    int length;
  };
  int file = 0;
  std::string text;             ///< comments gone, abbreviations replaced, continuation lines appended
  std::vector<Origin> origins;  ///< of every byte of `text`
  int lines = 0;                ///< how many lines of the file it took

  Location at(std::size_t first, std::size_t size) const;
};

/// Puts together the logical line that starts at a line of a file. Text right of column `columns` is not read.
LogicalLine logical_line(const SourceMap& sources, int file, int first_line, int columns, const Abbreviations& abbreviations,
                         Diagnostics& diagnostics);

/// Cuts a logical line into tokens. Never fails: a token that makes no sense carries its fault.
std::vector<Token> tokenize(const LogicalLine& line, const Abbreviations& abbreviations);

}  // namespace engrane::deck
