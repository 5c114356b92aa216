// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/arc_length.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "solve/algebra/probe.hpp"
#include "solve/schemes/mode_text.hpp"

namespace engrane::solve {

namespace {

/// Finite-difference step, in load time over H, for the change of forces with the load time.
constexpr double load_step = 1e-4;
/// If Newton's method takes more iterations, the next step is half as long. Fewer do not count: their number changes by one
/// with the last digit, and steps would change with it.
constexpr int most_iterations = 12;
/// Angle by which a step of the path should turn, and by which it may: more than the 45 degrees where the loads of a linear
/// structure cease to grow.
constexpr double wished_turn = 6 * std::numbers::pi / 180, most_turn = 46 * std::numbers::pi / 180;
/// Loads whose change moves the structure less than this fraction of what it did at the start stand still: differences over
/// load_step leave about 1e-10 of rounding.
constexpr double stands_still = 1e-8;
/// Nodes that have travelled less than this fraction of the farthest count as if it were that: what rounding moves must not
/// count.
constexpr double least_travel = 1e-4;
/// Nodes leap that move farther in a step than so many times what they have travelled and its beginning leads, and than this part
/// of the distance to the next node, or of a radian: what rounding moves does not.
constexpr double most_leap = 1.5, far_enough = 0.05;
constexpr double longest_step = 0.1;
/// Distance to the end of a step over that expected, at most: behind a corner of 87 degrees the plane is met so far away.
constexpr double most_overrun = 20;
/// Part of the run by which the load time changes in one step at most; the step before expected longest_step.
constexpr double most_path_change = 0.25;
/// Change of the load time over that at the start, for the same motion, from which on loads hardly change with time.
constexpr double slow_loads = 10;
/// Fraction of H below which a step may turn by any angle: at a corner the path turns however short the step is.
constexpr double corner = 1.0 / 128;
/// Number of steps after which a path without an end of its own is given up.
constexpr int most_steps = 10000;
/// Bifurcations are located to this fraction of the least eigenvalue, and nothing to less than that fraction of a step.
constexpr double sharp = 1e-4, narrow = 1e-9;
/// A step ends this fraction of it behind a bifurcation. Nearer, what Newton's method leaves of forces is a visible displacement
/// along the mode.
constexpr double passed_by = 2 * sharp;
/// If there is no solution, the next trial is nearer to the beginning by this fraction of the way.
constexpr double nearer_by = 1e-3;
constexpr int most_nearer = 4;
/// A small eigenvalue is accepted only if the bracket is shorter than this fraction of the step.
constexpr double near = 0.1;
constexpr int most_trials = 60;
/// Inverse iterations for the least eigenvalue, and the change at which they end: vectors are off by its square root.
constexpr int most_turns = 30;
constexpr double settled = 1e-15;

std::vector<double> copy(std::span<const double> values) { return {values.begin(), values.end()}; }

bool across(double a, double b) { return (a < 0) != (b < 0); }

double product(std::span<const double> weights, std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += weights[i] * a[i] * b[i];
  return sum;
}

/// By node: distance to the nearest of those that stand beside it in the record of an element; infinite for single nodes.
std::vector<double> distances_to_neighbours(const Model& model) {
  std::vector<double> least(model.nodes.size(), std::numeric_limits<double>::infinity());
  for (const Model::Part& part : model.parts)
    for (std::size_t k = 1; k < part.nodes.size(); ++k) {
      const int a = part.nodes[k - 1], b = part.nodes[k];
      const double distance = (model.node(a).x - model.node(b).x).norm();
      if (a == 0 || b == 0 || distance == 0) continue;  // the ground is everywhere
      for (const int node : {a, b}) {
        double& nearest = least[static_cast<std::size_t>(node)];
        nearest = std::min(nearest, distance);
      }
    }
  return least;
}

}  // namespace

ArcLength::ArcLength(SolverContext& context)
    : Statics(context), tangent_(context), load_derivative_(context, load_step * context.options.step) {
  for (Owned<Vec>* vector : {&load_, &toward_, &right_, &plane_}) *vector->out() = context.assembler.new_vector();
  const double extent = context.model.extent();
  const std::vector<double> reach = distances_to_neighbours(context.model);
  int node = -1;
  for (const Unknown& u : context.numbering.unknowns()) {
    weights_.push_back(u.multiplier ? 0 : u.measure == Measure::force ? 1 / (extent * extent) : 1);
    if (u.node < 0 || u.node != node) {
      travelled_.push_back(0);
      reach_.push_back(u.node < 0 ? 0 : reach[static_cast<std::size_t>(u.node)]);
    }
    groups_.push_back(travelled_.size() - 1);
    node = u.node;
  }
  relative_ = weights_;
  counted_.assign(travelled_.size(), 0.0);
}

StartReport ArcLength::start(Configuration& c) {
  StartReport report = Statics::start(c);
  unit_ = 0;
  if (!examine(c, nullptr, here_))
    throw SolutionFailure("the path cannot be followed: the tangent matrix is singular at its start");
  if (unit_ == 0)
    throw SolutionFailure(
        "the path cannot be followed: nothing moves when time grows; give loads or prescribed displacements a function of time, "
        "NF");
  travel(here_, context_.options.step);
  weigh();
  measure_ = relative(here_.way);
  course_.next = context_.options.step;
  course_.unstable = unstable(here_);
  return report;
}

void ArcLength::travel(const Point& at, double h) {
  std::vector<double> squares(travelled_.size());
  for (std::size_t i = 0; i < weights_.size(); ++i) squares[groups_[i]] += weights_[i] * at.way[i] * at.way[i];
  for (std::size_t g = 0; g < squares.size(); ++g) travelled_[g] += h * std::sqrt(squares[g]);
}

void ArcLength::weigh() {
  const double least = least_travel * *std::max_element(travelled_.begin(), travelled_.end());
  for (std::size_t i = 0; i < relative_.size(); ++i) {
    const double own = travelled_[groups_[i]], travelled = counted_[groups_[i]] != 0 ? own : std::max(own, least);
    relative_[i] = weights_[i] / (travelled * travelled);
  }
}

bool ArcLength::find_leaps(std::span<const double> chord, double h) {
  const double least = least_travel * *std::max_element(travelled_.begin(), travelled_.end());
  std::vector<double> squares(travelled_.size()), lead(travelled_.size()), visibly(travelled_.size());
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    const std::size_t g = groups_[i];
    squares[g] += weights_[i] * chord[i] * chord[i];
    lead[g] += weights_[i] * here_.way[i] * here_.way[i];
    const bool turns = context_.numbering.unknown(static_cast<int>(i)).rotational();
    if (weights_[i] > 0 && std::abs(chord[i]) > far_enough * (turns ? 1 : reach_[g])) visibly[g] = 1;
  }
  const double before = pace(here_);
  bool found = false;
  for (std::size_t g = 0; g < travelled_.size(); ++g) {
    if (visibly[g] == 0 || counted_[g] != 0 || !(travelled_[g] > 0) || travelled_[g] >= least) continue;
    if (std::sqrt(squares[g]) <= most_leap * (travelled_[g] + std::abs(h) * std::sqrt(lead[g]))) continue;
    counted_[g] = 1;
    found = true;
  }
  if (!found) return false;
  weigh();
  measure_ *= pace(here_) / before;
  return true;
}

