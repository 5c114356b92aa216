// SPDX-License-Identifier: BSD-3-Clause
#include "math/expression_operations.hpp"

#include <cmath>
#include <limits>

namespace engrane {

namespace {

using Code = Expression::Instruction::Code;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Comparisons and logic give 1 if true and 0 if false; anything but 0 is true. `difference` is the sign of a - b.
double compare(Code code, double difference) {
  if (std::isnan(difference)) return difference;
  switch (code) {
    case Code::less:
      return difference < 0;
    case Code::less_or_equal:
      return difference <= 0;
    case Code::greater:
      return difference > 0;
    case Code::greater_or_equal:
      return difference >= 0;
    case Code::equal:
      return difference == 0;
    default:
      return difference != 0;
  }
}

double logic(Code code, double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return not_a_number;
  return code == Code::logical_and ? a != 0 && b != 0 : a != 0 || b != 0;
}

/// f of a series, from the derivatives of f at its value (Faà di Bruno).
Series chain(const Series& a, double f, double f1, double f2, double f3) {
  // a constant argument has zero derivatives, even where those of f are infinite
  if (a.constant()) return {f, 0, 0, 0};
  return {f, f1 * a.c1, f1 * a.c2 + f2 / 2 * a.c1 * a.c1, f1 * a.c3 + f2 * a.c1 * a.c2 + f3 / 6 * a.c1 * a.c1 * a.c1};
}

Series operator-(const Series& a) { return {-a.c0, -a.c1, -a.c2, -a.c3}; }
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

/// Sign just to the right of the current point: that of the first non-zero coefficient. NaN where the function is NaN.
double sign_on_the_right(const Series& a) {
  for (const double c : {a.c0, a.c1, a.c2, a.c3})
    if (c != 0) return c > 0 ? 1 : c < 0 ? -1 : not_a_number;
  return 0;
}

/// Sign of a - b just to the right; infinite values are compared without forming the difference.
double difference_on_the_right(const Series& a, const Series& b) {
  if (a.c0 < b.c0) return -1;
  if (a.c0 > b.c0) return 1;
  return a.constant() && b.constant() && a.c0 == b.c0 ? 0 : sign_on_the_right(a - b);
}

Series absolute(const Series& a) { return sign_on_the_right(a) < 0 ? -a : a; }

Series exponential(const Series& a) {
  const double e = std::exp(a.c0);
  return chain(a, e, e, e, e);
}
Series logarithm(const Series& a) {
  const double i = 1 / a.c0;
  return chain(a, std::log(a.c0), i, -i * i, 2 * i * i * i);
}

Series power(const Series& a, const Series& b) {
  if (!b.constant()) {
    Series r = exponential(b * logarithm(a));
    r.c0 = std::pow(a.c0, b.c0);
    return r;
  }
  // p (p-1) … x^(p-k): a factor of exactly zero ends the sequence, so that x**2 at 0 gives no 0·∞
  const double p = b.c0;
  const std::array factors{p, p * (p - 1), p * (p - 1) * (p - 2)};
  std::array<double, 3> d{};
  for (std::size_t k = 0; k < 3; ++k)
    if (factors[k] != 0) d[k] = factors[k] * std::pow(a.c0, p - static_cast<double>(k + 1));
  return chain(a, std::pow(a.c0, p), d[0], d[1], d[2]);
}

Series arctangent2(const Series& y, const Series& x) {
  // θ′ = (x y′ − y x′)/(x² + y²), a series of order two, integrated
  const Series dx{x.c1, 2 * x.c2, 3 * x.c3, 0};
  const Series dy{y.c1, 2 * y.c2, 3 * y.c3, 0};
  const Series rate = (x * dy - y * dx) / (x * x + y * y);
  return {std::atan2(y.c0, x.c0), rate.c0, rate.c1 / 2, rate.c2 / 3};
}

double unary(Code code, double a) {
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
    case Code::hyperbolic_tangent:
      return std::tanh(a);
    case Code::sign:
      return a > 0 ? 1 : a < 0 ? -1 : a;
    case Code::logical_not:
      return std::isnan(a) ? a : a == 0;
    default:
      return std::abs(a);
  }
}

double binary(Code code, double a, double b) {
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
      return std::isnan(a) || b > a ? a : b;
    case Code::maximum:
      return std::isnan(a) || b < a ? a : b;
    case Code::transfer_sign:
      return std::isnan(b) ? b : b < 0 ? -std::abs(a) : std::abs(a);
    case Code::logical_and:
    case Code::logical_or:
      return logic(code, a, b);
    default:
      return compare(code, a == b ? 0 : a < b ? -1 : a > b ? 1 : not_a_number);
  }
}

