// SPDX-License-Identifier: BSD-3-Clause
#include "deck/language/token_stream.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <system_error>
#include <utility>

#include "base/text.hpp"

namespace engrane::deck {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t deepest_input = 20;
constexpr int most_files = 1000;  ///< two INPUT lines per file, nested twenty deep, would read a million files
constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 30;
constexpr int most_columns = 1'000'000;

/// Reads a regular file. Devices, pipes and folders are refused, as they may be endless.
bool read_plain_file(const fs::path& path, std::string& text, std::string& fault) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) return fault = "does not exist", false;
  if (!fs::is_regular_file(status)) return fault = "is not a plain file", false;
  const std::uintmax_t size = fs::file_size(path, error);
  if (size > largest_file || error) return fault = "is larger than 1 GiB", false;
  std::ifstream in(path, std::ios::binary);
  if (!in) return fault = "cannot be opened", false;
  text.resize(static_cast<std::size_t>(size));
  in.read(text.data(), static_cast<std::streamsize>(size));
  text.resize(static_cast<std::size_t>(in.gcount()));  // in case it has become shorter
  if (in.bad()) return fault = "cannot be read", false;
  const std::string_view start = std::string_view(text).substr(0, 2);
  if (start == "\xff\xfe" || start == "\xfe\xff")
    return fault = "is UTF-16; save it as UTF-8 or ASCII (iconv -f UTF-16 -t UTF-8)", false;
  if (text.find('\0') < 200) return fault = "is no text: it holds zero bytes (UTF-16 without its mark?)", false;
  return true;
}

/// Whether a file that is neither below the folder of the deck nor called .dat looks like a deck: its first significant line
/// starts with a command, a word or a number. Other files (/etc/passwd, keys, shell histories) must not be shown in messages.
bool begins_like_a_deck(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r\f\v"), line.size()));
    if (line.empty() || line.front() == '!') continue;
    const std::string_view word = line.substr(0, line.find_first_of(" \t\r\f\v"));
    const auto letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    const std::string_view name = word.substr(word.front() == '.' ? 1 : 0);
    if (!name.empty() && std::all_of(name.begin(), name.end(), letter)) return true;
    return word.find_first_not_of("+-.0123456789eEdD") == std::string_view::npos;
  }
  return true;
}

/// Whether a file lies in or below the folder of the deck, or has the extension .dat.
bool belongs_to_deck(const fs::path& identity, const fs::path& deck) {
  if (upper(identity.extension().string()) == ".DAT") return true;
  const fs::path way = identity.lexically_relative(deck.parent_path());
  return !way.empty() && *way.begin() != "..";
}

/// Path of the file that an INPUT names: relative to the including file; `.dat` is appended if omitted.
fs::path resolve_input(const std::string& including, const std::string& name) {
  const fs::path path = (fs::path(including).parent_path() / name).lexically_normal();
  std::error_code error;
  if (!fs::exists(path, error) && !path.has_extension()) return fs::path(path) += ".dat";
  return path;
}

}  // namespace

fs::path TokenStream::beside(const Location& where, const std::string& name) const {
  return (fs::path(sources_.path(where.file)).parent_path() / name).lexically_normal();
}

bool TokenStream::open_file(const fs::path& path) {
  std::string text;
  std::string fault;
  if (!read_plain_file(path, text, fault)) {
    diagnostics_.error({}, "the deck `" + path.string() + "` " + fault);
    return false;
  }
  std::error_code error;
  open_.push_back({sources_.add(path.string(), std::move(text)), 1, fs::weakly_canonical(path, error)});
  return true;
}

void TokenStream::open_text(std::string name, std::string text) {
  columns_ = usual_columns;  // independent of MODE LECT in other files
  open_.push_back({sources_.add(std::move(name), std::move(text)), 1, {}});
}

const Token& TokenStream::peek(std::size_t ahead) {
  if (ahead == 0 && !tokens_.empty()) return tokens_.front();
  static const Token end;
  while (tokens_.size() <= ahead && read_line()) {
  }
  return ahead < tokens_.size() ? tokens_[ahead] : end;
}

Token TokenStream::take() {
  Token token = peek();
  skip();
  report(token);
  return token;
}

void TokenStream::skip() {
  if (!peek().is_end()) tokens_.pop_front();
}

