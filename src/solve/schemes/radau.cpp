// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/radau.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "assembly/configuration_snapshot.hpp"
#include "model/fine_forces.hpp"
#include "solve/constraints/constraint_factors.hpp"
#include "solve/schemes/snapshot_part.hpp"

namespace engrane::solve {

namespace {

constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
/// Contraction above which matrices are evaluated at the present configuration: at once, and before the next step.
constexpr double slow = 0.3, growing_slow = 0.1;
/// A controlled step ends after most_idle corrections with a contraction above this.
constexpr double no_contraction = 1;
constexpr int most_idle = 3;
/// With exact tangents the contraction must be below this from the third correction on; corrections beyond the rounding of
/// lengths are rounding only above it.
constexpr double no_newton = 0.5;
/// Larger models take shorter steps instead: factors of three times as many equations would cost more.
constexpr int most_coupled = 10'000;
/// A step that needed the tangents of each stage says nothing about steps shorter than this fraction of it.
constexpr double no_shorter = 0.8;
/// Largest number of steps that begin with these tangents before the other matrices are tried again.
constexpr int most_untried = 16;
/// Predictions go through this many ends of steps, and use only points farther apart than the step over longest_growth.
constexpr std::size_t points_of_guess = 4;
constexpr double longest_growth = 3;
/// Fraction of the tolerance of a step that the iteration may leave.
constexpr double share_of_iteration = 0.02;
/// Where a drift leaves more than this open, over a length or in radians, it shows in the error of the next step.
constexpr double most_left_open = 1e-11;
/// An error of velocities counts this much beside one of displacements over the length of the step, and in full in the first
/// step after an event: what it excites passes unseen below steps of many of its periods, but not the speed that it has.
constexpr double weight_of_speeds = 0.15, weight_after_event = 1;
/// An error this many times what the step before lets expect may be rounding.
constexpr double unexpected = 10;
/// Steps that differ by less than this fraction use the same matrices.
constexpr double same = 1e-6;

}  // namespace

Radau::Radau(SolverContext& context)
    : Dynamics(context),
      accelerations_(points_of_guess, longest_growth),
      multipliers_(points_of_guess, longest_growth),
      collocation_(Collocation::radau()),
      solver_(context.assembler, collocation_, context.solver.package()),
      references_(context.assembler, context.options.precision),
      now_(context, collocation_),
      weight_of_places_(collocation_.embedded.lpNorm<1>()),
      weight_of_closing_(collocation_.inverse.rowwise().sum().cwiseProduct(collocation_.embedded).lpNorm<1>()),
      configurations_(static_cast<std::size_t>(collocation_.stages())),
      kept_(context.assembler, solver_),
      projection_(context, error_.wanted()),
      fine_forces_(has_fine_forces(context.model)) {
  for (std::size_t i = 0; i < configurations_.size(); ++i) {
    *residuals_.emplace_back().out() = context.assembler.new_vector();
    *changes_.emplace_back().out() = context.assembler.new_vector();
  }
  if (error_.wanted() && context.options.target > 0)
    lost_.emplace(collocation_, context.options.precision, context.model.extent(), 6 * context.model.nodes.size(),
                  LostVibrations::joined(context.model));
}

StartReport Radau::start(Configuration& c) {
  for (const Support& s : context_.model.supports) {
    if (s.component < 3 || s.value == 0) continue;
    for (int other = 3; other < 6; ++other)
      if (context_.numbering.equation(6 * s.node + other) >= 0)
        throw SolutionFailure(
            fmt::format("SCHEME RADAU cannot turn node {} about one axis while it is free about another: hold the two other "
                        "rotations, drive it by a HINGE, or take SCHEME CHUNG",
                        context_.model.nodes[static_cast<std::size_t>(s.node)].id));
  }
  return Dynamics::start(c);
}

void Radau::start_memory(const Configuration&, const MasslessMotions*) { forget(); }

void Radau::restart_memory(Configuration& c) {
  forget();
  leaves_open(c);
}

void Radau::leaves_open(const Configuration& c) {
  if (!error_.wanted() || !constrained()) return;
  const double open = relative_open(context_.assembler, context_.assembler.violations(c)).lpNorm<Eigen::Infinity>();
  drifted_open_ = std::min(open, most_left_open);
}

void Radau::forget_motion() {
  accelerations_.clear();
  multipliers_.clear();
  open_ = drifted_open_ = 0;
  judged_ = {};
  kept_step_ = 0;
  coupled_ = {};
}

void Radau::enter(const std::vector<int>& sides) {
  kept_.enter(sides);
  kept_step_ = 0;
}

void Radau::predict(const Configuration& from, double h) {
  if (accelerations_.empty()) {
    accelerations_.add(from.time, context_.motion.accelerations(from));
    multipliers_.add(from.time, from.multipliers);
  }
  now_.predict(from, h, accelerations_, multipliers_);
}

Imbalance Radau::evaluate(const Configuration& from) {
  Imbalance all;
  for (std::size_t i = 0; i < configurations_.size(); ++i) {
    Configuration& c = configurations_[i];
    context_.motion.move(from, now_.y[i], c);
    context_.motion.set_velocities(now_.v[i], c);
    context_.motion.set_accelerations(now_.a[i], c);
    c.multipliers = now_.multipliers[i];
    context_.assembler.residual(c, residuals_[i]);
    references_.take(c, context_.assembler.carried());
    all.join(imbalance(context_.assembler, references_, residuals_[i]));
  }
  return all;
}

std::vector<double> Radau::rounding_of_stage(std::size_t i) const {
  const Configuration& c = configurations_[i];
  const Numbering& numbering = context_.numbering;
  std::vector<double> size = rounding_of_unknowns(context_.assembler, references_, c);
  std::vector<double> way_of_node(context_.model.nodes.size(), 0.0);  // over lengths, or in radians
  for (std::size_t e = 0; e < size.size(); ++e) {
    const Unknown& u = numbering.unknown(static_cast<int>(e));
    if (u.multiplier) continue;
    const double length = references_.length(static_cast<int>(e));
    const double way = std::abs(now_.v[i][static_cast<std::size_t>(u.slot)] * c.time) / length;
    if (u.part < 0) {
      double& farthest = way_of_node[static_cast<std::size_t>(u.node)];
      farthest = std::max(farthest, way);
    }
    size[e] = std::max(size[e], last_places * way * length);
  }
  // the forces of constraints follow what they close
  for (std::size_t e = 0; e < size.size(); ++e) {
    const Unknown& u = numbering.unknown(static_cast<int>(e));
    if (!u.multiplier) continue;
    const double length = references_.length(static_cast<int>(e));
    for (const int node : context_.model.parts[static_cast<std::size_t>(u.part)].nodes)
      size[e] = std::max(size[e], last_places * way_of_node[static_cast<std::size_t>(node)] * length);
  }
  return size;
}

bool Radau::rests(double motion, double contraction) const {
  if (motion <= no_correction) return true;
  if (contraction <= no_newton) return false;  // the next one is less
  const std::vector<double> size = rounding_of_stage(configurations_.size() - 1);
  double largest = 0;
  for (const Unknown& u : context_.numbering.unknowns()) {
    if (u.multiplier) continue;
    const int e = context_.numbering.equation(u.slot);
    largest = std::max(largest, size[static_cast<std::size_t>(e)] / references_.length(e));
  }
  return motion <= largest;
}

bool Radau::left_to_rounding(double h, const CoupledStages* exact) const {
  const StageMatrices* shared = exact ? nullptr : kept_.current();
  if (!exact && !shared) return false;
  const Eigen::MatrixXd first = collocation_.inverse / h, second = first * first;
  const Eigen::VectorXd v = first.cwiseAbs().rowwise().sum(), a = second.cwiseAbs().rowwise().sum();
  for (std::size_t i = 0; i < residuals_.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const StageMatrices& matrices = exact ? exact->matrices()[i] : *shared;
    if (!is_noise(residuals_[i], magnitudes_times(matrices, v[k], a[k], rounding_of_stage(i)))) return false;
  }
  return true;
}

Radau::Correction Radau::correct() {
  const Numbering& numbering = context_.numbering;
  Correction largest;
  change_before_.swap(last_change_);
  last_change_.assign(context_.motion.size(), 0.0);
  for (std::size_t i = 0; i < changes_.size(); ++i) {
    const auto change = context_.assembler.gather(changes_[i]);
    if (error_.wanted() && i + 1 == changes_.size()) context_.motion.scatter(change, last_change_);
    context_.assembler.add_to_multipliers(change, now_.multipliers[i]);
    for (std::size_t e = 0; e < change.size(); ++e) {
      const Unknown& u = numbering.unknown(static_cast<int>(e));
      if (!u.multiplier) now_.y[i][static_cast<std::size_t>(u.slot)] += change[e];
      double& size = u.multiplier ? largest.forces : largest.motion;
      size = std::max(size, references_.relative_change(static_cast<int>(e), change[e]));
    }
  }
  return largest;
}

double Radau::increment() const {
  double largest = 0;
  for (const Unknown& u : context_.numbering.unknowns())
    if (!u.multiplier)
      largest = std::max(largest, std::abs(now_.y.back()[static_cast<std::size_t>(u.slot)]) /
                                      references_.length(context_.numbering.equation(u.slot)));
  return largest;
}

NewtonReport Radau::iterate(const Configuration& from, double h, CoupledStages* exact) {
  NewtonReport report;
  report.coupled = exact != nullptr;
  const std::vector<double> remembered = references_.memory();
  const double precision = context_.options.precision;
  references_.begin(from);
  bool renew = !exact && (!(std::abs(h / kept_step_ - 1) < same) || kept_scale_ != context_.assembler.scale()) && !recall(h);
  Correction last;
  double contraction = 0, slowest = 0;
  bool evaluated = false;  // in this step
  int uses = 0;            // of the matrices, in this step
  int idle = 0;            // corrections that did not shrink
  for (int k = 0;; ++k) {
    now_.differentiate(from, h);
    const Imbalance found = evaluate(from);
    report.rows.push_back({k, found.force, found.moment, found.length, found.angle, last.motion, found.worst});
    report.iterations = k;
    const double left = found.largest();
    if (!std::isfinite(left)) {
      report.reason = "the iteration left the range of numbers";
      break;
    }
    // nothing may act on a free body: its residual is then the rounding of accelerations, which are differences of increments
    const double changed = std::max(last.motion, last.forces);
    // forces that are small beside stiffness or inertia times the rounding of positions follow that rounding and never settle;
    // forces at stages are no results
    const auto noise = [&] {
      const NewtonRow& before = report.rows[report.rows.size() - 2];
      if (!(left > 0.5 * std::max(before.force, before.moment))) return false;
      return (left <= std::sqrt(precision) && std::max(last.motion, before.correction) <= negligible_correction) ||
             (rests(last.motion, contraction) && left_to_rounding(h, exact));
    };
    const bool still =
        k > 1 && (changed <= std::max(no_correction, rounding * increment()) ||
                  (left <= std::sqrt(precision) && changed * std::min(1.0, contraction) <= negligible_correction) || noise());
    // What is left of positions must not count in the step's error: θ/(1 − θ) of the last correction (Hairer and Wanner, IV.8),
    // with the θ of each unknown, since matrices of another configuration may leave one open while all others converge.
    const auto settled = [&] {
      if (!error_.wanted()) return true;
      std::vector<double> rates = last_change_;
      for (std::size_t i = 0; i < rates.size(); ++i) {
        const double own = k > 1 ? std::abs(rates[i]) / std::max(std::abs(change_before_[i]), std::abs(rates[i])) : 1;
        const double theta = std::max(contraction, rates[i] == 0 ? 0 : own);
        rates[i] *= std::min(1.0, theta / std::max(1 - theta, 0.5)) / h;
      }
      // the error estimate of the next step contains what joints leave open, with the weights of its formula
      return error_.over_tolerance(rates, now_.v.back(), h, StepError::known / weight_of_places_) <= share_of_iteration;
    };
    if ((k > 0 && found.within(precision) && settled()) || still) {
      report.converged = true;
      tried_.open = std::max(found.length, found.angle);
      break;
    }
    if (k == context_.options.iterations) {
      report.reason = fmt::format("no convergence in {} iterations", k);
      break;
    }
    if (renew) {
      keep(at_start_of_step(configurations_[configurations_.size() / 2]), h);
      evaluated = true;
      slowest = 0;
      uses = 0;
    }
    renew = false;
    if (!(exact ? exact->solve(configurations_, now_.y, h, residuals_, changes_) : solver_.solve(residuals_, changes_))) {
      report.singular = true;
      report.reason = "the tangent matrix is singular";
      break;
    }
    const double before = last.motion;
    last = correct();
    contraction = k > 0 && before > 0 ? last.motion / before : 1;
    // the first correction after a change of matrices says nothing about them, nor does one at rounding level about new ones
    if (++uses < 2 || (evaluated && last.motion <= negligible_correction)) continue;
    slowest = std::max(slowest, contraction);
    renew = !exact && contraction > slow;
    // across an event corrections alternate between both laws: a shorter step costs less than waiting for them
    const bool shrinks =
        exact ? k < 2 || contraction <= no_newton : !error_.wanted() || contraction <= no_contraction || ++idle < most_idle;
    if (!shrinks && !rests(last.motion, contraction)) {
      report.iterations = k + 1;
      report.reason = "the iteration does not converge";
      break;
    }
  }
  if (!report.converged) references_.restore(remembered);
  if (!report.converged || slowest > growing_slow) {
    kept_.drop();
    kept_step_ = 0;
  }
  return report;
}

void Radau::keep(const Configuration& c, double h) {
  kept_.evaluate(c, h);
  kept_step_ = matrices_step_ = h;
  factored_ = true;
  kept_scale_ = context_.assembler.scale();
}

bool Radau::recall(double h) {
  if (!error_.wanted() || !kept_.recall(h)) return false;
  kept_step_ = matrices_step_ = h;
  factored_ = true;
  kept_scale_ = context_.assembler.scale();
  return true;
}

NewtonReport Radau::find_stages(const Configuration& from, double h) {
  const bool tries = coupled_.left == 0 || h < no_shorter * coupled_.step;
  if (tries) {
    predict(from, h);
    NewtonReport report = iterate(from, h);
    if (report.converged) coupled_ = {};
    if (report.converged || context_.numbering.equations() > most_coupled) return report;
  }
  if (!coupled_stages_)
    coupled_stages_ = std::make_unique<CoupledStages>(context_.assembler, collocation_, context_.solver.package());
  coupled_stages_->begin();
  predict(from, h);
  NewtonReport report = iterate(from, h, coupled_stages_.get());
  if (!report.converged)
    coupled_ = {};
  else if (tries)
    coupled_ = {h, coupled_.tries + 1, coupled_.tries > 0 ? std::min(2 * coupled_.tries - 1, most_untried) : 0};
  else
    --coupled_.left;
  return report;
}

Outcome Radau::attempt(const Configuration& from, double h, Configuration& to) {
  scale_for(from, h, solver_.weights(h));
  factored_ = kept_step_ > 0 && kept_scale_ == context_.assembler.scale();
  for (std::size_t i = 0; i < configurations_.size(); ++i) {
    const double part = collocation_.c[static_cast<Eigen::Index>(i)];
    configurations_[i] = from;
    configurations_[i].time = from.time + part * h;
    configurations_[i].h = part * h;
  }
  now_.begin(from, h);
  NewtonReport foreseen = foresee(context_.motion.velocities(from), h);
  to = configurations_.back();
  if (!foreseen.converged) return {std::move(foreseen), {}};

  NewtonReport report = find_stages(from, h);
  to = at_start_of_step(configurations_.back());
  refuse_half_turns(now_.y.back(), report);
  if (!report.converged) return {std::move(report), {}};
  if (refuse_conflict(to, report)) return {std::move(report), {}};
  std::optional<double> error;
  if (error_.wanted()) error = local_error(from, h, to, report.coupled);
  tried_.judged = {h, error.value_or(0)};
  if (error) error = std::max(*error, error_.over_turn(context_.motion.velocities(to), h, order_of_error()));
  if (error && !(*error <= 1)) return {std::move(report), error};  // the step will be rejected
  if (constrained() && !fit_end(to)) {
    report.converged = false;
    report.singular = true;
    report.reason = "the accelerations are not determined";
  }
  tried_.time = to.time;
  tried_.v = context_.motion.velocities(to);
  tried_.a = context_.motion.accelerations(to);
  tried_.multipliers = to.multipliers;
  return {std::move(report), error};
}

double Radau::local_error(const Configuration& from, double h, const Configuration& to, bool coupled) {
  const auto v0 = context_.motion.velocities(from), a0 = context_.motion.accelerations(from);
  error_.take(v0);
  if (lost_) lost_->look(v0, a0, now_.y, now_.v, now_.a);
  const double weight = accelerations_.points() == 1 ? weight_after_event : weight_of_speeds;
  std::vector<double> places(v0.size()), speeds(v0.size());
  for (std::size_t slot = 0; slot < v0.size(); ++slot) {
    places[slot] = collocation_.embedded_first * v0[slot];
    speeds[slot] = collocation_.embedded_first * a0[slot] * h;
    for (std::size_t i = 0; i < now_.y.size(); ++i) {
      const double part = collocation_.embedded[static_cast<Eigen::Index>(i)];
      places[slot] += part * now_.y[i][slot] / h;
      speeds[slot] += part * (now_.v[i][slot] - v0[slot]);
    }
    speeds[slot] *= weight;
  }
  const auto v = context_.motion.velocities(to);
  // what a drift has left open is closed at once, by all stages
  const double open = StepError::known + weight_of_places_ * open_;
  const double of_places = open + weight_of_places_ * drifted_open_;
  const double of_speeds = open + weight * weight_of_closing_ * drifted_open_;
  const auto judged = [&] {
    return std::max(error_.over_tolerance(places, v, h, of_places), error_.over_tolerance(speeds, v, h, of_speeds));
  };
  const double error = judged();
  // A step that begins near a singular position knows the velocities and accelerations there only as far as the rounding that
  // its constraints amplify. Those at its end do not admit this part, and its motion does not have it. It shows as an error that
  // the step before did not let expect.
  const double expected = judged_.error * std::pow(h / judged_.step, order_of_error());
  if (error > 1 && coupled && constrained() && judged_.step > 0 && error > unexpected * expected) {
    projection_.renew(to);
    if (projection_.leave_admissible(places) && projection_.leave_admissible(speeds)) return judged();
  }
  return error;
}

void Radau::accept() {
  if (lost_) {
    const bool first = accelerations_.points() == 1;
    lost_->take(tried_.judged.step, first, tried_.v, tried_.a, inertia_of(lost_->differences()));
  }
  accelerations_.add(tried_.time, tried_.a);
  multipliers_.add(tried_.time, tried_.multipliers);
  open_ = tried_.open;
  drifted_open_ = 0;
  judged_ = tried_.judged;
  if (error_.wanted()) kept_.step();
}

void Radau::save(Snapshot& snapshot) const {
  Dynamics::save(snapshot);
  accelerations_.save(snapshot, "radau/accelerations");
  multipliers_.save(snapshot, "radau/multipliers");
  solver_.save(snapshot);
  snapshot.put("radau/kept_step", kept_step_);
  snapshot.put("radau/matrices_step", matrices_step_);
  snapshot.put("radau/open", open_);
  snapshot.put("radau/drifted_open", drifted_open_);
  snapshot.put("radau/judged", {judged_.step, judged_.error});
  snapshot.put("radau/coupled", {coupled_.step, static_cast<double>(coupled_.tries), static_cast<double>(coupled_.left)});
  save_part(kept_, "radau/kept/", snapshot);
  save_part(references_, "radau/", snapshot);
  save_part(projection_, "radau/", snapshot);
}

void Radau::load(const Snapshot& snapshot) {
  Dynamics::load(snapshot);
  if (!snapshot.has("radau/accelerations")) return;  // of another kind of analysis, or of another scheme
  accelerations_.load(snapshot, "radau/accelerations");
  multipliers_.load(snapshot, "radau/multipliers");
  references_.load_memory(part_of(snapshot, "radau/"));
  projection_.load(part_of(snapshot, "radau/"));
  solver_.load(snapshot);
  open_ = snapshot.number("radau/open");
  drifted_open_ = snapshot.has("radau/drifted_open") ? snapshot.number("radau/drifted_open") : 0;
  judged_ = {snapshot.array("radau/judged").at(0), snapshot.array("radau/judged").at(1)};
  const std::vector<double>& coupled = snapshot.array("radau/coupled");
  coupled_ = {coupled.at(0), static_cast<int>(coupled.at(1)), static_cast<int>(coupled.at(2))};
  kept_.load(part_of(snapshot, "radau/kept/"));
  kept_step_ = 0;
  matrices_step_ = snapshot.number("radau/matrices_step");
  if (const double h = snapshot.number("radau/kept_step"); h > 0 && kept_.restore(h)) {
    solver_.restore_factors();
    kept_step_ = matrices_step_ = h;
    kept_scale_ = context_.assembler.scale();
  }
}

}  // namespace engrane::solve
