// SPDX-License-Identifier: BSD-3-Clause
// Tangents of beams beside the same sums written out by hand, over the same points, and beside dual numbers.
//
//     cmake --build build --target beam_tangent_cost && build/bin/beam_tangent_cost
//     valgrind --tool=callgrind --callgrind-out-file=/dev/null build/bin/beam_tangent_cost block 3 1000
//
// Without arguments: microseconds, the least of many rounds. With `block`, `hand` or `duals`, nodes and a number: so many
// tangents of one of them, to be counted (the difference of 2000 and 1000).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "bench/beside.hpp"
#include "elements/beams/beam_piece.hpp"
#include "math/rotation.hpp"

namespace {

using namespace engrane;
using bench::microseconds;
using namespace engrane::elements::beams;

// Vectors and matrices of three, row by row.
using V = double[3];
using M = double[9];

void cross3(const double* a, const double* b, double* c) {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}
double dot3(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
void skew3(const double* a, double* m) {
  m[0] = m[4] = m[8] = 0;
  m[1] = -a[2], m[2] = a[1], m[3] = a[2], m[5] = -a[0], m[6] = -a[1], m[7] = a[0];
}
/// c += f a b, aᵀ b or a bᵀ; strides are those of rows.
void add_ab(double f, const double* a, int sa, const double* b, int sb, double* c, int sc) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      c[sc * i + j] += f * (a[sa * i] * b[j] + a[sa * i + 1] * b[sb + j] + a[sa * i + 2] * b[2 * sb + j]);
}
void add_atb(double f, const double* a, int sa, const double* b, int sb, double* c, int sc) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c[sc * i + j] += f * (a[i] * b[j] + a[sa + i] * b[sb + j] + a[2 * sa + i] * b[2 * sb + j]);
}
void add_abt(double f, const double* a, int sa, const double* b, int sb, double* c, int sc) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      c[sc * i + j] += f * (a[sa * i] * b[sb * j] + a[sa * i + 1] * b[sb * j + 1] + a[sa * i + 2] * b[sb * j + 2]);
}
void add_outer(double f, const double* a, const double* b, double* c, int sc) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c[sc * i + j] += f * a[i] * b[j];
}
void add(double f, const double* a, int sa, double* c, int sc) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c[sc * i + j] += f * a[sa * i + j];
}
void apply(const double* m, const double* v, double* out) {
  for (int i = 0; i < 3; ++i) out[i] = dot3(m + 3 * i, v);
}
void apply_back(const double* m, const double* v, double* out) {
  for (int i = 0; i < 3; ++i) out[i] = m[i] * v[0] + m[3 + i] * v[1] + m[6 + i] * v[2];
}

/// φ_1, φ_2, φ_3 and their first and second derivatives, by their series.
struct Series {
  double f[4], d[4], dd[4];
  explicit Series(double u) {
    for (int n = 1; n < 4; ++n) {
      double term = 1;
      for (int k = 2; k <= n; ++k) term /= k;
      double value = 0, first = 0, second = 0, power = 1;
      for (int k = 0; k < 12; ++k) {
        const double c = term * power;  // of u^k
        value += c;
        if (u > 0) first += c * k / u, second += c * k * (k - 1) / (u * u);
        term /= -static_cast<double>((2 * k + n + 1) * (2 * k + n + 2));
        power *= u;
      }
      f[n] = value, d[n] = first, dd[n] = second;
    }
  }
};

struct Plain {
  double x[3][3], R[3][9], W[3][3], a[3][3], A[3][3], T[3][9];
};
struct Section {
  double stiffness[6], mass[9], inertia[3];
  int points;
  double length[2], shape[2][3], slope[2][3];
};

void add_second(const double* psi, const double* p, double f1, double f2, double sign, double* m, int s) {
  const double in = dot3(psi, p);
  add_outer(2 * sign * f1, p, psi, m, s);
  add_outer(2 * sign * f1, psi, p, m, s);
  add_outer(4 * sign * f2 * in, psi, psi, m, s);
  for (int i = 0; i < 3; ++i) m[(s + 1) * i] += 2 * sign * f1 * in;
}
void add_second(const double* psi, const double* a, const double* b, double f, double f1, double f2, double* m, int s) {
  const double in_a = dot3(psi, a), in_b = dot3(psi, b), both = dot3(a, b), value = in_a * in_b - dot3(psi, psi) * both;
  V g;
  for (int i = 0; i < 3; ++i) g[i] = a[i] * in_b + b[i] * in_a - 2 * both * psi[i];
  add_outer(f, a, b, m, s);
  add_outer(f, b, a, m, s);
  add_outer(2 * f1, g, psi, m, s);
  add_outer(2 * f1, psi, g, m, s);
  add_outer(4 * f2 * value, psi, psi, m, s);
  for (int i = 0; i < 3; ++i) m[(s + 1) * i] += 2 * (f1 * value - f * both);
}

