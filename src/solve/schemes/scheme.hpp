// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "base/snapshot.hpp"
#include "solve/schemes/path_point.hpp"
#include "solve/schemes/solver_context.hpp"

namespace engrane::solve {

/// What came of an attempt to step.
struct Outcome {
  NewtonReport newton;
  std::optional<double> error;  ///< estimate of the step's local error over its tolerance, where one is asked for

  bool converged() const { return newton.converged; }
};

/// The motion between the ends of a step that stands. The ends must live as long.
class Within {
 public:
  Within(const Configuration& from, const Configuration& to) : from_(from), to_(to) {}
  virtual ~Within() = default;
  Within(const Within&) = delete;
  Within& operator=(const Within&) = delete;

  const Configuration& from() const { return from_; }
  const Configuration& to() const { return to_; }
  /// `c` becomes the motion at a `time` between; its multipliers are a guess.
  virtual void at(double time, Configuration& c) = 0;
  /// Gives such a configuration the multipliers and accelerations that balance it, and moves what is stiff to where its forces
  /// do. False where the scheme has no such balance, or does not find it; then `c` is as it was. Collective.
  virtual bool balance(Configuration& c) = 0;

 private:
  const Configuration &from_, &to_;
};

/// One way of going from one instant to the next. It tries steps and says what happened; cutting, growth, events and output
/// times are the Runner's.
class Scheme {
 public:
  explicit Scheme(SolverContext& context) : context_(context) {}
  virtual ~Scheme() = default;
  Scheme(const Scheme&) = delete;
  Scheme& operator=(const Scheme&) = delete;

  /// Makes the given configuration a solution at c.time. Throws SolutionFailure.
  virtual StartReport start(Configuration& c) = 0;
  /// Tries a step of h from an accepted configuration; `to` is a solution when the outcome is converged.
  virtual Outcome attempt(const Configuration& from, double h, Configuration& to) = 0;
  /// The last attempt stands.
  virtual void accept() {}
  /// Of a scheme that follows a path and knows itself how far; of the last step that stands. nullptr: time leads from begin to
  /// end.
  virtual const Course* course() const { return nullptr; }
  /// The power of the step that Outcome::error grows with.
  virtual int order_of_error() const { return 1; }
  /// The motion within the step that was accepted last; nullptr where there is none. Valid until the next attempt. `scalars`:
  /// those of its end before whole turns were counted.
  virtual std::unique_ptr<Within> within(const Configuration& /*from*/, const Configuration& /*to*/,
                                         std::span<const double> /*scalars*/) {
    return nullptr;
  }
  /// The accepted configuration is at a corner of a function of time: what lies before it tells little of what follows.
  virtual void pass_corner(const Configuration&) {}
  /// Whether steps are to end at the events of the elements' switches; drift() is then defined.
  virtual bool meets_events() const { return false; }
  /// `c` moved by h with the velocities and accelerations it has: where the next step may lead.
  virtual Configuration coast(const Configuration& c, double /*h*/) const { return c; }
  /// Moves an accepted configuration over a stretch much shorter than a step, past an event; what the scheme
  /// remembers of earlier steps is forgotten.
  virtual void drift(Configuration&, double /*h*/) {}
  /// The local error that drift() would have, over the tolerance of a controlled step. Between fixed steps: by how much something
  /// stiff would change a velocity on the way, over the most that is borne.
  virtual double drift_error(const Configuration&, double /*h*/) { return 0; }
  /// After a controlled step or a drift the switches of elements are on other sides.
  virtual void enter(const std::vector<int>& /*sides*/) {}

  /// Looks at an accepted configuration for frictions that come to rest or give way; true when `c` has been changed to fit what
  /// they do now, and what the scheme remembers with it.
  virtual bool settle_friction(Configuration&) { return false; }
  /// Goes on from a configuration that another kind of analysis may have left.
  virtual void take_over(Configuration& c) { context_.grips.let_go(c); }

  /// What the scheme remembers of accepted steps, for a restart.
  virtual void save(Snapshot&) const {}
  virtual void load(const Snapshot&) {}

 protected:
  /// Displacements of the prescribed slots between two times, written into a flat step.
  void prescribe_step(double from, double to, std::span<double> y) const;
  /// Fails a converged step in which a node turned so far that turns can no longer be counted.
  void refuse_half_turns(std::span<const double> y, NewtonReport& report) const;
  /// The same before a step of h: nodes that would turn so far at the speeds v. Newton's iteration finds no drive's angle more
  /// than half a turn away, and would not say why.
  NewtonReport foresee(std::span<const double> v, double h) const;
  /// Fails a converged step that leaves constraints open which were taken for consequences of the others; true where it does.
  bool refuse_conflict(const Configuration& to, NewtonReport& report) const;
  /// Multipliers of `c` in the scaled unknowns of the solver, and back.
  void multipliers_to_unknowns(const Configuration& c, std::span<double> unknowns) const;
  void unknowns_to_multipliers(std::span<const double> unknowns, Configuration& c) const;

  /// Newton's method from the unknowns given, with redundant constraints: these are seen to be closed, and their
  /// multipliers made the least.
  NewtonReport solve(Vec unknowns, Weights weights, const Newton::Apply& apply, Configuration& to, bool keep = false,
                     Border* border = nullptr);

  SolverContext& context_;
};

/// Moves the reference configuration to the initial displacements and supports of the deck.
void apply_initial_displacements(const SolverContext& context, Configuration& c);
/// Gives it the initial velocities of the deck.
void apply_initial_velocities(const SolverContext& context, Configuration& c);

/// The scheme that the options ask for.
std::unique_ptr<Scheme> make_scheme(SolverContext& context);

}  // namespace engrane::solve
