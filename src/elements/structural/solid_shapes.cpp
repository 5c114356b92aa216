// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "elements/structural/cell_shapes.hpp"

namespace engrane::elements::structural {

namespace {

/// Products of a rule with itself, twice.
QuadratureRule cubed(const LineRule& rule) {
  QuadratureRule points;
  for (const auto& [zeta, of_zeta] : rule)
    for (const auto& [eta, of_eta] : rule)
      for (const auto& [xi, of_xi] : rule) points.push_back({xi, eta, of_xi * of_eta * of_zeta, zeta});
  return points;
}

/// Of a triangle, along ζ.
QuadratureRule stacked(const QuadratureRule& triangle, const LineRule& rule) {
  QuadratureRule points;
  for (const auto& [zeta, of_zeta] : rule)
    for (const QuadraturePoint& p : triangle) points.push_back({p.xi, p.eta, p.weight * of_zeta, zeta});
  return points;
}

/// The four points of a tetrahedron with three coordinates `a`, the fourth what is left.
void add_four(QuadratureRule& points, double a, double weight) {
  const double b = 1 - 3 * a;
  points.insert(points.end(), {{a, a, weight, a}, {b, a, weight, a}, {a, b, weight, a}, {a, a, weight, b}});
}

using Slope = Eigen::Vector3d;

/// The trilinear function of a corner of the cube, whose coordinates are a, b, c.
struct Trilinear {
  double a, b, c, value;
  Slope slope;
  Trilinear(Eigen::Index corner, const QuadraturePoint& p)
      : a(corner % 4 == 1 || corner % 4 == 2 ? 1 : -1), b(corner % 4 >= 2 ? 1 : -1), c(corner >= 4 ? 1 : -1) {
    const double x = 1 + a * p.xi, y = 1 + b * p.eta, z = 1 + c * p.zeta;
    value = x * y * z / 8;
    slope << a * y * z / 8, b * x * z / 8, c * x * y / 8;
  }
};

/// Coordinates of the triangle of a wedge, and their slopes.
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
  const double l[4] = {1 - p.xi - p.eta - p.zeta, p.xi, p.eta, p.zeta};
  const Slope slope[4] = {Slope::Constant(-1), Slope::UnitX(), Slope::UnitY(), Slope::UnitZ()};
  constexpr int ends[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  Sample s;
  s.weight = p.weight;
  for (Eigen::Index i = 0; i < 4; ++i) {
    s.value[i] = l[i] * (2 * l[i] - 1);
    s.slope.col(i) = (4 * l[i] - 1) * slope[i];
  }
  for (Eigen::Index k = 0; k < 6; ++k) {
    const auto [i, j] = ends[k];
    s.value[4 + k] = 4 * l[i] * l[j];
    s.slope.col(4 + k) = 4 * (l[j] * slope[i] + l[i] * slope[j]);
  }
  return s;
}

/// Degree 5, 14 points (Walkington 2000, Quadrature on simplices of arbitrary dimension, Carnegie Mellon University): products of
/// two quadratic functions have degree 4.
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
  Sample s;
  s.weight = p.weight;
  for (Eigen::Index i = 0; i < 8; ++i) {
    const Trilinear n(i, p);
    s.value[i] = n.value;
    s.slope.col(i) = n.slope;
  }
  return s;
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
  Sample s;
  s.weight = p.weight;
  for (Eigen::Index i = 0; i < 8; ++i) {
    const Trilinear n(i, p);
    const double bend = n.a * p.xi + n.b * p.eta + n.c * p.zeta - 2;
    s.value[i] = n.value * bend;
    s.slope.col(i) = n.slope * bend + n.value * Slope(n.a, n.b, n.c);
  }
  // the middle of a side lies between two corners, whose coordinates along the side cancel
  constexpr int ends[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  const double place[3] = {p.xi, p.eta, p.zeta};
  for (Eigen::Index k = 0; k < 12; ++k) {
    const Trilinear n(ends[k][0], p), m(ends[k][1], p);
    const double corner[3] = {(n.a + m.a) / 2, (n.b + m.b) / 2, (n.c + m.c) / 2};
    double value[3], slope[3];
    for (int i = 0; i < 3; ++i) {
      value[i] = corner[i] == 0 ? 1 - place[i] * place[i] : 1 + corner[i] * place[i];
      slope[i] = corner[i] == 0 ? -2 * place[i] : corner[i];
    }
    s.value[8 + k] = value[0] * value[1] * value[2] / 4;
    s.slope.col(8 + k) << slope[0] * value[1] * value[2] / 4, value[0] * slope[1] * value[2] / 4,
        value[0] * value[1] * slope[2] / 4;
  }
  return s;
}

}  // namespace engrane::elements::structural
