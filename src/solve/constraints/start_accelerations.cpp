// SPDX-License-Identifier: BSD-3-Clause
// Accelerations and multipliers at a start, also where something is stiffer than a step resolves.
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "solve/constraints/constraint_factors.hpp"
#include "solve/constraints/diagnosis.hpp"
#include "solve/constraints/start.hpp"

namespace engrane::solve {

namespace {

void note_accelerations(const Assembler& assembler, const Configuration& c, int iterations, StartReport& report) {
  report.accelerations_found = true;
  report.acceleration_iterations = iterations;
  report.largest_acceleration = report.largest_force = 0;
  std::size_t most = 0;
  // translations say more than rotations, and forces more than moments; they have no common unit
  for (const bool turning : {false, true}) {
    if (report.largest_acceleration > 0) break;
    for (std::size_t i = 1; i < c.nodes.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const double a = std::abs((turning ? c.nodes[i].A : c.nodes[i].a)[k]);
        if (a <= report.largest_acceleration) continue;
        report.largest_acceleration = a;
        most = 6 * i + static_cast<std::size_t>(turning ? 3 + k : k);
      }
  }
  if (report.largest_acceleration > 0) report.accelerated_most = slot_name(assembler.model(), most);
  int carried = -1;
  for (const Measure measure : {Measure::length, Measure::angle}) {
    if (report.largest_force > 0) break;
    for (std::size_t m = 0; m < c.multipliers.size(); ++m) {
      const Unknown& u = assembler.numbering().multiplier(static_cast<int>(m));
      if (u.measure != measure || std::abs(c.multipliers[m]) <= report.largest_force) continue;
      report.largest_force = std::abs(c.multipliers[m]);
      carried = u.slot;
    }
  }
  if (carried >= 0) report.carried_most = assembler.numbering().describe(assembler.numbering().equation(carried));
}

[[noreturn]] void refuse_not_finite(Assembler& assembler, const Configuration& c) {
  throw SolutionFailure(fmt::format("forces at t = {:.6g} are not finite: {}", c.time, explain_not_finite(assembler, c)));
}

/// Displacement from rest by a mean acceleration over a step of h, over that acceleration, by the trapezoidal rule.
double give_of(double h) { return h * h / 4; }

using Matrix = Eigen::MatrixXd;

/// States with shorter lags than a step over this begin where they are after the lag: what is lost with it is a tenth of the
/// work of a step at most. No round number, since rounding would decide for lags that are a round part of a step.
constexpr double lags_in_a_step = std::numbers::pi * std::numbers::pi;

/// The states of one controller and their equations.
struct SignalRows {
  const Assembler& assembler;
  int part;
  Eigen::Index first;  ///< index into Configuration::scalars

  const Element& element() const { return *assembler.model().part(part).element; }
  Eigen::Index size() const { return static_cast<Eigen::Index>(element().layout().scalars.size()); }

