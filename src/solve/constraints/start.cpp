// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/start.hpp"

#include <fmt/format.h>

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "math/angle.hpp"
#include "math/rotation.hpp"
#include "model/elastic_teeth.hpp"
#include "solve/constraints/carried_bodies.hpp"
#include "solve/constraints/constraint_factors.hpp"
#include "solve/constraints/diagnosis.hpp"
#include "solve/constraints/open_loop.hpp"

namespace engrane::solve {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Teeth are 1.57 modules thick at the pitch circle. None is pressed in by a third of that.
constexpr double most_modules = 0.5;

const ElasticTeeth* elastic_teeth(const Model::Part& part) {
  const auto* teeth = dynamic_cast<const ElasticTeeth*>(part.element.get());
  return teeth && teeth->tooth_deformation() >= 0 ? teeth : nullptr;
}

/// Angle of the rotation from one to the other.
double angle_between(const Mat3& a, const Mat3& b) { return rotation_log(Mat3(a.transpose() * b)).norm(); }

}  // namespace

Start::Start(Assembler& assembler, LinearSolver& solver, const MotionSlots& motion, Redundancy& redundancy)
    : assembler_(assembler), solver_(solver), motion_(motion), redundancy_(redundancy), coordinates_(assembler) {
  *right_.out() = assembler.new_vector();
  *solution_.out() = assembler.new_vector();
}

double Start::away(const Configuration& c) const {
  const Model& model = assembler_.model();
  double farthest = model.extent();
  for (const Model::Part& part : model.parts)
    for (const int node : part.nodes)
      farthest = std::max(farthest, c.nodes[static_cast<std::size_t>(node)].x.cwiseAbs().maxCoeff());
  return farthest / model.extent();
}

bool Start::solve(std::vector<double>& right, std::vector<double>& solution) {
  assembler_.spread(right, right_);
  if (!solver_.solve(right_, solution_)) return false;
  const auto all = assembler_.gather(solution_);
  solution.assign(all.begin(), all.end());
  return true;
}

std::vector<int> Start::imposed(bool velocity) const {
  std::vector<int> equations;
  for (const InitialValue& value : assembler_.model().initial) {
    if (value.velocity != velocity || !value.imposed) continue;
    if (const int e = assembler_.numbering().equation(6 * value.node + value.component); e >= 0) equations.push_back(e);
  }
  return equations;
}

void Start::verify_imposed(const Configuration& c, std::span<const double> wished, bool velocity) const {
  const auto v = motion_.velocities(c);
  for (const int e : imposed(velocity)) {
    const Unknown& u = assembler_.numbering().unknown(e);
    const auto slot = static_cast<std::size_t>(u.slot);
    const NodeState& node = c.nodes[static_cast<std::size_t>(u.node)];
    double off = 0, size = 0;
    Dimension unit = dimension::length;
    if (velocity) {
      off = v[slot] - wished[slot];
      size = largest(v);
      unit = u.item < 3 ? dimension::velocity : dimension::angular_velocity;
    } else if (u.item < 3) {
      off = node.x[u.item] - wished[slot];
      size = assembler_.model().extent();
    } else {
      // the held value is the component of the rotation from where the deck put the node
      const std::size_t first = slot - static_cast<std::size_t>(u.item - 3);
      const Mat3 put = rotation_exp(Vec3(wished[first], wished[first + 1], wished[first + 2]));
      off = (motion_.adds_rotations() ? rotation_log(node.R)[u.item - 3] - wished[slot]
                                      : rotation_log(put.transpose() * node.R)[u.item - 3]) /
            degree;
      size = 1 / degree;
    }
    if (std::abs(off) <= 1e-6 * size) continue;
    throw SolutionFailure(fmt::format(
        "the initial {} of {} is imposed, but joints, drives or supports do not allow it: they change it by {:.4g} {}. Without "
        "IMPOSED it is a starting guess, which they may change",
        velocity ? "velocity" : "position", assembler_.numbering().describe(e), off,
        !velocity && u.item >= 3 ? "deg" : assembler_.model().units.label(unit)));
  }
}

