// SPDX-License-Identifier: BSD-3-Clause
// Lines of nodes divided into pieces of two or three nodes: shape functions and Gauss rules.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "model/registry.hpp"

namespace engrane::elements::beams {

struct GaussPoint {
  double place, weight;
};
inline const std::array<GaussPoint, 1> one_point = {{{0, 2}}};
inline const std::array<GaussPoint, 2> two_points = {{{-std::sqrt(1.0 / 3), 1}, {std::sqrt(1.0 / 3), 1}}};
inline const std::array<GaussPoint, 3> three_points = {{{-std::sqrt(0.6), 5.0 / 9}, {0, 8.0 / 9}, {std::sqrt(0.6), 5.0 / 9}}};

/// Lagrange shape functions and their derivatives by ξ, at ξ in [−1, 1].
template <int Nodes>
struct LineShape {
  std::array<double, Nodes> value, slope;

  explicit LineShape(double xi) {
    if constexpr (Nodes == 2) {
      value = {(1 - xi) / 2, (1 + xi) / 2};
      slope = {-0.5, 0.5};
    } else {
      value = {xi * (xi - 1) / 2, 1 - xi * xi, xi * (xi + 1) / 2};
      slope = {xi - 0.5, -2 * xi, xi + 0.5};
    }
  }

  Vec3 along(const std::array<Vec3, Nodes>& places) const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < Nodes; ++i) sum += slope[i] * places[i];
    return sum;
  }
};

/// ∫ ρ N_i N_j ds by three Gauss points; `density` returns ρ at ξ.
template <int Nodes, class Density>
Eigen::Matrix<double, Nodes, Nodes> line_masses(const std::array<Vec3, Nodes>& places, const Density& density) {
  Eigen::Matrix<double, Nodes, Nodes> masses;
  masses.setZero();
  for (const GaussPoint& point : three_points) {
    const LineShape<Nodes> shape(point.place);
    const Eigen::Map<const Eigen::Matrix<double, Nodes, 1>> value(shape.value.data());
    masses += density(point.place) * point.weight * shape.along(places).norm() * value * value.transpose();
  }
  return masses;
}
/// ∫ N_i N_j ds.
template <int Nodes>
Eigen::Matrix<double, Nodes, Nodes> line_masses(const std::array<Vec3, Nodes>& places) {
  return line_masses<Nodes>(places, [](double) { return 1.0; });
}

/// ∫ ds by three Gauss points.
template <int Nodes>
double line_length(const std::array<Vec3, Nodes>& places) {
  return line_masses<Nodes>(places).sum();
}

/// Nodes of a line, as listed by the keyword N of a card, and their division into pieces.
struct LineNodes {
  const std::vector<int>& nodes;
  bool linear;  ///< pieces of two nodes; otherwise of three, unless there are only two

  bool of_two() const { return linear || nodes.size() == 2; }
  std::size_t pieces() const { return of_two() ? nodes.size() - 1 : (nodes.size() - 1) / 2; }
  /// Whether the nodes can be divided into pieces and the element numbers of these, from that of the record on, are free.
  /// Otherwise reports an error.
  bool check(const BuildContext& context) const;
  /// Nodes of piece `p`. Neighbouring pieces share their end nodes.
  template <int Nodes>
  std::array<int, Nodes> piece(std::size_t p) const {
    std::array<int, Nodes> some;
    for (std::size_t i = 0; i < Nodes; ++i) some[i] = nodes[p * (Nodes - 1) + i];
    return some;
  }
};

/// Positions of the nodes of a piece. Reports an error and returns nothing if the piece is folded or has no length.
template <int Nodes>
std::optional<std::array<Vec3, Nodes>> line_places(const std::array<int, Nodes>& nodes, const BuildContext& context) {
  std::array<Vec3, Nodes> places;
  for (std::size_t i = 0; i < Nodes; ++i) places[i] = context.nodes.at(nodes[i]);
  const Vec3 chord = places.back() - places.front();
  constexpr double least = 1e-3;
  for (const double xi : {-1.0, 0.0, 1.0})
    if (!(LineShape<Nodes>(xi).along(places).dot(chord) > least * chord.squaredNorm())) {
      context.error("N", fmt::format("the line is folded, or has no length, at node {}", nodes[Nodes / 2]),
                    "nodes stand along the line in turn; of three the second is near the middle of the others");
      return {};
    }
  return places;
}

}  // namespace engrane::elements::beams