  /// Their tangent with these weights.
  Matrix block(const Configuration& c, const Weights& weights) const {
    const Eigen::Index slots = element().layout().slots(), begin = element().layout().node_slots();
    const Assembler::ElementTangent local = assembler.element_tangent(part, c, weights);
    return Eigen::Map<const Matrix>(local.k.data(), slots, slots).transpose().block(begin, begin, size(), size());
  }
  /// Their residual if they were zero and at rest.
  Eigen::VectorXd without_states(const Configuration& c) const {
    const std::vector<double> none(static_cast<std::size_t>(size()), 0.0);
    State state = assembler.view(part, c);
    state.scalars = state.scalar_rates = state.scalar_accelerations = none;
    std::vector<double> r(static_cast<std::size_t>(element().layout().slots()));
    element().residual(state, r);
    return Eigen::Map<const Eigen::VectorXd>(r.data() + element().layout().node_slots(), size());
  }
};

std::vector<SignalRows> signals_of(const Assembler& assembler) {
  std::vector<SignalRows> found;
  for (const Unknown& u : assembler.numbering().unknowns())
    if (!u.multiplier && u.signal && (found.empty() || found.back().part != u.part))
      found.push_back({assembler, u.part, assembler.numbering().scalar_begin(u.part)});
  return found;
}

/// Projection onto what dx/dt = A x damps faster than by `rate`: (I + sign(−A/rate − I))/2, the sign by Newton's iteration, which
/// does not mind multiple poles.
Matrix part_beyond(const Matrix& A, double rate) {
  constexpr int most_iterations = 100;
  const Matrix one = Matrix::Identity(A.rows(), A.rows());
  Matrix sign = -A / rate - one;
  for (int i = 0; i < most_iterations; ++i) {
    const Matrix next = 0.5 * (sign + sign.inverse());
    const double change = (next - sign).norm();
    sign = next;
    if (!(change > 1e-12 * sign.norm())) break;
  }
  return sign.allFinite() ? Matrix(0.5 * (one + sign)) : Matrix(0 * one);
}

}  // namespace

double Start::noise_of_missing_inertia(const Configuration& c) const {
  constexpr double rounding = 100 * std::numeric_limits<double>::epsilon();
  const double extent = assembler_.model().extent();
  double fastest = 0;  // as an angular velocity
  for (const NodeState& node : c.nodes) fastest = std::max({fastest, node.v.norm() / extent, node.W.norm()});
  return rounding * assembler_.missing_inertia() * fastest * fastest;
}

void Start::verify_balance(const Configuration& c, std::span<const double> unbalanced) {
  constexpr double enough = 1e-6;
  const Numbering& numbering = assembler_.numbering();
  // without friction such accelerations always exist
  const auto& parts = assembler_.model().parts;
  if (std::none_of(parts.begin(), parts.end(), [](const Model::Part& part) { return part.element->layout().has_friction(); }))
    return;
  assembler_.residual(c, right_);
  const double extent = assembler_.model().extent();
  Magnitudes largest;
  for (int e = 0; e < numbering.equations(); ++e)
    if (const Unknown& u = numbering.unknown(e); !u.multiplier)
      largest[u.measure] = std::max(largest[u.measure], assembler_.carried()[static_cast<std::size_t>(e)]);
  // forces that cancel inside a body are no loads, but leave their rounding behind: gyroscopic moments are of the size of the
  // kinetic energy
  double kinetic = 0;
  for (std::size_t p = 0; p < parts.size(); ++p)
    kinetic += parts[p].element->energies(assembler_.view(static_cast<int>(p), c)).kinetic;
  largest[Measure::moment] = std::max(largest[Measure::moment], kinetic);
  const Magnitudes own = largest;
  largest[Measure::force] = std::max(own[Measure::force], own[Measure::moment] / extent);
  largest[Measure::moment] = std::max(own[Measure::moment], own[Measure::force] * extent);
  const double noise = noise_of_missing_inertia(c);
  int worst = -1;
  double most = enough;
  for (int e = 0; e < numbering.equations(); ++e) {
    const Unknown& u = numbering.unknown(e);
    const double left = std::abs(unbalanced[static_cast<std::size_t>(e)]), part = left / largest[u.measure];
    if (u.multiplier || !(part > most) || left < noise / (u.measure == Measure::force ? extent : 1)) continue;
    most = part;
    worst = e;
  }
  if (worst < 0) return;
  const double left = std::abs(unbalanced[static_cast<std::size_t>(worst)]), carried = largest[numbering.measure(worst)];
  throw SolutionFailure(fmt::format(
      "no accelerations balance the forces at t = {:.6g}: {} is unbalanced by {:.3g} of {:.3g}. The friction jams: it raises the "
      "contact forces that cause it faster than they can be balanced. Reduce the friction, or lengthen the guide of a slider "
      "(LENGTH) or apply the load closer to its axis",
      c.time, numbering.describe(worst), left, carried));
}

Configuration Start::moved_along(const Configuration& c, double give) const {
  std::vector<double> y = motion_.accelerations(c);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] *= assembler_.numbering().equation(static_cast<int>(i)) < 0 ? 0 : give;
  Configuration moved = c;
  motion_.move(c, y, moved);
  return moved;
}

double Start::largest_force(std::span<const double> by_slot) const {
  double largest = 0, square = 0;
  std::size_t group = 0;
  for (const Unknown& u : assembler_.numbering().unknowns()) {
    if (u.multiplier || u.signal) continue;
    const auto slot = static_cast<std::size_t>(u.slot);
    const std::size_t own = slot < 6 * assembler_.model().nodes.size() ? slot / 3 : slot;
    if (own != group) square = 0;
    group = own;
    const double part = by_slot[slot] / (u.rotational() ? assembler_.model().extent() : 1);
    square += part * part;
    if (!std::isfinite(square)) return square;
    largest = std::max(largest, square);
  }
  return std::sqrt(largest);
}

bool Start::overshoots(const Configuration& c, double h) const {
  Configuration still = c;
  motion_.set_accelerations(std::vector<double>(motion_.size(), 0.0), still);
  const auto here = assembler_.slot_residual(c), resting = assembler_.slot_residual(still);
  // from halfway on: at an event a law may jump, which is no stiffness
  const auto half_way = assembler_.slot_residual(moved_along(c, give_of(h) / 2)),
             there = assembler_.slot_residual(moved_along(c, give_of(h)));
  std::vector<double> changed(here.size()), inertial(here.size());
  for (std::size_t slot = 0; slot < here.size(); ++slot) {
    changed[slot] = 2 * (there[slot] - half_way[slot]);
    inertial[slot] = resting[slot] - here[slot];
  }
  const double change = largest_force(changed), inertia = largest_force(inertial);
  if (!std::isfinite(change)) return true;
  // along a vibration forces change by ω² h²/4 times M a; steps cannot resolve a period shorter than two of them
  return change > std::numbers::pi * std::numbers::pi / 4 * inertia;
}

