// SPDX-License-Identifier: BSD-3-Clause
// Shape functions and quadrature rules of cells.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "model/element.hpp"

namespace engrane::elements::structural {

/// Quadrature point of a reference cell: triangle (ξ, η ≥ 0, ξ + η ≤ 1), square [−1, 1]², tetrahedron (ξ, η, ζ ≥ 0,
/// ξ + η + ζ ≤ 1), wedge (triangle × ζ in [−1, 1]) or cube [−1, 1]³.
struct QuadraturePoint {
  double xi, eta, weight, zeta = 0;
};
using QuadratureRule = std::vector<QuadraturePoint>;

/// Gauss–Legendre rule with 2 or 3 points on [−1, 1]: pairs of position and weight.
using LineRule = std::vector<std::pair<double, double>>;
const LineRule& gauss_legendre(int points);

/// Shape functions at a point and their derivatives by ξ, η and, for solids, ζ.
template <int N, int D>
struct ShapeSample {
  double weight;
  Eigen::Matrix<double, N, 1> value;
  Eigen::Matrix<double, D, N> slope;
};

template <int N, int Corners, int D>
struct CellNodes {
  static constexpr int nodes = N, corners = Corners, dimension = D;
  using Sample = ShapeSample<N, D>;
  /// Points at which stresses are reported; nullptr: those of the stiffness.
  static const QuadratureRule* result_points() { return nullptr; }
};

/// Shape functions and quadrature rules of a shape, with nodes in the order of CellShape.
template <CellShape S>
struct CellTraits;

template <>
struct CellTraits<CellShape::triangle> : CellNodes<3, 3, 2> {
  static Sample sample(const QuadraturePoint& p);
  static const QuadratureRule& stiffness_points();
  static const QuadratureRule& load_points();
  static const QuadratureRule& mass_points() { return load_points(); }
};

template <>
struct CellTraits<CellShape::triangle6> : CellNodes<6, 3, 2> {
  static Sample sample(const QuadraturePoint& p);
  static const QuadratureRule& stiffness_points() { return load_points(); }
  static const QuadratureRule& load_points() { return CellTraits<CellShape::triangle>::load_points(); }
  static const QuadratureRule& mass_points();
};

template <>
struct CellTraits<CellShape::quadrilateral> : CellNodes<4, 4, 2> {
  static Sample sample(const QuadraturePoint& p);
  static const QuadratureRule& stiffness_points();
  static const QuadratureRule& load_points();
  static const QuadratureRule& mass_points() { return load_points(); }
};

template <>
struct CellTraits<CellShape::quadrilateral8> : CellNodes<8, 4, 2> {
  static Sample sample(const QuadraturePoint& p);
  static const QuadratureRule& stiffness_points() { return CellTraits<CellShape::quadrilateral>::stiffness_points(); }
  static const QuadratureRule& load_points() { return CellTraits<CellShape::quadrilateral>::load_points(); }
  static const QuadratureRule& mass_points() { return load_points(); }
};

template <>
struct CellTraits<CellShape::tetrahedron> : CellNodes<4, 4, 3> {
  static Sample sample(const QuadraturePoint& p);
  static const QuadratureRule& stiffness_points();
  static const QuadratureRule& load_points();
  static const QuadratureRule& mass_points() { return load_points(); }
};

template <>
struct CellTraits<CellShape::tetrahedron10> : CellNodes<10, 4, 3> {
  static Sample sample(const QuadraturePoint& p);
  static const QuadratureRule& stiffness_points() { return load_points(); }
  static const QuadratureRule& load_points() { return CellTraits<CellShape::tetrahedron>::load_points(); }
  static const QuadratureRule& mass_points();
};

template <>
struct CellTraits<CellShape::wedge> : CellNodes<6, 6, 3> {
  static Sample sample(const QuadraturePoint& p);
  static const QuadratureRule& stiffness_points();
  static const QuadratureRule& load_points() { return stiffness_points(); }
  static const QuadratureRule& mass_points() { return load_points(); }
};

template <>
struct CellTraits<CellShape::wedge15> : CellNodes<15, 6, 3> {
  static Sample sample(const QuadraturePoint& p);
  static const QuadratureRule& stiffness_points();
  static const QuadratureRule& load_points() { return stiffness_points(); }
  static const QuadratureRule& mass_points();
};

template <>
struct CellTraits<CellShape::hexahedron> : CellNodes<8, 8, 3> {
  static Sample sample(const QuadraturePoint& p);
  static const QuadratureRule& stiffness_points();
  static const QuadratureRule& load_points();
  static const QuadratureRule& mass_points() { return load_points(); }
};

template <>
struct CellTraits<CellShape::hexahedron20> : CellNodes<20, 8, 3> {
  static Sample sample(const QuadraturePoint& p);
  static const QuadratureRule& stiffness_points() { return load_points(); }
  static const QuadratureRule& load_points() { return CellTraits<CellShape::hexahedron>::load_points(); }
  /// Points of optimal stress accuracy (Barlow 1976, Int. J. Numer. Methods Eng. 10).
  static const QuadratureRule* result_points() { return &CellTraits<CellShape::hexahedron>::stiffness_points(); }
  static const QuadratureRule& mass_points() { return load_points(); }
};

/// Shape functions of a cell at the points of a rule.
template <CellShape S>
std::vector<typename CellTraits<S>::Sample> tabulate(const QuadratureRule& points) {
  std::vector<typename CellTraits<S>::Sample> samples;
  for (const QuadraturePoint& p : points) samples.push_back(CellTraits<S>::sample(p));
  return samples;
}

/// Shape functions of an edge with 2 or 3 nodes (ends, then the middle) and their derivatives, at s in [−1, 1].
struct EdgeSample {
  double weight;
  std::array<double, 3> value, slope;
};

/// Samples at three Gauss points: exact for pressure on an edge wherever its middle node is, also in axisymmetry.
std::array<EdgeSample, 3> edge_samples(std::size_t nodes);

}  // namespace engrane::elements::structural
