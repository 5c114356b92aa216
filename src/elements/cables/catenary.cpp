// SPDX-License-Identifier: BSD-3-Clause
#include "elements/cables/catenary.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace engrane::elements::cables {

namespace {

/// Initial guess of the tension for a span (Jayaraman and Knudson, Comput. Struct. 14 (1981), p. 273, for a cable with sag),
/// plus the elastic tension of a cable that is too short.
Vec3 guess(const Catenary& cable, const Vec3& span) {
  const double q = cable.weight.norm(), L = cable.length, distance = span.norm();
  const Vec3 n = cable.weight / q;
  const double h = n.dot(span), l = (span - h * n).norm(), least = 1e-6 * L;
  constexpr double taut = 0.2;
  const double slack = 3 * ((L * L - h * h) / std::max(l * l, least * least) - 1);
  const double lambda = slack > taut * taut ? std::min(std::sqrt(slack), 300.0) : taut;
  const Vec3 across = l > least ? Vec3((span - h * n) / l) : perpendicular(n);
  Vec3 start = q / 2 * (std::max(l, least) / lambda * across + (h / std::tanh(lambda) + L) * n);
  if (distance > L) start += cable.stiffness * (distance / L - 1) / distance * span;
  return start;
}

}  // namespace

Mat3 Catenary::flexibility(const Vec3& start) const {
  using D = Dual<3>;
  Vec3T<D> t = start.cast<D>();
  for (int i = 0; i < 3; ++i) t[i].d[static_cast<std::size_t>(i)] = 1;
  const Vec3T<D> span = shape(t).span;
  Mat3 f;
  for (int r = 0; r < 3; ++r) f.row(r) = Eigen::Map<const Vec3>(span[r].d.data());
  return f;
}

/// The span is the gradient of the complementary energy L (∫|t| + ∫|t|²/2EA), which is strictly convex: Newton's method, with
/// the step halved until the energy decreases.
Vec3 Catenary::start_tension(const Vec3& span) const {
  const auto energy = [&](const Vec3& t, const Shape<double>& at) {
    return length * (at.mean + at.square / (2 * stiffness)) - span.dot(t);
  };
  Vec3 t = guess(*this, span);
  Shape<double> at = shape(t);
  double value = energy(t, at), error = (at.span - span).norm();
  constexpr int most = 200;
  constexpr double rounding = 4e-16;
  for (int i = 0; i < most && error > rounding * length; ++i) {
    const Vec3 step = flexibility(t).inverse() * (span - at.span);
    bool falls = false;
    for (double part = 1; part > 1e-10 && !falls; part /= 2) {
      const Vec3 next = t + part * step;
      const Shape<double> there = shape(next);
      const double now = energy(next, there), rest = (there.span - span).norm();
      // near the solution the energy difference is lost in rounding, and the error decides
      falls = now < value || rest < error;
      if (!falls) continue;
      t = next;
      at = there;
      value = now;
      error = rest;
    }
    if (!falls) break;
  }
  return t;
}

}  // namespace engrane::elements::cables