/// Residual and tangent of an elastic piece of N nodes whose sections stand along the global axes at rest and resist one strain
/// each, in loops and arrays alone.
template <int N>
void by_hand(const Section& data, const Plain& node, Weights w, double* r, double* k) {
  constexpr int ref = N == 3 ? 1 : 0, inner = 6 * (N - 1), all = 6 * N;
  constexpr int other[2] = {N == 3 ? 0 : 1, 2};
  std::fill_n(r, all, 0.0);
  std::fill_n(k, all * all, 0.0);
  double y[2][3], psi[2][3], turn[2][9] = {}, kappa[2], kappa_slope[2], change[2][9];
  for (int o = 0; o < N - 1; ++o) {
    const int i = other[o];
    V d;
    for (int c = 0; c < 3; ++c) d[c] = node.x[i][c] - node.x[ref][c];
    apply_back(node.R[ref], d, y[o]);
    add_atb(1, node.R[ref], 3, node.R[i], 3, turn[o], 3);
    const double* t = turn[o];
    const V axis = {(t[7] - t[5]) / 2, (t[2] - t[6]) / 2, (t[3] - t[1]) / 2};  // sin a times the axis
    const double sine = std::sqrt(dot3(axis, axis)), angle = std::atan2(sine, (t[0] + t[4] + t[8] - 1) / 2);
    const double u = angle * angle, scale = sine > 0 ? angle / sine : 1;
    for (int c = 0; c < 3; ++c) psi[o][c] = scale * axis[c];
    kappa[o] = u > 1e-4 ? (1 - angle / 2 / std::tan(angle / 2)) / u : 1.0 / 12 + u / 720;
    kappa_slope[o] = u > 1e-2 ? (0.125 - 1.5 * kappa[o] + kappa[o] * kappa[o] * u / 2) / u : 1.0 / 720 + u / 15120;
    M s;
    skew3(psi[o], s);
    for (int c = 0; c < 9; ++c) change[o][c] = (c % 4 == 0) - s[c] / 2;
    add_ab(kappa[o], s, 3, s, 3, change[o], 3);
  }
  double force[inner] = {}, K[inner * inner] = {};
  for (int p = 0; p < data.points; ++p) {
    V h = {}, ps = {}, sl = {};
    for (int o = 0; o < N - 1; ++o)
      for (int c = 0; c < 3; ++c) {
        h[c] += data.slope[p][other[o]] * y[o][c];
        ps[c] += data.shape[p][other[o]] * psi[o][c];
        sl[c] += data.slope[p][other[o]] * psi[o][c];
      }
    const Series f(dot3(ps, ps));
    M spin, square = {}, slope_spin, E, T, mixed = {};
    skew3(ps, spin);
    skew3(sl, slope_spin);
    add_ab(1, spin, 3, spin, 3, square, 3);
    add_ab(1, spin, 3, slope_spin, 3, mixed, 3);
    add_ab(1, slope_spin, 3, spin, 3, mixed, 3);
    const double rate = 2 * dot3(ps, sl);
    double b[6][9] = {};
    for (int c = 0; c < 9; ++c) {
      E[c] = (c % 4 == 0) + f.f[1] * spin[c] + f.f[2] * square[c];
      T[c] = (c % 4 == 0) - f.f[2] * spin[c] + f.f[3] * square[c];
      b[c % 3][c / 3] = E[c];
      b[3 + c / 3][6 + c % 3] = T[c];
      b[3 + c / 3][3 + c % 3] = -f.d[2] * rate * spin[c] - f.f[2] * slope_spin[c] + f.d[3] * rate * square[c] + f.f[3] * mixed[c];
    }
    double strain[6];
    apply_back(E, h, strain);
    apply(T, sl, strain + 3);
    M g;
    skew3(strain, g);
    add_ab(1, g, 3, T, 3, &b[0][3], 9);
    skew3(strain + 3, g);
    add_ab(1, g, 3, T, 3, &b[3][3], 9);
    strain[0] -= 1;
    double stress[6], c[6][9], q[81] = {}, forces[9] = {};
    for (int e = 0; e < 6; ++e) {
      stress[e] = data.stiffness[e] * strain[e];
      for (int j = 0; j < 9; ++j) c[e][j] = data.stiffness[e] * b[e][j], forces[j] += stress[e] * b[e][j];
    }
    for (int e = 0; e < 6; ++e)
      for (int i = 0; i < 9; ++i)
        for (int j = 0; j < 9; ++j) q[9 * i + j] += b[e][i] * c[e][j];
    M pull, slid = {}, bend = {}, moment;
    const double *n = stress, *m = stress + 3;
    V world;
    apply(E, n, world);
    skew3(n, pull);
    add_ab(-1, pull, 3, T, 3, slid, 3);
    add_ab(1, E, 3, slid, 3, q + 3, 9);
    V across, twice, first, second;
    cross3(ps, m, across);
    cross3(ps, across, twice);
    skew3(m, moment);
    add(-f.f[2], moment, 3, bend, 3);
    add_outer(2 * f.d[2], across, ps, bend, 3);
    add_outer(2 * f.d[3], twice, ps, bend, 3);
    add_outer(f.f[3], ps, m, bend, 3);
    add_outer(-2 * f.f[3], m, ps, bend, 3);
    for (int i = 0; i < 3; ++i) bend[4 * i] += f.f[3] * dot3(ps, m);
    add(1, bend, 3, q + 9 * 6 + 3, 9);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) q[9 * (3 + i) + j] = q[9 * j + 3 + i], q[9 * (3 + i) + 6 + j] = q[9 * (6 + j) + 3 + i];
    cross3(h, n, first);
    cross3(sl, m, second);
    double* middle = q + 9 * 3 + 3;
    add_second(ps, n, h, f.f[2], f.d[2], f.dd[2], middle, 9);
    add_second(ps, first, f.d[1], f.dd[1], -1, middle, 9);
    add_second(ps, m, sl, f.f[3], f.d[3], f.dd[3], middle, 9);
    add_second(ps, second, f.d[2], f.dd[2], -1, middle, 9);
    for (int o = 0; o < N - 1; ++o) {
      const double v = data.length[p] * data.shape[p][other[o]], s = data.length[p] * data.slope[p][other[o]];
      for (int a = 0; a < 3; ++a) {
        force[6 * o + a] += s * forces[a];
        force[6 * o + 3 + a] += v * forces[3 + a] + s * forces[6 + a];
      }
      for (int o2 = 0; o2 < N - 1; ++o2) {
        const double v2 = data.shape[p][other[o2]], s2 = data.slope[p][other[o2]];
        double* to = K + inner * 6 * o + 6 * o2;
        for (int a = 0; a < 3; ++a)
          for (int e = 0; e < 3; ++e) {
            to[inner * a + e] += s * s2 * q[9 * a + e];
            to[inner * a + 3 + e] += s * v2 * q[9 * a + 3 + e] + s * s2 * q[9 * a + 6 + e];
            to[inner * (3 + a) + e] += v * s2 * q[9 * (3 + a) + e] + s * s2 * q[9 * (6 + a) + e];
            to[inner * (3 + a) + 3 + e] += v * v2 * q[9 * (3 + a) + 3 + e] + v * s2 * q[9 * (3 + a) + 6 + e] +
                                           s * v2 * q[9 * (6 + a) + 3 + e] + s * s2 * q[9 * (6 + a) + 6 + e];
          }
      }
    }
  }

  double by[inner * all] = {};
  double own[2][9] = {}, own_change[2][9] = {}, counter[2][9] = {}, arm[2][9] = {}, lever[2][9];
  for (int o = 0; o < N - 1; ++o) {
    const int i = other[o];
    add_ab(w.q, turn[o], 3, node.T[i], 3, own[o], 3);
    add_ab(1, change[o], 3, own[o], 3, own_change[o], 3);
    add_ab(-w.q, change[o], 3, node.T[ref], 3, counter[o], 3);
    skew3(y[o], lever[o]);
    add_ab(w.q, lever[o], 3, node.T[ref], 3, arm[o], 3);
    for (int b = 0; b < inner; b += 3) {
      const double *ky = K + inner * b + 6 * o, *kp = ky + 3;
      double* row = by + all * b;
      add_abt(w.q, ky, inner, node.R[ref], 3, row + 6 * i, all);
      add_ab(1, kp, inner, own_change[o], 3, row + 6 * i + 3, all);
      add(-1, row + 6 * i, all, row + 6 * ref, all);
      add_ab(1, ky, inner, arm[o], 3, row + 6 * ref + 3, all);
      add_ab(1, kp, inner, counter[o], 3, row + 6 * ref + 3, all);
    }
  }
  for (int o = 0; o < N - 1; ++o) {
    const int i = other[o];
    const double *g = force + 6 * o, *mu = g + 3;
    V tau, space, back, lift, across, twice;
    apply_back(change[o], mu, tau);
    apply(node.R[ref], g, space);
    apply_back(turn[o], tau, back);
    cross3(y[o], g, lift);
    for (int c = 0; c < 3; ++c) {
      r[6 * i + c] += space[c];
      r[6 * i + 3 + c] += back[c];
      r[6 * ref + c] -= space[c];
      r[6 * ref + 3 + c] -= tau[c] + lift[c];
    }
    M bend, pull, twist, turned = {}, spun = {};
    cross3(psi[o], mu, across);
    cross3(psi[o], across, twice);
    skew3(mu, bend);
    for (double& value : bend) value *= -0.5;
    add_outer(2 * kappa_slope[o], twice, psi[o], bend, 3);
    add_outer(kappa[o], psi[o], mu, bend, 3);
    add_outer(-2 * kappa[o], mu, psi[o], bend, 3);
    for (int c = 0; c < 3; ++c) bend[4 * c] += kappa[o] * dot3(psi[o], mu);
    skew3(g, pull);
    skew3(tau, twist);
    double moments[3 * all] = {};
    for (int b = 0; b < all; b += 3) add_atb(1, change[o], 3, by + all * (6 * o + 3) + b, all, moments + b, all);
    add_ab(1, bend, 3, own_change[o], 3, moments + 6 * i + 3, all);
    add_ab(1, bend, 3, counter[o], 3, moments + 6 * ref + 3, all);
    double* on_ref = k + all * (6 * ref + 3);
    for (int b = 0; b < all; b += 3) {
      add(-1, moments + b, all, on_ref + b, all);
      add_ab(-1, lever[o], 3, by + all * 6 * o + b, all, on_ref + b, all);
    }
    add_abt(w.q, pull, 3, node.R[ref], 3, on_ref + 6 * i, all);
    add_abt(-w.q, pull, 3, node.R[ref], 3, on_ref + 6 * ref, all);
    add_ab(1, pull, 3, arm[o], 3, on_ref + 6 * ref + 3, all);
    double* on = k + all * 6 * i;
    for (int b = 0; b < all; b += 3) add_ab(1, node.R[ref], 3, by + all * 6 * o + b, all, on + b, all);
    add_ab(1, node.R[ref], 3, pull, 3, turned, 3);
    add_ab(-w.q, turned, 3, node.T[ref], 3, on + 6 * ref + 3, all);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < all; ++b) k[all * (6 * ref + a) + b] -= on[all * a + b];
    add_ab(1, twist, 3, own[o], 3, moments + 6 * i + 3, all);
    add_ab(-w.q, twist, 3, node.T[ref], 3, spun, 3);
    add(1, spun, 3, moments + 6 * ref + 3, all);
    for (int b = 0; b < all; b += 3) add_atb(1, turn[o], 3, moments + b, all, on + 3 * all + b, all);
  }

  for (int i = 0; i < N; ++i) {
    V spin, gyro;
    for (int c = 0; c < 3; ++c) spin[c] = data.inertia[c] * node.W[i][c];
    cross3(node.W[i], spin, gyro);
    M wheel, own;
    skew3(node.W[i], wheel);
    skew3(spin, own);
    for (int a = 0; a < 3; ++a) {
      for (int j = 0; j < N; ++j) {
        r[6 * i + a] += data.mass[3 * i + j] * node.a[j][a];
        k[all * (6 * i + a) + 6 * j + a] += w.a * data.mass[3 * i + j];
      }
      r[6 * i + 3 + a] += data.inertia[a] * node.A[i][a] + gyro[a];
      double* to = k + all * (6 * i + 3 + a) + 6 * i + 3;
      for (int b = 0; b < 3; ++b) to[b] += w.v * (wheel[3 * a + b] * data.inertia[b] - own[3 * a + b]);
      to[a] += w.a * data.inertia[a];
    }
  }
}

