// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "elements/structural/shape_functions.hpp"

namespace engrane::elements::structural {

namespace {

/// Triple tensor product of a rule.
QuadratureRule cubed(const LineRule& rule) {
  QuadratureRule points;
  for (const auto& [zeta, of_zeta] : rule)
    for (const auto& [eta, of_eta] : rule)
      for (const auto& [xi, of_xi] : rule) points.push_back({xi, eta, of_xi * of_eta * of_zeta, zeta});
  return points;
}

/// Tensor product of a triangle's rule with a line rule along ζ.
QuadratureRule stacked(const QuadratureRule& triangle, const LineRule& rule) {
  QuadratureRule points;
  for (const auto& [zeta, of_zeta] : rule)
    for (const QuadraturePoint& p : triangle) points.push_back({p.xi, p.eta, p.weight * of_zeta, zeta});
  return points;
}

/// Adds the four points of a tetrahedron with barycentric coordinates (a, a, a, 1 − 3a) in all orders.
void add_four(QuadratureRule& points, double a, double weight) {
  const double b = 1 - 3 * a;
  points.insert(points.end(), {{a, a, weight, a}, {b, a, weight, a}, {a, b, weight, a}, {a, a, weight, b}});
}

/// Barycentric coordinates of a wedge's triangle and their derivatives by ξ and η.
struct Triangle {
  double l[3];
  static constexpr double along[3][2] = {{-1, -1}, {1, 0}, {0, 1}};
  explicit Triangle(const QuadraturePoint& p) : l{1 - p.xi - p.eta, p.xi, p.eta} {}
};

}  // namespace

auto CellTraits<CellShape::tetrahedron>::sample(const QuadraturePoint& p) -> Sample {
  Sample s;
  s.weight = p.weight;
  s.value << 1 - p.xi - p.eta - p.zeta, p.xi, p.eta, p.zeta;
  s.slope << -1, 1, 0, 0, -1, 0, 1, 0, -1, 0, 0, 1;
  return s;
}

const QuadratureRule& CellTraits<CellShape::tetrahedron>::stiffness_points() {
  static const QuadratureRule points{{0.25, 0.25, 1.0 / 6, 0.25}};
  return points;
}

/// Degree 2: exact where each barycentric coordinate has the mean square 1/10.
const QuadratureRule& CellTraits<CellShape::tetrahedron>::load_points() {
  static const QuadratureRule points = [] {
    QuadratureRule four;
    add_four(four, (5 - std::sqrt(5.0)) / 20, 1.0 / 24);
    return four;
  }();
  return points;
}

auto CellTraits<CellShape::tetrahedron10>::sample(const QuadraturePoint& p) -> Sample {
  return quadratic_simplex<CellShape::tetrahedron10>(p);
}

/// Degree 5, 14 points (Walkington 2000, Quadrature on simplices of arbitrary dimension, Carnegie Mellon University). Products
/// of two quadratic functions need degree 4.
const QuadratureRule& CellTraits<CellShape::tetrahedron10>::mass_points() {
  static const QuadratureRule points = [] {
    QuadratureRule fourteen;
    add_four(fourteen, 0.31088591926330060980, 0.11268792571801585080 / 6);
    add_four(fourteen, 0.092735250310891226402, 0.073493043116361949544 / 6);
    constexpr double a = 0.045503704125649649492, b = 0.5 - a, weight = 0.042546020777081466438 / 6;
    fourteen.insert(
        fourteen.end(),
        {{a, a, weight, b}, {a, b, weight, a}, {b, a, weight, a}, {a, b, weight, b}, {b, a, weight, b}, {b, b, weight, a}});
    return fourteen;
  }();
  return points;
}

auto CellTraits<CellShape::wedge>::sample(const QuadraturePoint& p) -> Sample {
  const Triangle t(p);
  Sample s;
  s.weight = p.weight;
  for (Eigen::Index i = 0; i < 6; ++i) {
    const Eigen::Index at = i % 3;
    const double c = i < 3 ? -1 : 1, share = (1 + c * p.zeta) / 2;
    s.value[i] = t.l[at] * share;
    s.slope.col(i) << Triangle::along[at][0] * share, Triangle::along[at][1] * share, t.l[at] * c / 2;
  }
  return s;
}

const QuadratureRule& CellTraits<CellShape::wedge>::stiffness_points() {
  static const QuadratureRule points = stacked(CellTraits<CellShape::triangle>::load_points(), gauss_legendre(2));
  return points;
}

auto CellTraits<CellShape::wedge15>::sample(const QuadraturePoint& p) -> Sample {
  const Triangle t(p);
  Sample s;
  s.weight = p.weight;
  const auto along = [](Eigen::Index i, Eigen::Index k) { return Triangle::along[i][k]; };
  for (Eigen::Index half = 0; half < 2; ++half) {
    const double c = half == 0 ? -1 : 1, z = 1 + c * p.zeta;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const Eigen::Index j = (i + 1) % 3, corner = 3 * half + i, middle = 6 + 3 * half + i;
      const double bend = 2 * t.l[i] - 2 + c * p.zeta;
      s.value[corner] = t.l[i] * z * bend / 2;
      for (Eigen::Index k = 0; k < 2; ++k) {
        s.slope(k, corner) = along(i, k) * z * (bend + 2 * t.l[i]) / 2;
        s.slope(k, middle) = 2 * z * (along(i, k) * t.l[j] + t.l[i] * along(j, k));
      }
      s.slope(2, corner) = t.l[i] * c * (bend + z) / 2;
      s.value[middle] = 2 * t.l[i] * t.l[j] * z;
      s.slope(2, middle) = 2 * t.l[i] * t.l[j] * c;
    }
  }
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double z = 1 - p.zeta * p.zeta;
    s.value[12 + i] = t.l[i] * z;
    s.slope.col(12 + i) << along(i, 0) * z, along(i, 1) * z, -2 * p.zeta * t.l[i];
  }
  return s;
}

const QuadratureRule& CellTraits<CellShape::wedge15>::stiffness_points() {
  static const QuadratureRule points = stacked(CellTraits<CellShape::triangle>::load_points(), gauss_legendre(3));
  return points;
}

const QuadratureRule& CellTraits<CellShape::wedge15>::mass_points() {
  static const QuadratureRule points = stacked(CellTraits<CellShape::triangle6>::mass_points(), gauss_legendre(3));
  return points;
}

auto CellTraits<CellShape::hexahedron>::sample(const QuadraturePoint& p) -> Sample {
  return linear_cube<CellShape::hexahedron>(p);
}

const QuadratureRule& CellTraits<CellShape::hexahedron>::stiffness_points() {
  static const QuadratureRule points = cubed(gauss_legendre(2));
  return points;
}

const QuadratureRule& CellTraits<CellShape::hexahedron>::load_points() {
  static const QuadratureRule points = cubed(gauss_legendre(3));
  return points;
}

auto CellTraits<CellShape::hexahedron20>::sample(const QuadraturePoint& p) -> Sample {
  return quadratic_cube<CellShape::hexahedron20>(p);
}

}  // namespace engrane::elements::structural