Start::PressedTeeth Start::most_pressed_teeth(const Configuration& c) const {
  PressedTeeth most;
  const std::vector<Model::Part>& parts = assembler_.model().parts;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const ElasticTeeth* teeth = elastic_teeth(parts[p]);
    if (!teeth) continue;
    const int part = static_cast<int>(p);
    const double deflection = teeth->tooth_deflection(assembler_.view(part, c)), modules = deflection / teeth->tooth_size();
    if (modules > most.modules) most = {part, deflection, modules};
  }
  return most;
}

std::vector<std::size_t> Start::tooth_deformations() const {
  std::vector<std::size_t> scalars;
  const std::vector<Model::Part>& parts = assembler_.model().parts;
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (const ElasticTeeth* teeth = elastic_teeth(parts[p]))
      scalars.push_back(
          static_cast<std::size_t>(assembler_.numbering().scalar_begin(static_cast<int>(p)) + teeth->tooth_deformation()));
  return scalars;
}

std::vector<int> Start::held_positions() const {
  std::vector<int> equations = imposed(false);
  if (!holds_teeth_) return equations;
  const std::size_t first = 6 * assembler_.model().nodes.size();
  for (const std::size_t i : tooth_deformations())
    if (const int e = assembler_.numbering().equation(static_cast<int>(first + i)); e >= 0) equations.push_back(e);
  return equations;
}

void Start::assemble(Configuration& c, StartReport& report) {
  const Configuration given = c;
  assemble_once(c, report);
  std::vector<double> moves(c.nodes.size(), 0.0);
  for (const StartReport::Moved& one : report.moved)
    moves[static_cast<std::size_t>(one.node)] = std::max(one.move, assembler_.model().extent() * one.turn);
  CarriedBodies bodies(assembler_, Assembler::Metric::geometric, false, moves, 0);
  if (!bodies.none()) {
    carried_ = &bodies;
    Configuration whole = given;
    StartReport of_whole;
    try {
      assemble_once(whole, of_whole);
      c = std::move(whole);
      report = std::move(of_whole);
    } catch (const SolutionFailure& failure) {
      carried_ = nullptr;
      report.remarks.push_back(std::string("an elastic body begins strained, as it cannot be moved as a whole: ") +
                               failure.what());
    }
  }
  assemble_teeth(given, c, report);
  carried_ = nullptr;
  note_bodies(bodies, "what closes the joints or sets their values moves",
              "it begins strained. Give the coordinates of its nodes there", report);
}

void Start::assemble_teeth(const Configuration& given, Configuration& c, StartReport& report) {
  if (tooth_deformations().empty()) return;
  PressedTeeth pressed = most_pressed_teeth(c);
  if (!(pressed.modules > most_modules)) return;
  // to deform teeth is the shortest way to close the gap of a drive that begins far away, but no wheel stays behind its mate
  Configuration stiff = given;
  StartReport stiff_report;
  holds_teeth_ = true;
  try {
    assemble_once(stiff, stiff_report);
  } catch (const SolutionFailure&) {
    stiff = given;
    stiff_report = {};
    holds_teeth_ = false;
    assemble_once(stiff, stiff_report);
  }
  holds_teeth_ = false;
  c = std::move(stiff);
  report = std::move(stiff_report);
  pressed = most_pressed_teeth(c);
  if (!(pressed.modules > most_modules)) return;
  const Model::Part& part = assembler_.model().parts[static_cast<std::size_t>(pressed.part)];
  report.remarks.push_back(fmt::format(
      "the teeth of {} are pressed in by {:.4g} {} at the start, {:.3g} times their module, and carry the force that goes "
      "with "
      "it: the positions given for the wheels do not fit the gear ratio. Give the position of one wheel only (.INI DEP ELEMENT, "
      "or a drive); the other one follows",
      part.name(), pressed.deflection, assembler_.model().units.label(dimension::length), pressed.modules));
}

