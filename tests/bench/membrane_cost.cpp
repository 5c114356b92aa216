// SPDX-License-Identifier: BSD-3-Clause
// Tangents of membranes beside the same sums written out by hand, over the same points.
//
//     cmake --build build --target membrane_cost && build/bin/membrane_cost
//     valgrind --tool=callgrind --callgrind-out-file=/dev/null build/bin/membrane_cost block 8 1000
//
// Without arguments: microseconds of both, the least of many rounds. With `block` or `hand`, nodes and a number: so many tangents
// of one of them, to be counted (the difference of 2000 and 1000).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "bench/beside.hpp"
#include "elements/membranes/membrane_cells.hpp"
#include "elements/structural/cell_shapes.hpp"

namespace {

using namespace engrane;
using bench::microseconds;
using namespace engrane::elements;

/// Residual and tangent of an elastic membrane with a pressure, in arrays and loops alone. The shape functions are tabulated, as
/// they are for the block; what depends on the cell is computed at each point.
template <CellShape S>
void by_hand(const double (*places)[3], const NodeState* nodes, double young, double nu, double h, double density, double p,
             double* r, double* k) {
  constexpr int N = structural::CellTraits<S>::nodes;
  static const auto samples = structural::tabulate<S>(structural::CellTraits<S>::load_points());
  std::fill_n(r, 3 * N, 0.0);
  std::fill_n(k, 9 * N * N, 0.0);
  const double D = young / (1 - nu * nu), G = D * (1 - nu) / 2;
  for (const auto& s : samples) {
    double g1[3] = {}, g2[3] = {};
    for (int i = 0; i < N; ++i)
      for (int c = 0; c < 3; ++c) {
        g1[c] += s.slope(0, i) * places[i][c];
        g2[c] += s.slope(1, i) * places[i][c];
      }
    const double length = std::sqrt(g1[0] * g1[0] + g1[1] * g1[1] + g1[2] * g1[2]);
    const double across = (g1[0] * g2[0] + g1[1] * g2[1] + g1[2] * g2[2]) / length;
    const double height = std::sqrt(g2[0] * g2[0] + g2[1] * g2[1] + g2[2] * g2[2] - across * across);
    const double area = s.weight * length * height;
    double d1[N], d2[N], f1[3] = {}, f2[3] = {}, a[3] = {};
    for (int i = 0; i < N; ++i) {
      d1[i] = s.slope(0, i) / length;
      d2[i] = (s.slope(1, i) - across * d1[i]) / height;
      for (int c = 0; c < 3; ++c) {
        f1[c] += d1[i] * nodes[i].x[c];
        f2[c] += d2[i] * nodes[i].x[c];
        a[c] += s.value[i] * nodes[i].a[c];
      }
    }
    const double e1 = (f1[0] * f1[0] + f1[1] * f1[1] + f1[2] * f1[2] - 1) / 2;
    const double e2 = (f2[0] * f2[0] + f2[1] * f2[1] + f2[2] * f2[2] - 1) / 2;
    const double e12 = f1[0] * f2[0] + f1[1] * f2[1] + f1[2] * f2[2];
    const double w = area * h, s1 = w * D * (e1 + nu * e2), s2 = w * D * (e2 + nu * e1), s12 = w * G * e12;
    const double n[3] = {f1[1] * f2[2] - f1[2] * f2[1], f1[2] * f2[0] - f1[0] * f2[2], f1[0] * f2[1] - f1[1] * f2[0]};
    const double push = area * p, mass = area * h * density;
    double b[3][3 * N], c[3][3 * N];
    for (int i = 0; i < N; ++i)
      for (int m = 0; m < 3; ++m) {
        const int j = 3 * i + m;
        b[0][j] = d1[i] * f1[m];
        b[1][j] = d2[i] * f2[m];
        b[2][j] = d1[i] * f2[m] + d2[i] * f1[m];
        c[0][j] = w * D * (b[0][j] + nu * b[1][j]);
        c[1][j] = w * D * (b[1][j] + nu * b[0][j]);
        c[2][j] = w * G * b[2][j];
        r[j] += s1 * b[0][j] + s2 * b[1][j] + s12 * b[2][j] + s.value[i] * (mass * a[m] - push * n[m]);
      }
    for (int i = 0; i < 3 * N; ++i)
      for (int j = 0; j < 3 * N; ++j) k[3 * N * i + j] += b[0][i] * c[0][j] + b[1][i] * c[1][j] + b[2][i] * c[2][j];
    for (int i = 0; i < N; ++i) {
      const double t1 = s1 * d1[i] + s12 * d2[i], t2 = s12 * d1[i] + s2 * d2[i];
      for (int j = 0; j < N; ++j) {
        const double same = t1 * d1[j] + t2 * d2[j], turn = push * s.value[i];
        double* block = k + 9 * N * i + 3 * j;
        double u[3];
        for (int m = 0; m < 3; ++m) {
          block[(3 * N + 1) * m] += same;
          u[m] = turn * (d2[j] * f1[m] - d1[j] * f2[m]);
        }
        block[1] += u[2];
        block[2] -= u[1];
        block[3 * N] -= u[2];
        block[3 * N + 2] += u[0];
        block[6 * N] += u[1];
        block[6 * N + 1] -= u[0];
      }
    }
  }
}

template <CellShape S>
class Pair {
  static constexpr int N = structural::CellTraits<S>::nodes;