bool Start::soften(Configuration& c, double h, StartReport* report, const MasslessMotions* massless) {
  if (!overshoots(c, h)) return false;
  Configuration softer = at_start_of_step(c);
  StartReport found = report ? *report : StartReport();
  try {
    if (!balance_softly(softer, give_of(h), report ? &found : nullptr, massless)) return false;
  } catch (const SolutionFailure&) {
    return false;  // a law that ends near here, for example
  }
  c = std::move(softer);
  found.softened = true;
  if (report) *report = std::move(found);
  return true;
}

// Controllers need two remedies. Softened accelerations leave states where they are, as those of a motion that goes on behind an
// event have to be; but a rate that sets in with the run would still be an effort of order one or more in its first step. States
// placed after their lags avoid that, but lose the work of the lag: too much from a tenth of a step on, where the first is
// enough.
bool Start::soften_signals(Configuration& c, double h) const {
  // for one lag: shorter than h/π, as periods are that soften() looks for
  constexpr double half = 1 + std::numbers::pi / 2, unresolved = half * half - 1;
  std::vector<double> a = motion_.accelerations(c);
  bool any = false;
  for (const SignalRows& rows : signals_of(assembler_)) {
    const Matrix mass = rows.block(c, {0, 0, 1}), soft = rows.block(c, {give_of(h), h / 2, 1});
    // the rates of states depend on no accelerations, and no force depends on theirs
    if (!(mass.partialPivLu().solve(soft - mass).cwiseAbs().rowwise().sum().maxCoeff() > unresolved)) continue;
    any = true;
    Eigen::Map<Eigen::VectorXd> own(a.data() + 6 * assembler_.model().nodes.size() + rows.first, rows.size());
    own = soft.partialPivLu().solve(mass * own).eval();
  }
  if (any) motion_.set_accelerations(a, c);
  return any;
}

bool Start::settle_signals(Configuration& c, const Configuration& later, double span, double h) const {
  bool any = false;
  for (const SignalRows& rows : signals_of(assembler_)) {
    // dx/dt = A x + b of the states x = ż + κ z, from their equations (z̈ − dx/dt)/κ + ż = 0
    const Eigen::VectorXd pace = rows.block(c, {0, 0, 1}).diagonal().cwiseInverse();
    const Matrix one = Matrix::Identity(rows.size(), rows.size()), A = pace.asDiagonal() * (one - rows.block(c, {0, 1, 0}));
    const Matrix fast = part_beyond(A, lags_in_a_step / h);
    if (!(fast.trace() > 0.5)) continue;  // its rank
    any = true;
    const Eigen::VectorXd b = -pace.cwiseProduct(rows.without_states(c)),
                          b_later = -pace.cwiseProduct(rows.without_states(later));
    // x = −A⁻¹ (b + A⁻¹ ḃ) where A is fast
    const auto inverse = Matrix(A * fast - (one - fast)).partialPivLu();
    const Eigen::VectorXd rate = -inverse.solve((b_later - b) / span), there = inverse.solve(rate - b);
    Eigen::Map<Eigen::VectorXd> z(c.scalars.data() + rows.first, rows.size()), v(c.scalar_rates.data() + rows.first, rows.size());
    const Eigen::VectorXd before = v + pace.cwiseProduct(z), x = before + fast * (there - before);
    v += fast * (rate.cwiseQuotient(pace) - v).eval();
    z = (x - v).cwiseQuotient(pace);
  }
  return any;
}

std::vector<double> Start::out_of_balance(const Configuration& c, const MasslessMotions* massless) {
  const Numbering& numbering = assembler_.numbering();
  std::vector<double> r = assembler_.slot_residual(c), phi, rate, second;
  if (massless) massless->remove_forces(r);
  assembler_.constraint_rates(c, phi, rate, second);
  std::vector<double> lack(static_cast<std::size_t>(numbering.equations()));
  for (std::size_t e = 0; e < lack.size(); ++e) {
    const Unknown& u = numbering.unknown(static_cast<int>(e));
    const int m = u.slot - numbering.motion_slots();
    if (!u.multiplier)
      lack[e] = -r[static_cast<std::size_t>(u.slot)];
    else if (assembler_.released(m))
      lack[e] = assembler_.released_value(m) - c.multipliers[static_cast<std::size_t>(m)];
    else
      lack[e] = second[static_cast<std::size_t>(m)];
  }
  return lack;
}