int Start::close_again(Configuration& c) {
  const Configuration given = c;
  const Closing closing = close(c, {}, {});
  if (closing.singular)
    throw SolutionFailure(explain_singular(assembler_, "the constraints of the mechanism contradict or repeat one another"));
  if (!closing.closed) throw SolutionFailure(explain_open_loop(assembler_, motion_, given));
  if (const std::string conflict = redundancy_.conflict(c); !conflict.empty()) throw SolutionFailure(conflict);
  return closing.iterations;
}

void Start::assemble_once(Configuration& c, StartReport& report) {
  if (assembler_.numbering().slots() == assembler_.numbering().motion_slots() && assembler_.model().initial.empty() &&
      assembler_.model().initial_coordinates.empty()) {
    // nothing joins the parts, or moves them from where the deck has put them
    redundancy_.analyse(c);
    report.redundant = redundancy_.mobility().redundant();
    report.friction = friction_on_redundant(assembler_, redundancy_.mobility());
    report.mobility = describe_mobility(assembler_, c, redundancy_.mobility());
    return;
  }
  const Configuration given = c;
  redundancy_.analyse(given);
  note_open(given, report);
  Closing closing = close_initial(c, report);
  std::string conflict = closing.closed ? redundancy_.conflict(c) : "";
  bool sharp = true;
  // where the parts do not quite fit, redundant constraints look independent: analyse again with a looser tolerance
  if (!closing.closed || !conflict.empty()) {
    if (Configuration again = given; redundancy_.analyse(given, 1e-4)) {
      closing = close_initial(again, report);
      conflict = closing.closed ? redundancy_.conflict(again) : "";
      c = std::move(again);
      sharp = false;
    }
  }
  // redundant joints are exactly redundant only where the mechanism is closed
  if (closing.closed && conflict.empty() && (closing.iterations > 0 || !sharp) && redundancy_.analyse(c)) {
    closing = close(c, held_positions(), {});
    conflict = closing.closed ? redundancy_.conflict(c) : "";
  }
  if (!conflict.empty()) throw SolutionFailure(conflict);
  if (!closing.closed) throw SolutionFailure(explain_open_loop(assembler_, motion_, given));
  if (!assembler_.model().initial_coordinates.empty()) {
    move_coordinates(c, report);
    redundancy_.analyse(c);
    if (conflict = redundancy_.conflict(c); !conflict.empty()) throw SolutionFailure(conflict);
  }
  report.redundant = redundancy_.mobility().redundant();
  report.friction = friction_on_redundant(assembler_, redundancy_.mobility());
  report.mobility = describe_mobility(assembler_, c, redundancy_.mobility());
  std::vector<double> wished(motion_.size(), 0.0);
  for (std::size_t i = 0; i < given.nodes.size(); ++i) {
    const Vec3 turn = rotation_log(given.nodes[i].R);
    for (std::size_t k = 0; k < 3; ++k) {
      wished[6 * i + k] = given.nodes[i].x[static_cast<Eigen::Index>(k)];
      wished[6 * i + 3 + k] = turn[static_cast<Eigen::Index>(k)];
    }
  }
  verify_imposed(c, wished, false);
  note_moved(given.nodes, c, report);
  if (report.remarks.empty()) remark_on_guesses(c, report);
}

