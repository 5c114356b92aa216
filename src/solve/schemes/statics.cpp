// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/statics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <utility>

#include "assembly/energies.hpp"
#include "assembly/loads.hpp"
#include "model/linear_statics.hpp"
#include "solve/algebra/imbalance.hpp"
#include "solve/algebra/probe.hpp"
#include "solve/algebra/rows.hpp"
#include "solve/constraints/diagnosis.hpp"
#include "solve/schemes/descent.hpp"

namespace engrane::solve {

namespace {

/// A polynomial uses only points farther apart than the step over this (Extrapolation).
constexpr double longest_continuation = 4;
/// Largest distance of a parabola from the line through the ends of a first step, over its distance at the end from the line
/// through its beginning and its middle.
constexpr double share_of_first = 0.5;
/// Allows for derivatives that differ between both polynomials: an error is up to three times what their comparison shows.
constexpr double safety = 3;

/// Whether corrections, one or several, turned a node by a radian or moved it by the lengths around: far beyond what the first
/// tangent can tell.
bool went_far(const NewtonReport& report) {
  double way = 0;
  for (const NewtonRow& row : report.rows) way += row.correction;
  return way > 1;
}

/// Bridges across the gaps of contacts (State::contact_homotopy) for as long as it exists.
struct Bridges {
  double& part;
  ~Bridges() { part = 0; }
};

}  // namespace

/// On the polynomial through the equilibria; forces are not balanced again.
class Statics::Inside final : public Within {
 public:
  Inside(Statics& scheme, const Configuration& from, const Configuration& to) : Within(from, to), scheme_(scheme) {}

  void at(double time, Configuration& c) override {
    const std::size_t slots = scheme_.way_.size();
    std::vector<double> y(slots);
    // points closer than the step over longest_continuation lie on the other side of a jump, or nearly so
    const double h = to().time - from().time;
    scheme_.path_.at(time, h, y);
    for (std::size_t i = 0; i < slots; ++i) y[i] -= scheme_.way_[i] - scheme_.y_[i];
    scheme_.context_.motion.prescribe_increment(from().time, time, y);
    c = from();
    c.time = time;
    c.h = time - from().time;
    scheme_.context_.motion.move(from(), y, c);
    scheme_.forces_.at(time, h, c.multipliers);
  }

  bool balance(Configuration&) override { return false; }

