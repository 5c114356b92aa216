// SPDX-License-Identifier: BSD-3-Clause
// The two families of shape functions, simplex and cube, in two and three dimensions.
#pragma once

#include "elements/structural/cell_shapes.hpp"
#include "elements/structural/cell_topology.hpp"

namespace engrane::elements::structural {

template <int D>
Eigen::Matrix<double, D, 1> place_of(const QuadraturePoint& p) {
  return Eigen::Vector3d(p.xi, p.eta, p.zeta).head<D>();
}

/// Quadratic shape functions of a triangle or tetrahedron in barycentric coordinates l: l (2 l − 1) at a corner, 4 l_i l_j at a
/// mid-side node.
template <CellShape S>
typename CellTraits<S>::Sample quadratic_simplex(const QuadraturePoint& p) {
  constexpr int D = CellTraits<S>::dimension, corners = D + 1;
  Eigen::Matrix<double, corners, 1> l;
  Eigen::Matrix<double, D, corners> slope;
  l << 1 - place_of<D>(p).sum(), place_of<D>(p);
  slope << Eigen::Matrix<double, D, 1>::Constant(-1), Eigen::Matrix<double, D, D>::Identity();
  typename CellTraits<S>::Sample s;
  s.weight = p.weight;
  for (Eigen::Index i = 0; i < corners; ++i) {
    s.value[i] = l[i] * (2 * l[i] - 1);
    s.slope.col(i) = (4 * l[i] - 1) * slope.col(i);
  }
  Eigen::Index middle = corners;
  for (const auto& [i, j] : sides(S)) {
    s.value[middle] = 4 * l[i] * l[j];
    s.slope.col(middle++) = 4 * (l[j] * slope.col(i) + l[i] * slope.col(j));
  }
  return s;
}

/// Coordinates of a corner of the square or the cube.
template <int D>
Eigen::Matrix<double, D, 1> corner_of_cube(int corner) {
  return Eigen::Vector3d(corner % 4 == 1 || corner % 4 == 2 ? 1 : -1, corner % 4 >= 2 ? 1 : -1, corner >= 4 ? 1 : -1).head<D>();
}

/// Product over the coordinates of 1 + c x if c is −1 or 1, or 1 − x² if c is 0, and its gradient.
template <int D>
struct Product {
  double value = 1;
  Eigen::Matrix<double, D, 1> slope = Eigen::Matrix<double, D, 1>::Ones();
  Product(const Eigen::Matrix<double, D, 1>& c, const Eigen::Matrix<double, D, 1>& x) {
    for (int i = 0; i < D; ++i) {
      const double one = c[i] == 0 ? 1 - x[i] * x[i] : 1 + c[i] * x[i];
      value *= one;
      for (int k = 0; k < D; ++k) slope[k] *= k == i ? (c[i] == 0 ? -2 * x[i] : c[i]) : one;
    }
  }
};

/// Bilinear or trilinear shape functions.
template <CellShape S>
typename CellTraits<S>::Sample linear_cube(const QuadraturePoint& p) {
  constexpr int D = CellTraits<S>::dimension, corners = 1 << D;
  typename CellTraits<S>::Sample s;
  s.weight = p.weight;
  for (int i = 0; i < corners; ++i) {
    const Product<D> n(corner_of_cube<D>(i), place_of<D>(p));
    s.value[i] = n.value / corners;
    s.slope.col(i) = n.slope / corners;
  }
  return s;
}

/// Quadratic serendipity shape functions (Zienkiewicz and Taylor 2000, The Finite Element Method 1, 8.6).
template <CellShape S>
typename CellTraits<S>::Sample quadratic_cube(const QuadraturePoint& p) {
  constexpr int D = CellTraits<S>::dimension, corners = 1 << D;
  const Eigen::Matrix<double, D, 1> x = place_of<D>(p);
  typename CellTraits<S>::Sample s;
  s.weight = p.weight;
  for (int i = 0; i < corners; ++i) {
    const Eigen::Matrix<double, D, 1> c = corner_of_cube<D>(i);
    const Product<D> n(c, x);
    const double bend = c.dot(x) - (D - 1);
    s.value[i] = n.value * bend / corners;
    s.slope.col(i) = (n.slope * bend + n.value * c) / corners;
  }
  Eigen::Index middle = corners;
  for (const auto& [i, j] : sides(S)) {  // the mean of the end points is 0 in the coordinate along the side
    const Product<D> n((corner_of_cube<D>(i) + corner_of_cube<D>(j)) / 2, x);
    s.value[middle] = n.value / (corners / 2);
    s.slope.col(middle++) = n.slope / (corners / 2);
  }
  return s;
}

}  // namespace engrane::elements::structural