Start::Closing Start::close(Configuration& c, std::span<const int> held, const Target& target,
                            const std::vector<StartCoordinates::Wanted>& wanted) {
  constexpr int most_iterations = 50;
  constexpr double undeformed = 1e-9;  // over the extent
  constexpr double at_rest = 1e-10;    // of the longest step, for bodies that are carried along
  const Numbering& numbering = assembler_.numbering();
  const double extent = assembler_.model().extent();
  const auto motion_size = motion_.size();
  std::vector<double> phi, rate, second, right(static_cast<std::size_t>(numbering.equations())), step;
  const auto measure = [&](const Configuration& at) {
    assembler_.constraint_rates(at, phi, rate, second);
    double open = 0;
    for (std::size_t e = 0; e < right.size(); ++e) {
      const Unknown& u = numbering.unknown(static_cast<int>(e));
      right[e] = 0;
      if (!u.multiplier || assembler_.released(u.slot - static_cast<int>(motion_size))) continue;
      const std::size_t m = static_cast<std::size_t>(u.slot) - motion_size;
      const double gap = target.gaps.empty() ? 0.0 : target.gaps[m];
      right[e] = phi[m] - target.part * gap;
      // angles of many turns and long travels are rounded to their own size
      const double relative = std::abs(right[e]) / std::max(size_of(u, extent), std::abs(gap));
      open = std::isnan(relative) ? relative : std::max(open, relative);
    }
    const std::vector<double> missed = coordinates_.missed(at, wanted);
    for (std::size_t i = 0; i < wanted.size(); ++i) open = std::max(open, std::abs(missed[i]) / coordinates_.size(wanted[i]));
    return open;
  };
  Closing result;
  const double away = this->away(c), accuracy = away * target.accuracy;
  const std::vector<std::size_t> teeth = holds_teeth_ ? tooth_deformations() : std::vector<std::size_t>{};
  double open = measure(c), deformed = std::numeric_limits<double>::infinity();
  double last = carried_ ? std::numeric_limits<double>::infinity() : 0;  // length of the last step
  for (;; ++result.iterations) {
    result.closed = open <= accuracy && (last <= at_rest || result.iterations == most_iterations);
    // held teeth take a small part of each motion: it is given back until the wheels have made all of it, unless they cannot
    if (result.closed && holds_teeth_) {
      double now = 0;
      for (const std::size_t i : teeth) now = std::max(now, std::abs(c.scalars[i]));
      if (now > undeformed * extent && now < 0.5 * deformed) {
        deformed = now;
        for (const std::size_t i : teeth) c.scalars[i] = 0;
        open = measure(c);
        result.closed = open <= accuracy;
      }
    }
    if (result.closed || result.iterations == most_iterations || !std::isfinite(open)) return result;
    if (carried_) {
      motion_.gather(carried_->pull(c), right);
      assembler_.projection(at_start_of_step(c), Assembler::Metric::geometric, held, assembler_.matrix(), carried_->give());
    } else {
      assembler_.projection(c, Assembler::Metric::geometric, held);
    }
    if (!solve(right, step) || !add_coordinates(c, wanted, step)) {
      result.singular = true;
      return result;
    }
    // a step far beyond where the constraints are nearly linear would jump to another way of assembling
    double length = 0;
    std::vector<double> y(motion_size, 0.0);
    motion_.scatter(step, y);
    for (std::size_t i = 0; i < 6 * c.nodes.size(); ++i)
      length = std::max(length, std::abs(y[i]) / (i % 6 < 3 ? 0.25 * extent : 0.5));
    if (result.iterations == 0) result.first = length;
    if (carried_) last = length;
    if (length > 1) {
      result.far = true;
      for (double& v : y) v /= length;
    }
    const double before = open;
    Configuration moved = c;
    // damped: a step that opens the constraints further is halved, at most four times
    for (int halvings = 0;; ++halvings) {
      motion_.move(c, y, moved);
      moved = at_start_of_step(std::move(moved));
      open = measure(moved);
      if (open <= before || before < 1e-6 || halvings == 4) break;
      result.far = true;
      for (double& v : y) v /= 2;
    }
    std::swap(c, moved);
    if (length < 4 * away * epsilon && before < 1e-11 * away) {  // closed as far as rounding allows
      ++result.iterations;
      result.closed = true;
      return result;
    }
  }
}

Start::Distance Start::distance(const Configuration& from, const Configuration& to) const {
  const double extent = assembler_.model().extent();
  Distance largest;
  for (std::size_t i = 1; i < from.nodes.size(); ++i) {
    const double move = (to.nodes[i].x - from.nodes[i].x).norm() / extent;
    const double both = std::max(move, angle_between(from.nodes[i].R, to.nodes[i].R));
    if (both > largest.size) largest = {both, static_cast<int>(i)};
  }
  return largest;
}

