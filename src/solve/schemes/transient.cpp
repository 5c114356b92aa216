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

namespace {

/// A step longer than this many times the one before has a memory of its own.
constexpr double longest_growth = 3;

AlphaScheme coefficients(const SolverOptions& options) {
  switch (options.family) {
    case SolverOptions::Family::newmark:
      return AlphaScheme::newmark();
    case SolverOptions::Family::hht:
      return AlphaScheme::hht(options.damping);
    case SolverOptions::Family::bossak:
      return AlphaScheme::bossak(options.damping);
    case SolverOptions::Family::chung:
      break;
  }
  return AlphaScheme::chung(options.damping);
}

}  // namespace

Transient::Transient(SolverContext& context)
    : Scheme(context), scheme_(coefficients(context.options)), changes_(context.assembler, context.newton, context.motion) {
  *unknowns_.out() = context.assembler.new_vector();
}

Configuration Transient::glide(const Configuration& c, double h) const {
  const auto v = context_.motion.velocities(c), a = context_.motion.accelerations(c);
  std::vector<double> y(v.size()), ahead(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) {
    y[i] = h * (v[i] + 0.5 * h * a[i]);
    ahead[i] = v[i] + h * a[i];
  }
  Configuration later = c;
  later.time = c.time + h;
  prescribe_step(c.time, later.time, y);
  for (const auto& p : context_.motion.prescribed(later.time)) ahead[p.slot] = p.v;
  context_.motion.move(c, y, later);
  context_.motion.set_velocities(ahead, later);
  return later;
}

const MasslessMotions* Transient::massless_at(const Configuration& c) {
  if (!has_massless_) return nullptr;
  return &massless_.emplace(context_.assembler, c);
}

void Transient::drift(Configuration& c, double h) {
  // Heun's step. Both accelerations fit the constraints, so their mean does; the constraints open by a third of the cube of
  // a hundredth of a step at most, and the next step closes them.
  const auto before = context_.motion.accelerations(c);
  c = glide(c, h);
  const MasslessMotions* massless = massless_at(c);
  context_.start.balance_accelerations(c, 2, nullptr, massless);
  auto v = context_.motion.velocities(c);
  const auto after = context_.motion.accelerations(c);
  for (std::size_t i = 0; i < v.size(); ++i) v[i] += 0.5 * h * (after[i] - before[i]);
  for (const auto& p : context_.motion.prescribed(c.time)) v[p.slot] = p.v;
  context_.motion.set_velocities(v, c);
  if (constrained()) {
    context_.motion.set_velocities(fitting_velocities(c), c);
    context_.start.balance_accelerations(c, 2, nullptr, massless);
  }
  restart_memory(c);
}

bool Transient::settle_friction(Configuration& c) {
  if (!context_.grips.violated(c)) return false;
  context_.grips.settle(c, has_massless_);
  context_.solver.reset();  // other constraints, other pivots
  restart_memory(c);
  return true;
}

void Transient::refine_grips(Configuration& c) {
  // multipliers of a step are those of the balance between its ends; the force at which a grip gives way is that of its end
  Configuration balanced = c;
  context_.start.balance_accelerations(balanced, 3, nullptr, massless_at(c));
  c.multipliers = std::move(balanced.multipliers);
  context_.solver.reset();
}