double ArcLength::relative(std::span<const double> way) const { return std::sqrt(product(relative_, way, way)) / measure_; }

double ArcLength::pace(const Point& point) const {
  const double size = relative(point.way);
  return size > 0 ? size : 1;
}

double ArcLength::length(std::span<const double> way) const { return std::sqrt(product(weights_, way, way)); }

int ArcLength::unstable(const Point& point) const { return unstable_directions(context_, point.negative, point.symmetric); }

int ArcLength::turned(const Point& a, const Point& b) const {
  if (a.symmetric == b.symmetric) return std::abs(a.negative - b.negative);
  return std::abs(unstable(a) - unstable(b)) % 2;
}

bool ArcLength::examine(const Configuration& c, const Point* before, Point& point) {
  if (!tangent_.factor(c)) return false;
  load_derivative_.turn(!before || before->load >= 0);
  load_derivative_.find(tangent_.place(), load_);
  tangent_.solve(load_, toward_);
  point.way = copy(context_.assembler.gather(toward_));
  point.negative = tangent_.negative();
  point.symmetric = tangent_.symmetric();
  const double size = length(point.way);
  if (!std::isfinite(size)) return false;
  if (unit_ == 0) unit_ = size;
  if (size <= stands_still * unit_) {  // only the load time goes on
    std::fill(point.way.begin(), point.way.end(), 0.0);
    point.load = before ? std::copysign(1.0, before->load) : 1.0;
    return true;
  }
  point.load = unit_ / size;
  for (double& value : point.way) value *= -point.load;
  if (!before) return true;
  const double along = product(relative_, before->way, point.way);
  if (along < 0 || (along == 0 && before->load < 0)) {
    point.load = -point.load;
    for (double& value : point.way) value = -value;
  }
  return true;
}