Start::Closing Start::close_initial(Configuration& c, StartReport& report) {
  constexpr double near = 0.3;     // a shorter way, over the extent or in radians, is not checked again
  constexpr double another = 0.1;  // positions farther apart than this count as different
  const Configuration given = c;
  const std::vector<int> held = held_positions();
  report.remarks.clear();
  report.path_steps = 0;
  Closing direct = close(c, held, {});
  report.position_iterations = direct.iterations;
  if (direct.closed && !direct.far && distance(given, c).size < near) return direct;

  Configuration followed = given;
  const int steps = follow(followed, held);
  const auto node = [this](const Distance& d) {
    return fmt::format("node {}", assembler_.model().nodes[static_cast<std::size_t>(d.node)].id);
  };
  if (!direct.closed) {
    if (steps == 0) return direct;
    report.path_steps = steps;
    direct.closed = true;
    c = std::move(followed);
  } else if (const Distance apart = distance(followed, c); steps > 0 && apart.size > another) {
    const bool nearer = distance(given, followed).size < distance(given, c).size;
    report.remarks.push_back(fmt::format(
        "there are two ways to assemble the mechanism near the positions given, apart by most at {}; the {} was taken. Begin "
        "nearer to the other (.INI DEP) if that is the one you mean",
        node(apart), nearer ? "one reached by closing the gaps little by little" : "nearer one"));
    if (nearer) {
      report.path_steps = steps;
      c = std::move(followed);
    }
  } else if (steps > 0 && turns_differ(followed, c)) {
    // a wheel may turn several times while its drive turns little: the direct way leaves out whole turns
    report.path_steps = steps;
    c = std::move(followed);
  }
  remark_on_branch(given, c, held, report);
  if (steps == 0 && report.remarks.empty())
    report.remarks.push_back(
        "this position is not reached by closing the gaps little by little from the positions given: the mechanism may be "
        "assembled on another branch than they suggest; begin nearer to it (.INI DEP) if so");
  return direct;
}

int Start::follow(Configuration& c, std::span<const int> held) {
  constexpr double shortest = 1e-3;
  constexpr int most_steps = 100000;  // about 3000 turns
  const std::vector<double> phi = assembler_.violations(c);
  double done = 0, part = 0.1;
  for (int steps = 1; steps <= most_steps;) {
    const double next = std::min(1.0, done + part);
    Configuration tried = c;
    const Closing closing = close(tried, held, {phi, 1 - next});
    const double moved = distance(c, tried).size;
    if (!closing.closed || closing.far || moved > longest_step_) {
      part /= 2;
      if (too_short(part, shortest, closing)) return 0;
      continue;
    }
    c = std::move(tried);
    assembler_.count_turns(c);  // turns are counted on the way to drives that begin more than half a turn away
    if (next == 1) {
      // every part is closed to rounding, but turned from that before: axes would keep the sum of small tilts
      close(c, held, {{}, 0, epsilon});
      return steps;
    }
    done = next;
    part = next_part(part, closing, moved);
    ++steps;
  }
  throw SolutionFailure(fmt::format(
      "drives begin too far from where the parts are put: turns are counted on the way, in parts of at most {} rad, and {} of "
      "them close {:.2g} per cent of the gaps. Let drives begin fewer turns away",
      longest_step_, most_steps, 100 * done));
}

double Start::next_part(double part, const Closing& closing, double moved) {
  constexpr double margin = 0.95;
  if (closing.iterations >= 5) return part;
  return moved > 0 ? part * std::min(1.5, margin * longest_step_ / moved) : 1.5 * part;
}

bool Start::too_short(double part, double shortest, const Closing& closing) {
  constexpr double resolution = 1e-9, motion = 1e-3;
  return part < resolution || (part < shortest && closing.first < motion);
}

bool Start::turns_differ(const Configuration& counted, Configuration other) {
  assembler_.count_turns(other);
  for (std::size_t i = 0; i < counted.history.size(); ++i)
    if (std::abs(counted.history[i] - other.history[i]) > 0.5) return true;
  return false;
}

