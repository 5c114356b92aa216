// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/cell_shapes.hpp"

#include <cmath>

namespace engrane::elements::structural {

namespace {

/// Products of the Gauss–Legendre rule with itself.
std::vector<QuadraturePoint> squared(const std::vector<std::pair<double, double>>& rule) {
  std::vector<QuadraturePoint> points;
  for (const auto& [eta, of_eta] : rule)
    for (const auto& [xi, of_xi] : rule) points.push_back({xi, eta, of_xi * of_eta});
  return points;
}

const double two_point = 1 / std::sqrt(3.0), three_point = std::sqrt(0.6);

/// The bilinear function of the corner (a, b) of the square.
struct Bilinear {
  double a, b, value, along_xi, along_eta;
  Bilinear(std::size_t corner, const QuadraturePoint& p)
      : a(corner == 1 || corner == 2 ? 1 : -1),
        b(corner >= 2 ? 1 : -1),
        value((1 + a * p.xi) * (1 + b * p.eta) / 4),
        along_xi(a * (1 + b * p.eta) / 4),
        along_eta(b * (1 + a * p.xi) / 4) {}
};

}  // namespace

ShapeSample<3> CellTraits<3>::sample(const QuadraturePoint& p) {
  ShapeSample<3> s;
  s.weight = p.weight;
  s.value << 1 - p.xi - p.eta, p.xi, p.eta;
  s.slope << -1, 1, 0, -1, 0, 1;
  return s;
}

const std::vector<QuadraturePoint>& CellTraits<3>::stiffness_points() {
  static const std::vector<QuadraturePoint> points{{1.0 / 3, 1.0 / 3, 0.5}};
  return points;
}

const std::vector<QuadraturePoint>& CellTraits<3>::load_points() {
  constexpr double a = 1.0 / 6, b = 2.0 / 3, w = 1.0 / 6;
  static const std::vector<QuadraturePoint> points{{a, a, w}, {b, a, w}, {a, b, w}};
  return points;
}

ShapeSample<6> CellTraits<6>::sample(const QuadraturePoint& p) {
  const double l[3] = {1 - p.xi - p.eta, p.xi, p.eta};
  const Eigen::Vector2d slope[3] = {{-1, -1}, {1, 0}, {0, 1}};
  ShapeSample<6> s;
  s.weight = p.weight;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::Index j = (i + 1) % 3;
    s.value[i] = l[i] * (2 * l[i] - 1);
    s.slope.col(i) = (4 * l[i] - 1) * slope[i];
    s.value[3 + i] = 4 * l[i] * l[j];
    s.slope.col(3 + i) = 4 * (l[j] * slope[i] + l[i] * slope[j]);
  }
  return s;
}

/// Degree 4 (Dunavant 1985, Int. J. Num. Meth. Eng. 21): products of two quadratic functions. The roots and weights are those of
/// its table in closed form.
const std::vector<QuadraturePoint>& CellTraits<6>::mass_points() {
  static const std::vector<QuadraturePoint> points = [] {
    const double ten = std::sqrt(10.0), inner = std::sqrt(38 - 44 * std::sqrt(0.4));
    const double mean = (8 - ten) / 18, half = inner / 18, sum = 1.0 / 6, apart = std::sqrt(213125 - 53320 * ten) / 3720;
    const double a = mean + half, b = mean - half, wa = (sum + apart) / 2, wb = (sum - apart) / 2;
    std::vector<QuadraturePoint> six;
    for (const auto& [c, w] : {std::pair(a, wa), std::pair(b, wb)})
      for (const auto& [xi, eta] : {std::pair(c, c), std::pair(1 - 2 * c, c), std::pair(c, 1 - 2 * c)})
        six.push_back({xi, eta, w});
    return six;
  }();
  return points;
}

ShapeSample<4> CellTraits<4>::sample(const QuadraturePoint& p) {
  ShapeSample<4> s;
  s.weight = p.weight;
  for (std::size_t i = 0; i < 4; ++i) {
    const Bilinear n(i, p);
    const auto at = static_cast<Eigen::Index>(i);
    s.value[at] = n.value;
    s.slope.col(at) << n.along_xi, n.along_eta;
  }
  return s;
}

const std::vector<QuadraturePoint>& CellTraits<4>::stiffness_points() {
  static const std::vector<QuadraturePoint> points = squared({{-two_point, 1}, {two_point, 1}});
  return points;
}

const std::vector<QuadraturePoint>& CellTraits<4>::load_points() {
  static const std::vector<QuadraturePoint> points = squared({{-three_point, 5.0 / 9}, {0, 8.0 / 9}, {three_point, 5.0 / 9}});
  return points;
}

ShapeSample<8> CellTraits<8>::sample(const QuadraturePoint& p) {
  ShapeSample<8> s;
  s.weight = p.weight;
  for (std::size_t i = 0; i < 4; ++i) {
    const Bilinear n(i, p);
    const double bend = n.a * p.xi + n.b * p.eta - 1;
    const auto at = static_cast<Eigen::Index>(i);
    s.value[at] = n.value * bend;
    s.slope.col(at) << n.along_xi * bend + n.value * n.a, n.along_eta * bend + n.value * n.b;
  }
  const double x = 1 - p.xi * p.xi, y = 1 - p.eta * p.eta;
  for (const double side : {-1.0, 1.0}) {
    const Eigen::Index along_x = side < 0 ? 4 : 6, along_y = side < 0 ? 7 : 5;
    s.value[along_x] = x * (1 + side * p.eta) / 2;
    s.slope.col(along_x) << -p.xi * (1 + side * p.eta), x * side / 2;
    s.value[along_y] = y * (1 + side * p.xi) / 2;
    s.slope.col(along_y) << y * side / 2, -p.eta * (1 + side * p.xi);
  }
  return s;
}

std::array<EdgeSample, 3> edge_samples(std::size_t nodes) {
  std::array<EdgeSample, 3> samples{};
  const double s[3] = {-three_point, 0, three_point}, weight[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
  for (std::size_t i = 0; i < 3; ++i) {
    samples[i].weight = weight[i];
    if (nodes == 2) {
      samples[i].value = {(1 - s[i]) / 2, (1 + s[i]) / 2, 0};
      samples[i].slope = {-0.5, 0.5, 0};
    } else {
      samples[i].value = {s[i] * (s[i] - 1) / 2, s[i] * (s[i] + 1) / 2, 1 - s[i] * s[i]};
      samples[i].slope = {s[i] - 0.5, s[i] + 0.5, -2 * s[i]};
    }
  }
  return samples;
}

}  // namespace engrane::elements::structural
