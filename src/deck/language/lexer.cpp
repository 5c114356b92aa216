// SPDX-License-Identifier: BSD-3-Clause
#include "deck/language/lexer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/text.hpp"
#include "deck/language/number.hpp"
#include "math/expression.hpp"

namespace engrane::deck {

namespace {

/// Control characters count as blanks: tabs, the carriage return of CRLF, the end-of-file mark of DOS.
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v' || c == '\x1a'; }

bool ends_word(char c) {
  static constexpr auto table = [] {
    std::array<bool, 256> ends{};
    for (const char end : std::string_view(" \t\r\f\v\x1a\"'()!")) ends[static_cast<unsigned char>(end)] = true;
    return ends;
  }();
  return table[static_cast<unsigned char>(c)];
}

bool is_name_character(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; }

/// Whether the rest is only blanks and a comment.
bool nothing_left(std::string_view rest) {
  const auto first = std::find_if_not(rest.begin(), rest.end(), is_blank);
  return first == rest.end() || *first == '!';
}

/// A line ready for tokenising: comments removed, abbreviations expanded, continuation lines appended.
struct LogicalLine {
  /// Source position of a byte of the text.
  struct Origin {
    int line;
    int column;
    int length;
  };
  int file = 0;
  int first_line = 1;
  std::string_view text;
  std::vector<Origin> origins;  ///< of every byte; empty if the text is the beginning of its line in the file

  Origin origin(std::size_t i) const { return origins.empty() ? Origin{first_line, static_cast<int>(i) + 1, 1} : origins[i]; }

  Location at(std::size_t first, std::size_t size) const {
    if (text.empty()) return {file, 1, 1, 1};
    first = std::min(first, text.size() - 1);
    std::size_t last = std::min(first + std::max<std::size_t>(size, 1), text.size()) - 1;
    const Origin start = origin(first);
    while (last > first && origin(last).line != start.line) --last;  // a caret marks a single line only
    const Origin stop = origin(last);
    return {file, start.line, start.column, stop.column + stop.length - start.column};
  }
};

/// Size of the part of a line before its comment, if it can be used without processing: no continuation, no possible
/// abbreviation, nothing past the last column. Otherwise npos.
std::size_t plain_size(std::string_view source, int columns, const Abbreviations& abbreviations) {
  if (source.size() > static_cast<std::size_t>(columns)) return std::string_view::npos;
  char quote = '\0';
  for (std::size_t i = 0; i < source.size(); ++i) {
    const char c = source[i];
    if (c == '$' || (c == '/' && !abbreviations.empty())) return std::string_view::npos;
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '!') {
      return i;
    }
  }
  return source.size();
}

/// Assembles a LogicalLine from lines of a file.
class LineBuilder {
 public:
  LineBuilder(std::string& text, LogicalLine& line, const Abbreviations& abbreviations, Diagnostics& diagnostics)
      : text_(text), line_(line), abbreviations_(abbreviations), diagnostics_(diagnostics) {}

  /// Appends one line of the file; returns true if a `$` continues it on the next line.
  bool append(std::string_view source, int number, int columns) {
    char quote = '\0';
    int characters = 0;
    for (std::size_t i = 0; i < source.size();) {
      const char c = source[i];
      const std::string_view rest = source.substr(i);
      if (quote == '\0') {
        if (c == '!') return false;
        if (c == '$' && nothing_left(rest.substr(1))) {
          put(' ', {number, column(i), 1});
          return true;
        }
      }
      if (characters >= columns) {
        report_lost_text(source, number, i, columns, quote != '\0');
        return false;
      }
      if (quote == '\0' && c == '/') {
        if (const std::string_view name = abbreviations_.longest_at(rest); !name.empty()) {
          replace(source, i, name, number);
          i += name.size();
          characters += static_cast<int>(character_count(name));
          continue;
        }
      }
      if (quote != '\0')
        quote = c == quote ? '\0' : quote;
      else if (c == '"' || c == '\'')
        quote = c;
      else
        parentheses_ = std::max(0, parentheses_ + (c == '(' ? 1 : c == ')' ? -1 : 0));
      const std::size_t size = character_size(source, i);
      for (std::size_t k = 0; k < size; ++k) put(source[i + k], {number, column(i + k), 1});
      i += size;
      ++characters;
    }
    return false;
  }

 private:
  static int column(std::size_t offset) { return static_cast<int>(offset) + 1; }