bool ArcLength::loads_have_ended(const Configuration& c) {
  Point point;
  if (!examine(c, &here_, point)) return false;
  const double begin = context_.options.begin, span = context_.options.end - begin, by = longest_step * span;
  for (double later = -by; c.load_time() + later > begin - span; later -= by) {
    load_derivative_.change(tangent_.place(), later, load_);
    tangent_.solve(load_, toward_);
    if (length(context_.assembler.gather(toward_)) > stands_still * unit_ * span) return false;
  }
  return true;
}

double ArcLength::angle(const Point& a, const Point& b) const {
  const auto with_load = [&](const Point& p, const Point& q) {
    return product(relative_, p.way, q.way) / (measure_ * measure_) + p.load * q.load;
  };
  return std::acos(std::clamp(with_load(a, b) / std::sqrt(with_load(a, a) * with_load(b, b)), -1.0, 1.0));
}

NewtonReport ArcLength::follow(const Configuration& from, double h, Configuration& to, bool at_end) {
  to = from;
  to.time = from.time + h;
  to.h = h;
  now_ = at_end ? context_.options.end : from.load_time() + here_.load * h;
  load_derivative_.turn(here_.load >= 0);
  std::vector<double> y(context_.motion.size(), 0.0), guess(here_.way.size(), 0.0), normal(here_.way.size());
  context_.assembler.multipliers_to_unknowns(from, guess);
  for (std::size_t i = 0; i < guess.size(); ++i) {
    guess[i] += h * here_.way[i];
    normal[i] = relative_[i] * here_.way[i];
  }
  aim_ = h * product(relative_, here_.way, here_.way);
  context_.assembler.spread(normal, plane_);
  const Newton::Apply apply = [&](std::span<const double> unknowns, Configuration& c) {
    context_.motion.scatter(unknowns, y);
    context_.motion.prescribe_increment(from.load_time(), now_, y);
    context_.motion.move(from, y, c);
    c.lead = now_ - c.time;
    context_.assembler.unknowns_to_multipliers(unknowns, c);
  };
  context_.assembler.spread(guess, unknowns());
  work_ = &to;
  NewtonReport report = solve(unknowns(), {1, 0, 0}, apply, to, false, at_end ? nullptr : this);
  refuse_half_turns(y, report);
  if (report.converged && !branching_) {
    Point chord{std::vector<double>(here_.way.size()), now_ - from.load_time()};
    context_.motion.gather(y, chord.way);
    const double turn = angle(here_, chord), way = h * pace(here_);
    report.converged = relative(chord.way) <= most_overrun * way && (turn <= most_turn || way <= corner * context_.options.step);
    if (!report.converged)
      report.reason = fmt::format("the step ends {:.0f} degrees off the path", turn * 180 / std::numbers::pi);
    if (report.converged && find_leaps(chord.way, h)) {
      report.converged = false;
      report.reason = "parts of the structure snap within the step";
    }
  }
  if (!report.converged) context_.newton.refuse_last();
  return report;
}