std::vector<double> Start::solve_balance(std::vector<double>& right, Configuration& c, const MasslessMotions* massless) {
  std::vector<double> change, motion(motion_.size(), 0.0);
  if (!solve(right, change))
    throw SolutionFailure(explain_singular(assembler_, "the accelerations at the start are not determined"));
  for (std::size_t e = 0; e < right.size(); ++e) {
    const Unknown& u = assembler_.numbering().unknown(static_cast<int>(e));
    if (u.multiplier)
      c.multipliers[static_cast<std::size_t>(u.slot) - motion_.size()] += change[e];
    else
      motion[static_cast<std::size_t>(u.slot)] = change[e];
  }
  if (massless) massless->remove(motion);
  return motion;
}

bool Start::balance_softly(Configuration& c, double give, StartReport* report, const MasslessMotions* massless) {
  constexpr int most_iterations = 12;
  constexpr double settled = 1e-3;  // rounding of stiff meshes leaves 1e-6
  std::vector<double> a(motion_.size(), 0.0);
  if (massless) {  // no balance gives them back
    a = motion_.accelerations(c);
    massless->keep(a);
  }
  motion_.prescribe_accelerations(c.time, a);
  Configuration still = c;
  motion_.set_accelerations(a, still);
  std::vector<double> last;
  double change = std::numeric_limits<double>::infinity();
  const std::vector<double> gives(assembler_.model().parts.size(), give);
  // repeated where forces depend on the multipliers, as in balance_accelerations
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    // the whole of the accelerations is sought each time: forces follow them only through the stiffness in the matrix
    std::vector<double> right = out_of_balance(still, massless);
    if (!std::isfinite(largest(right))) refuse_not_finite(assembler_, still);
    assembler_.projection(still, Assembler::Metric::dynamic, {}, assembler_.matrix(), gives);
    std::vector<double> found = solve_balance(right, still, massless);
    for (std::size_t i = 0; i < a.size(); ++i) found[i] += a[i];
    c.multipliers = still.multipliers;
    motion_.set_accelerations(found, c);
    if (report) note_accelerations(assembler_, c, iteration, *report);
    if (c.multipliers.empty()) return true;
    const double before = change;
    if (!last.empty()) change = 0;
    for (std::size_t i = 0; i < last.size(); ++i) change = std::max(change, std::abs(found[i] - last[i]));
    if (change == 0 || (iteration > 1 && change >= 0.5 * before)) break;
    last = std::move(found);
  }
  redundancy_.share(c, true);
  return change <= settled * largest(last);
}

void Start::balance_accelerations(Configuration& c, int most_iterations, StartReport* report, const MasslessMotions* massless) {
  std::vector<double> a = motion_.accelerations(c);
  motion_.prescribe_accelerations(c.time, a);
  motion_.set_accelerations(a, c);
  // once is enough where forces depend linearly on the multipliers
  constexpr int most_passes = 6;
  int iteration = 0;
  for (int pass = 0; pass < most_passes; ++pass) {
    std::vector<double> right;
    const bool balanced = balance_as_shared(c, a, right, iteration, iteration + most_iterations, report, massless);
    if (redundancy_.share(c, pass + 1 == most_passes)) continue;
    if (balanced) verify_balance(c, right);
    return;
  }
}

bool Start::balance_as_shared(Configuration& c, std::vector<double>& a, std::vector<double>& right, int& iteration, int end,
                              StartReport* report, const MasslessMotions* massless) {
  const int begin = iteration;
  // linear but for forces that depend on the multipliers (|λ| of the separating force), hence a short iteration; where λ changes
  // its sign, it may lead away once or twice
  constexpr double rounding = 1e-10;
  constexpr int most_idle = 2;
  double least = std::numeric_limits<double>::infinity(), most = 0;
  int idle = 0;
  for (; iteration < end; ++iteration) {
    right = out_of_balance(c, massless);
    const double size = largest(right);
    if (report) note_accelerations(assembler_, c, iteration, *report);
    if (!std::isfinite(size)) refuse_not_finite(assembler_, c);
    if (size == 0) return true;
    most = std::max(most, size);
    idle = size < 0.5 * least ? 0 : idle + 1;
    least = std::min(least, size);
    if (iteration > begin + 1 && idle > (size <= rounding * most ? 0 : most_idle)) return true;
    // without multipliers nothing in the matrix depends on the unknowns
    if (iteration == begin || !c.multipliers.empty())
      assembler_.projection(c, Assembler::Metric::dynamic, {}, assembler_.matrix());
    const std::vector<double> change = solve_balance(right, c, massless);
    for (std::size_t i = 0; i < a.size(); ++i) a[i] += change[i];
    motion_.set_accelerations(a, c);
  }
  return false;
}

}  // namespace engrane::solve