  void put(char c, LogicalLine::Origin origin) {
    text_ += c;
    line_.origins.push_back(origin);
  }

  /// A word or number cut in two is an error: what is left of it means something else.
  void report_lost_text(std::string_view source, int number, std::size_t offset, int columns, bool quoted) {
    const std::string_view rest = source.substr(offset);
    if (nothing_left(rest)) return;
    const char* cure = "MODE LECT n sets how many columns are read; `$` continues a line";
    if (offset > 0 && !quoted && !ends_word(source[offset - 1]) && !ends_word(rest.front())) {
      std::size_t begin = offset, end = offset;
      while (begin > 0 && !ends_word(source[begin - 1])) --begin;
      while (end < source.size() && !ends_word(source[end])) ++end;
      const Location where{line_.file, number, column(begin), static_cast<int>(end - begin)};
      diagnostics_.error(where,
                         fmt::format("`{}` reaches past column {}, the last that is read: `{}` is left of it",
                                     source.substr(begin, end - begin), columns, source.substr(begin, offset - begin)),
                         cure);
      return;
    }
    const Location where{line_.file, number, column(offset), static_cast<int>(rest.size())};
    diagnostics_.warning(where, "text past column " + std::to_string(columns) + " is not read", cure);
  }

  void replace(std::string_view source, std::size_t i, std::string_view name, int number) {
    const Location where{line_.file, number, column(i), static_cast<int>(name.size())};
    const char before = i > 0 ? source[i - 1] : ' ';
    if (parentheses_ > 0 && (is_name_character(before) || before == '.' || before == ')')) {
      const std::string quoted = "`" + std::string(name) + "`";
      diagnostics_.error(
          where, "the abbreviation " + quoted + " would be pasted right behind `" + before + "`",
          "to divide by it write `/" + std::string(name) + "`; to divide by something else put a blank behind `/`");
    }
    const std::size_t end = i + name.size();
    if (end < source.size() && is_name_character(source[end]) && is_name_character(name.back())) {
      std::size_t word_end = end;
      while (word_end < source.size() && is_name_character(source[word_end])) ++word_end;
      const std::string word(source.substr(i, word_end - i));
      diagnostics_.warning(
          where,
          "`" + word + "` is read as the abbreviation `" + std::string(name) + "` followed by `" + word.substr(name.size()) + "`",
          "no ABRE defines `" + word + "`");
    }
    for (char c : abbreviations_.expand(name, where, diagnostics_)) {
      parentheses_ = std::max(0, parentheses_ + (c == '(' ? 1 : c == ')' ? -1 : 0));
      put(c, {number, where.column, where.length});
    }
  }

  std::string& text_;
  LogicalLine& line_;
  const Abbreviations& abbreviations_;
  Diagnostics& diagnostics_;
  int parentheses_ = 0;
};

/// Splits a logical line into tokens.
class Tokenizer {
 public:
  Tokenizer(const LogicalLine& line, const Abbreviations& abbreviations, std::deque<TokenFault>& faults,
            std::vector<Token>& tokens)
      : line_(line), text_(line.text), abbreviations_(abbreviations), faults_(faults), tokens_(tokens) {}

  void run() {
    if (begins_with_word(text_, "\xef\xbb\xbf")) at_ = 3;  // byte order mark, written by some editors
    for (;;) {
      while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
      if (at_ == text_.size() || text_[at_] == '!') break;  // an abbreviation may contain a comment
      next();
    }
    if (!tokens_.empty()) {
      tokens_.front().starts_line = tokens_.front().may_start_row = true;
      if (tokens_.front().is_command() && tokens_.size() > 1) tokens_[1].may_start_row = true;
    }
  }

 private:
  void next() {
    const char c = text_[at_];
    if (c == '"') return quoted(Token::Kind::text, "this string is not closed on its line");
    if (c == '\'') return quoted(Token::Kind::replacement, "this ' is not closed on its line");
    if (c == '(') return parenthesis();
    if (c == ')') {
      Token& token = add(Token::Kind::word, at_, 1);
      blame(token, "this ) closes nothing");
      ++at_;
      return;
    }
    word();
  }

  Token& add(Token::Kind kind, std::size_t first, std::size_t size) {
    Token& token = tokens_.emplace_back();
    token.kind = kind;
    token.text = text_.substr(first, size);
    token.where = line_.at(first, size);
    return token;
  }

