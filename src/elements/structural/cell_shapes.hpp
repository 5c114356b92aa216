// SPDX-License-Identifier: BSD-3-Clause
// Shape functions and quadrature of cells, tabulated once for each rule.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "model/element.hpp"

namespace engrane::elements::structural {

/// A point of the reference cell with its weight: triangle (ξ, η ≥ 0, ξ + η ≤ 1), square (−1 to 1), tetrahedron (ξ, η, ζ ≥ 0,
/// ξ + η + ζ ≤ 1), wedge (a triangle, ζ from −1 to 1), cube.
struct QuadraturePoint {
  double xi, eta, weight, zeta = 0;
};
using QuadratureRule = std::vector<QuadraturePoint>;

/// Places from −1 to 1, and weights, of the rule of Gauss and Legendre with 2 or 3 points.
using LineRule = std::vector<std::pair<double, double>>;
const LineRule& gauss_legendre(int points);

/// What is tabulated at a point: shape functions and their derivatives along ξ, η and, of a solid, ζ.
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
  /// Where stresses are given, other than at the points of the stiffness.
  static const QuadratureRule* result_points() { return nullptr; }
};

/// Shape functions and rules of quadrature; the order of nodes is that of CellShape.
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
  /// Where its stresses are best (Barlow 1976, Int. J. Numer. Methods Eng. 10).
  static const QuadratureRule* result_points() { return &CellTraits<CellShape::hexahedron>::stiffness_points(); }
  static const QuadratureRule& mass_points() { return load_points(); }
};

/// The shape functions of a cell at the points of a rule.
template <CellShape S>
std::vector<typename CellTraits<S>::Sample> tabulate(const QuadratureRule& points) {
  std::vector<typename CellTraits<S>::Sample> samples;
  for (const QuadraturePoint& p : points) samples.push_back(CellTraits<S>::sample(p));
  return samples;
}

/// Shape functions and slopes of an edge of 2 or 3 nodes (ends, then the middle) at s from −1 to 1.
struct EdgeSample {
  double weight;
  std::array<double, 3> value, slope;
};

/// Three Gauss points: exact for the pressure on an edge whose middle node is anywhere, also round an axis.
std::array<EdgeSample, 3> edge_samples(std::size_t nodes);

}  // namespace engrane::elements::structural
