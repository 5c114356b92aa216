// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/transient.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solve/constraints/constraint_factors.hpp"

namespace engrane::solve {

AlphaScheme AlphaScheme::chung(double rho) {
  AlphaScheme s;
  s.alpha_m = (2 * rho - 1) / (rho + 1);
  s.alpha_f = rho / (rho + 1);
  s.gamma = 0.5 + s.alpha_f - s.alpha_m;
  s.beta = 0.25 * (s.gamma + 0.5) * (s.gamma + 0.5);
  return s;
}

AlphaScheme AlphaScheme::newmark() { return {0, 0, 0.25, 0.5}; }

AlphaScheme AlphaScheme::hht(double alpha) { return {0, alpha, 0.25 * (1 + alpha) * (1 + alpha), 0.5 + alpha}; }

AlphaScheme AlphaScheme::bossak(double alpha) { return {-alpha, 0, 0.25 * (1 + alpha) * (1 + alpha), 0.5 + alpha}; }

double AlphaScheme::gain_of_noise() const {
  constexpr int most = 1000;        // steps
  constexpr double largest = 5000;  // as with ρ∞ = 0.99: it grows without end where nothing is damped
  // a/δ = C/h² (z − 1)² (z + m) / ((z + f)(z² + s z + p)), with C = (1 − α_m)/((1 − α_f) β) that of the step itself
  const double m = alpha_m / (1 - alpha_m), f = alpha_f / (1 - alpha_f);
  const double s = (0.5 + gamma - 2 * beta) / beta, p = (0.5 - gamma + beta) / beta;
  const double driven[] = {1, m - 2, 1 - 2 * m, m}, own[] = {s + f, p + s * f, p * f};
  double last[3] = {0, 0, 0}, squares = 0;
  for (int k = 0; k < most; ++k) {
    const double response = (k < 4 ? driven[k] : 0) - own[0] * last[0] - own[1] * last[1] - own[2] * last[2];
    squares += response * response;
    last[2] = std::exchange(last[1], std::exchange(last[0], response));
  }
  return std::min(std::sqrt(squares), largest);
}

namespace {

/// A step longer than this many times the one before restarts the memory. Steps that follow their error double again and again
/// behind an event: what the first ones have left in the memory would grow by the square of their length, and forces swing. Steps
/// of H double a few times at most, and a new beginning leaves more than they do.
constexpr double longest_growth = 3, longest_controlled_growth = 1.6;

AlphaScheme coefficients(const SolverOptions& options) {
  switch (options.family) {
    case SolverOptions::Family::newmark:
      return AlphaScheme::newmark();
    case SolverOptions::Family::hht:
      return AlphaScheme::hht(options.damping);
    case SolverOptions::Family::bossak:
      return AlphaScheme::bossak(options.damping);
    case SolverOptions::Family::chung:
    case SolverOptions::Family::radau:  // another class
      break;
  }
  return AlphaScheme::chung(options.damping);
}

}  // namespace

Transient::Transient(SolverContext& context)
    : Dynamics(context),
      scheme_(coefficients(context.options)),
      changes_(context.assembler, context.newton, context.motion, scheme_.gain_of_noise()) {}

Outcome Transient::attempt(const Configuration& from, double h, Configuration& to) {
  const double am = scheme_.alpha_m, af = scheme_.alpha_f, beta = scheme_.beta, gamma = scheme_.gamma;
  const Weights weights{1, gamma / (beta * h), (1 - am) / ((1 - af) * beta * h * h)};
  scale_for(from, h, weights);
  auto vdot0 = context_.motion.accelerations(from);
  // a run that continues another kind of analysis has no memory: the accelerations of its configuration start it
  if (algorithmic_.empty()) {
    algorithmic_ = vdot0;
    step_of_algorithmic_ = h;
  }
  const bool controlled = context_.options.tolerance > 0;
  if (h > (controlled ? longest_controlled_growth : longest_growth) * step_of_algorithmic_) vdot0 = renew_memory(from, h);
  const std::vector<double> v0 = first_velocities(from, h);
  std::vector<double> a0 = algorithmic_;
  // a_n is v̇ shifted by (α_m − α_f) h: another h, another shift
  if (h != step_of_algorithmic_)
    for (std::size_t i = 0; i < a0.size(); ++i) a0[i] = vdot0[i] + h / step_of_algorithmic_ * (a0[i] - vdot0[i]);

  const std::size_t n = context_.motion.size();
  std::vector<double> y(n), unknown(n), v(n), vdot(n);
  tried_.resize(n);
  // A prediction so good that nothing is corrected keeps its errors. Where each iteration has its own tangent, and one removes
  // all errors, the last values are used.
  const bool keep = context_.options.keep_factors;
  std::vector<double> ahead = a0;
  if (keep && accelerations_.empty()) {
    accelerations_.add(from.time, a0);
    multipliers_.add(from.time, from.multipliers);
  }
  if (keep) accelerations_.at(from.time + h, h, ahead);
  for (std::size_t i = 0; i < n; ++i) y[i] = h * (v0[i] + h * ((0.5 - beta) * a0[i] + beta * ahead[i]));
  to = from;
  to.time = from.time + h;
  to.h = h;
  for (std::size_t slot = 0; slot < n; ++slot)
    if (context_.numbering.equation(static_cast<int>(slot)) < 0) y[slot] = 0;
  context_.motion.prescribe_increment(from.time, to.time, y);
  NewtonReport foreseen = foresee(v0, h);
  if (!foreseen.converged) return {std::move(foreseen), {}};
  const auto prescribed = context_.motion.prescribed(to.time);

  // The unknowns are the differences of the increments from the predicted ones: accelerations computed from increments of short
  // steps would be rounding. For steps so long that predictions leave the machine they are the increments, since the
  // differences would be rounding.
  const std::vector<double> predicted = y;
  const bool far = leaves(predicted);
  std::vector<double> guess(static_cast<std::size_t>(context_.numbering.equations()), 0.0);
  if (far) context_.motion.gather(predicted, guess);
  if (keep) multipliers_.at(to.time, h, to.multipliers);
  context_.assembler.multipliers_to_unknowns(to, guess);
  changes_.begin(from, predicted);

  const Newton::Apply apply = [&](std::span<const double> unknowns, Configuration& c) {
    context_.motion.scatter(unknowns, unknown);
    for (std::size_t i = 0; i < n; ++i) {
      if (context_.numbering.equation(static_cast<int>(i)) < 0) {
        tried_[i] = v[i] = vdot[i] = 0;
        continue;
      }
      y[i] = far ? unknown[i] : predicted[i] + unknown[i];
      tried_[i] = ahead[i] + (far ? unknown[i] - predicted[i] : unknown[i]) / (beta * h * h);
      v[i] = v0[i] + h * ((1 - gamma) * a0[i] + gamma * tried_[i]);
      vdot[i] = ((1 - am) * tried_[i] + am * a0[i] - af * vdot0[i]) / (1 - af);
    }
    for (const auto& p : prescribed) {
      v[p.slot] = p.v;
      tried_[p.slot] = vdot[p.slot] = p.a;
    }
    context_.motion.move(from, y, c);
    // constraints that are closed by positions do not see the remainders, and would let them drift
    if (constrained() && !changes_.any()) std::fill(c.remainders.begin(), c.remainders.end(), 0.0);
    context_.motion.set_velocities(v, c);
    context_.motion.set_accelerations(vdot, c);
    context_.assembler.unknowns_to_multipliers(unknowns, c);
    changes_.state(from, h, y);
  };
  context_.assembler.spread(guess, unknowns_);
  if (error_.wanted() && constrained()) context_.newton.close_next(error_.may_be_open(v0, h));
  NewtonReport report = solve(unknowns_, weights, apply, to, keep);
  changes_.end();
  refuse_half_turns(y, report);
  if (!report.converged) context_.newton.refuse_last();
  if (report.converged && context_.grips.strained(to)) refine_grips(to);
  tried_step_ = h;
  tried_time_ = to.time;
  tried_multipliers_ = to.multipliers;
  if (error_.wanted() && report.converged) {
    error_.take(context_.motion.velocities(from));
    return {std::move(report), local_error(a0, h, to)};
  }
  return {std::move(report), {}};
}

std::optional<double> Transient::local_error(std::span<const double> a0, double h, const Configuration& to) {
  // with a_n = v̇(t_n + (α_m − α_f) h) a step has the position error h² |1/6 − β − (α_m − α_f)/2| |a_{n+1} − a_n| (for Newmark:
  // Zienkiewicz and Xie 1991)
  const double part = std::abs(1.0 / 6 - scheme_.beta - 0.5 * (scheme_.alpha_m - scheme_.alpha_f));
  std::vector<double> rates(a0.size());
  for (std::size_t i = 0; i < rates.size(); ++i) rates[i] = h * part * (tried_[i] - a0[i]);
  const auto v = context_.motion.velocities(to);
  return std::max(error_.over_tolerance(rates, v, h), error_.over_turn(v, h, order_of_error()));
}

bool Transient::leaves(std::span<const double> increments) const {
  const double extent = context_.model.extent();
  for (const Unknown& u : context_.numbering.unknowns())
    if (!u.multiplier && !(std::abs(increments[static_cast<std::size_t>(u.slot)]) < size_of(u, extent))) return true;
  return false;
}

void Transient::accept() {
  if (context_.options.keep_factors) {
    accelerations_.add(tried_time_, tried_);
    multipliers_.add(tried_time_, tried_multipliers_);
  }
  algorithmic_ = tried_;
  step_of_algorithmic_ = tried_step_;
  offset_.clear();
  fitting_.clear();
}

void Transient::save(Snapshot& snapshot) const {
  Dynamics::save(snapshot);
  snapshot.put("scheme/algorithmic", algorithmic_);
  snapshot.put("scheme/offset", offset_);
  accelerations_.save(snapshot, "scheme/accelerations");
  multipliers_.save(snapshot, "scheme/multipliers");
  snapshot.put("scheme/step", step_of_algorithmic_);
}

void Transient::load(const Snapshot& snapshot) {
  Dynamics::load(snapshot);
  if (!snapshot.has("scheme/algorithmic")) return;  // of another kind of analysis, or of another scheme
  algorithmic_ = snapshot.array("scheme/algorithmic");
  offset_ = snapshot.array("scheme/offset");
  accelerations_.load(snapshot, "scheme/accelerations");
  multipliers_.load(snapshot, "scheme/multipliers");
  fitting_.clear();
  step_of_algorithmic_ = snapshot.number("scheme/step");
}

}  // namespace engrane::solve
