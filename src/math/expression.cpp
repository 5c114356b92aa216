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

namespace engrane {

namespace {

using Code = Expression::Instruction::Code;

/// Parentheses, powers and arguments may nest this deep: more than anyone writes, and little enough for any stack.
constexpr int deepest = 100;
/// Operands that may wait on the stack of an evaluation; each level of nesting keeps at most three.
constexpr std::size_t most_waiting = 64;

struct Named {
  std::string_view name;
  Code code;
  std::size_t least;
  std::size_t most;
};
constexpr std::size_t any_number = 64;
constexpr std::array<Named, 13> functions{{
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
    {"abs", Code::absolute, 1, 1},
    {"min", Code::minimum, 1, any_number},
    {"max", Code::maximum, 1, any_number},
}};

bool unary(Code code) {
  switch (code) {
    case Code::negate:
    case Code::sine:
    case Code::cosine:
    case Code::tangent:
    case Code::arcsine:
    case Code::arccosine:
    case Code::arctangent:
    case Code::square_root:
    case Code::exponential:
    case Code::logarithm:
    case Code::absolute:
      return true;
    default:
      return false;
  }
}

double apply(Code code, double a) {
  switch (code) {
    case Code::negate:
      return -a;
    case Code::sine:
      return std::sin(a);
    case Code::cosine:
      return std::cos(a);
    case Code::tangent:
      return std::tan(a);
    case Code::arcsine:
      return std::asin(a);
    case Code::arccosine:
      return std::acos(a);
    case Code::arctangent:
      return std::atan(a);
    case Code::square_root:
      return std::sqrt(a);
    case Code::exponential:
      return std::exp(a);
    case Code::logarithm:
      return std::log(a);
    default:
      return std::abs(a);
  }
}

double apply(Code code, double a, double b) {
  switch (code) {
    case Code::add:
      return a + b;
    case Code::subtract:
      return a - b;
    case Code::multiply:
      return a * b;
    case Code::divide:
      return a / b;
    case Code::power:
      return std::pow(a, b);
    case Code::arctangent2:
      return std::atan2(a, b);
    case Code::minimum:
      return std::min(a, b);
    default:
      return std::max(a, b);
  }
}

/// A Taylor series in the variable, cut after the third power.
struct Series {
  double c0 = 0, c1 = 0, c2 = 0, c3 = 0;