std::optional<NewtonReport> ArcLength::arrive(const Configuration& from, double h, Configuration& to) {
  const double left = context_.options.end - from.load_time(), way = left / here_.load;
  if (branching_ || !(way > 0 && way <= h)) return {};
  NewtonReport report = follow(from, way, to, true);
  if (!report.converged || !examine(to, &here_, there_) || there_.load <= 0 || angle(here_, there_) > most_turn) return {};
  next_course_.arrived = true;
  return report;
}

void ArcLength::complete(Vec x, Vec step) {
  moved_ = 0;
  load_derivative_.find(*work_, load_);
  if (!context_.solver.solve(load_, toward_)) return;
  PetscReal at = 0, by = 0, with = 0;
  check_petsc(VecDot(plane_, x, &at));
  check_petsc(VecDot(plane_, step, &by));
  check_petsc(VecDot(plane_, toward_, &with));
  if (std::abs(with) <= stands_still * product(relative_, here_.way, here_.way))
    return;  // no change of the loads leads into the plane
  // a change Δ of the load time changes x by −step − Δ toward
  const double change = (at - by - aim_) / with;
  if (!std::isfinite(change)) return;
  now_ += change;
  moved_ = change;
  check_petsc(VecAXPY(step, change, toward_));
}

bool ArcLength::has_settled(double part) const {
  return std::abs(moved_) <= part * std::max(std::abs(now_ - context_.options.begin), context_.options.step);
}

Outcome ArcLength::attempt(const Configuration& from, double h, Configuration& to) {
  if (context_.options.path.steps == 0 && steps_ == most_steps)
    throw SolutionFailure(fmt::format(
        "the path has not come to load time {:g} in {} steps, and may never: give STEPS, or NODE with a displacement that "
        "it comes to",
        context_.options.end, most_steps));
  if (here_.load < 0 && length(here_.way) == 0 && loads_have_ended(from))
    throw SolutionFailure(fmt::format(
        "the loads stay as they are from load time {:.6g} back, and the path cannot go on: a TABLE holds its first value before "
        "its first point. Give functions that go on changing there, such as EXPR \"T\"",
        from.load_time()));
  next_course_ = {};
  next_bifurcations_ = bifurcations_;
  if (std::optional<NewtonReport> report = arrive(from, h, to)) {
    next_course_.next = h * pace(here_);  // of a restart with a later end
    h = to.h;
    find_goal(from, h, to, there_);
    find_critical(from, h, to, there_);
    step_ = h;
    return {std::move(*report), {}};
  }
  NewtonReport report = follow(from, h, to);
  const double span = context_.options.end - context_.options.begin, passed = std::abs(to.load_time() - from.load_time());
  // behind the top of a function of time the same loads stand at another time
  const bool off = !(passed <= most_path_change * span), slow = !report.converged && here_.load > slow_loads;
  if (off || slow) {
    report.reason = fmt::format(
        "{}. Either the loads hardly change with time at load time {:.6g}, and a path cannot pass such a place: give them a "
        "function that goes on changing, such as EXPR \"T\". Or the path ends there, as where the ends of a spring meet",
        off ? fmt::format("the step ends off the path, at load time {:.6g}", to.load_time()) : report.reason, from.load_time());
    report.converged = false;
  }
  if (!report.converged) return {std::move(report), {}};
  if (!examine(to, &here_, there_)) {
    report.converged = false;
    report.singular = true;
    report.reason = "the tangent matrix is singular at the end of the step";
    return {std::move(report), {}};
  }
  const double turn = angle(here_, there_);
  if (!branching_ && turn > most_turn && h * pace(here_) > corner * context_.options.step) {
    report.converged = false;
    report.reason = fmt::format("the path turns by {:.0f} degrees in the step", turn * 180 / std::numbers::pi);
    return {std::move(report), {}};
  }
  const double growth = report.iterations > most_iterations ? 0.5 : std::clamp(wished_turn / turn, 0.5, 2.0);
  // the load time changes by a fraction of the run's at most
  const double longest = longest_step * (context_.options.end - context_.options.begin) / std::abs(there_.load);
  next_course_.next = std::min(growth * h * pace(here_), longest * pace(there_));
  find_goal(from, h, to, there_);
  if (!branching_) find_critical(from, h, to, there_);
  step_ = h;
  return {std::move(report), {}};
}