 private:
  Statics& scheme_;
};

Statics::Statics(SolverContext& context)
    : Scheme(context),
      error_(context.assembler, context.options),
      branch_(context, !error_.wanted() && !has_linear_forces(context.model)),
      path_(points, longest_continuation),
      forces_(points, longest_continuation),
      way_(error_.wanted() ? context.motion.size() : 0, 0.0),
      y_(context.motion.size(), 0.0) {
  *unknowns_.out() = context.assembler.new_vector();
  for (std::size_t p = 0; p < context.model.parts.size(); ++p)
    if (context.model.parts[p].element->has_gaps()) contacts_.push_back(static_cast<int>(p));
  if (!contacts_.empty()) supports_.emplace(context.assembler);
  if (has_linear_forces(context.model)) context_.newton.keep_one_tangent();
}

StartReport Statics::start(Configuration& c) {
  StartReport report;
  apply_initial_displacements(context_, c);
  context_.start.assemble(c, report);
  {
    // forces of contacts that only touch are rounding errors: their derivatives are no measure of the stiffness
    const Bridges bridges{context_.assembler.contact_homotopy = touches(c) ? 1 : 0};
    context_.assembler.choose_scale(c, {1, 0, 0}, context_.options.scale);
  }
  if (context_.newton.keeps_one_tangent()) context_.newton.refine_next();
  std::optional<Configuration> before;
  if (!contacts_.empty() && !context_.newton.keeps_one_tangent()) before = c;
  NewtonReport newton = find_or_rest(c, 0, c);
  // what contacts that only touch leave free, as a string that is not tight yet, they may hold under load
  if (newton.singular && before) {
    Configuration other;
    if (NewtonReport crept = creep(*before, 0, other); crept.converged) {
      c = std::move(other);
      newton = std::move(crept);
    } else {
      context_.assembler.tangent(c, {1, 0, 0});  // for the message
    }
  }
  if (!newton.converged) {
    std::string why = fmt::format("no equilibrium at the start, t = {:.6g}: {}", c.time, newton.reason);
    if (newton.conflict) throw SolutionFailure(why);
    const Resistance resistance = context_.options.moves() ? Resistance::at_start : Resistance::at_rest;
    if (newton.singular) throw SolutionFailure(explain_singular(context_.assembler, why, resistance));
    const Configuration reference = context_.numbering.reference_configuration(c.time);
    const std::string free = explain_unresisted(
        context_.assembler, reference,
        fmt::format("no equilibrium at the start, t = {:.6g}: the stiffness matrix is singular", c.time), resistance);
    if (!free.empty()) throw SolutionFailure(free);
    const std::string residual = explain_residual(context_.assembler, c, newton);
    if (residual.empty()) throw SolutionFailure(why + ": " + explain_not_finite(context_.assembler, c));
    why += "; " + residual;
    why += explain_small_turns(context_.model, c);
    throw SolutionFailure(
        why + ". Loads without NF, and those whose function is not 0 there, act in full from the start: let them grow from 0");
  }
  if (error_.wanted()) {
    begin_path(c.time, c.multipliers);
    error_.take(way_);
  }
  return report;
}

Outcome Statics::attempt(const Configuration& from, double h, Configuration& to) {
  leapt_ = false;
  if (supports_) loads_ = context_.newton.loads();
  if (!error_.wanted() || path_.empty()) {
    NewtonReport report = find_or_rest(from, h, to);
    stay_on_branch(from, h, report, to);
    return {std::move(report), {}};
  }
  if (has_middle_) begin_path(from.time, from.multipliers);  // of a step that was rejected
  if (path_.points() == 1 && !find_middle(from, h)) return {find(from, h, to, false), {}};
  if (NewtonReport report = find(from, h, to, true); report.converged) return {std::move(report), error(from, h)};
  return {find(from, h, to, false), error(from, h)};
}

Outcome Statics::snap(const Configuration& from, double h, Configuration& to) {
  if (context_.newton.keeps_one_tangent()) return {};  // a linear model has one equilibrium
  NewtonReport report = creep(from, h, to);
  if (!report.converged) return {std::move(report), {}};
  return {std::move(report), error_.wanted() ? error(from, h) : std::nullopt};
}

NewtonReport Statics::creep(const Configuration& from, double h, Configuration& to) {
  const MotionSlots::Origin origin(from);
  to = from;
  to.time = from.time + h;
  to.h = h;
  std::fill(y_.begin(), y_.end(), 0.0);
  context_.motion.prescribe_increment(from.time, to.time, y_);
  if (!Descent(context_).descend(move(origin, y_), unknowns_of(y_, to), to)) return {};
  NewtonReport report = resisted_balance(false, origin, y_, to);
  tried_time_ = to.time;
  tried_forces_ = to.multipliers;
  return report;
}

bool Statics::leaps(const Configuration& from, const Configuration& to) {
  constexpr double small = 1e-3, rounding = 1e-6, bend = 0.1;
  if (!supports_) return false;
  const double before = total_energies(context_.assembler, from).potential;
  const double after = total_energies(context_.assembler, to).potential;
  const double lost = std::abs(static_work(context_.assembler, *supports_, from, to).lost(after - before, bend));
  if (lost <= small * (std::abs(before) + std::abs(after)) ||
      lost <= rounding * std::max(largest_force_, references().last_force()) * context_.model.extent())
    return false;
  context_.newton.restore_loads(loads_);
  return leapt_ = true;
}

NewtonReport Statics::find_or_rest(const Configuration& from, double h, Configuration& to) {
  const bool may_rest = !context_.newton.keeps_one_tangent() && context_.options.end > context_.options.begin;
  const std::optional<Configuration> start = may_rest && &to == &from ? std::optional(from) : std::nullopt;
  NewtonReport report;
  std::exception_ptr unresisted;
  try {
    report = find(from, h, to, false);
  } catch (const SolutionFailure&) {
    unresisted = std::current_exception();
  }
  if (report.converged || report.conflict) return report;
  if (may_rest) {
    const Configuration& still = start ? *start : from;
    Configuration there = still;
    there.time = still.time + h;
    there.h = h;
    std::fill(y_.begin(), y_.end(), 0.0);
    context_.motion.prescribe_increment(still.time, there.time, y_);
    context_.motion.move(MotionSlots::Origin(still), y_, there);
    if (rests(there)) {
      to = std::move(there);
      tried_time_ = to.time;
      tried_forces_ = to.multipliers;
      report = {};
      report.converged = true;
      return report;
    }
  }
  if (unresisted) std::rethrow_exception(unresisted);
  return report;
}

NewtonReport Statics::find(const Configuration& from, double h, Configuration& to, bool predicted) {
  const double begin = from.time;
  const MotionSlots::Origin origin(from);
  if (&to != &from) to = from;
  to.time = begin + h;
  to.h = h;
  std::vector<double>& y = y_;
  std::fill(y.begin(), y.end(), 0.0);
  if (predicted) {
    path_.at(to.time, h, y);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] -= way_[i];
    forces_.at(to.time, h, to.multipliers);
  }
  context_.motion.prescribe_increment(begin, begin + h, y);
  const bool jumps = !contacts_.empty() && !predicted;
  NewtonReport report = jumps ? balance_contacts(origin, y, to) : resisted_balance(false, origin, y, to);
  if (report.unresisted && !predicted) throw SolutionFailure(report.reason);
  if (error_.wanted()) {
    tried_time_ = to.time;
    tried_forces_ = to.multipliers;
  }
  return report;
}

