// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

namespace engrane {

/// Forward-mode dual number: a value with its derivatives along N directions. Evaluating an element's residual once in duals
/// yields its exact tangent.
template <int N>
struct Dual {
  double value = 0;
  std::array<double, N> d{};

  Dual() = default;
  Dual(double v) : value(v) {}  // NOLINT(google-explicit-constructor): a constant has no derivatives

  /// Chain rule: a function with value f and slope df at this number.
  Dual chain(double f, double df) const {
    Dual r;
    r.value = f;
    for (int i = 0; i < N; ++i) r.d[i] = df * d[i];
    return r;
  }

  Dual& operator+=(const Dual& b) {
    value += b.value;
    for (int i = 0; i < N; ++i) d[i] += b.d[i];
    return *this;
  }
  Dual& operator-=(const Dual& b) {
    value -= b.value;
    for (int i = 0; i < N; ++i) d[i] -= b.d[i];
    return *this;
  }
  Dual& operator*=(const Dual& b) {
    for (int i = 0; i < N; ++i) d[i] = d[i] * b.value + value * b.d[i];
    value *= b.value;
    return *this;
  }
  Dual& operator/=(const Dual& b) {
    const double inverse = 1 / b.value;
    value *= inverse;
    for (int i = 0; i < N; ++i) d[i] = (d[i] - value * b.d[i]) * inverse;
    return *this;
  }
  Dual& operator*=(double s) {
    value *= s;
    for (int i = 0; i < N; ++i) d[i] *= s;
    return *this;
  }
  Dual operator-() const { return chain(-value, -1); }

  friend Dual operator+(Dual a, const Dual& b) { return a += b; }
  friend Dual operator-(Dual a, const Dual& b) { return a -= b; }
  friend Dual operator*(Dual a, const Dual& b) { return a *= b; }
  friend Dual operator/(Dual a, const Dual& b) { return a /= b; }
  friend Dual operator+(Dual a, double s) {
    a.value += s;
    return a;
  }
  friend Dual operator+(double s, Dual a) {
    a.value += s;
    return a;
  }
  friend Dual operator-(Dual a, double s) {
    a.value -= s;
    return a;
  }
  friend Dual operator-(double s, const Dual& a) { return s + (-a); }
  friend Dual operator*(Dual a, double s) { return a *= s; }
  friend Dual operator*(double s, Dual a) { return a *= s; }
  friend Dual operator/(Dual a, double s) { return a *= 1 / s; }

  friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.value > b.value; }
  friend bool operator<=(const Dual& a, const Dual& b) { return a.value <= b.value; }
  friend bool operator>=(const Dual& a, const Dual& b) { return a.value >= b.value; }
  friend bool operator==(const Dual& a, const Dual& b) { return a.value == b.value; }

  friend Dual sqrt(const Dual& a) {
    const double s = std::sqrt(a.value);
    return a.chain(s, 0.5 / s);
  }
  friend Dual sin(const Dual& a) { return a.chain(std::sin(a.value), std::cos(a.value)); }
  friend Dual cos(const Dual& a) { return a.chain(std::cos(a.value), -std::sin(a.value)); }
  friend Dual abs(const Dual& a) { return a.value < 0 ? -a : a; }
  friend Dual atan2(const Dual& y, const Dual& x) {
    const double n = 1 / (x.value * x.value + y.value * y.value);
    Dual r(std::atan2(y.value, x.value));
    for (int i = 0; i < N; ++i) r.d[i] = (x.value * y.d[i] - y.value * x.d[i]) * n;
    return r;
  }
};

/// The plain value of any scalar type that elements are evaluated with.
inline double value_of(double x) { return x; }
template <int N>
double value_of(const Dual<N>& x) {
  return x.value;
}

/// f(x) in the arithmetic of x, given the value and first two derivatives of f at x.
inline double compose(double, double f, double, double) { return f; }
template <int N>
Dual<N> compose(const Dual<N>& x, double f, double df, double) {
  return x.chain(f, df);
}

}  // namespace engrane

namespace Eigen {
template <int N>
struct NumTraits<engrane::Dual<N>> : GenericNumTraits<engrane::Dual<N>> {
  using Real = engrane::Dual<N>;
  using NonInteger = engrane::Dual<N>;
  using Nested = engrane::Dual<N>;
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 1, ReadCost = N, AddCost = N, MulCost = 2 * N };
};
template <int N, typename Op>
struct ScalarBinaryOpTraits<engrane::Dual<N>, double, Op> {
  using ReturnType = engrane::Dual<N>;
};
template <int N, typename Op>
struct ScalarBinaryOpTraits<double, engrane::Dual<N>, Op> {
  using ReturnType = engrane::Dual<N>;
};
}  // namespace Eigen
