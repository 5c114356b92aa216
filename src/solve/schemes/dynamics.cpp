// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/dynamics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solve/schemes/interpolation.hpp"

namespace engrane::solve {

namespace {

constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();

/// A drift between fixed steps takes accelerations as constant. Accelerations that depend on positions may change the velocity
/// of a coordinate by this fraction of what the drift itself does; a vibration with five periods in a step reaches it in the
/// longest drift. Velocities below the fraction `no_speed` of the fastest of their kind are rounding.
constexpr double most_change = 0.3, no_speed = 1e-9;

}  // namespace

Dynamics::Dynamics(SolverContext& context) : Scheme(context), error_(context.assembler, context.options) {
  *unknowns_.out() = context.assembler.new_vector();
}

class Dynamics::Inside : public Within {
 public:
  Inside(Dynamics& scheme, const Configuration& from, const Configuration& to, std::span<const double> scalars, bool drift)
      : Within(from, to), scheme_(scheme), motion_(scheme.context_.motion, from, to, scalars), drift_(drift) {}

  void at(double time, Configuration& c) override {
    const MotionSlots& slots = scheme_.context_.motion;
    motion_.at(time, now_);
    scheme_.context_.motion.prescribe_increment(from().time, time, now_.y);
    motion_.place(time, now_, c);
    c.h = time - from().time;
    auto v = slots.velocities(c), a = slots.accelerations(c);
    if (drift_) follow_speeds(c.h, v);
    slots.prescribe_rates(time, v);
    slots.prescribe_accelerations(time, a);
    slots.set_velocities(v, c);
    slots.set_accelerations(a, c);
    const double part = c.h / (to().time - from().time);
    for (std::size_t m = 0; m < c.multipliers.size(); ++m)
      c.multipliers[m] += part * (to().multipliers[m] - from().multipliers[m]);
  }

  bool balance(Configuration& c) override { return scheme_.restore_balance(c); }

 private:
  /// Sets the velocities a time `gone` after the beginning to the cubic that has those of both ends and their slopes. A drift
  /// leaves positions accurate to second order only, from which speeds that nearly vanish would not follow.
  void follow_speeds(double gone, std::vector<double>& v) const {
    const MotionSlots& slots = scheme_.context_.motion;
    const double h = to().time - from().time, s = gone / h, r = 1 - s;
    const auto v0 = slots.velocities(from()), v1 = slots.velocities(to()), a0 = slots.accelerations(from()),
               a1 = slots.accelerations(to());
    for (std::size_t i = 0; i < v.size(); ++i)
      v[i] = r * r * ((1 + 2 * s) * v0[i] + s * h * a0[i]) + s * s * ((1 + 2 * r) * v1[i] - r * h * a1[i]);
  }