Outcome Transient::attempt(const Configuration& from, double h, Configuration& to) {
  const auto [am, af, beta, gamma] = scheme_;
  const Weights weights{1, gamma / (beta * h), (1 - am) / ((1 - af) * beta * h * h)};
  // only the order of magnitude of k matters: steps of a little less than H need no other
  if (!(h > 0.3 * scaled_for_ && h < 3 * scaled_for_)) {
    context_.assembler.choose_scale(from, weights, context_.options.scale);
    scaled_for_ = h;
  }
  const auto vdot0 = context_.motion.accelerations(from);
  // a run that continues another kind of analysis has no memory: the accelerations of its configuration begin it
  if (algorithmic_.empty()) {
    algorithmic_ = vdot0;
    step_of_algorithmic_ = h;
  }
  if (h > longest_growth * step_of_algorithmic_) renew_memory(from, h);
  const std::vector<double> v0 = first_velocities(from, h);
  std::vector<double> a0 = algorithmic_;
  // a_n is v̇ shifted by (α_m − α_f) h: another h, another shift
  if (h != step_of_algorithmic_)
    for (std::size_t i = 0; i < a0.size(); ++i) a0[i] = vdot0[i] + h / step_of_algorithmic_ * (a0[i] - vdot0[i]);

  const std::size_t n = context_.motion.size();
  std::vector<double> y(n), unknown(n), v(n), vdot(n);
  tried_.resize(n);
  if (accelerations_.empty()) {
    accelerations_.add(from.time, a0);
    multipliers_.add(from.time, from.multipliers);
  }
  std::vector<double> ahead(n);
  accelerations_.at(from.time + h, ahead);
  for (std::size_t i = 0; i < n; ++i) y[i] = h * (v0[i] + h * ((0.5 - beta) * a0[i] + beta * ahead[i]));
  to = from;
  to.time = from.time + h;
  to.h = h;
  for (std::size_t slot = 0; slot < n; ++slot)
    if (context_.numbering.equation(static_cast<int>(slot)) < 0) y[slot] = 0;
  prescribe_step(from.time, to.time, y);
  // Newton's iteration finds no drive's angle more than half a turn away, and would not say why
  std::vector<double> coasting(n);
  for (std::size_t i = 0; i < n; ++i) coasting[i] = h * v0[i];
  NewtonReport foreseen;
  foreseen.converged = true;
  refuse_half_turns(coasting, foreseen);
  if (!foreseen.converged) return {std::move(foreseen), 0, {}};
  const auto prescribed = context_.motion.prescribed(to.time);

  // Unknowns are what increments differ by from those predicted: accelerations found from increments of short steps would be
  // rounding. Of steps so long that predictions leave the machine they are the increments, which would be rounding otherwise.
  const std::vector<double> predicted = y;
  const bool far = leaves(predicted);
  std::vector<double> guess(static_cast<std::size_t>(context_.numbering.equations()), 0.0);
  if (far) context_.motion.gather(predicted, guess);
  multipliers_.at(to.time, to.multipliers);
  multipliers_to_unknowns(to, guess);
  changes_.begin(from);

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
    // constraints that are closed by positions do not see what these leave out, and would let it drift
    if (constrained() && !changes_.any()) std::fill(c.remainders.begin(), c.remainders.end(), 0.0);
    context_.motion.set_velocities(v, c);
    context_.motion.set_accelerations(vdot, c);
    unknowns_to_multipliers(unknowns, c);
    changes_.state(from, h, y);
  };
  context_.assembler.spread(guess, unknowns_);
  NewtonReport report = solve(unknowns_, weights, apply, to, context_.options.keep_factors);
  changes_.end();
  refuse_half_turns(y, report);
  if (report.converged && context_.grips.strained(to)) refine_grips(to);
  tried_step_ = h;
  tried_time_ = to.time;
  tried_multipliers_ = to.multipliers;
  return {std::move(report), 0, {}};
}

bool Transient::leaves(std::span<const double> increments) const {
  const double extent = context_.model.extent();
  for (const Unknown& u : context_.numbering.unknowns())
    if (!u.multiplier && !(std::abs(increments[static_cast<std::size_t>(u.slot)]) < size_of(u, extent))) return true;
  return false;
}

void Transient::accept() {
  accelerations_.add(tried_time_, tried_);
  multipliers_.add(tried_time_, tried_multipliers_);
  algorithmic_ = tried_;
  step_of_algorithmic_ = tried_step_;
  offset_.clear();
  fitting_.clear();
}

void Transient::save(Snapshot& snapshot) const {
  snapshot.put("scheme/algorithmic", algorithmic_);
  snapshot.put("scheme/offset", offset_);
  accelerations_.save(snapshot, "scheme/accelerations");
  multipliers_.save(snapshot, "scheme/multipliers");
  snapshot.put("scheme/step", step_of_algorithmic_);
  snapshot.put("scheme/scaled_for", scaled_for_);
  snapshot.put("scheme/has_massless", has_massless_ ? 1.0 : 0.0);
}

void Transient::load(const Snapshot& snapshot) {
  if (!snapshot.has("scheme/algorithmic")) return;  // of another kind of analysis
  algorithmic_ = snapshot.array("scheme/algorithmic");
  offset_ = snapshot.array("scheme/offset");
  accelerations_.load(snapshot, "scheme/accelerations");
  multipliers_.load(snapshot, "scheme/multipliers");
  fitting_.clear();
  step_of_algorithmic_ = snapshot.number("scheme/step");
  scaled_for_ = snapshot.number("scheme/scaled_for");
  has_massless_ = snapshot.number("scheme/has_massless") != 0;
}

}  // namespace engrane::solve
