// SPDX-License-Identifier: BSD-3-Clause
// Shape functions and quadrature of plane cells, tabulated once for each rule.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "model/element.hpp"

namespace engrane::elements::structural {

/// A point of the reference triangle (ξ, η ≥ 0, ξ + η ≤ 1) or square (−1 to 1) with its weight.
struct QuadraturePoint {
  double xi, eta, weight;
};

/// What is tabulated at a point: shape functions and their derivatives along ξ and η.
template <int N>
struct ShapeSample {
  double weight;
  Eigen::Matrix<double, N, 1> value;
  Eigen::Matrix<double, 2, N> slope;
};

/// Cells of N nodes: corners first, then mid-side nodes from the side of the first two on.
template <int N>
struct CellTraits;

template <>
struct CellTraits<3> {
  static constexpr int corners = 3;
  static constexpr CellShape shape = CellShape::triangle;
  static ShapeSample<3> sample(const QuadraturePoint& p);
  static const std::vector<QuadraturePoint>& stiffness_points();
  static const std::vector<QuadraturePoint>& load_points();
  static const std::vector<QuadraturePoint>& mass_points() { return load_points(); }
};

template <>
struct CellTraits<6> {
  static constexpr int corners = 3;
  static constexpr CellShape shape = CellShape::triangle6;
  static ShapeSample<6> sample(const QuadraturePoint& p);
  static const std::vector<QuadraturePoint>& stiffness_points() { return load_points(); }
  static const std::vector<QuadraturePoint>& load_points() { return CellTraits<3>::load_points(); }
  static const std::vector<QuadraturePoint>& mass_points();
};

template <>
struct CellTraits<4> {
  static constexpr int corners = 4;
  static constexpr CellShape shape = CellShape::quadrilateral;
  static ShapeSample<4> sample(const QuadraturePoint& p);
  static const std::vector<QuadraturePoint>& stiffness_points();
  static const std::vector<QuadraturePoint>& load_points();
  static const std::vector<QuadraturePoint>& mass_points() { return load_points(); }
};

template <>
struct CellTraits<8> {
  static constexpr int corners = 4;
  static constexpr CellShape shape = CellShape::quadrilateral8;
  static ShapeSample<8> sample(const QuadraturePoint& p);
  static const std::vector<QuadraturePoint>& stiffness_points() { return CellTraits<4>::stiffness_points(); }
  static const std::vector<QuadraturePoint>& load_points() { return CellTraits<4>::load_points(); }
  static const std::vector<QuadraturePoint>& mass_points() { return load_points(); }
};

/// The shape functions of a cell at the points of a rule.
template <int N>
std::vector<ShapeSample<N>> tabulate(const std::vector<QuadraturePoint>& points) {
  std::vector<ShapeSample<N>> samples;
  for (const QuadraturePoint& p : points) samples.push_back(CellTraits<N>::sample(p));
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