  Dynamics& scheme_;
  Interpolation motion_;
  Interpolation::Motion now_;
  bool drift_;
};

std::unique_ptr<Within> Dynamics::within(const Configuration& from, const Configuration& to, std::span<const double> scalars,
                                         bool drift) {
  return std::make_unique<Inside>(*this, from, to, scalars, drift);
}

Configuration Dynamics::glide(const Configuration& c, double h) const {
  const auto v = context_.motion.velocities(c), a = context_.motion.accelerations(c);
  std::vector<double> y(v.size()), ahead(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) {
    y[i] = h * (v[i] + 0.5 * h * a[i]);
    ahead[i] = v[i] + h * a[i];
  }
  Configuration later = c;
  later.time = c.time + h;
  context_.motion.prescribe_increment(c.time, later.time, y);
  context_.motion.prescribe_rates(later.time, ahead);
  context_.motion.move(c, y, later);
  context_.motion.set_velocities(ahead, later);
  return later;
}

const MasslessMotions* Dynamics::massless_at(const Configuration& c) {
  if (!has_massless_.value_or(false)) return nullptr;
  return &massless_.emplace(context_.assembler, c);
}

void Dynamics::drift(Configuration& c, double h) {
  // Heun's step. Both accelerations satisfy the constraints, so their mean does. The constraints open by at most a third of the
  // cube of a hundredth of a step, and the next step closes them.
  const auto before = context_.motion.accelerations(c);
  c = glide(c, h);
  const MasslessMotions* massless = massless_at(c);
  context_.start.balance_accelerations(c, 2, nullptr, massless);
  auto v = context_.motion.velocities(c);
  const auto after = context_.motion.accelerations(c);
  for (std::size_t i = 0; i < v.size(); ++i) v[i] += 0.5 * h * (after[i] - before[i]);
  context_.motion.prescribe_rates(c.time, v);
  context_.motion.set_velocities(v, c);
  if (constrained()) {
    context_.motion.set_velocities(fitting_velocities(c), c);
    context_.start.balance_accelerations(c, 2, nullptr, massless);
  }
  restart_memory(c);
}

double Dynamics::drift_error(const Configuration& c, double h) {
  if (!error_.wanted()) return stiff_drift(c, h);
  Configuration later = glide(c, h);
  context_.start.balance_accelerations(later, 2, nullptr, massless_at(c));
  auto rates = context_.motion.accelerations(later);
  const auto before = context_.motion.accelerations(c);
  for (std::size_t i = 0; i < rates.size(); ++i) rates[i] = (rates[i] - before[i]) * h / 6;
  return error_.over_tolerance(rates, context_.motion.velocities(later), h);
}

double Dynamics::stiff_drift(const Configuration& c, double h) {
  Configuration moved = glide(c, h), still = c;
  still.time = moved.time;  // a drift does follow changes of the loads themselves
  const MasslessMotions* massless = massless_at(c);
  context_.start.balance_accelerations(moved, 2, nullptr, massless);
  context_.start.balance_accelerations(still, 2, nullptr, massless);
  const auto with = context_.motion.accelerations(moved), without = context_.motion.accelerations(still);
  const auto v = context_.motion.velocities(c);
  Magnitudes fastest;
  const auto each = [&](auto&& use) {
    for (const Unknown& u : context_.numbering.unknowns())
      if (!u.multiplier) use(u.measure, static_cast<std::size_t>(u.slot));
  };
  each([&](Measure m, std::size_t i) { fastest[m] = std::max(fastest[m], std::abs(v[i])); });
  double worst = 0;
  each([&](Measure m, std::size_t i) {
    const double change = h * std::abs(with[i] - without[i]), own = h * std::abs(without[i]) + no_speed * fastest[m];
    if (change > 0) worst = std::max(worst, change / std::max(most_change * own, std::numeric_limits<double>::min()));
  });
  return worst;
}

std::optional<Configuration> Dynamics::settle_friction(Configuration& c) {
  if (!context_.grips.violated(c)) return {};
  std::optional<Configuration> before = c;
  context_.grips.settle(c, has_massless_.value_or(false));
  context_.solver.reset();  // other constraints, other pivots
  restart_memory(c);
  return before;
}

void Dynamics::take_over(Configuration& c) {
  if (!has_massless_) has_massless_ = MasslessMotions(context_.assembler, c).any();
  settle_friction(c);
}

void Dynamics::refine_grips(Configuration& c) {
  // multipliers of a step balance it between its ends; whether a grip gives way depends on the force at its end
  Configuration balanced = c;
  context_.start.balance_accelerations(balanced, 3, nullptr, massless_at(c));
  c.multipliers = std::move(balanced.multipliers);
  context_.solver.reset();
}

std::vector<double> Dynamics::fitting_velocities(const Configuration& c) const {
  std::vector<double> v = context_.motion.velocities(c);
  Configuration fitted = c;
  try {
    context_.start.project_velocities(fitted, Assembler::Metric::mass);
  } catch (const SolutionFailure&) {
    return v;  // the step itself finds the conflict, and says when
  }
  std::vector<double> fit = context_.motion.velocities(fitted), change = fit;
  for (std::size_t i = 0; i < v.size(); ++i) change[i] -= v[i];
  return counts(change, context_.options.step, v, rounding) ? fit : v;
}

bool Dynamics::counts(std::span<const double> changes, double scale, std::span<const double> rates, double share) const {
  const double extent = context_.model.extent();
  Magnitudes change, rate;
  for (const Unknown& u : context_.numbering.unknowns()) {
    if (u.multiplier) continue;
    const auto slot = static_cast<std::size_t>(u.slot);
    const double size = std::abs(changes[slot]);
    if (size * scale > rounding * size_of(u, extent)) return true;
    change[u.measure] = std::max(change[u.measure], size);
    rate[u.measure] = std::max(rate[u.measure], std::abs(rates[slot]));
  }
  for (int m = 0; m < 4; ++m)
    if (rate.of[m] > 0 && change.of[m] > share * rate.of[m]) return true;
  return false;
}

bool Dynamics::constrained() const { return context_.numbering.slots() > context_.numbering.motion_slots(); }

void Dynamics::scale_for(const Configuration& c, double h, Weights weights) {
  // controlled steps of many lengths share matrices (KeptMatrices), which belong to one scale
  const double far = error_.wanted() ? 10 : 3;
  if (far * h > scaled_for_ && h < far * scaled_for_) return;
  context_.assembler.choose_scale(c, weights, context_.options.scale);
  scaled_for_ = h;
}

void Dynamics::save(Snapshot& snapshot) const {
  snapshot.put("scheme/scaled_for", scaled_for_);
  error_.save(snapshot);
  snapshot.put("scheme/has_massless", has_massless_.value_or(false) ? 1.0 : 0.0);
}

void Dynamics::load(const Snapshot& snapshot) {
  if (!snapshot.has("scheme/has_massless")) return;  // of another kind of analysis
  scaled_for_ = snapshot.number("scheme/scaled_for");
  has_massless_ = snapshot.number("scheme/has_massless") != 0;
  error_.load(snapshot);
}

}  // namespace engrane::solve