void ArcLength::find_goal(const Configuration& from, double& h, Configuration& to, Point& there) {
  const SolverOptions::Path& path = context_.options.path;
  const auto seek = [&](const std::function<double(const Configuration&)>& value) {
    const double first = value(from);
    if (first == 0 || !across(first, value(to))) return;
    locate(from, h, to, there, first, narrow, [&](const Configuration& c, const Point&) { return value(c); });
    next_course_.arrived = true;
  };
  const double end = context_.options.end;
  if (!next_course_.arrived) seek([end](const Configuration& c) { return c.load_time() - end; });
  if (path.node > 0)
    seek([&](const Configuration& c) {
      const auto node = static_cast<std::size_t>(path.node);
      return (c.nodes[node].x - context_.model.nodes[node].x)[path.component] - path.displacement;
    });
}

ArcLength::Bracket ArcLength::locate(const Configuration& from, double& h, Configuration& to, Point& there, double first,
                                     double precision, const std::function<double(const Configuration&, const Point&)>& value) {
  Bracket found{{here_, from.load_time(), first}, {there, to.load_time(), value(to, there)}};
  const double whole = h, small = precision * std::max(std::abs(first), std::abs(found.behind.value));
  double low = 0, high = h, at_low = first, at_high = found.behind.value;
  int side = 0;
  for (int trial = 0; trial < most_trials && high - low > narrow * whole; ++trial) {
    // regula falsi; the value of an end that stays twice is halved (Illinois). The least eigenvalue at an end may be another
    // one than that which changes its sign: every third trial bisects
    double h_try = high - at_high * (high - low) / (at_high - at_low);
    if (!(h_try > low && h_try < high) || trial % 3 == 2) h_try = 0.5 * (low + high);
    Configuration tried;
    Point point;
    bool solved = false;
    // next to a bifurcation the tangent may be too close to singular
    for (int nearer = 0; !solved && nearer < most_nearer; ++nearer, h_try -= nearer_by * (h_try - low))
      if (follow(from, h_try, tried).converged && examine(tried, &here_, point)) {
        solved = true;
        break;
      }
    if (!solved) break;
    const double at = value(tried, point);
    if (across(at, at_high)) {
      if (side < 0) at_high /= 2;
      low = h_try, at_low = at, side = -1;
      found.before = {point, tried.load_time(), at};
    } else {
      if (side > 0) at_low /= 2;
      high = h_try, at_high = at, side = 1;
      found.behind = {point, tried.load_time(), at};
    }
    h = h_try;
    to = std::move(tried);
    there = std::move(point);
    // what is smooth has but one zero there; any nearer to a limit point the factors lose the digits of its place
    if (std::abs(at) <= small && (precision < sharp || high - low < near * whole)) break;
  }
  return found;
}