int Start::orientation(const Configuration& c, std::span<const int> held) {
  const Numbering& numbering = assembler_.numbering();
  const ConstraintMatrix gradients(assembler_, at_start_of_step(c), ConstraintColumns::gradients);
  std::vector<bool> is_held(static_cast<std::size_t>(numbering.equations()), false);
  for (const int e : held) is_held[static_cast<std::size_t>(e)] = true;
  std::vector<int> row(gradients.rows.slot.size(), 0);
  int rows = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const int e = numbering.equation(static_cast<int>(gradients.rows.slot[i]));
    row[i] = is_held[static_cast<std::size_t>(e)] ? -1 : rows++;
  }
  std::vector<Eigen::Triplet<double>> entries;
  int columns = 0;
  for (int m = 0; m < gradients.matrix.outerSize(); ++m) {
    if (assembler_.released(m)) continue;
    for (Eigen::SparseMatrix<double>::InnerIterator it(gradients.matrix, m); it; ++it)
      if (const int at = row[static_cast<std::size_t>(it.row())]; at >= 0) entries.emplace_back(at, columns, it.value());
    ++columns;
  }
  if (rows == 0 || rows != columns) return 0;
  Eigen::SparseMatrix<double> square(rows, columns);
  square.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> factors(square);
  return factors.info() == Eigen::Success ? static_cast<int>(factors.signDeterminant()) : 0;
}

void Start::remark_on_branch(const Configuration& given, const Configuration& c, std::span<const int> held, StartReport& report) {
  const int before = orientation(given, held), after = orientation(c, held);
  if (before * after >= 0) return;
  const Distance farthest = distance(given, c);
  report.remarks.push_back(fmt::format(
      "branch flip: on the way from the positions given a loop was stretched straight and folded the other way (the "
      "determinant of the constraints changed its sign); node {} went farthest. If the other way is meant begin nearer to it "
      "(.INI DEP)",
      assembler_.model().nodes[static_cast<std::size_t>(farthest.node)].id));
}

void Start::note_open(const Configuration& given, StartReport& report) {
  const Numbering& numbering = assembler_.numbering();
  const double extent = assembler_.model().extent();
  const std::vector<double> phi = assembler_.violations(given);
  const Eigen::VectorXd relative = relative_open(assembler_, phi);
  std::vector<StartReport::Opened> all;
  for (std::size_t m = 0; m < phi.size(); ++m) {
    if (relative[static_cast<Eigen::Index>(m)] < 1e-9) continue;
    const Unknown& u = numbering.multiplier(static_cast<int>(m));
    if (all.empty() || all.back().part != u.part) all.push_back({u.part, 0, 0});
    double& sum = u.measure == Measure::length ? all.back().length : all.back().angle;
    sum = std::hypot(sum, phi[m]);
  }
  const auto size = [&](const StartReport::Opened& o) { return std::max(o.length / extent, o.angle); };
  std::stable_sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return size(a) > size(b); });
  report.opened = std::move(all);
}

void Start::note_moved(const std::vector<NodeState>& begun, const Configuration& c, StartReport& report) const {
  const double extent = assembler_.model().extent();
  for (std::size_t i = 1; i < c.nodes.size(); ++i) {
    const double move = (c.nodes[i].x - begun[i].x).norm(), turn = angle_between(begun[i].R, c.nodes[i].R);
    report.largest_move = std::max(report.largest_move, move);
    report.largest_turn = std::max(report.largest_turn, turn);
    if (std::max(move / extent, turn) > 1e-9) report.moved.push_back({static_cast<int>(i), move, turn});
  }
  const auto size = [&](const StartReport::Moved& m) { return std::max(m.move / extent, m.turn); };
  std::stable_sort(report.moved.begin(), report.moved.end(), [&](const auto& a, const auto& b) { return size(a) > size(b); });
}

void Start::fit_velocities(Configuration& c, Assembler::Metric metric, StartReport& report) { fit(c, metric, &report); }

