// SPDX-License-Identifier: BSD-3-Clause
#include "solve/run/runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "assembly/configuration_snapshot.hpp"
#include "model/fine_forces.hpp"
#include "model/jump.hpp"
#include "model/pulses.hpp"
#include "model/speed_jumps.hpp"
#include "solve/constraints/diagnosis.hpp"
#include "solve/run/restart_jump.hpp"

namespace engrane::solve {

namespace {

/// With error control steps may be cut by this many more halvings than CUTS says.
constexpr int deeper = 20;
/// A controlled step without a solution is cut to this fraction. Equal steps of it do not end where it did, which may be a
/// singular position; halves would, again and again.
constexpr double aside = 0.38;
/// Fraction of the run below which two corners of functions of time count as one.
constexpr double shortest_way = 1e-9;
/// Even steps shorter than this fraction of H are the rounding error of their sum.
constexpr double shortest_step = 1e-9;
/// A drift across an event is certainly still before it this many of the locator's tolerances before its end.
constexpr double crossing = 1.5;
/// Largest error of a drift, over the tolerance of a controlled step: as for one across an event (EventLocator::reach). Whole
/// phases passed in such a way in every run have errors that no comparison of runs shows.
constexpr double share_of_drift = 0.02;
/// Fraction of H below which reactions would show the noise of rounding.
constexpr double noisy = 0.1;

/// Advice where load steps come to an end although they are as short as they may be.
constexpr const char* beyond_limit =
    ". Equilibria near the last one may have come to an end, as at the largest load that a structure bears before it snaps "
    "through: .PATH follows them beyond it, TYPE DYNAMIC the motion";

std::string failure_text(SolverContext& context, const Configuration& last, const Configuration& tried,
                         const NewtonReport& report, int number, int cuts) {
  std::string text = fmt::format("step {}, t = {:.6g}: ", number, tried.time);
  const std::string cut = cuts == 0 ? "" : fmt::format("; the step was cut {} time{}", cuts, cuts == 1 ? "" : "s");
  if (!context.options.moves() && !report.conflict && !report.singular)
    if (std::string free = explain_unresisted(context.assembler, last, text + "the stiffness matrix is singular" + cut);
        !free.empty())
      return free;
  const bool loads = context.options.analysis == SolverOptions::Analysis::statics && !context.options.path.follow;
  if (const std::string element = explain_not_finite(context.assembler, tried); !element.empty()) return text + element + cut;
  if (report.conflict) return text + report.reason + cut;
  if (report.singular)
    return explain_singular(context.assembler, text + report.reason + cut,
                            context.options.moves() ? Resistance::in_motion : Resistance::at_rest);  // ends with advice
  if (const std::string where = explain_residual(context.assembler, tried, report); !where.empty())
    text += report.reason + "; " + where + explain_small_turns(context.model, tried);
  else
    text += report.reason;
  return text + cut + (loads ? beyond_limit : "");
}

/// Number of halvings of H that make a step. Steps that divide the rest equally are some hundredths longer than the halvings.
int depth_of(double size, double step) { return static_cast<int>(std::floor(std::log2(step / size) + 0.1)); }

}  // namespace

Runner::Runner(SolverContext& context, Scheme& scheme)
    : context_(context),
      scheme_(scheme),
      options_(context.options),
      locator_(context, scheme),
      control_(options_, scheme.order_of_error()),
      now_(context.numbering.reference_configuration(options_.begin)),
      h_(control_.active() ? std::min(options_.step, options_.longest) : options_.step),
      within_drifts_(control_.active() && options_.moves() && has_fine_forces(context.model)) {}

bool Runner::run(const StepCallback& after_step, const std::function<void(const StartReport&)>& started) {
  after_step_ = &after_step;
  started(scheme_.start(now_));
  // the start used matrices of other kinds; the steps need their own analysis
  if (!context_.newton.keeps_one_tangent()) context_.solver.reset();
  context_.assembler.commit(now_);
  if (locator_.active()) locator_.switches().take(now_);
  started_ = true;
  step_.course = scheme_.course();
  step_.last = over();
  if (!step_.last) next_ = now_;
  return after_step(now_, step_) && march();
}

bool Runner::resume(const Snapshot& snapshot, const StepCallback& after_step) {
  after_step_ = &after_step;
  load_configuration(snapshot, now_);
  context_.motion.take_over(now_);
  next_ = now_;
  context_.load(snapshot);
  // where a function jumps at this very instant the run itself is open there; equilibria need not be neighbours
  if (options_.moves() && !context_.model.jumps_at(now_.time))
    if (const std::string jump = explain_jump(context_, now_); !jump.empty()) throw std::out_of_range(jump);
  scheme_.load(snapshot);
  locator_.load(snapshot);
  scheme_.take_over(now_);
  if (locator_.active()) locator_.switches().complete_sides(now_);
  control_.load(snapshot, locator_.switches().sides().size());
  h_ = std::min(snapshot.number("runner/h"), control_.active() ? options_.longest : options_.step);
  step_.number = resumed_at_ = static_cast<int>(snapshot.number("runner/number"));
  step_.corner = snapshot.number("runner/corner") != 0;
  renewed_ = snapshot.number("runner/renewed") != 0;
  pending_drift_ = snapshot.number("runner/pending_drift");
  if (step_.corner) scheme_.pass_corner(now_);
  earlier_speeds_ = load_speeds(context_.model, snapshot, now_.time);
  started_ = true;
  if (speed_jump(context_.model, now_.time, earlier_speeds_)) {
    // drives and supports go on with other speeds than they have had: the impulse is yet to come
    const double corner = now_.time;
    if ((control_.active() && scheme_.meets_events()) || options_.ends_even_steps_at_corners()) {
      now_.time = number_before(corner);
      if (!pass_corner(now_.time, corner, true)) return false;
    }
  } else if (!scheme_.takes_velocities(snapshot)) {
    scheme_.drift(now_, 0);  // fits them to the constraints, and accelerations to both
  }
  return march();
}

void Runner::save(Snapshot& snapshot) const {
  save_configuration(now_, snapshot);
  context_.save(snapshot);
  scheme_.save(snapshot);
  locator_.save(snapshot);
  control_.save(snapshot);
  snapshot.put("runner/h", h_);
  snapshot.put("runner/number", step_.number);
  snapshot.put("runner/renewed", renewed_ ? 1 : 0);
  snapshot.put("runner/pending_drift", pending_drift_);
  snapshot.put("runner/corner", step_.corner ? 1 : 0);
  save_speeds(speeds_so_far(), snapshot);
}

std::vector<ValueAndRate> Runner::speeds_so_far() const {
  if (!earlier_speeds_.empty()) return earlier_speeds_;
  // the start, and what has passed a corner, have the speeds that follow
  const bool follows = step_.number == 0 || step_.corner;
  std::vector<ValueAndRate> speeds = imposed_speeds(context_.model, follows ? now_.time : number_before(now_.time));
  if (!options_.moves()) std::fill(speeds.begin(), speeds.end(), ValueAndRate{0, 0});
  return speeds;
}

bool Runner::over() const { return scheme_.course() ? scheme_.course()->arrived : now_.time >= options_.end; }

bool Runner::renew(const NewtonReport& report) {
  if ((!report.singular && !report.conflict) || renewed_ || !context_.redundancy.renew(now_)) return false;
  renewed_ = true;
  return true;
}

bool Runner::follow() {
  h_ = scheme_.course()->next;
  while (!over()) {
    const Outcome outcome = scheme_.attempt(now_, h_, next_);
    if (!outcome.converged()) {
      if (!renew(outcome.newton)) cut(h_, h_ / 2, outcome.newton);
      continue;
    }
    scheme_.accept();
    std::swap(now_, next_);
    renewed_ = false;
    step_.newton = &outcome.newton;
    if (!accepted(now_.h, true, true)) return false;
    h_ = scheme_.course()->next;
  }
  return true;
}

bool Runner::march() {
  if (scheme_.course()) return follow();
  return control_.active() ? march_by_error() : march_evenly();
}

bool Runner::march_by_error() {
  const double end = options_.end, least = shortest_way * (end - options_.begin);
  for (const double corner : step_ends(context_.model, now_.time, end)) {
    const bool there = now_.time == number_before(corner) && way_to(corner).jumps;  // where a resumed run begins
    if (!there && (corner - now_.time < least || end - corner < least)) continue;
    if (!meet_corner(corner)) return false;
  }
  corner_.reset();
  return now_.time >= end || reach(end);
}

bool Runner::march_evenly() {
  const double begin = options_.begin, end = options_.end, step = options_.step, least = shortest_step * step;
  const auto steps = static_cast<long long>(std::ceil((end - begin) / step * (1 - shortest_step)));
  const auto done = static_cast<long long>(std::floor((now_.time - begin) / step * (1 + 1e-15)));
  std::vector<double> corners;
  if (options_.ends_even_steps_at_corners()) corners = context_.model.corners(now_.time, end);
  auto corner = corners.begin();
  for (long long k = std::max(1LL, done); k <= steps; ++k) {
    const double target = k == steps ? end : begin + static_cast<double>(k) * step;
    for (; corner != corners.end() && *corner < target + least && end - *corner >= least; ++corner) {
      beside_even_ = std::abs(*corner - target) >= least;
      if (!meet_corner(*corner)) return false;
      beside_even_ = false;
    }
    const bool near = k < steps && step_.corner && target - now_.time < least;
    if (now_.time < target && !near && !reach(target)) return false;
  }
  return true;
}

Runner::WayToCorner Runner::way_to(double corner) const {
  // a step that ends at a jump must not see what follows
  if (!scheme_.meets_events()) return {corner, false, false};
  const Model& model = context_.model;
  const bool impulse = speed_jump(model, corner).has_value();
  const bool jumps = impulse || model.jumps_at(corner) || imposed_acceleration_jumps(model, corner);
  return {jumps ? number_before(corner) : corner, jumps, impulse};
}

bool Runner::meet_corner(double corner) {
  const WayToCorner way = way_to(corner);
  corner_ = way.before;
  const bool beside = beside_even_;
  if (!control_.active()) beside_even_ = beside || way.jumps;  // results are those behind a jump
  const bool there = reach(way.before);
  beside_even_ = beside;
  return there && pass_corner(way.before, corner, way.impulse);
}

bool Runner::pass_corner(double before, double corner, bool impulse) {
  corner_ = corner;
  step_.impulse = impulse;
  if (before < corner && !drift(corner - before, corner)) return false;
  scheme_.pass_corner(now_);
  return true;
}

double Runner::next_size(double left) const {
  if (h_ >= 0.99 * left) return left;
  if (control_.active()) return std::min(h_, 0.5 * left);
  return left / std::ceil(left / h_ * 0.99);
}

bool Runner::reach(double target) {
  // a resumed run may have a drift to make first
  if (pending_drift_ > 0 && !drift(std::exchange(pending_drift_, 0), target)) return false;
  while (now_.time < target)
    if (!advance(target)) return false;
  locator_.new_target();
  renewed_ = false;
  step_.locating = 0;
  return true;
}

bool Runner::advance(double target) {
  const double left = target - now_.time;
  if (control_.active()) locator_.step_is(h_);
  if (locator_.active() && left < locator_.shortest()) {
    if (drifts(left)) return drift(left, target);
    h_ = left;  // the last step was chosen for a motion that has ended, as at a corner of a load
    locator_.step_is(h_);
  }
  Tried tried = attempt(left);
  if (tried.found.kind == Kind::drift) return !crosses(tried) || drift(tried.found.drift, target);
  if (!solved(tried, left) || !accurate(tried) || !stays(tried)) return true;
  return take(tried, target);
}

Runner::Tried Runner::attempt(double left) {
  Tried tried;
  tried.size = next_size(left);
  if (control_.active()) tried.size = locator_.foresee(now_, tried.size);
  tried.outcome = scheme_.attempt(now_, tried.size, next_);
  tried.found = locator_.inspect(now_, tried.size, tried.outcome.converged(), next_);
  step_.locating += tried.found.attempts;
  tried.size = tried.found.step;
  if (tried.found.outcome) tried.outcome = std::move(*tried.found.outcome);
  if (tried.found.kind != Kind::drift || control_.active() || !strays(tried.found.drift)) return tried;
  // a drift is too inaccurate for what is stiff: a step of the shortest length passes over the event
  tried.size = locator_.shortest();
  tried.outcome = scheme_.attempt(now_, tried.size, next_);
  if (tried.outcome.converged()) tried.found.kind = Kind::pass;
  return tried;
}

bool Runner::strays(double drift) {
  const double way = before_event(drift);
  return way > 0 && scheme_.drift_error(now_, way) > (control_.active() ? share_of_drift : 1);
}

bool Runner::crosses(const Tried& tried) {
  if (!control_.active() || !strays(tried.found.drift)) return true;
  // the motion has changed since the step was chosen, as after a jump of a force: a shorter step gets there
  ++step_.cuts;
  h_ = tried.found.drift;
  return false;
}

bool Runner::solved(Tried& tried, double left) {
  const NewtonReport& report = tried.outcome.newton;
  if (report.converged) return true;
  // other constraints may be redundant here than at the start
  if (renew(report)) return false;
  control_.refused();
  const double shorter = (control_.active() ? aside : 0.5) * tried.size;
  const double way = shortest(tried.size, shorter) ? find_beyond(tried.size, left, tried.outcome) : 0;
  if (way == 0) {
    cut(tried.size, shorter, report);
    return false;
  }
  tried.size = way;
  tried.jumps = true;
  return true;
}

bool Runner::accurate(Tried& tried) {
  const double error = tried.error();
  if (!control_.active() || error <= 1 || tried.jumps) return true;
  const double shorter = control_.retry(tried.size, error);
  tried.jumps = jumps_at(tried.size, shorter, error);
  if (tried.jumps) return true;
  NewtonReport inaccurate = tried.outcome.newton;
  inaccurate.reason = fmt::format("the step's error is {:.3g} times the tolerance TOL", error);
  cut(tried.size, shorter, inaccurate);
  return false;
}

bool Runner::stays(Tried& tried) {
  if (tried.jumps || !scheme_.leaps(now_, next_)) return true;
  tried.jumps = shortest(tried.size, 0.5 * tried.size);
  if (!tried.jumps) cut(tried.size, 0.5 * tried.size, tried.outcome.newton);
  return tried.jumps;
}

bool Runner::take(const Tried& tried, double target) {
  const EventLocator::Finding& found = tried.found;
  const double size = tried.size;
  if (std::abs(next_.time - target) <= 1e-9 * size) next_.time = target;  // avoids rounding accumulated in sums of h
  scheme_.accept();
  locator_.stepped(size);
  std::swap(now_, next_);
  // the inverse square of a short step amplifies rounding in accelerations and multipliers: they are computed anew
  if (locator_.active() && size < noisy * (control_.active() ? h_ : options_.step)) scheme_.drift(now_, 0);
  using Landing = StepControl::Landing;
  const Landing landing = found.kind != Kind::land ? Landing::none : found.attempts > 0 ? Landing::sought : Landing::foreseen;
  // back to the step asked for as soon as possible
  h_ = control_.active() ? control_.after(size, tried.error(), h_, landing) : std::min(options_.step, 2 * h_);
  step_.newton = &tried.outcome.newton;
  if (control_.active() && found.kind == Kind::none) locator_.new_target();
  if (tried.jumps) pass_jump();
  pending_drift_ = found.kind == Kind::land && now_.time < target ? found.drift : 0;
  // between the ends of a jump there is no motion
  if (!accepted(size, found.kind == Kind::none || now_.time == target, !tried.jumps)) return false;
  return !(pending_drift_ > 0) || drift(std::exchange(pending_drift_, 0), target);
}

double Runner::before_event(double drift) const {
  const double before = drift - crossing * locator_.tolerance();
  return before > locator_.tolerance() ? before : 0;
}

/// May so short a way be left to a drift?
bool Runner::drifts(double way) { return !control_.active() || !(scheme_.drift_error(now_, way) > share_of_drift); }

/// Drifts across an event, and on to the target if a step would be too short to get there.
bool Runner::drift(double time, double target) {
  const double left = target - now_.time;
  const bool arrives = left - time < locator_.shortest() && drifts(left);
  const double begun = now_.time;
  double size = arrives ? left : time;
  // a drift takes the mean of the forces at its ends: a force that jumps at the event must act only after it
  if (within_drifts_) before_drift_ = now_;
  if (const double before = before_event(size); before > 0) {
    scheme_.drift(now_, before);
    size -= before;
    // results within it lie on lines between its ends, which must not cross the jump
    step_.newton = nullptr;
    pending_drift_ = size;
    const bool tells = control_.active() && now_.time > begun && now_.time + size > now_.time;
    if (tells && !accepted(before, false, false)) return false;
    pending_drift_ = 0;
    if (within_drifts_) before_drift_ = now_;
  }
  scheme_.drift(now_, size);
  locator_.forget();
  if (arrives) now_.time = target;
  step_.newton = nullptr;
  return accepted(size, arrives, false);
}

bool Runner::shortest(double size, double shorter) const {
  // CUTS is a depth below H, whatever made the step as short as it is
  const int most = options_.cuts + (control_.active() ? deeper : 0);
  return depth_of(size, options_.step) >= most || now_.time + shorter == now_.time;
}

bool Runner::jumps_at(double size, double shorter, double error) {
  if (options_.analysis != SolverOptions::Analysis::statics) return false;
  // close to a limit load equilibria move with the root of the load: no step shows how
  return control_.stays(now_.time, size, error) || shortest(size, shorter);
}

double Runner::find_beyond(double size, double left, Outcome& outcome) {
  constexpr double longer = 4;
  if (options_.analysis != SolverOptions::Analysis::statics || outcome.newton.conflict) return 0;
  // results at multiples of H must not lie within the jump
  const double gone = (now_.time - options_.begin) / options_.step;
  const double most = std::min(left, (std::floor(gone * (1 + 1e-12)) + 1) * options_.step - (now_.time - options_.begin));
  Configuration tried = next_;
  Outcome found;
  // what nothing holds does not snap, unless it is a string without load that is tight from now on
  const auto& parts = context_.model.parts;
  const bool may_tighten = now_.time == options_.begin &&
                           std::any_of(parts.begin(), parts.end(), [](const auto& part) { return part.element->has_gaps(); });
  if (may_tighten || explain_unresisted(context_.assembler, now_, {}).empty()) found = scheme_.snap(now_, size, next_);
  for (double way = size;;) {
    if (found.converged()) {
      outcome = std::move(found);
      return way;
    }
    if (way >= most) break;
    way = longer * way < 0.5 * most ? longer * way : most;
    found = scheme_.attempt(now_, way, next_);
  }
  next_ = std::move(tried);
  return 0;
}

void Runner::pass_jump() {
  jumped_at_ = now_.time;
  scheme_.pass_corner(now_);
  control_.begin_anew();
  h_ = control_.active() ? std::min(options_.step, control_.longest()) : options_.step;
}

void Runner::cut(double size, double shorter, const NewtonReport& report) {
  if (shortest(size, shorter))
    throw SolutionFailure(
        failure_text(context_, now_, next_, report, step_.number + 1, std::max(depth_of(size, options_.step), 0)));
  ++step_.cuts;
  h_ = shorter;
}

bool Runner::accepted(double size, bool regular, bool solved) {
  ended_ = now_.scalars;
  earlier_speeds_.clear();
  context_.assembler.commit(now_);
  step_.events.clear();
  if (locator_.active()) step_.events = locator_.switches().take(now_);
  unsettled_ = scheme_.settle_friction(now_);
  if (unsettled_ && locator_.active()) {
    const std::vector<Event> late = locator_.switches().renew(now_);
    step_.events.insert(step_.events.end(), late.begin(), late.end());
  }
  if (control_.active() && !step_.events.empty()) {
    h_ = control_.enter(locator_.switches().sides(), h_);
    scheme_.enter(locator_.switches().sides());
  }
  ++step_.number;
  step_.step = size;
  step_.regular = regular && !beside_even_;
  step_.corner = now_.time == corner_ || jumped_at_ == now_.time;
  step_.course = scheme_.course();
  step_.last = over();
  step_.settled = unsettled_.has_value();
  step_.within = nullptr;
  step_.drift = !solved;
  if (control_.active() && (solved || within_drifts_))
    step_.within = [this] {
      return scheme_.within(step_.drift ? before_drift_ : next_, unsettled_ ? *unsettled_ : now_, ended_, step_.drift);
    };
  step_.chatter = locator_.chatters();
  const bool go_on = (*after_step_)(now_, step_);
  step_.cuts = step_.locating = 0;
  step_.impulse = false;
  return go_on;
}

}  // namespace engrane::solve