void ArcLength::find_critical(const Configuration& from, double& h, Configuration& to, Point& there) {
  const int turns = turned(here_, there);
  if (turns == 0) return;
  const bool limit = across(here_.load, there.load) && turns == 1;
  const auto value = [&](const Configuration&, const Point& point) {
    if (limit) return point.load;
    // the least eigenvalue, with a sign for the side
    const double size = std::abs(least_mode().eigenvalue);
    return turned(here_, point) == 0 ? size : -size;
  };
  double first = here_.load;
  if (!limit) {
    Point start;
    if (!examine(from, &here_, start)) return;
    first = std::abs(least_mode().eigenvalue);
    if (!examine(to, &here_, there)) return;  // the factors are of the end again
  }
  const Configuration end = to;
  const Point at_end = there;
  const double whole = h;
  const Bracket bracket = locate(from, h, to, there, first, limit ? narrow : sharp, value);
  const bool behind = !limit && pass(from, end, whole, h, to);
  // the last factors of the search may belong to a failed attempt
  if (!examine(to, &here_, there)) return;
  const Mode mode = least_mode();
  CriticalPoint point;
  point.kind = limit ? CriticalPoint::Kind::limit : CriticalPoint::Kind::bifurcation;
  point.load_time = to.load_time();
  if (limit)  // passed, whichever side the last trial ended on; the other end of the bracket may be far behind
    there.load = std::copysign(there.load, bracket.behind.point.load);
  else
    point.load_time = std::lerp(bracket.before.load_time, bracket.behind.load_time,
                                bracket.before.value / (bracket.before.value - bracket.behind.value));
  point.before = unstable(bracket.before.point);
  point.counted = bracket.before.point.symmetric;
  if (!behind) {
    there.negative = bracket.behind.point.negative;
    there.symmetric = bracket.behind.point.symmetric;
  }
  point.after = unstable(there);
  point.mode = largest_components(context_.numbering, mode.vector);
  if (!limit) keep_direction(at_end, h / whole, there);
  if (!limit && ++next_bifurcations_ == context_.options.path.branch) point.switched = take_branch(mode, there);
  if (h < whole || point.switched != 0) next_course_.arrived = false;  // that was beyond it
  next_course_.critical = std::move(point);
}

bool ArcLength::pass(const Configuration& from, const Configuration& end, double whole, double& h, Configuration& to) {
  const double wished = h + passed_by * whole;
  Configuration behind;
  Point point;
  if (wished < whole) {
    if (!follow(from, wished, behind).converged || !examine(behind, &here_, point) || turned(here_, point) == 0) return false;
    // a last step under given loads has another measure of its length
    if (!next_course_.arrived || behind.load_time() <= context_.options.end) {
      h = wished;
      to = std::move(behind);
      return true;
    }
  }
  h = whole;
  to = end;
  return true;
}

void ArcLength::keep_direction(const Point& at_end, double part, Point& there) const {
  for (std::size_t i = 0; i < there.way.size(); ++i) there.way[i] = std::lerp(here_.way[i], at_end.way[i], part);
  there.load = std::lerp(here_.load, at_end.load, part);
  const double size = length(there.way) / unit_;
  if (size == 0) return;
  there.load /= size;
  for (double& value : there.way) value /= size;
}

ArcLength::Mode ArcLength::least_mode() {
  const auto equations = weights_.size();
  Mode mode;
  mode.vector.resize(equations);
  // has a component in every motion
  for (std::size_t i = 0; i < equations; ++i) mode.vector[i] = weights_[i] > 0 ? probe_value(i) : 0;
  std::vector<double> right(equations);
  for (int turn = 0; turn < most_turns; ++turn) {
    const double size = length(mode.vector);
    for (std::size_t i = 0; i < equations; ++i) right[i] = weights_[i] * mode.vector[i] / size;
    context_.assembler.spread(right, right_);
    tangent_.solve(right_, toward_);
    std::vector<double> next = copy(context_.assembler.gather(toward_));
    const double inverse = product(weights_, mode.vector, next) / size;
    const double before = mode.eigenvalue;
    mode.eigenvalue = 1 / inverse;
    mode.vector = std::move(next);
    if (turn > 0 && std::abs(mode.eigenvalue - before) <= settled * std::abs(mode.eigenvalue)) break;
  }
  return mode;
}

