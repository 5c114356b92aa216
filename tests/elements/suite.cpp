// SPDX-License-Identifier: BSD-3-Clause
#include "elements/suite.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace engrane::suite {

namespace {

using Vector = std::vector<double>;
using Level = StateBuffer::Level;

/// Sixth-order central difference of a vector function: its error is h⁶, so a step of 1e-3 leaves rounding only.
Vector difference(const std::function<Vector(double)>& f, double h) {
  Vector d(f(0).size(), 0.0);
  const double weight[3] = {45.0 / 60, -9.0 / 60, 1.0 / 60};
  for (int k = 1; k <= 3; ++k) {
    const Vector plus = f(k * h), minus = f(-k * h);
    for (std::size_t i = 0; i < d.size(); ++i) d[i] += weight[k - 1] * (plus[i] - minus[i]) / h;
  }
  return d;
}

/// Sixth-order second difference.
Vector second_difference(const std::function<Vector(double)>& f, double h) {
  const Vector middle = f(0);
  Vector d(middle.size(), 0.0);
  const double weight[3] = {1.5, -3.0 / 20, 1.0 / 90};
  for (int k = 1; k <= 3; ++k) {
    const Vector plus = f(k * h), minus = f(-k * h);
    for (std::size_t i = 0; i < d.size(); ++i) d[i] += weight[k - 1] * (plus[i] - 2 * middle[i] + minus[i]) / (h * h);
  }
  return d;
}

/// Kind of a slot: errors are judged against the largest entry between slots of the same kinds, since units differ.
enum Kind { force_kind, moment_kind, scalar_kind, multiplier_kind, kinds };

struct Slots {
  explicit Slots(const Element& element) : layout(element.layout()) {}
  const Layout& layout;
  std::size_t nodes() const { return layout.nodes.size(); }
  std::size_t first_scalar() const { return 6 * nodes(); }
  std::size_t first_multiplier() const { return first_scalar() + layout.scalars.size(); }
  std::size_t count() const { return first_multiplier() + layout.multipliers.size(); }
  Kind kind(std::size_t slot) const {
    if (slot >= first_multiplier()) return multiplier_kind;
    if (slot >= first_scalar()) return scalar_kind;
    return slot % 6 < 3 ? force_kind : moment_kind;
  }
  bool ground(std::size_t slot) const { return slot < first_scalar() && layout.nodes[slot / 6] == 0; }
  bool needed(std::size_t slot) const {
    if (slot >= first_scalar()) return true;
    return layout.has(slot / 6, static_cast<int>(slot % 6));
  }
  std::string name(std::size_t slot) const {
    if (slot >= first_multiplier()) return "multiplier " + layout.multipliers[slot - first_multiplier()].name;
    if (slot >= first_scalar()) return layout.scalars[slot - first_scalar()].name;
    const char* component[6] = {"x", "y", "z", "rx", "ry", "rz"};
    return "node " + std::to_string(layout.nodes[slot / 6]) + " " + component[slot % 6];
  }
};

double size_of(const Subject& s, Kind kind, Level level) {
  const double q = kind == force_kind ? s.length : kind == scalar_kind ? s.scalar : kind == multiplier_kind ? s.force : 1;
  return level == Level::position || kind == multiplier_kind ? q : q * s.velocity / s.length;
}

void expect_all_finite(const Vector& v, const std::string& what) {
  for (std::size_t i = 0; i < v.size(); ++i)
    if (!std::isfinite(v[i])) {
      ADD_FAILURE() << what << ": entry " << i << " is " << v[i];
      return;
    }
}

/// Compares two matrices (rows × count) kind by kind; `noise` is the rounding of the differences in units of the row.
void expect_matrix(const Slots& slots, const Vector& exact, const Vector& differences, const Vector& noise, double tolerance,
                   const std::string& what) {
  const std::size_t n = slots.count();
  double largest[kinds][kinds] = {};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      largest[slots.kind(i)][slots.kind(j)] = std::max(largest[slots.kind(i)][slots.kind(j)], std::abs(differences[i * n + j]));
  int shown = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const double allowed = tolerance * largest[slots.kind(i)][slots.kind(j)] + noise[slots.kind(i) * kinds + slots.kind(j)];
      const double error = std::abs(exact[i * n + j] - differences[i * n + j]);
      if (!(error <= allowed) && ++shown <= 5)
        ADD_FAILURE() << what << ": row " << slots.name(i) << ", column " << slots.name(j) << ": " << exact[i * n + j]
                      << ", differences give " << differences[i * n + j] << " (allowed " << allowed << ")";
    }
}

