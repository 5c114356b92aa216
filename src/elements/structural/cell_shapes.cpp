// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/cell_shapes.hpp"

#include <cmath>

#include "elements/structural/shape_functions.hpp"

namespace engrane::elements::structural {

namespace {

/// Tensor product of a rule with itself.
QuadratureRule squared(const LineRule& rule) {
  QuadratureRule points;
  for (const auto& [eta, of_eta] : rule)
    for (const auto& [xi, of_xi] : rule) points.push_back({xi, eta, of_xi * of_eta});
  return points;
}

}  // namespace

const LineRule& gauss_legendre(int points) {
  static const double two = 1 / std::sqrt(3.0), three = std::sqrt(0.6);
  static const LineRule two_points{{-two, 1}, {two, 1}}, three_points{{-three, 5.0 / 9}, {0, 8.0 / 9}, {three, 5.0 / 9}};
  return points == 2 ? two_points : three_points;
}

auto CellTraits<CellShape::triangle>::sample(const QuadraturePoint& p) -> Sample {
  Sample s;
  s.weight = p.weight;
  s.value << 1 - p.xi - p.eta, p.xi, p.eta;
  s.slope << -1, 1, 0, -1, 0, 1;
  return s;
}

const QuadratureRule& CellTraits<CellShape::triangle>::stiffness_points() {
  static const QuadratureRule points{{1.0 / 3, 1.0 / 3, 0.5}};
  return points;
}

const QuadratureRule& CellTraits<CellShape::triangle>::load_points() {
  constexpr double a = 1.0 / 6, b = 2.0 / 3, w = 1.0 / 6;
  static const QuadratureRule points{{a, a, w}, {b, a, w}, {a, b, w}};
  return points;
}

auto CellTraits<CellShape::triangle6>::sample(const QuadraturePoint& p) -> Sample {
  return quadratic_simplex<CellShape::triangle6>(p);
}

/// Degree 4, as needed for products of two quadratic functions (Dunavant 1985, Int. J. Num. Meth. Eng. 21). Points and weights
/// are those of its table in closed form.
const QuadratureRule& CellTraits<CellShape::triangle6>::mass_points() {
  static const QuadratureRule points = [] {
    const double ten = std::sqrt(10.0), inner = std::sqrt(38 - 44 * std::sqrt(0.4));
    const double mean = (8 - ten) / 18, half = inner / 18, sum = 1.0 / 6, apart = std::sqrt(213125 - 53320 * ten) / 3720;
    const double a = mean + half, b = mean - half, wa = (sum + apart) / 2, wb = (sum - apart) / 2;
    QuadratureRule six;
    for (const auto& [c, w] : {std::pair(a, wa), std::pair(b, wb)})
      for (const auto& [xi, eta] : {std::pair(c, c), std::pair(1 - 2 * c, c), std::pair(c, 1 - 2 * c)})
        six.push_back({xi, eta, w});
    return six;
  }();
  return points;
}

auto CellTraits<CellShape::quadrilateral>::sample(const QuadraturePoint& p) -> Sample {
  return linear_cube<CellShape::quadrilateral>(p);
}

const QuadratureRule& CellTraits<CellShape::quadrilateral>::stiffness_points() {
  static const QuadratureRule points = squared(gauss_legendre(2));
  return points;
}

const QuadratureRule& CellTraits<CellShape::quadrilateral>::load_points() {
  static const QuadratureRule points = squared(gauss_legendre(3));
  return points;
}

auto CellTraits<CellShape::quadrilateral8>::sample(const QuadraturePoint& p) -> Sample {
  return quadratic_cube<CellShape::quadrilateral8>(p);
}

std::array<EdgeSample, 3> edge_samples(std::size_t nodes) {
  std::array<EdgeSample, 3> samples{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [s, weight] = gauss_legendre(3)[i];
    samples[i].weight = weight;
    if (nodes == 2) {
      samples[i].value = {(1 - s) / 2, (1 + s) / 2, 0};
      samples[i].slope = {-0.5, 0.5, 0};
    } else {
      samples[i].value = {s * (s - 1) / 2, s * (s + 1) / 2, 1 - s * s};
      samples[i].slope = {s - 0.5, s + 0.5, -2 * s};
    }
  }
  return samples;
}

}  // namespace engrane::elements::structural