void Statics::stay_on_branch(const Configuration& from, double h, NewtonReport& report, Configuration& to) {
  branch_.tried(h);
  if (!branch_.doubts()) return;
  std::vector<double> found = std::exchange(y_, branch_.continued(h));
  Configuration other = from;
  other.time = from.time + h;
  other.h = h;
  context_.motion.prescribe_increment(from.time, other.time, y_);
  NewtonReport again = balance(MotionSlots::Origin(from), y_, other);
  again.iterations += report.iterations;
  branch_.disregard();
  if (again.converged) {
    to = std::move(other);
    report = std::move(again);
  } else {
    y_ = std::move(found);
  }
}

bool Statics::find_middle(const Configuration& from, double h) {
  Configuration middle;
  if (!find(from, h / 2, middle, false).converged) return false;
  std::vector<double> there = way_;
  for (std::size_t i = 0; i < there.size(); ++i) there[i] += y_[i];
  path_.add(middle.time, there);
  forces_.add(middle.time, middle.multipliers);
  has_middle_ = true;
  return true;
}

std::optional<double> Statics::error(const Configuration& from, double h) const {
  std::vector<double> off(way_.size()), there = way_;
  path_.at(from.time + h, h, off);
  const double share = path_.points() == 2 ? share_of_first : path_.share(from.time + h, h);
  for (std::size_t i = 0; i < off.size(); ++i) {
    there[i] += y_[i];
    off[i] = safety * share * (there[i] - off[i]);
  }
  return error_.over_tolerance(off, there, 1);
}

void Statics::accept() {
  largest_force_ = std::max(largest_force_, references().last_force());
  if (leapt_) supports_.reset();  // shorter steps do not help, and would in no later one
  branch_.accept(y_);
  if (!error_.wanted()) return;
  for (std::size_t i = 0; i < way_.size(); ++i) way_[i] += y_[i];
  path_.add(tried_time_, way_);
  forces_.add(tried_time_, tried_forces_);
  error_.take(way_);
  has_middle_ = false;
}

void Statics::begin_path(double time, std::span<const double> multipliers) {
  path_.clear();
  forces_.clear();
  path_.add(time, way_);
  forces_.add(time, multipliers);
  has_middle_ = false;
}

