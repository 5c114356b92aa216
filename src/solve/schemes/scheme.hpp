// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "base/snapshot.hpp"
#include "solve/schemes/path_point.hpp"
#include "solve/schemes/solver_context.hpp"

namespace engrane::solve {

class LostVibrations;

/// Result of an attempted step.
struct Outcome {
  NewtonReport newton;
  std::optional<double> error;  ///< estimated local error of the step over its tolerance, if there is one

  bool converged() const { return newton.converged; }
};

/// Motion within an accepted step. Both ends must outlive it.
class Within {
 public:
  Within(const Configuration& from, const Configuration& to) : from_(from), to_(to) {}
  virtual ~Within() = default;
  Within(const Within&) = delete;
  Within& operator=(const Within&) = delete;

  const Configuration& from() const { return from_; }
  const Configuration& to() const { return to_; }
  /// Sets `c` to the motion at a `time` in between; its multipliers are a guess.
  virtual void at(double time, Configuration& c) = 0;
  /// Gives such a configuration the multipliers and accelerations that balance it, and moves stiff parts to where their forces
  /// balance. False, with `c` unchanged, if the scheme has no such balance or does not find it. Collective.
  virtual bool balance(Configuration& c) = 0;

 private:
  const Configuration &from_, &to_;
};

/// A way of advancing from one instant to the next. It tries steps and reports the result; step cuts, growth, events and output
/// times are the Runner's.
class Scheme {
 public:
  explicit Scheme(SolverContext& context) : context_(context) {}
  virtual ~Scheme() = default;
  Scheme(const Scheme&) = delete;
  Scheme& operator=(const Scheme&) = delete;

  /// Makes the given configuration a solution at c.time. Throws SolutionFailure.
  virtual StartReport start(Configuration& c) = 0;
  /// Tries a step of h from an accepted configuration; `to` is a solution if the outcome is converged.
  virtual Outcome attempt(const Configuration& from, double h, Configuration& to) = 0;
  /// Tries a step where equilibria near `from` have come to an end: seeks the one to which the structure would snap.
  virtual Outcome snap(const Configuration& /*from*/, double /*h*/, Configuration& /*to*/) { return {}; }
  /// Did the last attempt, from one equilibrium to the other, leap to where no path of equilibria leads? Shorter steps may then
  /// stay on theirs. Collective.
  virtual bool leaps(const Configuration& /*from*/, const Configuration& /*to*/) { return false; }
  /// Accepts the last attempt.
  virtual void accept() {}
  /// Progress after the last accepted step of a scheme that follows a path and knows itself how far; nullptr if time leads from
  /// begin to end.
  virtual const Course* course() const { return nullptr; }
  /// Power of the step with which Outcome::error grows.
  virtual int order_of_error() const { return 1; }
  /// Motion within the step that was accepted last, or within a drift(); nullptr if there is none. Valid until the next attempt.
  /// `scalars`: those of its end before whole turns were removed.
  virtual std::unique_ptr<Within> within(const Configuration& /*from*/, const Configuration& /*to*/,
                                         std::span<const double> /*scalars*/, bool /*drift*/) {
    return nullptr;
  }
  /// The accepted configuration is at a corner of a function of time: what lies before it says little about what follows.
  virtual void pass_corner(const Configuration&) {}
  /// Whether steps are to end at the events of the elements' switches; drift() is then defined.
  virtual bool meets_events() const { return false; }
  /// Returns `c` moved by h with its present velocities and accelerations: where the next step may lead.
  virtual Configuration coast(const Configuration& c, double /*h*/) const { return c; }
  /// Moves an accepted configuration across an event, over a time much shorter than a step, and discards the scheme's memory of
  /// earlier steps.
  virtual void drift(Configuration&, double /*h*/) {}
  /// Local error that drift() would have, over the tolerance of a controlled step. Between fixed steps: the change of a
  /// velocity that something stiff would cause on the way, over the largest acceptable one.
  virtual double drift_error(const Configuration&, double /*h*/) { return 0; }
  /// Switches of elements have changed sides in a controlled step or a drift.
  virtual void enter(const std::vector<int>& /*sides*/) {}

  /// Checks an accepted configuration for frictions that come to rest or give way. Where they do, changes `c` and the memory of
  /// the scheme to fit their new state, and returns what `c` was.
  virtual std::optional<Configuration> settle_friction(Configuration& /*c*/) { return {}; }
  /// Continues from a configuration that another kind of analysis may have left.
  virtual void take_over(Configuration& c) { context_.grips.let_go(c); }

  /// Loads and lengths that the residuals of its steps are compared with.
  virtual const References& references() const { return context_.newton.references(); }

  /// What its steps since the start or the restart have lost; nullptr if that is not looked for.
  virtual const LostVibrations* lost_vibrations() const { return nullptr; }

  /// The scheme's memory of accepted steps, for a restart.
  virtual void save(Snapshot&) const {}
  virtual void load(const Snapshot&) {}
  /// Whether steps may begin with the velocities of this restart point as they are.
  virtual bool takes_velocities(const Snapshot&) const { return true; }

 protected:
  /// Fails a converged step in which a node turned so far that turns can no longer be counted.
  void refuse_half_turns(std::span<const double> y, NewtonReport& report) const;
  /// refuse_half_turns() before a step of h: fails if nodes would turn so far at the speeds v. Newton's iteration finds no angle
  /// of a drive more than half a turn away, and could not say why.
  NewtonReport foresee(std::span<const double> v, double h) const;
  /// Fails a converged step that leaves constraints open that were taken to be redundant; true if it does.
  bool refuse_conflict(const Configuration& to, NewtonReport& report) const;
  /// Newton's method from the given unknowns, with redundant constraints: checks that these are closed, and makes their
  /// multipliers the smallest.
  NewtonReport solve(Vec unknowns, Weights weights, const Newton::Apply& apply, Configuration& to, bool keep = false,
                     Border* border = nullptr);

  SolverContext& context_;
};

/// Moves the reference configuration to the initial displacements and supports of the deck.
void apply_initial_displacements(const SolverContext& context, Configuration& c);
/// Gives it the initial velocities of the deck.
void apply_initial_velocities(const SolverContext& context, Configuration& c);

/// Returns the scheme that the options select.
std::unique_ptr<Scheme> make_scheme(SolverContext& context);

}  // namespace engrane::solve