bool TokenStream::report(const Token& token) {
  if (!token.fault) return false;
  diagnostics_.error(token.where, token.fault->message, token.fault->hint);
  return true;
}

/// Reads one logical line; false at the end of the deck.
bool TokenStream::read_line() {
  if (open_.empty()) return false;
  OpenFile& current = open_.back();
  if (current.next_line > sources_.line_count(current.file)) {
    open_.pop_back();
    return !open_.empty();
  }
  current.next_line += lexer_.read(current.file, current.next_line, columns_, abbreviations_, line_);
  if (!line_.empty() && !control(line_)) push(line_);
  return true;
}

bool TokenStream::mend_command() {
  const Token& token = peek();
  if (!token.is_word() || !token.starts_line) return false;
  const auto same = [&](const std::string& word) { return same_word(word.substr(1), token.text); };
  if (std::none_of(commands_.begin(), commands_.end(), same)) return false;
  mended_.push_back("." + std::string(token.text));
  diagnostics_.error(token.where, token.quoted() + " lacks its dot", "a command is written `" + mended_.back() + "`");
  tokens_.front().text = mended_.back();
  return true;
}

namespace {

/// Whether a token starts a comment in other languages.
bool begins_foreign_comment(const Token& token) {
  if (!token.is_word() || begins_with_word(token.text, "#INQ")) return false;
  return token.text.front() == '#' || token.text.front() == '%' || token.text.starts_with("//");
}

}  // namespace

void TokenStream::push(const std::vector<Token>& tokens) {
  for (const Token& token : tokens) {
    if (begins_foreign_comment(token)) {
      if (!told_of_comment_)
        diagnostics_.error(token.where, token.quoted() + " begins no comment", "a comment begins with `!`; this is said once");
      told_of_comment_ = true;
      return;
    }
    if (token.is_word() && begins_with_word(token.text, "#INQ")) {
      diagnostics_.warning_once("#INQ", token.where, "`#INQ` (an inquiry) is not used by engrane: its line is skipped");
      return;
    }
    if (token.is_word() && token.text == "&") {
      diagnostics_.warning_once("&", token.where, token.quoted() + " is not used by engrane and is skipped");
      continue;
    }
    tokens_.push_back(token);
  }
}

/// Executes a line of control words for the reader; false if it is data.
bool TokenStream::control(const std::vector<Token>& tokens) {
  const Token& first = tokens.front();
  if (!first.is_word()) return false;
  if (same_word(first.text, "INPUT")) return input(tokens), true;
  if (same_word(first.text, "ABRE")) return abbreviation(tokens), true;
  if (same_word(first.text, "MODE")) return mode(tokens), true;
  if (same_word(first.text, "RETURN")) return surplus(tokens, 1), leave_file(first), true;
  if (same_word(first.text, "EXIT")) return surplus(tokens, 1), finish(first), true;
  if (begins_with_word(first.text, ".FIN")) {
    const bool numbered = tokens.size() > 1 && tokens[1].is_number();
    return surplus(tokens, numbered ? 2 : 1), finish(first), true;
  }
  return false;
}

void TokenStream::surplus(const std::vector<Token>& tokens, std::size_t first) {
  if (tokens.size() <= first) return;
  diagnostics_.error(tokens[first].where, "nothing may follow `" + upper(tokens.front().text) + "` here");
}

void TokenStream::input(const std::vector<Token>& tokens) {
  const Token& word = tokens.front();
  if (tokens.size() < 2 || tokens[1].kind != Token::Kind::text || tokens[1].text.empty())
    return diagnostics_.error(word.where, "INPUT needs the name of a file in double quotes", "INPUT \"nodes.dat\"");
  const Token& name = tokens[1];
  if (report(name)) return;
  surplus(tokens, 2);
  if (open_.size() > deepest_input)
    return diagnostics_.error(name.where, "INPUT is nested more than " + std::to_string(deepest_input) + " deep");
  if (sources_.size() >= most_files)
    return diagnostics_.error(name.where, "INPUT reads more than " + std::to_string(most_files) + " files");
  if (name.text.find('\0') != std::string_view::npos) return diagnostics_.error(name.where, "this is no name of a file");

  const fs::path path = resolve_input(sources_.path(name.where.file), std::string(name.text));
  std::error_code error;
  const fs::path identity = fs::weakly_canonical(path, error);
  for (const OpenFile& open : open_)
    if (!open.identity.empty() && open.identity == identity)
      return diagnostics_.error(name.where, "`" + path.string() + "` includes itself");
  std::string text;
  std::string fault;
  if (!read_plain_file(path, text, fault))
    return diagnostics_.error(name.where, "the file `" + path.string() + "` " + fault,
                              "names are relative to the folder of the including file");
  const bool foreign = !belongs_to_deck(identity, open_.front().identity);
  if (foreign && !begins_like_a_deck(text))
    return diagnostics_.error(name.where, "the file `" + path.string() + "` is no part of a deck: it does not begin like one");
  open_.push_back({sources_.add(path.string(), std::move(text), word.where, foreign), 1, identity});
}