void Statics::pass_corner(const Configuration& c) {
  if (error_.wanted()) begin_path(c.time, c.multipliers);
}

std::unique_ptr<Within> Statics::within(const Configuration& from, const Configuration& to, std::span<const double>,
                                        bool /*drift*/) {
  return std::make_unique<Inside>(*this, from, to);
}

void Statics::save(Snapshot& snapshot) const {
  error_.save(snapshot);
  snapshot.put("scheme/leaps", {supports_ ? 1.0 : 0.0, largest_force_});
  branch_.save(snapshot);
  if (!error_.wanted()) return;
  path_.save(snapshot, "scheme/path");
  forces_.save(snapshot, "scheme/forces");
  snapshot.put("scheme/way", way_);
}

void Statics::load(const Snapshot& snapshot) {
  error_.load(snapshot);
  if (snapshot.has("scheme/leaps")) {
    if (snapshot.array("scheme/leaps").at(0) == 0) supports_.reset();
    largest_force_ = snapshot.array("scheme/leaps").at(1);
  }
  branch_.load(snapshot);
  if (!error_.wanted() || !snapshot.has("scheme/way")) return;
  path_.load(snapshot, "scheme/path");
  forces_.load(snapshot, "scheme/forces");
  way_ = snapshot.array("scheme/way");
}

Newton::Apply Statics::move(const MotionSlots::Origin& from, std::span<double> y) const {
  return [this, &from, y](std::span<const double> unknowns, Configuration& c) {
    context_.motion.scatter(unknowns, y);
    context_.motion.move(from, y, c);
    context_.assembler.unknowns_to_multipliers(unknowns, c);
  };
}

std::vector<double> Statics::unknowns_of(std::span<const double> y, const Configuration& c) const {
  std::vector<double> unknowns(static_cast<std::size_t>(context_.numbering.equations()), 0.0);
  context_.motion.gather(y, unknowns);
  context_.assembler.multipliers_to_unknowns(c, unknowns);
  return unknowns;
}

NewtonReport Statics::balance(const MotionSlots::Origin& from, std::span<double> y, Configuration& to) {
  branch_.begin();
  const Newton::Apply apply = [this, moved = move(from, y)](std::span<const double> unknowns, Configuration& c) {
    branch_.look();
    moved(unknowns, c);
  };
  context_.assembler.spread(unknowns_of(y, to), unknowns_);
  if (error_.wanted()) context_.newton.close_next(error_.may_be_open(way_, 1));
  NewtonReport report = solve(unknowns_, {1, 0, 0}, apply, to);
  refuse_half_turns(y, report);
  if (!report.converged) context_.newton.refuse_last();
  return report;
}

bool Statics::rests(Configuration& c) {
  if (any_loads(context_.assembler, c) || !context_.redundancy.conflict(c).empty()) return false;
  Configuration still = c;
  try {
    context_.start.balance_accelerations(still);  // finds the reactions
  } catch (const SolutionFailure&) {
    return false;
  }
  context_.motion.set_accelerations(std::vector<double>(y_.size(), 0.0), still);
  context_.assembler.residual(still, unknowns_);
  // a contact that touches by rounding has the stiffness of one that is closed
  const Bridges bridges{context_.assembler.contact_homotopy = 1};
  context_.assembler.tangent(still, {1, 0, 0});
  constexpr double several = 256;  // positions of contacts come of sums and products
  std::vector<double> size = rounding_of_unknowns(context_.assembler, references(), still);
  for (double& one : size) one *= several;
  if (!is_noise(unknowns_, magnitudes_times(context_.assembler.matrix(), size))) return false;
  c = std::move(still);
  return true;
}

bool Statics::touches(const Configuration& c) const {
  return std::any_of(contacts_.begin(), contacts_.end(), [&](int part) {
    return context_.model.parts[static_cast<std::size_t>(part)].element->touches(context_.assembler.view(part, c));
  });
}