  bool constant() const { return c1 == 0 && c2 == 0 && c3 == 0; }
  /// f of this series, from the derivatives of f at c0 (Faà di Bruno).
  Series chain(double f, double f1, double f2, double f3) const {
    // a constant inside has no derivatives, even where those of f are infinite
    if (constant()) return {f, 0, 0, 0};
    return {f, f1 * c1, f1 * c2 + f2 / 2 * c1 * c1, f1 * c3 + f2 * c1 * c2 + f3 / 6 * c1 * c1 * c1};
  }
  Series operator-() const { return {-c0, -c1, -c2, -c3}; }
};

Series operator+(const Series& a, const Series& b) { return {a.c0 + b.c0, a.c1 + b.c1, a.c2 + b.c2, a.c3 + b.c3}; }
Series operator-(const Series& a, const Series& b) { return {a.c0 - b.c0, a.c1 - b.c1, a.c2 - b.c2, a.c3 - b.c3}; }
Series operator*(const Series& a, const Series& b) {
  return {a.c0 * b.c0, a.c0 * b.c1 + a.c1 * b.c0, a.c0 * b.c2 + a.c1 * b.c1 + a.c2 * b.c0,
          a.c0 * b.c3 + a.c1 * b.c2 + a.c2 * b.c1 + a.c3 * b.c0};
}
Series operator/(const Series& a, const Series& b) {
  Series q;
  q.c0 = a.c0 / b.c0;
  q.c1 = (a.c1 - q.c0 * b.c1) / b.c0;
  q.c2 = (a.c2 - q.c0 * b.c2 - q.c1 * b.c1) / b.c0;
  q.c3 = (a.c3 - q.c0 * b.c3 - q.c1 * b.c2 - q.c2 * b.c1) / b.c0;
  return q;
}

/// Is the function just right of here below zero? The first coefficient that is not zero decides.
bool negative_on_the_right(const Series& a) {
  for (const double c : {a.c0, a.c1, a.c2, a.c3})
    if (c != 0) return c < 0;
  return false;
}

Series exponential(const Series& a) {
  const double e = std::exp(a.c0);
  return a.chain(e, e, e, e);
}
Series logarithm(const Series& a) {
  const double i = 1 / a.c0;
  return a.chain(std::log(a.c0), i, -i * i, 2 * i * i * i);
}

Series power(const Series& a, const Series& b) {
  if (!b.constant()) {
    Series r = exponential(b * logarithm(a));
    r.c0 = std::pow(a.c0, b.c0);
    return r;
  }
  // p (p-1) … x^(p-k): a factor that is exactly zero ends the chain, so that x**2 at 0 has no 0·∞
  const double p = b.c0;
  const std::array factors{p, p * (p - 1), p * (p - 1) * (p - 2)};
  std::array<double, 3> d{};
  for (std::size_t k = 0; k < 3; ++k)
    if (factors[k] != 0) d[k] = factors[k] * std::pow(a.c0, p - static_cast<double>(k + 1));
  return a.chain(std::pow(a.c0, p), d[0], d[1], d[2]);
}

Series arctangent2(const Series& y, const Series& x) {
  // θ′ = (x y′ − y x′)/(x² + y²), a series of order two, integrated
  const Series dx{x.c1, 2 * x.c2, 3 * x.c3, 0};
  const Series dy{y.c1, 2 * y.c2, 3 * y.c3, 0};
  const Series rate = (x * dy - y * dx) / (x * x + y * y);
  return {std::atan2(y.c0, x.c0), rate.c0, rate.c1 / 2, rate.c2 / 3};
}

Series apply(Code code, const Series& a) {
  const double u = a.c0;
  switch (code) {
    case Code::negate:
      return -a;
    case Code::sine: {
      const double s = std::sin(u), c = std::cos(u);
      return a.chain(s, c, -s, -c);
    }
    case Code::cosine: {
      const double s = std::sin(u), c = std::cos(u);
      return a.chain(c, -s, -c, s);
    }
    case Code::tangent: {
      const double t = std::tan(u), w = 1 + t * t;
      return a.chain(t, w, 2 * t * w, w * (2 + 6 * t * t));
    }
    case Code::arcsine:
    case Code::arccosine: {
      const double w = 1 / ((1 - u) * (1 + u)), r = std::sqrt(w);
      const double d1 = r, d2 = u * r * w, d3 = (1 + 2 * u * u) * r * w * w;
      return code == Code::arcsine ? a.chain(std::asin(u), d1, d2, d3) : a.chain(std::acos(u), -d1, -d2, -d3);
    }
    case Code::arctangent: {
      const double w = 1 / (1 + u * u);
      return a.chain(std::atan(u), w, -2 * u * w * w, (6 * u * u - 2) * w * w * w);
    }
    case Code::square_root: {
      const double s = std::sqrt(u), i = 1 / s;
      return a.chain(s, 0.5 * i, -0.25 * i * i * i, 0.375 * i * i * i * i * i);
    }
    case Code::exponential:
      return exponential(a);
    case Code::logarithm:
      return logarithm(a);
    default:
      return negative_on_the_right(a) ? -a : a;
  }
}

Series apply(Code code, const Series& a, const Series& b) {
  switch (code) {
    case Code::add:
      return a + b;
    case Code::subtract:
      return a - b;
    case Code::multiply:
      return a * b;
    case Code::divide:
      return a / b;
    case Code::power:
      return power(a, b);
    case Code::arctangent2:
      return arctangent2(a, b);
    case Code::minimum:
      return negative_on_the_right(b - a) ? b : a;
    default:
      return negative_on_the_right(a - b) ? b : a;
  }
}

/// Runs a program on doubles or series; variables in the order of Instruction::number. The parser has checked that the stack
/// suffices.
template <class T>
T run(const std::vector<Expression::Instruction>& program, const std::array<T, 3>& variables) {
  std::array<T, most_waiting> stack;
  std::size_t top = 0;
  for (const Expression::Instruction& i : program) {
    if (i.code == Code::number) {
      stack[top++] = T{i.number};
    } else if (i.code == Code::variable) {
      stack[top++] = variables[static_cast<std::size_t>(i.number)];
    } else if (unary(i.code)) {
      stack[top - 1] = apply(i.code, stack[top - 1]);
    } else {
      --top;
      stack[top - 1] = apply(i.code, stack[top - 1], stack[top]);
    }
  }
  return stack[0];
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Recursive descent that emits postfix code. After a fault it runs to the end without complaining again.
class Parser {
 public:
  Parser(std::string_view text, bool variable_allowed) : text_(text), variable_allowed_(variable_allowed) {}

  Expression::Fault run() {
    sum();
    skip_blanks();
    if (good() && at_ < text_.size()) {
      const std::string next(text_.substr(at_, character_size(text_, at_)));
      const bool product = is_letter(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '(';
      fault(next == ")" ? "this `)` closes nothing" : "an operator is missing before `" + next + "`",
            product ? "a product needs its `*`" : "", at_, next.size());
    }
    return fault_;
  }

  std::vector<Expression::Instruction> take_program() { return std::move(program_); }
  bool uses_time() const { return variable_ != 0; }
  bool uses_law() const { return law_; }

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
    if (text_.substr(at_, token.size()) != token) return false;
    at_ += token.size();
    return true;
  }
  bool next_is(std::string_view token) {
    skip_blanks();
    return text_.substr(at_, token.size()) == token;
  }

  void push(Expression::Instruction instruction) {
    program_.push_back(instruction);
    if (++waiting_ > most_waiting) too_deep();
  }
  void too_deep() { fault("the expression nests too deeply", "split it into simpler parts", at_ > 0 ? at_ - 1 : 0, 1); }

  /// Appends an operation, or works it out when its operands are numbers. `at` and `length` name it in a fault.
  void operation(Code code, std::size_t at, std::size_t length) {
    if (!good()) return;
    const std::size_t operands = unary(code) ? 1 : 2;
    waiting_ -= operands - 1;
    const std::size_t n = program_.size();
    bool numbers = true;
    for (std::size_t i = 0; i < operands; ++i) numbers = numbers && program_[n - 1 - i].code == Code::number;
    if (!numbers) {
      program_.push_back({code, 0});
      return;
    }
    const double b = program_.back().number;
    if (operands == 2) program_.pop_back();
    const double result = operands == 1 ? apply(code, b) : apply(code, program_.back().number, b);
    program_.back().number = result;
    if (!std::isfinite(result)) fault("this is not a finite real number", "", at, length);
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
      } else if (accept("/")) {
        signed_power();
        operation(Code::divide, at, 1);
      } else {
        return;
      }
    }
  }