void Start::project_velocities(Configuration& c, Assembler::Metric metric) { fit(c, metric, nullptr); }

void Start::fit(Configuration& c, Assembler::Metric metric, StartReport* report) {
  const Numbering& numbering = assembler_.numbering();
  std::vector<double> v = motion_.velocities(c);
  motion_.prescribe_rates(c.time, v);
  motion_.set_velocities(v, c);
  std::vector<double> phi, rate, second, change;
  assembler_.constraint_rates(c, phi, rate, second);
  if (report) report->velocities_fitted = true;
  const auto asked = report ? coordinates_.wanted(true) : std::vector<StartCoordinates::Wanted>{};
  if (largest(rate) == 0 && asked.empty()) return;
  std::vector<double> right(static_cast<std::size_t>(numbering.equations()), 0.0);
  double fastest = 0;
  std::size_t worst = 0;
  const double extent = assembler_.model().extent();
  for (std::size_t e = 0; e < right.size(); ++e) {
    const Unknown& u = numbering.unknown(static_cast<int>(e));
    if (!u.multiplier) continue;
    const double r = rate[static_cast<std::size_t>(u.slot) - motion_.size()];
    if (!assembler_.released(u.slot - numbering.motion_slots())) right[e] = r;
    const double relative = std::abs(r) / size_of(u, extent);
    if (relative <= fastest) continue;
    fastest = relative;
    worst = e;
  }
  if (report && fastest > 0) report->rate_violated_most = numbering.describe(static_cast<int>(worst));
  const std::vector<double> wished = v;
  const std::vector<int> held = report ? imposed(true) : std::vector<int>{};
  const auto free = undecided(c, asked, held);
  assembler_.projection(c, metric, held);
  if (!solve(right, change) || !add_coordinates(c, free, change))
    throw SolutionFailure(explain_singular(assembler_, "no velocities fit the constraints and drives at the start"));
  std::vector<double> delta(motion_.size(), 0.0);
  motion_.scatter(change, delta);
  for (std::size_t i = 0; i < v.size(); ++i) v[i] += delta[i];
  motion_.set_velocities(v, c);
  if (redundancy_.active()) {
    const double open = largest(rate);
    assembler_.constraint_rates(c, phi, rate, second);
    if (const std::string conflict = redundancy_.rate_conflict(c, rate, std::max(open, largest(v))); !conflict.empty())
      throw SolutionFailure(conflict);
  }
  if (!report) return;
  std::vector<double> changes(c.nodes.size());
  for (std::size_t n = 0; n < changes.size(); ++n) {
    const auto change_of = [&](std::size_t slot) { return (Vec3(&v[slot]) - Vec3(&wished[slot])).norm(); };
    changes[n] = std::max(change_of(6 * n), extent * change_of(6 * n + 3));
  }
  constexpr double slow = 1e-6;  // moves a body by this part of the model in the whole run
  const deck::SteppingCard& stepping = assembler_.model().commands.stepping;
  CarriedBodies bodies(assembler_, metric, true, changes, slow * extent / (stepping.end - stepping.start));
  carry(c, metric, held, free, bodies);
  note_bodies(bodies, "the speed of joints and drives at the start moves",
              "it begins with an impact. Give it its speed by .INI VIT GROUP … AXIS … AT … V", *report);
  const std::vector<double> fitted = motion_.velocities(c);
  report->largest_velocity_change = 0;
  std::size_t fastest_slot = 0;
  for (std::size_t i = 0; i < 6 * c.nodes.size(); ++i) {  // scalars follow: their change says nothing
    if (std::abs(fitted[i] - wished[i]) <= report->largest_velocity_change) continue;
    report->largest_velocity_change = std::abs(fitted[i] - wished[i]);
    fastest_slot = i;
  }
  if (report->largest_velocity_change > 0) report->velocity_changed_most = slot_name(assembler_.model(), fastest_slot);
  verify_imposed(c, wished, true);
  verify_coordinates(c, asked);
}

}  // namespace engrane::solve
