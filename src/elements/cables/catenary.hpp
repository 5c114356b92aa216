// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "math/dual.hpp"
#include "math/taylor.hpp"
#include "math/vector.hpp"

namespace engrane::elements::cables {

/// An elastic cable hanging under its weight q per unstretched length. With the unstretched length s from the first end, the
/// tension is t(s) = t₀ − q s and dx/ds = t (1/|t| + 1/EA) (Irvine, Cable Structures, 1981, ch. 1, in vector form).
struct Catenary {
  double length = 0, stiffness = 0;  ///< L, EA
  Vec3 weight = Vec3::Zero();        ///< q

  /// Quantities that follow from the tension at the first end.
  template <class T>
  struct Shape {
    Vec3T<T> end;   ///< tension t₁ = t₀ − q L
    Vec3T<T> span;  ///< from the first end to the second
    T mean;         ///< ∫|t| ds/L
    T square;       ///< ∫|t|² ds/L
  };
  template <class T>
  Shape<T> shape(const Vec3T<T>& start) const;

  /// The tension at the first end for the given span between the ends; cables with weight only.
  Vec3 start_tension(const Vec3& span) const;
  /// The same with derivatives. `start` is the result of start_tension() for the span's value.
  template <class T>
  Vec3T<T> start_tension(const Vec3T<T>& span, const Vec3& start) const;

  /// Tension of a weightless string, straight or slack. `pressed` is the fraction of its stiffness that acts in compression.
  template <class T>
  Vec3T<T> string_tension(const Vec3T<T>& span, double pressed) const;

 private:
  /// atanh(x)/x at x = q L/(|t₀| + |t₁|), with p the tension component across q and v₀, v₁ those along it.
  template <class T>
  static T stretched_angle(const T& x, const T& first, const T& last, const T& p2, const T& v0, const T& v1);
  Mat3 flexibility(const Vec3& start) const;
};

template <class T>
T Catenary::stretched_angle(const T& x, const T& first, const T& last, const T& p2, const T& v0, const T& v1) {
  const T square = x * x;
  const double s = value_of(square);
  if (s < 1e-3) {
    const T one(1);
    return one +
           square * (one / 3.0 + square * (one / 5.0 + square * (one / 7.0 + square * (one / 9.0 + square * (one / 11.0)))));
  }
  // f(x²) = atanh(x)/x satisfies 2 x² f' = 1/(1 − x²) − f. In a narrow hanging loop 1 − x² is small; it equals 2 (|t₀||t₁| +
  // v₀v₁ + p²)/(|t₀| + |t₁|)², evaluated here without cancellation
  const T product = first * last, along = v0 * v1;
  const T added = value_of(along) > 0 ? product + along : p2 * (v0 * v0 + v1 * v1 + p2) / (product - along);
  const T rest = (added + p2) * T(2) / ((first + last) * (first + last));
  const double y = std::max(value_of(rest), 1e-300), root = std::sqrt(1 - y);
  const double f = std::log((1 + root) / std::sqrt(y)) / root;
  const double df = (1 / y - f) / (2 * (1 - y)), ddf = (1 / (y * y) - 3 * df) / (2 * (1 - y));
  return compose(rest, f, -df, ddf);
}

template <class T>
Catenary::Shape<T> Catenary::shape(const Vec3T<T>& start) const {
  using std::sqrt;
  Shape<T> c;
  const Vec3T<T> q = weight.template cast<T>();
  c.end = start - q * T(length);
  const T first = sqrt(dot(start, start)), last = sqrt(dot(c.end, c.end)), sum = first + last;
  const Vec3T<T> both = start + c.end;
  const T over = T(2 * length) / sum;  // ∫ds/|t| of a straight cable
  // along q the integral ∫t/|t| ds is a difference of |t|, L q·(t₀ + t₁)/(|t₀| + |t₁|); across q it is t times ∫ds/|t| = 2/q
  // atanh(q L/(|t₀| + |t₁|)). ∫|t| ds = ½ (v₀|t₀| − v₁|t₁|)/q + ½ p² ∫ds/|t|
  if (const double size = weight.norm(); size > 0) {
    const Vec3T<T> n = Vec3(weight / size).template cast<T>();
    const T v0 = dot(n, start), v1 = dot(n, c.end), v = v0 + v1;
    const Vec3T<T> across = start - n * v0;
    const T p2 = dot(across, across);
    const T integral = over * stretched_angle(T(T(size * length) / sum), first, last, p2, v0, v1);
    c.span = across * integral + n * T(v * over * T(0.5));
    c.mean = (v0 * v / sum + last + p2 * integral * T(1 / length)) * T(0.5);
  } else {
    c.span = start * over;
    c.mean = first;
  }
  c.span += both * T(0.5 * length / stiffness);
  c.square = (dot(start, start) + dot(c.end, c.end) + dot(start, c.end)) * T(1.0 / 3);
  return c;
}

template <class T>
Vec3T<T> Catenary::string_tension(const Vec3T<T>& span, double pressed) const {
  using std::sqrt;
  const T square = dot(span, span);
  const bool taut = value_of(square) > length * length;
  if ((!taut && pressed == 0) || value_of(square) == 0) return Vec3T<T>(T(0), T(0), T(0));
  const T distance = sqrt(square);
  return span * T((T(1 / length) - T(1) / distance) * (stiffness * (taut ? 1 : pressed)));
}

template <class T>
Vec3T<T> Catenary::start_tension(const Vec3T<T>& span, const Vec3& start) const {
  // one Newton step from the converged solution leaves its value unchanged and yields exact derivatives
  const Mat3 resistance = flexibility(start).inverse();
  const Vec3 found = shape(start).span;
  Vec3T<T> t;
  const Vec3T<T> rest = span - found.cast<T>();
  for (int r = 0; r < 3; ++r)
    t[r] = T(start[r]) + rest[0] * resistance(r, 0) + rest[1] * resistance(r, 1) + rest[2] * resistance(r, 2);
  return t;
}

}  // namespace engrane::elements::cables