Series unary(Code code, const Series& a) {
  const double u = a.c0;
  switch (code) {
    case Code::negate:
      return -a;
    case Code::sine: {
      const double s = std::sin(u), c = std::cos(u);
      return chain(a, s, c, -s, -c);
    }
    case Code::cosine: {
      const double s = std::sin(u), c = std::cos(u);
      return chain(a, c, -s, -c, s);
    }
    case Code::tangent: {
      const double t = std::tan(u), w = 1 + t * t;
      return chain(a, t, w, 2 * t * w, w * (2 + 6 * t * t));
    }
    case Code::arcsine:
    case Code::arccosine: {
      const double w = 1 / ((1 - u) * (1 + u)), r = std::sqrt(w);
      const double d1 = r, d2 = u * r * w, d3 = (1 + 2 * u * u) * r * w * w;
      return code == Code::arcsine ? chain(a, std::asin(u), d1, d2, d3) : chain(a, std::acos(u), -d1, -d2, -d3);
    }
    case Code::arctangent: {
      const double w = 1 / (1 + u * u);
      return chain(a, std::atan(u), w, -2 * u * w * w, (6 * u * u - 2) * w * w * w);
    }
    case Code::square_root: {
      const double s = std::sqrt(u), i = 1 / s;
      return chain(a, s, 0.5 * i, -0.25 * i * i * i, 0.375 * i * i * i * i * i);
    }
    case Code::exponential:
      return exponential(a);
    case Code::logarithm:
      return logarithm(a);
    case Code::hyperbolic_tangent: {
      const double t = std::tanh(u), w = (1 - t) * (1 + t);
      return chain(a, t, w, -2 * t * w, w * (6 * t * t - 2));
    }
    case Code::sign:
      return {sign_on_the_right(a)};
    case Code::logical_not:
      return {unary(code, sign_on_the_right(a))};
    default:
      return absolute(a);
  }
}

Series binary(Code code, const Series& a, const Series& b) {
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
    case Code::maximum: {
      const double difference = difference_on_the_right(a, b);
      if (std::isnan(difference)) return {difference};
      return (code == Code::minimum) == (difference <= 0) ? a : b;
    }
    case Code::transfer_sign: {
      const double sign = sign_on_the_right(b);
      return std::isnan(sign) ? Series{sign} : sign < 0 ? -absolute(a) : absolute(a);
    }
    case Code::logical_and:
    case Code::logical_or:
      return {logic(code, sign_on_the_right(a), sign_on_the_right(b))};
    default:
      return {compare(code, difference_on_the_right(a, b))};
  }
}

}  // namespace

std::size_t operand_count(Code code) {
  if (code == Code::choice) return 3;
  return code >= Code::add ? 2 : 1;
}

bool decides(Code code) {
  switch (code) {
    case Code::absolute:
    case Code::sign:
    case Code::minimum:
    case Code::maximum:
    case Code::transfer_sign:
    case Code::less:
    case Code::less_or_equal:
    case Code::greater:
    case Code::greater_or_equal:
    case Code::equal:
    case Code::not_equal:
      return true;
    default:
      return false;
  }
}

signed char decision(Code code, const Series* operands) {
  const auto side = [](double sign) { return std::isnan(sign) ? 2 : static_cast<int>(sign); };
  const int first =
      side(operand_count(code) == 1 || code == Code::transfer_sign ? sign_on_the_right(operands[0])
                                                                   : difference_on_the_right(operands[0], operands[1]));
  const int second = code == Code::transfer_sign ? side(sign_on_the_right(operands[1])) : 0;
  return static_cast<signed char>(first + 8 * second);
}

double apply(Code code, double a, double b, double c) {
  switch (operand_count(code)) {
    case 1:
      return unary(code, a);
    case 2:
      return binary(code, a, b);
    default:
      return std::isnan(a) ? a : a != 0 ? b : c;
  }
}

Series apply(Code code, const Series& a, const Series& b, const Series& c) {
  switch (operand_count(code)) {
    case 1:
      return unary(code, a);
    case 2:
      return binary(code, a, b);
    default: {
      const double condition = sign_on_the_right(a);
      return std::isnan(condition) ? Series{condition} : condition != 0 ? b : c;
    }
  }
}

}  // namespace engrane