/// Largest entry by kind, to judge what ought to be zero.
Vector largest_by_kind(const Slots& slots, const Vector& r) {
  Vector largest(kinds, 0.0);
  for (std::size_t i = 0; i < r.size(); ++i) largest[slots.kind(i)] = std::max(largest[slots.kind(i)], std::abs(r[i]));
  return largest;
}

void check_tangent(const Subject& s, const Element& element, const StateBuffer& state) {
  const Slots slots(element);
  const std::size_t n = slots.count();
  const Vector r0 = residual_of(element, state);

  Vector by_level[3];
  const Level levels[3] = {Level::position, Level::velocity, Level::acceleration};
  const Weights weights[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const char* names[3] = {"∂r/∂q", "∂r/∂v", "∂r/∂a"};
  const Vector scale = largest_by_kind(slots, r0);
  for (int l = 0; l < 3; ++l) {
    Vector differences(n * n, 0.0), noise(kinds * kinds, 0.0);
    for (std::size_t j = 0; j < n; ++j) {
      if (slots.ground(j)) continue;
      const double h = s.step * size_of(s, slots.kind(j), levels[l]);
      const Vector column = difference(
          [&](double t) {
            StateBuffer moved = state;
            moved.add(j, levels[l], t);
            return residual_of(element, moved);
          },
          h);
      for (std::size_t i = 0; i < n; ++i) {
        differences[i * n + j] = column[i];
        double& eps = noise[slots.kind(i) * kinds + slots.kind(j)];
        eps = std::max(eps, 1e-14 * scale[slots.kind(i)] / h);
      }
    }
    Vector r;
    const Vector k = tangent_of(element, state, weights[l], &r);
    expect_matrix(slots, k, differences, noise, s.tolerance, names[l]);
    for (std::size_t i = 0; i < n; ++i)
      EXPECT_NEAR(r[i], r0[i], 1e-12 * scale[slots.kind(i)]) << "tangent() returns another residual in " << slots.name(i);
    by_level[l] = k;
  }

  // the weights combine
  const Weights w{0.7, -1.3, 0.4};
  const Vector k = tangent_of(element, state, w);
  const double largest =
      std::abs(*std::max_element(k.begin(), k.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const double sum = slots.kind(j) == multiplier_kind
                             ? by_level[0][i * n + j]
                             : w.q * by_level[0][i * n + j] + w.v * by_level[1][i * n + j] + w.a * by_level[2][i * n + j];
      EXPECT_NEAR(k[i * n + j], sum, 1e-12 * largest) << "weights do not combine, " << slots.name(i) << ", " << slots.name(j);
    }
}

Vector constraints_of(const Element& element, const StateBuffer& state) {
  const Slots slots(element);
  const Vector r = residual_of(element, state);
  Vector phi(element.layout().multipliers.size());
  for (std::size_t i = 0; i < phi.size(); ++i) phi[i] = -r[slots.first_multiplier() + i];
  return phi;
}

void check_rates(const Subject& s, const Element& element, const StateBuffer& state) {
  const std::size_t n = element.layout().multipliers.size();
  Vector phi(n), rate(n), second(n);
  element.constraint_rates(state.view(), phi, rate, second);
  const auto along = [&](double t) { return constraints_of(element, state.after(t)); };
  // second differences lose twice the digits: a larger step
  const double h = 5 * s.step * s.length / s.velocity;
  const Vector now = along(0), first = difference(along, h), twice = second_difference(along, 2 * h);
  double largest[3] = {0, 0, 0};
  for (std::size_t i = 0; i < n; ++i) {
    largest[0] = std::max(largest[0], std::abs(now[i]));
    largest[1] = std::max(largest[1], std::abs(first[i]));
    largest[2] = std::max(largest[2], std::abs(twice[i]));
  }
  const double tolerance = 10 * s.tolerance;
  for (std::size_t i = 0; i < n; ++i) {
    const std::string& name = element.layout().multipliers[i].name;
    EXPECT_NEAR(phi[i], now[i], 1e-12 * largest[0]) << "Φ of " << name;
    EXPECT_NEAR(rate[i], first[i], tolerance * largest[1] + 1e-13 * largest[0] / h) << "dΦ/dt of " << name;
    EXPECT_NEAR(second[i], twice[i], 10 * tolerance * largest[2] + 1e-13 * largest[0] / (h * h)) << "d²Φ/dt² of " << name;
  }
}

void check_ideal(const Element& element, StateBuffer state) {
  const Slots slots(element);
  const std::size_t n = slots.count();
  for (NodeState& node : state.nodes) node.T = Mat3::Identity();  // rows are material increments; columns then too
  const Vector k = tangent_of(element, state, {1, 0, 0});
  double largest = 0;
  for (std::size_t j = slots.first_multiplier(); j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::abs(k[i * n + j]));
  for (std::size_t j = slots.first_multiplier(); j < n; ++j)
    for (std::size_t i = 0; i < slots.first_multiplier(); ++i) {
      if (slots.ground(i)) continue;
      EXPECT_NEAR(k[i * n + j], k[j * n + i], 1e-12 * largest)
          << "force of " << slots.name(j) << " on " << slots.name(i) << " is not along its gradient";
    }
}

double kinetic_of(const Element& element, const StateBuffer& state) { return element.energies(state.view()).kinetic; }
double potential_of(const Element& element, const StateBuffer& state) { return element.energies(state.view()).potential; }

/// ∂K/∂q̇ by differences, exact up to rounding because K is quadratic.
Vector momentum_of(const Subject& s, const Element& element, const StateBuffer& state) {
  const Slots slots(element);
  Vector p(slots.first_multiplier(), 0.0);
  for (std::size_t j = 0; j < p.size(); ++j) {
    if (slots.ground(j)) continue;
    const double h = size_of(s, slots.kind(j), Level::velocity);
    StateBuffer plus = state, minus = state;
    plus.add(j, Level::velocity, h);
    minus.add(j, Level::velocity, -h);
    p[j] = (kinetic_of(element, plus) - kinetic_of(element, minus)) / (2 * h);
  }
  return p;
}

void check_lagrange(const Subject& s, const Element& element, StateBuffer state) {
  const Slots slots(element);
  std::fill(state.multipliers.begin(), state.multipliers.end(), 0.0);
  state.penalty = 0;
  for (std::size_t i = 0; i < state.nodes.size(); ++i) state.turn(i, state.nodes[i].R, Vec3::Zero());

  const Vector r = residual_of(element, state);
  const Vector p = momentum_of(s, element, state);
  Vector expected =
      difference([&](double t) { return momentum_of(s, element, state.after(t)); }, 5 * s.step * s.length / s.velocity);
  double largest[kinds] = {};
  for (std::size_t j = 0; j < expected.size(); ++j) {
    if (slots.ground(j)) continue;
    const double h = s.step * size_of(s, slots.kind(j), Level::position);
    const Vector slope = difference(
        [&](double t) {
          StateBuffer moved = state;
          moved.add(j, Level::position, t);
          return Vector{potential_of(element, moved) - kinetic_of(element, moved)};
        },
        h);
    expected[j] += slope[0];
  }
  // in material angular velocities Lagrange's equations are Euler–Poincaré's: W × ∂K/∂W joins
  for (std::size_t i = 0; i < slots.nodes(); ++i) {
    const Vec3 gyro = cross(state.nodes[i].W, Vec3(p[6 * i + 3], p[6 * i + 4], p[6 * i + 5]));
    for (std::size_t c = 0; c < 3; ++c) expected[6 * i + 3 + c] += gyro[static_cast<Eigen::Index>(c)];
  }
  for (std::size_t j = 0; j < expected.size(); ++j)
    largest[slots.kind(j)] = std::max({largest[slots.kind(j)], std::abs(expected[j]), std::abs(r[j])});
  for (std::size_t j = 0; j < expected.size(); ++j) {
    if (slots.ground(j)) continue;
    EXPECT_NEAR(r[j], expected[j], 10 * s.tolerance * largest[slots.kind(j)]) << "Lagrange's equation of " << slots.name(j);
  }
}

void check_power(const Subject& s, const Element& element, StateBuffer state) {
  const Slots slots(element);
  state.penalty = 0;
  const Vector r = residual_of(element, state);
  const std::size_t m = state.multipliers.size();
  Vector phi(m), rate(m), second(m);
  element.constraint_rates(state.view(), phi, rate, second);
  double given = 0, largest = 0;
  const auto sum = [&](double p) {
    given += p;
    largest = std::max(largest, std::abs(p));
  };
  for (std::size_t j = 0; j < slots.first_multiplier(); ++j) sum(r[j] * state.velocity(j));
  for (std::size_t i = 0; i < m; ++i) sum(state.multipliers[i] * rate[i]);
  const Energies now = element.energies(state.view());
  const Vector storing = difference(
      [&](double t) {
        const Energies e = element.energies(state.after(t).view());
        return Vector{e.kinetic + e.potential};
      },
      5 * s.step * s.length / s.velocity);
  const double found = storing[0] + now.dissipated - now.external;
  EXPECT_NEAR(given, found, 10 * s.tolerance * largest)
      << "power: stored " << storing[0] << ", dissipated " << now.dissipated << ", external " << now.external;
}

void check_rigid(const Subject& s, const Element& element, Random& random) {
  StateBuffer state(element, s.nodes);
  const Mat3 Q = uniform_rotation(s, random);
  const Vec3 shift = 10 * s.length * uniform_vector(s, random),
             spin = s.velocity / s.length * (s.in_plane ? Vec3(uniform(random) * Vec3::UnitZ()) : uniform_vector(random)),
             speed = s.velocity * uniform_vector(s, random);
  for (std::size_t i = 0; i < state.nodes.size(); ++i) {
    NodeState& node = state.nodes[i];
    node.x = Q * node.x + shift;
    state.turn(i, Q, Vec3::Zero());
    node.v = speed + cross(spin, node.x);
    node.W = Q.transpose() * spin;
  }
  const Slots slots(element);
  const Vector r = residual_of(element, state);
  // rounding of the positions, magnified by the stiffest direction
  const Vector k = tangent_of(element, state, {1, 1, 0});
  double stiffest = 0;
  for (double entry : k) stiffest = std::max(stiffest, std::abs(entry));
  for (std::size_t i = 0; i < r.size(); ++i)
    EXPECT_NEAR(r[i], 0, 1e-13 * (stiffest + 1) * (1 + shift.norm() + 10 * s.length) * (1 + s.length))
        << "a rigid motion makes a force on " << slots.name(i);
}

/// Forces of two states that ought to be equal when those of `r` are rotated: forces by Qf, moments by Qm.
void expect_rotated(const Slots& slots, const Vector& r, const Vector& rotated, const Mat3& Qf, const Mat3& Qm, double tolerance,
                    const std::string& what) {
  Vector expected = r;
  for (std::size_t i = 0; i < slots.nodes(); ++i) {
    Eigen::Map<Vec3> f(&expected[6 * i]), m(&expected[6 * i + 3]);
    f = (Qf * f).eval();
    m = (Qm * m).eval();
  }
  const Vector scale = largest_by_kind(slots, expected);
  for (std::size_t j = 0; j < expected.size(); ++j)
    EXPECT_NEAR(rotated[j], expected[j], tolerance * (scale[slots.kind(j)] + 1e-3)) << what << ": " << slots.name(j);
}

void check_objectivity(const Subject& s, const Element& element, const StateBuffer& state, Random& random) {
  const Mat3 Q = uniform_rotation(s, random);
  const Vec3 shift = s.length * uniform_vector(s, random);
  StateBuffer moved = state;
  moved.gravity = Q * state.gravity;
  for (std::size_t i = 0; i < moved.nodes.size(); ++i) {
    NodeState& node = moved.nodes[i];
    node.x = Q * node.x + shift;
    node.v = Q * node.v;
    node.a = Q * node.a;
    moved.turn(i, Q * node.R, Vec3::Zero());
  }
  expect_rotated(Slots(element), residual_of(element, state), residual_of(element, moved), Q, Mat3::Identity(),
                 1e-3 * s.tolerance, "rotated with all its nodes");
}

void check_rotated_copy(const Subject& s, const Element& element, const StateBuffer& state, Random& random) {
  const Mat3 Q = uniform_rotation(s, random);
  const auto copy = s.build(Q);
  ASSERT_NE(copy, nullptr);
  StateBuffer original = state;
  if (s.own_axes) std::fill(original.multipliers.begin(), original.multipliers.end(), 0.0);
  StateBuffer turned_state = original;
  turned_state.gravity = Q * state.gravity;
  for (std::size_t i = 0; i < turned_state.nodes.size(); ++i) {
    NodeState& node = turned_state.nodes[i];
    for (Vec3* v : {&node.x, &node.v, &node.a, &node.W, &node.A}) *v = (Q * *v).eval();
    turned_state.turn(i, Q * node.R * Q.transpose(), Vec3::Zero());
  }
  const Slots slots(element);
  Vector expected = residual_of(element, original), found = residual_of(*copy, turned_state);
  if (s.own_axes) {
    expected.resize(slots.first_multiplier());
    found.resize(slots.first_multiplier());
  }
  expect_rotated(slots, expected, found, Q, Q, 1e-3 * s.tolerance, "built in a rotated frame");
}

void check_equilibrium(const Element& element, const StateBuffer& state) {
  const Slots slots(element);
  const Vector r = residual_of(element, state);
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double largest = 0, arm = 0;
  for (std::size_t i = 0; i < slots.nodes(); ++i) {
    const Vec3 f(r[6 * i], r[6 * i + 1], r[6 * i + 2]), m(r[6 * i + 3], r[6 * i + 4], r[6 * i + 5]);
    force += f;
    moment += cross(state.nodes[i].x, f) + state.nodes[i].R * m;
    largest = std::max(largest, f.norm());
    arm = std::max({arm, m.norm(), (state.nodes[i].x.norm() + 1e-300) * f.norm()});
  }
  EXPECT_LE(force.norm(), 1e-13 * (largest + 1e-300)) << "forces do not sum to zero: " << force.transpose();
  EXPECT_LE(moment.norm(), 1e-12 * (arm + 1e-300)) << "moments do not sum to zero: " << moment.transpose();
}

void check_zero(const Subject& s, const Element& element) {
  const StateBuffer state(element, s.nodes);
  const Slots slots(element);
  const Vector r = residual_of(element, state), k = tangent_of(element, state, {1, 1, 0});
  double stiffest = 0;
  for (double entry : k) stiffest = std::max(stiffest, std::abs(entry));
  for (std::size_t i = 0; i < r.size(); ++i)
    EXPECT_NEAR(r[i], 0, 1e-14 * (stiffest * (1 + s.length) + 1)) << "at rest, " << slots.name(i);
}

void check_needs(const Subject& s, const Element& element, const StateBuffer& state, Random& random) {
  const Slots slots(element);
  const Vector r = residual_of(element, state);
  for (std::size_t j = 0; j < slots.count(); ++j) {
    if (slots.ground(j) || slots.needed(j)) continue;
    StateBuffer moved = state;
    for (Level level : {Level::position, Level::velocity, Level::acceleration})
      moved.add(j, level, size_of(s, slots.kind(j), level) * uniform(random));
    EXPECT_EQ(residual_of(element, moved), r) << "depends on an unknown it did not ask for: " << slots.name(j);
  }
}

void check_parts(const Element& element, const StateBuffer& state) {
  const Weights all{0.7, 0.3, 0.2, 0.9};
  const Vector whole = tangent_of(element, state, all), k = tangent_of(element, state, {1, 0, 0, 0}),
               c = tangent_of(element, state, {0, 1, 0, 0}), m = tangent_of(element, state, {0, 0, 1, 0}),
               b = tangent_of(element, state, {0, 0, 0, 1});
  double largest = 0;
  const auto sum = [&](std::size_t i) { return all.q * k[i] + all.v * c[i] + all.a * m[i] + all.multipliers * b[i]; };
  for (std::size_t i = 0; i < whole.size(); ++i) largest = std::max(largest, std::abs(k[i]) + std::abs(c[i]) + std::abs(m[i]));
  for (std::size_t i = 0; i < whole.size(); ++i)
    ASSERT_NEAR(whole[i], sum(i), 1e-12 * (largest + std::abs(b[i])))
        << "K, C, M and the multipliers' columns apart: entry " << i;
}

void check_mass(const Subject& s, const Element& element, StateBuffer state, Random& random) {
  std::fill(state.multipliers.begin(), state.multipliers.end(), 0.0);
  state.penalty = 0;
  const auto total = [&](const Vec3& acceleration, const Vec3& gravity) {
    for (NodeState& node : state.nodes) {
      node.v = node.W = node.A = Vec3::Zero();
      node.a = acceleration;
    }
    state.gravity = gravity;
    const Vector r = residual_of(element, state);
    Vec3 force = Vec3::Zero();
    for (std::size_t i = 0; i < state.nodes.size(); ++i) force += Vec3(r[6 * i], r[6 * i + 1], r[6 * i + 2]);
    return force;
  };
  const Vec3 a = uniform_vector(s, random), g = uniform_vector(s, random), none = Vec3::Zero();
  const double m = *s.mass;
  const Vec3 internal = total(none, none);
  EXPECT_LE((total(a, none) - internal - m * a).norm(), 1e-13 * (std::abs(m) + internal.norm())) << "resistance to acceleration";
  EXPECT_LE((total(none, g) - internal + m * g).norm(), 1e-13 * (std::abs(m) + internal.norm())) << "weight";
}

void check_swap(const Subject& s, const Element& element, const StateBuffer& state) {
  const auto swapped = s.build_swapped();
  ASSERT_NE(swapped, nullptr);
  StateBuffer other(*swapped, s.nodes);
  other.time = state.time;
  other.gravity = state.gravity;
  other.penalty = state.penalty;
  std::map<int, std::size_t> index;
  for (std::size_t i = 0; i < state.ids.size(); ++i) index[state.ids[i]] = i;
  for (std::size_t i = 0; i < other.ids.size(); ++i) {
    other.nodes[i] = state.nodes[index.at(other.ids[i])];
    other.turn(i, other.nodes[i].R, Vec3::Zero());
  }
  if (s.carry) {
    s.carry(state, other);
  } else {
    other.scalars = state.scalars;
    other.scalar_rates = state.scalar_rates;
    other.scalar_accelerations = state.scalar_accelerations;
    other.multipliers = state.multipliers;
  }
  const Slots slots(element);
  const Vector r = residual_of(element, state), q = residual_of(*swapped, other);
  const Vector scale = largest_by_kind(slots, r);
  for (std::size_t i = 0; i < other.ids.size(); ++i)
    for (std::size_t c = 0; c < 6; ++c) {
      const std::size_t slot = 6 * index.at(other.ids[i]) + c;
      EXPECT_NEAR(q[6 * i + c], r[slot], 1e-12 * (scale[slots.kind(slot)] + 1e-300))
          << "with nodes swapped, " << slots.name(slot);
    }
  const Energies e = element.energies(state.view()), f = swapped->energies(other.view());
  EXPECT_NEAR(e.potential, f.potential, 1e-12 * std::abs(e.potential));
  EXPECT_NEAR(e.kinetic, f.kinetic, 1e-12 * std::abs(e.kinetic));
  EXPECT_NEAR(e.dissipated, f.dissipated, 1e-12 * std::abs(e.dissipated));
}

void check_finite(const Element& element, const StateBuffer& state) {
  const std::size_t m = state.multipliers.size();
  expect_all_finite(residual_of(element, state), "residual");
  expect_all_finite(tangent_of(element, state, {1, 1, 1}), "tangent");
  Vector phi(m), rate(m), second(m);
  element.constraint_rates(state.view(), phi, rate, second);
  expect_all_finite(phi, "Φ");
  expect_all_finite(rate, "dΦ/dt");
  expect_all_finite(second, "d²Φ/dt²");
  const Energies e = element.energies(state.view());
  expect_all_finite({e.kinetic, e.potential, e.dissipated, e.external}, "energies");
  EXPECT_GE(e.kinetic, 0);
  Vector values(element.channels().size());
  element.observe(state.view(), values);
  expect_all_finite(values, "channels");
  Vector scalars = state.scalars, history = state.history;
  element.commit(state.view(), scalars, history);
  expect_all_finite(scalars, "scalars after commit");
  expect_all_finite(history, "history after commit");
}

bool on_ground(const Element& element) {
  const auto& ids = element.layout().nodes;
  return std::find(ids.begin(), ids.end(), 0) != ids.end();
}

}  // namespace

void run_suite(const Subject& s) {
  SCOPED_TRACE(s.name);
  for (const auto& [check, reason] : s.skip) EXPECT_FALSE(reason.empty()) << "a check is skipped without a reason";
  const auto element = s.build(Mat3::Identity());
  ASSERT_NE(element, nullptr);
  const auto runs = [&](Check check) { return !s.skip.contains(check); };
  const bool ground = on_ground(*element);

  Random random(20240611);
  if (runs(Check::zero)) check_zero(s, *element);
  if (runs(Check::rigid) && !ground) check_rigid(s, *element, random);
  for (int i = 0; i < s.states; ++i) {
    SCOPED_TRACE("state " + std::to_string(i));
    const StateBuffer state = random_state(s, *element, random);
    if (runs(Check::finite)) check_finite(*element, state);
    if (runs(Check::tangent)) check_tangent(s, *element, state);
    if (runs(Check::rates)) check_rates(s, *element, state);
    if (runs(Check::ideal)) check_ideal(*element, state);
    if (runs(Check::lagrange)) check_lagrange(s, *element, state);
    if (runs(Check::power)) check_power(s, *element, state);
    if (runs(Check::objectivity) && !ground) check_objectivity(s, *element, state, random);
    if (runs(Check::rotated_copy)) check_rotated_copy(s, *element, state, random);
    if (runs(Check::equilibrium)) check_equilibrium(*element, state);
    if (runs(Check::parts)) check_parts(*element, state);
    if (runs(Check::needs)) check_needs(s, *element, state, random);
    if (runs(Check::mass) && s.mass) check_mass(s, *element, state, random);
    if (runs(Check::swap) && s.build_swapped) check_swap(s, *element, state);
  }
}

void run_extreme(const Subject& s) {
  SCOPED_TRACE(s.name);
  const auto element = s.build(Mat3::Identity());
  ASSERT_NE(element, nullptr);
  Random random(7);
  check_finite(*element, StateBuffer(*element, s.nodes));
  for (int i = 0; i < s.states; ++i) {
    StateBuffer state = random_state(s, *element, random);
    check_finite(*element, state);
    for (std::size_t n = 0; n < state.nodes.size(); ++n)
      if (!state.is_ground(n)) state.turn(n, Mat3::Identity(), 2e6 * std::numbers::pi * uniform_vector(random));
    check_finite(*element, state);
  }
}

}  // namespace engrane::suite
