// SPDX-License-Identifier: BSD-3-Clause
#include "deck/language/number.hpp"

#include <charconv>
#include <cstddef>

namespace engrane::deck {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_sign(char c) { return c == '+' || c == '-'; }

/// A cursor over the word that copies accepted characters in the notation of from_chars.
class Scanner {
 public:
  explicit Scanner(std::string_view word) : word_(word) {}

  char next() const { return at_ < word_.size() ? word_[at_] : '\0'; }
  bool done() const { return at_ == word_.size(); }
  void skip() { ++at_; }
  void copy() { spelling += word_[at_++]; }
  std::size_t copy_digits() {
    const std::size_t start = at_;
    while (is_digit(next())) copy();
    return at_ - start;
  }
  std::string_view rest() const { return word_.substr(at_); }

  std::string spelling;

 private:
  std::string_view word_;
  std::size_t at_ = 0;
};

Number fault(std::string_view word, std::string why, std::string hint = {}) {
  Number number;
  number.fault = "`" + std::string(word) + "` " + std::move(why);
  number.hint = std::move(hint);
  return number;
}

Number malformed(std::string_view word) {
  if (word.find(',') != std::string_view::npos)
    return fault(word, "is not a number", "write a decimal point; values are separated by blanks, not by commas");
  return fault(word, "is not a number");
}

/// Parses a number in the notation of from_chars, as nearly all are. Returns false if it is not, or is out of range.
bool parse_usual(std::string_view word, double& value) {
  if (!looks_like_number(word)) return false;      // from_chars accepts inf and nan, decks do not
  if (word.front() == '+') word.remove_prefix(1);  // from_chars does not accept a plus sign
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  return error == std::errc() && stop == end;
}

/// Parses a number without a repeat count.
Number parse_plain(std::string_view word) {
  if (double value = 0; parse_usual(word, value)) return {value, 1, {}, {}};
  Scanner scan(word);
  if (is_sign(scan.next())) {
    if (scan.next() == '+')
      scan.skip();  // from_chars does not accept a plus sign
    else
      scan.copy();
  }
  std::size_t digits = scan.copy_digits();
  if (scan.next() == '.') {
    scan.copy();
    digits += scan.copy_digits();
  }
  if (digits == 0) return malformed(word);
  const char mark = scan.next();
  const bool letter = mark == 'e' || mark == 'E' || mark == 'd' || mark == 'D';
  bool small = false;  // distinguishes underflow from overflow, which from_chars does not
  if (letter || is_sign(mark)) {
    if (letter) scan.skip();
    scan.spelling += 'e';
    if (is_sign(scan.next())) {
      small = scan.next() == '-';
      scan.copy();
    }
    if (scan.copy_digits() == 0) return malformed(word);
  }
  if (!scan.done()) return malformed(word);

  Number number;
  const char* const end = scan.spelling.data() + scan.spelling.size();
  const auto [stop, error] = std::from_chars(scan.spelling.data(), end, number.value);
  if (error == std::errc::result_out_of_range) {
    if (small) return fault(word, "is too small for a double", "write 0");
    return fault(word, "is too large for a double");
  }
  if (error != std::errc() || stop != end) return malformed(word);
  return number;
}

}  // namespace

bool looks_like_number(std::string_view word) {
  std::size_t i = 0;
  if (i < word.size() && is_sign(word[i])) ++i;
  if (i < word.size() && word[i] == '.') ++i;
  return i < word.size() && is_digit(word[i]);
}

Number parse_number(std::string_view word) {
  const std::size_t star = word.find('*');
  if (star == std::string_view::npos) return parse_plain(word);
  int repeat = 0;
  const char* const end = word.data() + star;
  const auto [stop, error] = std::from_chars(word.data(), end, repeat);
  if (error == std::errc::invalid_argument || stop != end)
    return fault(word, "is not a number", "arithmetic stands in parentheses: (2*3)");
  if (error == std::errc::result_out_of_range || repeat > most_repeated)
    return fault(word, "repeats more than " + std::to_string(most_repeated) + " times");
  if (repeat < 1) return fault(word, "repeats a value less than once");
  Number number = parse_plain(word.substr(star + 1));
  if (!number.good()) return fault(word, "is not a number", number.hint);
  number.repeat = repeat;
  return number;
}

}  // namespace engrane::deck