template <int N>
class Pair {
 public:
  explicit Pair(double damping) {
    auto section = std::make_shared<BeamSection>();
    section->stiffness.diagonal() << 1000, 400, 400, 30, 50, 50;
    section->mass = 2;
    section->inertia.diagonal() << 0.2, 0.1, 0.1;
    section->damping = damping;
    piece_.section = section;
    for (int e = 0; e < 6; ++e) data_.stiffness[e] = section->stiffness(e, e);
    data_.points = N - 1;
    piece_.mass.setConstant(0.3);
    for (int p = 0; p < N - 1; ++p) {
      const double xi = N == 2 ? 0 : (2 * p - 1) / std::sqrt(3.0);
      const double shape[3] = {N == 2 ? 0.5 : xi * (xi - 1) / 2, N == 2 ? 0.5 : 1 - xi * xi, xi * (xi + 1) / 2};
      const double slope[3] = {N == 2 ? -0.5 : xi - 0.5, N == 2 ? 0.5 : -2 * xi, xi + 0.5};
      auto& point = piece_.at[static_cast<std::size_t>(p)];
      data_.length[p] = point.length = 2.0 / (N - 1);
      std::copy_n(shape, N, point.shape.begin());
      std::copy_n(slope, N, point.slope.begin());
      std::copy_n(shape, N, data_.shape[p]);
      std::copy_n(slope, N, data_.slope[p]);
      point.axes.setIdentity();
      point.section = section;
    }
    for (int i = 0; i < N; ++i) {
      const auto at = static_cast<std::size_t>(i);
      piece_.axes[at].setIdentity();
      piece_.centers[at].setZero();
      piece_.inertia[at] = section->inertia;
      NodeState& node = nodes_[at];
      node.x = Vec3(i, 0.1 * i * i, 0.02 * i);
      node.R = rotation_exp(Vec3(0.1 * i, 0.05, 0.2 * i));
      node.T = rotation_exp(Vec3(0.01, 0, 0.02 * i));
      node.v = Vec3(1, -1, i);
      node.W = Vec3(1, 2, i);
      node.a = Vec3(i, i, 1);
      node.A = Vec3(i, 2, 1);
      for (int c = 0; c < 3; ++c) {
        plain_.x[i][c] = node.x[c], plain_.W[i][c] = node.W[c], plain_.a[i][c] = node.a[c], plain_.A[i][c] = node.A[c];
        data_.inertia[c] = section->inertia(c, c);
        for (int b = 0; b < 3; ++b) plain_.R[i][3 * c + b] = node.R(c, b), plain_.T[i][3 * c + b] = node.T(c, b);
      }
    }
    std::fill_n(data_.mass, 9, 0.3);
    Layout layout;
    layout.nodes.assign(N, -1);
    layout.needs.assign(N, NodeNeed::both);
    sweep_ = Sweep<N, 6 * N>(layout);
  }

