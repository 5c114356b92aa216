// SPDX-License-Identifier: BSD-3-Clause
// Access to matrices with one column per node by types that do not depend on the number of nodes. Expressions of these are
// compiled once for all shapes; with the whole matrices GCC took minutes.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <type_traits>

namespace engrane::elements::structural {

/// Column i.
template <class Matrix>
auto column(Matrix& m, Eigen::Index i) {
  using Column = Eigen::Matrix<double, Matrix::RowsAtCompileTime, 1>;
  return Eigen::Map<std::conditional_t<std::is_const_v<Matrix>, const Column, Column>>(m.data() + m.rows() * i);
}

/// All entries as a vector, column by column.
template <class Matrix>
auto entries(Matrix& m) {
  using Vector = std::conditional_t<std::is_const_v<Matrix>, const Eigen::VectorXd, Eigen::VectorXd>;
  return Eigen::Map<Vector>(m.data(), static_cast<Eigen::Index>(m.size()));
}

template <class Matrix>
Matrix zero() {
  Matrix m;
  std::fill_n(m.data(), m.size(), 0);
  return m;
}

/// a bᵀ, as the sum over the nodes of the dyads of their columns.
template <int A, int B, int N>
Eigen::Matrix<double, A, B> dyads(const Eigen::Matrix<double, A, N>& a, const Eigen::Matrix<double, B, N>& b) {
  Eigen::Matrix<double, A, B> sum = Eigen::Matrix<double, A, B>::Zero();
  for (Eigen::Index n = 0; n < N; ++n) sum += column(a, n) * column(b, n).transpose();
  return sum;
}

/// m v: nodal values m interpolated by the shape functions v.
template <int D, int N>
Eigen::Matrix<double, D, 1> interpolated(const Eigen::Matrix<double, D, N>& m, const Eigen::Matrix<double, N, 1>& v) {
  Eigen::Matrix<double, D, 1> sum = Eigen::Matrix<double, D, 1>::Zero();
  for (Eigen::Index n = 0; n < N; ++n) sum += v[n] * column(m, n);
  return sum;
}

}  // namespace engrane::elements::structural