void Statics::require_resistance(const Configuration& c, NewtonReport& report) {
  // Measured: at most 1.7e-16 for free motions of 115 meshes, where it is the rounding of pivots; 5e-16 for springs of 1 and 1e15
  // in series and 6e-15 for a beam a million times as long as high, which are solved.
  constexpr double rounding = 1.5 * std::numeric_limits<double>::epsilon();
  if (resists_ || !report.converged || report.iterations == 0 || !context_.solver.direct()) return;
  const bool touching = touches(c);
  if (!contacts_.empty()) {
    // the last correction may have closed or opened contacts; those that only touch resist on one side
    const Bridges bridges{context_.assembler.contact_homotopy = touching ? 1 : 0};
    context_.assembler.tangent(c, {1, 0, 0});
  }
  const std::string what = fmt::format("t = {:.6g}: the stiffness matrix is singular up to rounding", c.time);
  std::string free;
  Owned<Vec> load, motion;
  if (!answer_probe(context_.assembler, context_.solver, load, motion))
    free = explain_singular(context_.assembler, what, Resistance::at_rest);
  else if (relative_stiffness(context_.assembler, context_.assembler.matrix(), motion, load) <= rounding)
    free = explain_null_vector(context_.assembler, what, context_.assembler.gather(motion), Resistance::at_rest);
  resists_ = free.empty() && !touching;
  if (free.empty()) return;
  report.converged = false;
  report.unresisted = true;
  report.reason = std::move(free);
  context_.newton.refuse_last();
}

NewtonReport Statics::resisted_balance(bool across_gaps, const MotionSlots::Origin& from, std::span<double> y,
                                       Configuration& to) {
  NewtonReport report = across_gaps ? balance_across_gaps(from, y, to) : balance(from, y, to);
  require_resistance(to, report);
  return report;
}

NewtonReport Statics::balance_contacts(const MotionSlots::Origin& from, std::span<double> y, Configuration& to) {
  Configuration other = to;
  std::vector<double> way(y.begin(), y.end());
  const bool touched = touches(to);
  NewtonReport report = resisted_balance(touched, from, y, to);
  const bool doubtful = report.iterations > 0 && (touches(to) || went_far(report));
  if (report.converged && (touched || !doubtful)) return report;
  context_.newton.refuse_last();
  NewtonReport second = resisted_balance(!touched, from, way, other);
  // if neither finds anything, the reason why the plain iteration does not tells more
  if (second.converged || (!report.converged && !report.unresisted && (second.unresisted || touched))) {
    std::copy(way.begin(), way.end(), y.begin());
    to = std::move(other);
    report = std::move(second);
  }
  return report;
}

NewtonReport Statics::balance_across_gaps(const MotionSlots::Origin& from, std::span<double> y, Configuration& to) {
  constexpr double fastest = 0.1, slowest = 0.7, first_last = 1e-6, least_last = 1e-14;
  const Bridges bridges{context_.assembler.contact_homotopy};
  const auto balance_with = [&](double part) {
    bridges.part = part;
    return balance(from, y, to);
  };
  NewtonReport report = balance_with(1);
  int iterations = report.iterations;
  // Where several contacts close and open in turn, as pairs of flanks do, smaller changes keep Newton's iteration from a cycle;
  // where only a slight force is left to close a contact, as that of a ball, they keep it from leading far away.
  for (double bridged = 1, ratio = fastest, last = first_last; bridged > 0 && report.converged;) {
    const Configuration before = to;
    const std::vector<double> way(y.begin(), y.end());
    const double next = bridged * ratio < (1 - fastest) * last ? 0 : bridged * ratio;
    report = balance_with(next);
    iterations += report.iterations;
    const bool finer = next > 0 ? ratio < slowest : last > least_last;
    if (report.converged && (!finer || !went_far(report))) {
      bridged = next;
      ratio = std::max(ratio * ratio, fastest);
    } else if (finer) {
      next > 0 ? ratio = std::sqrt(ratio) : last *= fastest;
      context_.newton.refuse_last();
      std::copy(way.begin(), way.end(), y.begin());
      to = before;
      report.converged = true;
    }
  }
  report.iterations = iterations;
  return report;
}

}  // namespace engrane::solve