double ArcLength::take_branch(const Mode& mode, Point& there) {
  const SolverOptions::Path& path = context_.options.path;
  const double size = length(mode.vector) / unit_;
  double farthest = 0;
  for (std::size_t i = 0; i < weights_.size(); ++i)
    if (is_translation(context_.numbering, i) && std::abs(mode.vector[i]) > std::abs(farthest)) farthest = mode.vector[i];
  if (farthest == 0) return 0;
  there.way = mode.vector;
  there.load = 0;
  // the sign of the amplitude is that of the largest displacement
  const double sign = across(farthest, path.amplitude) ? -1 : 1;
  for (double& value : there.way) value *= sign / size;
  branch_step_ = std::abs(path.amplitude / farthest) * size;
  return path.amplitude;
}

void ArcLength::accept() {
  travel(here_, step_ / 2);
  travel(there_, step_ / 2 * pace(here_) / pace(there_));
  // a direction goes on being worth as much beside the load time
  const Point& last = length(there_.way) > 0 ? there_ : here_;
  const double before = pace(last);
  weigh();
  measure_ *= pace(last) / before;
  here_ = std::move(there_);
  const double critical_time = course_.critical_time;
  course_ = std::move(next_course_);
  course_.critical_time = course_.critical ? course_.critical->load_time : critical_time;
  course_.unstable = unstable(here_);
  bifurcations_ = next_bifurcations_;
  branching_ = course_.critical && course_.critical->switched != 0;
  course_.next = branching_ ? branch_step_ : course_.next / pace(here_);
  if (++steps_ == context_.options.path.steps) course_.arrived = true;
}

void ArcLength::save(Snapshot& snapshot) const {
  Statics::save(snapshot);
  snapshot.put("path/way", here_.way);
  snapshot.put("path/state", {here_.load, static_cast<double>(here_.negative), here_.symmetric ? 1.0 : 0.0, unit_,
                              static_cast<double>(bifurcations_), static_cast<double>(steps_), branching_ ? 1.0 : 0.0,
                              course_.next, static_cast<double>(course_.unstable), course_.critical_time});
  snapshot.put("path/travelled", travelled_);
  snapshot.put("path/counted", counted_);
  snapshot.put("path/measure", measure_);
  snapshot.put("path/arrived", course_.arrived ? goal() : std::vector<double>{});
}

std::vector<double> ArcLength::goal() const {
  const SolverOptions::Path& path = context_.options.path;
  return {context_.options.end, static_cast<double>(path.steps), static_cast<double>(path.node),
          static_cast<double>(path.component), path.displacement};
}

void ArcLength::load(const Snapshot& snapshot) {
  Statics::load(snapshot);
  here_.way = snapshot.array("path/way");
  const std::vector<double>& state = snapshot.array("path/state");
  if (here_.way.size() != weights_.size()) throw std::out_of_range("the path has other equations");
  travelled_ = snapshot.array("path/travelled");
  if (snapshot.has("path/counted")) counted_ = snapshot.array("path/counted");  // files of earlier versions lack it
  weigh();
  measure_ = snapshot.number("path/measure");
  here_.load = state.at(0);
  here_.negative = static_cast<int>(state.at(1));
  here_.symmetric = state.at(2) != 0;
  unit_ = state.at(3);
  bifurcations_ = static_cast<int>(state.at(4));
  steps_ = static_cast<int>(state.at(5));
  branching_ = state.at(6) != 0;
  course_.next = state.at(7);
  course_.unstable = static_cast<int>(state.at(8));
  course_.critical_time = state.at(9);
  course_.arrived = snapshot.array("path/arrived") == goal();
}

}  // namespace engrane::solve