 public:
  Pair() {
    const bool three = N % 3 == 0;
    std::vector<Vec3> x;
    for (int i = 0; i < N; ++i) {
      const int corners = three ? 3 : 4, corner = i % corners;
      const double turn = 2 * 3.14159265358979 * (corner + (i < corners ? 0 : 0.5)) / corners;
      const double radius = i < corners ? 1 : std::cos(3.14159265358979 / corners) * 1.05;
      x.emplace_back(radius * std::cos(turn), radius * std::sin(turn), 0.1 * corner);
    }
    std::vector<int> ids;
    for (int i = 0; i < N; ++i) {
      ids.push_back(i + 1);
      for (int c = 0; c < 3; ++c) places_[i][c] = x[static_cast<std::size_t>(i)][c];
      nodes_[i].x = x[static_cast<std::size_t>(i)] * (1 + 0.02 * i);
      nodes_[i].a = Vec3(1, 2, i);
    }
    membranes::MembraneSection section;
    section.law.young = young;
    section.law.poisson = nu;
    section.thickness = thick;
    section.density = density;
    section.pressure = pressure;
    membrane_ = membranes::make_membrane(1, S, ids, x, std::make_shared<const membranes::MembraneSection>(section), nullptr);
  }

  void block() {
    State state;
    state.nodes = nodes_;
    membrane_->tangent(state, {1, 0, 0, 0}, r_, k_);
  }
  void hand() { by_hand<S>(places_, nodes_.data(), young, nu, thick, density, pressure, r_.data(), k_.data()); }

  /// The largest difference of the two tangents, over the largest entry.
  double difference() {
    block();
    const auto k = k_;
    const auto r = r_;
    hand();
    return bench::difference(r, k, r_, k_);
  }

 private:
  static constexpr double young = 50, nu = 0.3, thick = 0.2, density = 2, pressure = 3;
  double places_[N][3];
  std::array<NodeState, N> nodes_;
  std::array<double, 3 * N> r_;
  std::array<double, 9 * N * N> k_;
  std::unique_ptr<Element> membrane_;
};

template <CellShape S>
void measure(std::string_view which, int count) {
  Pair<S> pair;
  if (which == "block")
    for (int i = 0; i < count; ++i) pair.block();
  else if (which == "hand")
    for (int i = 0; i < count; ++i) pair.hand();
  else {
    const double block = microseconds([&] { pair.block(); }), hand = microseconds([&] { pair.hand(); });
    fmt::print("{} nodes: block {:.3f} us, by hand {:.3f} us, ratio {:.2f}; they differ by {:.1e}\n",
               structural::CellTraits<S>::nodes, block, hand, block / hand, pair.difference());
  }
}

}  // namespace

int main(int count, char** words) {
  const std::string_view which = count > 1 ? words[1] : "";
  const int nodes = count > 2 ? std::atoi(words[2]) : 0, times = count > 3 ? std::atoi(words[3]) : 0;
  if (nodes == 0 || nodes == 3) measure<CellShape::triangle>(which, times);
  if (nodes == 0 || nodes == 6) measure<CellShape::triangle6>(which, times);
  if (nodes == 0 || nodes == 4) measure<CellShape::quadrilateral>(which, times);
  if (nodes == 0 || nodes == 8) measure<CellShape::quadrilateral8>(which, times);
}
