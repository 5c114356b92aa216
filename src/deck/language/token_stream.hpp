// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <string>
#include <vector>

#include "base/diagnostics.hpp"
#include "deck/language/abbreviations.hpp"
#include "deck/language/lexer.hpp"

namespace engrane::deck {

/// The tokens of a deck across its files. Executes the control words without a dot (INPUT, RETURN, EXIT, ABRE, MODE) and stops
/// at `.FIN`.
class TokenStream {
 public:
  TokenStream(SourceMap& sources, Diagnostics& diagnostics)
      : sources_(sources), diagnostics_(diagnostics), lexer_(sources, diagnostics) {}

  /// Overrides texts of ABRE; call before the first token is read.
  void overrule(Definitions definitions) { abbreviations_.overrule(std::move(definitions)); }
  /// All names defined by ABRE so far.
  std::vector<std::string> abbreviations() const { return abbreviations_.names(); }

  /// Opens the main file; returns false with an error if it cannot be read.
  bool open_file(const std::filesystem::path& path);
  void open_text(std::string name, std::string text);
  /// Path of a file named at `where`: relative to the folder of the file that contains `where`.
  std::filesystem::path beside(const Location& where, const std::string& name) const;

  /// Sets the words of all commands, with their dots, for mend_command().
  void know_commands(std::vector<std::string> words) { commands_ = std::move(words); }
  /// If the next token is the first of its line and a command without its dot, reports this, inserts the dot and returns true.
  bool mend_command();

  /// The token `ahead` positions further; of kind end after the last one.
  const Token& peek(std::size_t ahead = 0);
  /// Takes the next token and reports its fault, if any.
  Token take();
  /// Takes the next token without reporting its fault.
  void skip();

 private:
  struct OpenFile {
    int file = 0;
    int next_line = 1;
    std::filesystem::path identity;  ///< to detect a file that includes itself
  };

  bool read_line();
  void push(const std::vector<Token>& tokens);
  bool control(const std::vector<Token>& tokens);
  void input(const std::vector<Token>& tokens);
  void abbreviation(const std::vector<Token>& tokens);
  void mode(const std::vector<Token>& tokens);
  void leave_file(const Token& word);
  void finish(const Token& word);
  void warn_of_rest(const OpenFile& open, const Token& word);
  void surplus(const std::vector<Token>& tokens, std::size_t first);
  bool report(const Token& token);

  SourceMap& sources_;
  Diagnostics& diagnostics_;
  Lexer lexer_;
  Abbreviations abbreviations_;
  std::vector<OpenFile> open_;
  std::vector<Token> line_;  ///< tokens of the line being read
  std::deque<Token> tokens_;
  std::vector<std::string> commands_;
  std::deque<std::string> mended_;  ///< texts of commands with inserted dots
  bool told_of_comment_ = false;
  static constexpr int usual_columns = 256;
  int columns_ = usual_columns;
};

}  // namespace engrane::deck