  /// A sign binds less than a power: -2**2 is -4.
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
      sum();
      if (good() && !accept(")")) {
        if (next_is(",")) return fault("a comma belongs between the arguments of a function", "", at_, 1);
        if (at_ < text_.size()) return;  // the caller says what is odd about it
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
    if (at_ < text_.size() && text_[at_] == '.') {
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
    do {
      sum();
      if (++count > function.most) break;
      if (count > 1) operation(function.code, at, length);
    } while (good() && accept(","));
    if (!good()) return;
    if (count < function.least || count > function.most) {
      const std::string wanted = function.least == function.most ? counted(function.most, "argument") : "at most 64 arguments";
      return fault(std::string(function.name) + " takes " + wanted, "", at, length);
    }
    if (function.most == 1) operation(function.code, at, length);
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
    parsed.expression.uses_time_ = parser.uses_time();
    parsed.expression.uses_law_ = parser.uses_law();
    parsed.expression.constant_ = !parser.uses_time() && !parser.uses_law();
  }
  return parsed;
}

double Expression::value(double x) const { return run<double>(program_, {x, 0, 0}); }

Jet Expression::at(double x) const {
  const Series s = run<Series>(program_, {Series{x, 1, 0, 0}, Series{0}, Series{0}});
  return {s.c0, s.c1, 2 * s.c2, 6 * s.c3};
}

Expression::Law Expression::law(double elongation, double rate, double time) const {
  const Series along_d = run<Series>(program_, {Series{time}, Series{elongation, 1, 0, 0}, Series{rate}});
  const Series along_v = run<Series>(program_, {Series{time}, Series{elongation}, Series{rate, 1, 0, 0}});
  return {along_d.c0, along_d.c1, along_v.c1};
}

}  // namespace engrane
