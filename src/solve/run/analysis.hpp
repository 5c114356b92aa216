// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "solve/algebra/newton.hpp"
#include "solve/constraints/start.hpp"

namespace engrane::solve {

/// What every analysis works with; made once per run, outlives the analysis.
struct SolverContext {
  SolverContext(const Model& model, MPI_Comm comm);

  const Model& model;
  Numbering numbering;
  Assembler assembler;
  LinearSolver solver;
  Newton newton;
  MotionSlots motion;
  Redundancy redundancy;
  Start start;
};

/// One way of going from one instant to the next.
class Analysis {
 public:
  explicit Analysis(SolverContext& context) : context_(context) {}
  virtual ~Analysis() = default;
  Analysis(const Analysis&) = delete;
  Analysis& operator=(const Analysis&) = delete;

  /// Makes the given configuration a solution at c.time. Throws SolutionFailure.
  virtual StartReport start(Configuration& c) = 0;
  /// Tries a step of h from an accepted configuration; `to` is a solution when the report says converged.
  virtual NewtonReport attempt(const Configuration& from, double h, Configuration& to) = 0;
  /// The last attempt stands.
  virtual void accept() {}
  /// Whether steps are to end at the events of the elements' switches; drift() is then defined.
  virtual bool meets_events() const { return false; }
  /// Moves an accepted configuration over a stretch much shorter than a step, past an event; what the analysis
  /// remembers of earlier steps is forgotten.
  virtual void drift(Configuration&, double /*h*/) {}

 protected:
  /// Displacements of the prescribed slots between two times, written into a flat step.
  void prescribe_step(double from, double to, std::span<double> y) const;
  /// Fails a converged step in which a node turned so far that turns can no longer be counted.
  void refuse_half_turns(std::span<const double> y, NewtonReport& report) const;
  /// Multipliers of `c` in the scaled unknowns of the solver, and back.
  void multipliers_to_unknowns(const Configuration& c, std::span<double> unknowns) const;
  void unknowns_to_multipliers(std::span<const double> unknowns, Configuration& c) const;

  /// Newton's method from the unknowns given, with redundant constraints: these are seen to be closed, and their
  /// multipliers made the least.
  NewtonReport solve(Vec unknowns, Weights weights, const Newton::Apply& apply, Configuration& to);

  SolverContext& context_;
};

/// Moves the reference configuration to the initial displacements and supports of the deck.
void apply_initial_displacements(const SolverContext& context, Configuration& c);
/// Gives it the initial velocities of the deck.
void apply_initial_velocities(const SolverContext& context, Configuration& c);

/// The analysis that `.SAM` asks for.
std::unique_ptr<Analysis> make_analysis(SolverContext& context);

/// A switch of an element that has changed sign.
struct Event {
  int part = 0;   ///< index into Model::parts
  int index = 0;  ///< into Layout::switches
  bool rises = true;
};

/// What the run tells about each accepted step.
struct StepReport {
  int number = 0;             ///< from 1; 0 is the start
  double step = 0;            ///< h
  int cuts = 0;               ///< failed attempts before this one
  bool regular = true;        ///< false: the step ended for an event, not where a multiple of H or a cut asks for it
  int locating = 0;           ///< attempts spent on locating an event before this step
  bool chatter = false;       ///< the first time that events come too thick to be located
  std::vector<Event> events;  ///< that happened in this step
  const NewtonReport* newton = nullptr;
};

/// Called with the start and every accepted step; false ends the run early.
using Observer = std::function<bool(const Configuration&, const StepReport&)>;

/// Runs from the start to the end of `.SUB`, cutting steps that fail and ending steps at events. Throws SolutionFailure when
/// cutting does not help. Returns false when the observer ended it.
bool run(SolverContext& context, Analysis& analysis, const Observer& observer,
         const std::function<void(const StartReport&)>& started);

}  // namespace engrane::solve