  void blame(Token& token, std::string message, std::string hint = {}) {
    token.fault = &faults_.emplace_back(TokenFault{std::move(message), std::move(hint)});
  }

  void quoted(Token::Kind kind, const char* unclosed) {
    const std::size_t end = text_.find(text_[at_], at_ + 1);
    const bool closed = end != std::string_view::npos;
    const std::size_t size = (closed ? end + 1 : text_.size()) - at_;
    Token& token = add(kind, at_, size);
    token.text = text_.substr(at_ + 1, closed ? size - 2 : size - 1);
    if (!closed) blame(token, unclosed);
    at_ += size;
  }

  /// Size in bytes of the parenthesis that opens at `first`, or 0 if it is not closed.
  std::size_t parenthesis_size(std::size_t first) const {
    int depth = 0;
    for (std::size_t i = first; i < text_.size() && text_[i] != '"' && text_[i] != '\''; ++i) {
      if (text_[i] == '(') ++depth;
      if (text_[i] == ')' && --depth == 0) return i + 1 - first;
    }
    return 0;
  }

  void parenthesis() {
    const std::size_t size = parenthesis_size(at_);
    if (size == 0) {
      Token& token = add(Token::Kind::number, at_, 1);
      blame(token, "this ( is not closed");
      at_ = text_.size();
      return;
    }
    Token& token = add(Token::Kind::number, at_, size);
    const Expression::Parsed result = Expression::parse(text_.substr(at_ + 1, size - 2), false);
    if (result.good()) token.value = result.expression.value(0);
    if (result.good() && !std::isfinite(token.value)) blame(token, "this is not a finite number");
    if (!result.good()) {
      blame(token, result.fault.message, result.fault.hint);
      token.where = line_.at(at_ + 1 + result.fault.at, result.fault.length);
    }
    at_ += size;
  }

  void word() {
    const std::size_t first = at_;
    while (at_ < text_.size() && !ends_word(text_[at_])) ++at_;
    const std::string_view word = text_.substr(first, at_ - first);
    if (word.front() == '#' && at_ < text_.size() && text_[at_] == '(') {  // BACON's #INQ(...) is one word
      const std::size_t size = parenthesis_size(at_);
      at_ = size == 0 ? text_.size() : at_ + size;
      add(Token::Kind::word, first, at_ - first);
      return;
    }
    const bool command = tokens_.empty() && word.front() == '.' && !parse_number(word).good();
    if (command || !(looks_like_number(word) || (word.find('*') != std::string_view::npos && word.front() != '*'))) {
      Token& token = add(Token::Kind::word, first, word.size());
      if (word.front() == '/') undefined_abbreviation(token);
      return;
    }
    Number number = parse_number(word);
    Token& token = add(Token::Kind::number, first, word.size());
    token.value = number.value;
    token.repeat = number.repeat;
    if (!number.good()) blame(token, std::move(number.fault), std::move(number.hint));
  }

  void undefined_abbreviation(Token& token) {
    const std::string near = nearest(token.text, abbreviations_.names());
    blame(token, "no ABRE defines " + token.quoted(), near.empty() ? "" : "did you mean `" + near + "`?");
  }

  const LogicalLine& line_;
  std::string_view text_;
  const Abbreviations& abbreviations_;
  std::deque<TokenFault>& faults_;
  std::vector<Token>& tokens_;
  std::size_t at_ = 0;
};

}  // namespace

std::string Token::quoted() const {
  const char mark = kind == Kind::text ? '"' : '`';
  return mark + std::string(text) + mark;
}

int Lexer::read(int file, int first_line, int columns, const Abbreviations& abbreviations, std::vector<Token>& tokens) {
  LogicalLine line;
  line.file = file;
  line.first_line = first_line;
  int lines = 1;
  const std::string_view source = sources_.line(file, first_line);
  if (const std::size_t size = plain_size(source, columns, abbreviations); size != std::string_view::npos) {
    line.text = source.substr(0, size);
  } else {
    std::string& text = composed_.emplace_back();
    LineBuilder builder(text, line, abbreviations, diagnostics_);
    bool continued = builder.append(source, first_line, columns);
    for (; continued && first_line + lines <= sources_.line_count(file); ++lines)
      continued = builder.append(sources_.line(file, first_line + lines), first_line + lines, columns);
    line.text = text;
  }
  tokens.clear();
  Tokenizer(line, abbreviations, faults_, tokens).run();
  return lines;
}

}  // namespace engrane::deck