  void block() {
    State state;
    state.nodes = nodes_;
    piece_.tangent(state, weights, r_, k_);
  }
  void duals() {
    State state;
    state.nodes = nodes_;
    sweep_.tangent(state, weights, r_, k_, [&](const auto& motion, auto& balance) { piece_.evaluate(motion, state, balance); });
  }
  void hand() { by_hand<N>(data_, plain_, weights, r_.data(), k_.data()); }

  /// The largest difference from the tangent and residual of the block that `other` leaves, over the largest entry.
  template <class Other>
  double difference(const Other& other) {
    block();
    const auto k = k_;
    const auto r = r_;
    other();
    return bench::difference(r, k, r_, k_);
  }

 private:
  static constexpr Weights weights = {1, 2, 3, 1};
  BeamPiece<N> piece_;
  Sweep<N, 6 * N> sweep_;
  Section data_;
  Plain plain_;
  std::array<NodeState, N> nodes_;
  std::array<double, 6 * N> r_;
  std::array<double, 36 * N * N> k_;
};

template <int N>
void measure(std::string_view which, int count) {
  Pair<N> pair(0), damped(1e-3);
  if (which == "block")
    for (int i = 0; i < count; ++i) pair.block();
  else if (which == "hand")
    for (int i = 0; i < count; ++i) pair.hand();
  else if (which == "duals")
    for (int i = 0; i < count; ++i) pair.duals();
  else {
    const auto block = microseconds([&] { pair.block(); }), hand = microseconds([&] { pair.hand(); });
    fmt::print("{} nodes: block {:.3f} us, by hand {:.3f} us, ratio {:.2f}; they differ by {:.1e}\n", N, block, hand,
               block / hand, pair.difference([&] { pair.hand(); }));
    fmt::print("  dual numbers {:.3f} us, differ by {:.1e}\n", microseconds([&] { pair.duals(); }),
               pair.difference([&] { pair.duals(); }));
    fmt::print("  damped: block {:.3f} us, dual numbers {:.3f} us, differ by {:.1e}\n", microseconds([&] { damped.block(); }),
               microseconds([&] { damped.duals(); }), damped.difference([&] { damped.duals(); }));
  }
}

}  // namespace

int main(int count, char** words) {
  const std::string_view which = count > 1 ? words[1] : "";
  const int nodes = count > 2 ? std::atoi(words[2]) : 0, times = count > 3 ? std::atoi(words[3]) : 0;
  if (nodes == 0 || nodes == 2) measure<2>(which, times);
  if (nodes == 0 || nodes == 3) measure<3>(which, times);
}
