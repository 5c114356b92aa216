// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace engrane {

/// A quantity along a motion with its first and second time derivatives. Constraints evaluated in this type give their exact
/// velocity- and acceleration-level forms.
struct Taylor {
  double value = 0;
  double d1 = 0;
  double d2 = 0;

  Taylor() = default;
  Taylor(double v) : value(v) {}  // NOLINT(google-explicit-constructor): a constant does not move
  Taylor(double v, double rate, double second) : value(v), d1(rate), d2(second) {}

  /// Chain rule for a function with value f, slope df and curvature ddf at this number.
  Taylor chain(double f, double df, double ddf) const { return {f, df * d1, df * d2 + ddf * d1 * d1}; }

  Taylor& operator+=(const Taylor& b) {
    value += b.value;
    d1 += b.d1;
    d2 += b.d2;
    return *this;
  }
  Taylor& operator-=(const Taylor& b) {
    value -= b.value;
    d1 -= b.d1;
    d2 -= b.d2;
    return *this;
  }
  Taylor& operator*=(const Taylor& b) {
    d2 = d2 * b.value + 2 * d1 * b.d1 + value * b.d2;
    d1 = d1 * b.value + value * b.d1;
    value *= b.value;
    return *this;
  }
  Taylor& operator/=(const Taylor& b) {
    const double i = 1 / b.value;
    return *this *= b.chain(i, -i * i, 2 * i * i * i);
  }
  Taylor operator-() const { return {-value, -d1, -d2}; }

  friend Taylor operator+(Taylor a, const Taylor& b) { return a += b; }
  friend Taylor operator-(Taylor a, const Taylor& b) { return a -= b; }
  friend Taylor operator*(Taylor a, const Taylor& b) { return a *= b; }
  friend Taylor operator/(Taylor a, const Taylor& b) { return a /= b; }

  friend bool operator<(const Taylor& a, const Taylor& b) { return a.value < b.value; }
  friend bool operator>(const Taylor& a, const Taylor& b) { return a.value > b.value; }
  friend bool operator<=(const Taylor& a, const Taylor& b) { return a.value <= b.value; }
  friend bool operator>=(const Taylor& a, const Taylor& b) { return a.value >= b.value; }
  friend bool operator==(const Taylor& a, const Taylor& b) { return a.value == b.value; }

  friend Taylor sqrt(const Taylor& a) {
    const double s = std::sqrt(a.value);
    return a.chain(s, 0.5 / s, -0.25 / (s * a.value));
  }
  friend Taylor sin(const Taylor& a) {
    const double s = std::sin(a.value);
    return a.chain(s, std::cos(a.value), -s);
  }
  friend Taylor cos(const Taylor& a) {
    const double c = std::cos(a.value);
    return a.chain(c, -std::sin(a.value), -c);
  }
  friend Taylor abs(const Taylor& a) { return a.value < 0 ? -a : a; }
  friend Taylor atan2(const Taylor& y, const Taylor& x) {
    const double n = 1 / (x.value * x.value + y.value * y.value);
    const double rate = (x.value * y.d1 - y.value * x.d1) * n;
    const double growth = 2 * (x.value * x.d1 + y.value * y.d1) * n;  // of x² + y²
    return {std::atan2(y.value, x.value), rate, (x.value * y.d2 - y.value * x.d2) * n - rate * growth};
  }
};

inline double value_of(const Taylor& x) { return x.value; }
inline Taylor compose(const Taylor& x, double f, double df, double ddf) { return x.chain(f, df, ddf); }

}  // namespace engrane

namespace Eigen {
template <>
struct NumTraits<engrane::Taylor> : GenericNumTraits<engrane::Taylor> {
  using Real = engrane::Taylor;
  using NonInteger = engrane::Taylor;
  using Nested = engrane::Taylor;
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 1, ReadCost = 3, AddCost = 3, MulCost = 6 };
};
template <typename Op>
struct ScalarBinaryOpTraits<engrane::Taylor, double, Op> {
  using ReturnType = engrane::Taylor;
};
template <typename Op>
struct ScalarBinaryOpTraits<double, engrane::Taylor, Op> {
  using ReturnType = engrane::Taylor;
};
}  // namespace Eigen