void TokenStream::abbreviation(const std::vector<Token>& tokens) {
  if (tokens.size() < 3)
    return diagnostics_.error(tokens.front().where, "ABRE needs a name and a text in single quotes", "ABRE '/radius' '0.25'");
  for (std::size_t i = 1; i < tokens.size(); i += 2) {
    if (report(tokens[i])) return;
    if (tokens[i].kind != Token::Kind::replacement || i + 1 == tokens.size() || tokens[i + 1].kind != Token::Kind::replacement)
      return diagnostics_.error(tokens[i].where, "ABRE takes pairs of a name and a text, each in single quotes",
                                "ABRE '/radius' '0.25'");
    if (report(tokens[i + 1])) return;
    const std::string_view name = tokens[i].text;
    const auto blank = [](char c) { return static_cast<unsigned char>(c) <= ' '; };
    if (name.size() < 2 || name.size() > 64 || name.front() != '/' || std::any_of(name.begin(), name.end(), blank))
      return diagnostics_.error(tokens[i].where, "the name of an abbreviation is `/` and one word of at most 63 characters",
                                "ABRE '/radius' '0.25'");
    abbreviations_.define(std::string(name), std::string(tokens[i + 1].text));
  }
}

void TokenStream::mode(const std::vector<Token>& tokens) {
  if (tokens.size() < 2) return diagnostics_.warning_once("MODE", tokens.front().where, "`MODE` without a setting is skipped");
  for (std::size_t i = 1; i < tokens.size();) {
    const Token& setting = tokens[i++];
    const bool numbered = i < tokens.size() && tokens[i].is_number();
    if (setting.is_word() && setting.text.size() >= 4 && begins_with_word("LECTURE", setting.text)) {
      if (!numbered || tokens[i].value < 1 || tokens[i].value > most_columns ||
          tokens[i].value != static_cast<int>(tokens[i].value))
        return diagnostics_.error(setting.where,
                                  "MODE LECT needs the number of columns to read, 1 to " + std::to_string(most_columns),
                                  "MODE LECT 132");
      columns_ = static_cast<int>(tokens[i++].value);
      if (i < tokens.size() && !tokens[i].is_word())
        return diagnostics_.error(tokens[i].where, "nothing but another setting may follow MODE LECT");
      continue;
    }
    const std::string name = "MODE " + std::string(setting.text);
    diagnostics_.warning_once(name, setting.where, "`" + name + "` is not used by engrane and is skipped");
    while (i < tokens.size() && !tokens[i].is_word()) ++i;
  }
}

void TokenStream::leave_file(const Token& word) {
  if (open_.size() < 2) return finish(word);
  const OpenFile left = open_.back();
  open_.pop_back();
  warn_of_rest(left, word);
}

void TokenStream::finish(const Token& word) {
  for (; !open_.empty(); open_.pop_back()) warn_of_rest(open_.back(), word);
}

/// Warns of any text after the end of a file or deck: no input may be ignored silently.
void TokenStream::warn_of_rest(const OpenFile& open, const Token& word) {
  for (int number = open.next_line; number <= sources_.line_count(open.file); ++number) {
    const std::string_view line = sources_.line(open.file, number);
    const std::size_t first = line.find_first_not_of(" \t\r\f\v\x1a");
    if (first == std::string_view::npos || line[first] == '!') continue;
    const Location where{open.file, number, static_cast<int>(first) + 1, static_cast<int>(line.size() - first)};
    diagnostics_.warning(where, "the text from here on is not read: " + upper(word.text) + " stands before it");
    return;
  }
}

}  // namespace engrane::deck
