// SPDX-License-Identifier: BSD-3-Clause
#include "math/expression.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/diagnostics.hpp"
#include "base/text.hpp"
#include "math/expression_operations.hpp"

namespace engrane {

namespace {

using Code = Expression::Instruction::Code;

/// Limit on the nesting of parentheses, powers and arguments: more than anyone writes, and safe for any stack.
constexpr int deepest = 100;

struct Named {
  std::string_view name;
  Code code;
  std::size_t least;
  std::size_t most;
};
constexpr std::size_t any_number = 64;
constexpr std::array<Named, 16> functions{{
    {"sin", Code::sine, 1, 1},
    {"cos", Code::cosine, 1, 1},
    {"tan", Code::tangent, 1, 1},
    {"asin", Code::arcsine, 1, 1},
    {"acos", Code::arccosine, 1, 1},
    {"atan", Code::arctangent, 1, 1},
    {"atan2", Code::arctangent2, 2, 2},
    {"sqrt", Code::square_root, 1, 1},
    {"exp", Code::exponential, 1, 1},
    {"log", Code::logarithm, 1, 1},
    {"tanh", Code::hyperbolic_tangent, 1, 1},
    {"abs", Code::absolute, 1, 1},
    {"sign", Code::sign, 1, 2},
    {"if", Code::choice, 3, 3},
    {"min", Code::minimum, 1, any_number},
    {"max", Code::maximum, 1, any_number},
}};

struct Operator {
  std::string_view sign;
  Code code;
};
/// Comparisons of Fortran 90 and FORTRAN 77. Of two that begin alike, the longer comes first.
constexpr std::array<Operator, 12> comparisons{{{"<=", Code::less_or_equal},
                                                {"<", Code::less},
                                                {">=", Code::greater_or_equal},
                                                {">", Code::greater},
                                                {"==", Code::equal},
                                                {"/=", Code::not_equal},
                                                {".LE.", Code::less_or_equal},
                                                {".LT.", Code::less},
                                                {".GE.", Code::greater_or_equal},
                                                {".GT.", Code::greater},
                                                {".EQ.", Code::equal},
                                                {".NE.", Code::not_equal}}};

/// Operators of other languages, with hints for what to write instead.
constexpr std::array<std::array<std::string_view, 2>, 6> foreign{{{"^", "a power is written **"},
                                                                  {"=", "equality is written =="},
                                                                  {"!=", "inequality is written /="},
                                                                  {"&", "write .AND."},
                                                                  {"|", "write .OR."},
                                                                  {"?", "write if(condition, a, b)"}}};

/// Whether a dotted operator such as `.LT.` starts at `at`. Then the dot does not belong to the number before it.
bool dotted_operator_at(std::string_view text, std::size_t at) {
  for (const std::string_view word : {".LE.", ".LT.", ".GE.", ".GT.", ".EQ.", ".NE.", ".AND.", ".OR.", ".NOT."})
    if (same_word(text.substr(at, word.size()), word)) return true;
  return false;
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Recursive-descent parser that emits postfix code. After the first fault it skips to the end of the text and reports nothing
/// more.
class Parser {
 public:
  Parser(std::string_view text, bool variable_allowed) : text_(text), variable_allowed_(variable_allowed) {}

  Expression::Fault run() {
    alternative();
    skip_blanks();
    if (good() && at_ < text_.size()) {
      const std::string next(text_.substr(at_, character_size(text_, at_)));
      const bool product = is_letter(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '(';
      std::string hint = product ? "a product needs its `*`" : "";
      for (const auto& [sign, answer] : foreign)
        if (begins_with_word(text_.substr(at_), sign)) hint = answer;
      fault(next == ")" ? "this `)` closes nothing" : "an operator is missing before `" + next + "`", std::move(hint), at_,
            next.size());
    }
    return fault_;
  }

  std::vector<Expression::Instruction> take_program() { return std::move(program_); }
  bool uses_time() const { return variable_ != 0; }
  bool uses_law() const { return law_; }
  char variable() const { return variable_; }

 private:
  bool good() const { return fault_.message.empty(); }
  void fault(std::string message, std::string hint, std::size_t at, std::size_t length) {
    if (good()) fault_ = {std::move(message), std::move(hint), at, std::max<std::size_t>(length, 1)};
    at_ = text_.size();
  }
  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' || text_[at_] == '\r')) ++at_;
  }
  bool accept(std::string_view token) {
    skip_blanks();
    if (!same_word(text_.substr(at_, token.size()), token)) return false;
    at_ += token.size();
    return true;
  }
  bool next_is(std::string_view token) {
    skip_blanks();
    return same_word(text_.substr(at_, token.size()), token);
  }

  void push(Expression::Instruction instruction) {
    program_.push_back(instruction);
    if (++waiting_ > most_waiting_operands) too_deep();
  }
  void too_deep() { fault("the expression nests too deeply", "split it into simpler parts", at_ > 0 ? at_ - 1 : 0, 1); }

  /// Appends an operation, or folds it if its operands are constants. `at` and `length` locate it in a fault.
  void operation(Code code, std::size_t at, std::size_t length) {
    if (!good()) return;
    const std::size_t operands = operand_count(code);
    waiting_ -= operands - 1;
    const auto first = program_.end() - static_cast<std::ptrdiff_t>(operands);
    if (!std::all_of(first, program_.end(), [](const Expression::Instruction& i) { return i.code == Code::number; })) {
      program_.push_back({code, 0});
      return;
    }
    std::array<double, 3> numbers{};
    std::transform(first, program_.end(), numbers.begin(), [](const Expression::Instruction& i) { return i.number; });
    const double result = apply(code, numbers[0], numbers[1], numbers[2]);
    program_.resize(program_.size() - operands + 1);
    program_.back().number = result;
    if (!std::isfinite(result)) fault("this is not a finite real number", "", at, length);
  }

  void alternative() {
    conjunction();
    for (;;) {
      skip_blanks();
      const std::size_t at = at_;
      if (!good() || !accept(".OR.")) return;
      conjunction();
      operation(Code::logical_or, at, 4);
    }
  }

  void conjunction() {
    negation();
    for (;;) {
      skip_blanks();
      const std::size_t at = at_;
      if (!good() || !accept(".AND.")) return;
      negation();
      operation(Code::logical_and, at, 5);
    }
  }

  void negation() {
    bool negative = false;
    skip_blanks();
    const std::size_t at = at_;
    while (accept(".NOT.")) negative = !negative;
    comparison();
    if (negative) operation(Code::logical_not, at, 5);
  }

  void comparison() {
    sum();
    if (!good() || !compare_with_next()) return;
    skip_blanks();
    const std::size_t at = at_;
    for (const Operator& o : comparisons)
      if (next_is(o.sign)) return fault("a comparison has two sides", "write a < b .AND. b < c", at, o.sign.size());
  }

  bool compare_with_next() {
    skip_blanks();
    const std::size_t at = at_;
    for (const Operator& o : comparisons)
      if (accept(o.sign)) {
        sum();
        operation(o.code, at, o.sign.size());
        return good();
      }
    return false;
  }

  void sum() {
    product();
    while (good()) {
      skip_blanks();
      const std::size_t at = at_;
      if (accept("+")) {
        product();
        operation(Code::add, at, 1);
      } else if (accept("-")) {
        product();
        operation(Code::subtract, at, 1);
      } else {
        return;
      }
    }
  }

  void product() {
    signed_power();
    while (good() && !next_is("**")) {
      skip_blanks();
      const std::size_t at = at_;
      if (accept("*")) {
        signed_power();
        operation(Code::multiply, at, 1);
      } else if (!next_is("/=") && accept("/")) {
        signed_power();
        operation(Code::divide, at, 1);
      } else {
        return;
      }
    }
  }

  /// A sign binds less tightly than a power: -2**2 is -4.
  void signed_power() {
    bool negative = false;
    skip_blanks();
    const std::size_t at = at_;
    for (;;) {
      if (accept("-"))
        negative = !negative;
      else if (!accept("+"))
        break;
    }
    power();
    if (negative) operation(Code::negate, at, 1);
  }

  void power() {
    if (++depth_ > deepest) return too_deep();
    operand();
    skip_blanks();
    const std::size_t at = at_;
    if (good() && accept("**")) {
      signed_power();
      operation(Code::power, at, 2);
    }
    --depth_;
  }

  void operand() {
    skip_blanks();
    const std::size_t at = at_;
    if (at_ >= text_.size()) return fault("a number, a name or `(` is missing here", "", at > 0 ? at - 1 : 0, 1);
    const char c = text_[at_];
    if (is_digit(c) || (c == '.' && at_ + 1 < text_.size() && is_digit(text_[at_ + 1]))) return number();
    if (is_letter(c)) return name();
    if (accept("(")) {
      alternative();
      if (good() && !accept(")")) {
        if (next_is(",")) return fault("a comma belongs between the arguments of a function", "", at_, 1);
        if (at_ < text_.size()) return;  // the caller reports what is wrong with it
        fault("this `(` is never closed", "", at, 1);
      }
      return;
    }
    const std::string next(text_.substr(at_, character_size(text_, at_)));
    fault("a number, a name or `(` is expected, not `" + next + "`", "", at, next.size());
  }

  void number() {
    const std::size_t start = at_;
    std::string digits;
    const auto take_digits = [&] {
      while (at_ < text_.size() && is_digit(text_[at_])) digits += text_[at_++];
    };
    take_digits();
    if (at_ < text_.size() && text_[at_] == '.' && !dotted_operator_at(text_, at_)) {
      digits += text_[at_++];
      take_digits();
    }
    if (at_ < text_.size() && (text_[at_] == 'e' || text_[at_] == 'E' || text_[at_] == 'd' || text_[at_] == 'D')) {
      std::size_t after = at_ + 1;
      if (after < text_.size() && (text_[after] == '+' || text_[after] == '-')) ++after;
      if (after < text_.size() && is_digit(text_[after])) {
        digits += 'e';
        if (text_[++at_] == '-') digits += '-';
        at_ = after;
        take_digits();
      }
    }
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size())
      return fault("`" + std::string(text_.substr(start, at_ - start)) + "` is beyond the range of numbers", "", start,
                   at_ - start);
    push({Code::number, value});
  }

  void name() {
    const std::size_t start = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
    const std::string_view word = text_.substr(start, at_ - start);
    const Named* function = nullptr;
    for (const Named& f : functions)
      if (same_word(word, f.name)) function = &f;
    if (next_is("(") && function) return arguments(*function, start, word.size());
    if (function) return fault(std::string(word) + " needs its argument in parentheses", "", start, word.size());
    if (same_word(word, "PI")) return push({Code::number, std::numbers::pi});
    const bool t = same_word(word, "T");
    if (variable_allowed_ && (t || same_word(word, "X"))) {
      const char variable = t ? 'T' : 'X';
      if (variable_ != 0 && variable_ != variable)
        return fault("T and X are two names of one variable", "use one of them", start, 1);
      variable_ = variable;
      return push({Code::variable, 0});
    }
    const bool elongation = same_word(word, "D");
    if (variable_allowed_ && (elongation || same_word(word, "V"))) {
      law_ = true;
      return push({Code::variable, elongation ? 1.0 : 2.0});
    }
    std::vector<std::string> known{"PI"};
    for (const Named& f : functions) known.emplace_back(f.name);
    const std::string near = nearest(word, known);
    std::string hint = near.empty() ? "" : "did you mean " + near + "?";
    if (hint.empty())
      hint = variable_allowed_ ? "the variable is called T or X; D and V are those of a law" : "known are " + join(known);
    fault("`" + std::string(word) + "` is not known here", std::move(hint), start, word.size());
  }

  void arguments(const Named& function, std::size_t at, std::size_t length) {
    const std::size_t open = at_;
    accept("(");
    std::size_t count = 0;
    const bool fold = function.most == any_number;  // reduced pairwise
    do {
      alternative();
      if (++count > function.most) break;
      if (fold && count > 1) operation(function.code, at, length);
    } while (good() && accept(","));
    if (!good()) return;
    if (count < function.least || count > function.most) {
      const std::string wanted = function.least == function.most ? counted(function.most, "argument")
                                 : fold                          ? "at most 64 arguments"
                                                                 : "1 or 2 arguments";
      return fault(std::string(function.name) + " takes " + wanted, "", at, length);
    }
    if (!fold) operation(function.code == Code::sign && count == 2 ? Code::transfer_sign : function.code, at, length);
    if (!good() || accept(")")) return;
    if (at_ >= text_.size()) fault("this `(` is never closed", "", open, 1);
  }

  std::string_view text_;
  bool variable_allowed_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::size_t waiting_ = 0;
  char variable_ = 0;
  bool law_ = false;
  std::vector<Expression::Instruction> program_;
  Expression::Fault fault_;
};

}  // namespace

Expression::Parsed Expression::parse(std::string_view text, bool variable_allowed) {
  Parser parser(text, variable_allowed);
  Parsed parsed;
  parsed.fault = parser.run();
  if (parsed.good()) {
    parsed.expression.program_ = parser.take_program();
    parsed.expression.name_decisions();
    parsed.expression.uses_time_ = parser.uses_time();
    if (parser.uses_time()) parsed.expression.variable_ = parser.variable();
    parsed.expression.uses_law_ = parser.uses_law();
    parsed.expression.constant_ = !parser.uses_time() && !parser.uses_law();
  }
  return parsed;
}

double Expression::value(double x) const { return evaluate_program<double>(program_, {x, 0, 0}); }

Jet Expression::at(double x) const {
  const Series s = evaluate_program<Series>(program_, {Series{x, 1, 0, 0}, Series{0}, Series{0}});
  return {s.c0, s.c1, 2 * s.c2, 6 * s.c3};
}

Expression::Law Expression::law(double elongation, double rate, double time) const {
  const Series along_d = evaluate_program<Series>(program_, {Series{time}, Series{elongation, 1, 0, 0}, Series{rate}});
  const Series along_v = evaluate_program<Series>(program_, {Series{time}, Series{elongation}, Series{rate, 1, 0, 0}});
  return {along_d.c0, along_d.c1, along_v.c1};
}

}  // namespace engrane
