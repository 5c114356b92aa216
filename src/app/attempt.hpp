// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/companion.hpp"
#include "app/energy_watch.hpp"
#include "app/fast_turns.hpp"
#include "app/instants.hpp"
#include "app/linked_turns.hpp"
#include "app/options.hpp"
#include "app/read.hpp"
#include "app/run_summary.hpp"
#include "app/schedule.hpp"
#include "app/times.hpp"
#include "app/trial.hpp"
#include "app/writer.hpp"
#include "observe/observer.hpp"
#include "solve/run/runner.hpp"
#include "solve/schemes/stability.hpp"

namespace engrane::app {

/// The run that the user asked for. Each attempt at it has the same task.
struct Task {
  Reading& reading;
  const Options& options;
  const std::string& prefix;     ///< of the results
  const Resumption* resumption;  ///< what the run continues from, or nullptr
  RunSummary& summary;           ///< to be filled in by rank 0
  MPI_Comm comm;
};

/// One run of a deck on all ranks of a communicator, from start to final output. Rank 0 writes files and messages.
class Attempt {
 public:
  /// `companion`: a run with longer steps, for the error estimate; none if the deck does not ask for ACCURACY.
  Attempt(const Task& task, const Trial& trial, std::optional<Companion>& companion);

  /// Runs. Collective.
  Verdict make();

 private:
  /// Returns false on every rank if the files cannot be created.
  bool open_results();
  void announce();
  /// Makes the steps, up to the end or to a failure.
  void run();
  /// Called after each accepted step; returns false to stop.
  bool after_step(const Configuration& solved, const solve::StepReport& step);
  void find_buckling_modes(const Configuration& solved, const solve::StepReport& step);
  /// Observes an accepted step; returns which outputs are due.
  Schedule::Due show(const Configuration& solved, const solve::StepReport& step);
  /// show() for a controlled step; also writes the output instants within it.
  Schedule::Due show_instants(Instants& instants, const Configuration& solved, const solve::StepReport& step);
  /// Observes a configuration. Looks for channels that are not unique at the start, after 1, 2, 4, … steps and at the end.
  void observe(const Configuration& seen, const solve::StepReport& step, const Schedule::Due& due);
  /// Calls `write` on rank 0. If it throws OutputError, the run has failed.
  template <class Write>
  void write(const Write& write);

  bool no_scheme_helps() const;
  /// The next run to make if the error of this one is too large, otherwise nothing. Collective.
  std::optional<Trial> sharper();
  /// Vibrations that are far too fast for the motion are stated, but no run is repeated for them.
  struct Estimates {
    ErrorEstimate deciding, stated;
  };
  /// On rank 0.
  Estimates estimates();
  /// Tolerance and longest step (time) of that run; the tolerance is 0 if there is none. Collective.
  std::array<double, 2> sharper_steps();
  /// Whether nearly every step was as long as HMAX allows, so that TOL determined few of them.
  bool steps_are_longest() const;
  long first_steps() const;  ///< Trial::first_steps, or those of this run
  /// Time at which the run, or its continuation, began.
  double begun() const;
  /// A warning that the part before the restart point was solved with a looser tolerance than the rest; empty if it was not.
  std::string looser_before() const;
  void tell_condition();
  /// Completes the results; returns the exit status. Collective.
  int finish();

  const Task& task_;
  const Trial& trial_;
  std::vector<double> differences_;  ///< Trial::differences and the difference of this run; on rank 0
  std::optional<Companion>& companion_;
  int rank_ = 0, ranks_ = 1;
  Times times_;
  solve::SolverContext context_;
  observe::Observer observer_;
  Schedule schedule_;
  FastTurns fast_turns_;
  LinkedTurns linked_turns_;
  solve::StabilityWatch stability_;
  EnergyWatch energies_;
  std::optional<Writer> writer_;  ///< of rank 0
  std::unique_ptr<solve::Scheme> scheme_;
  std::optional<solve::Runner> runner_;
  double last_time_ = 0;    ///< of the last accepted step
  std::string failure_;     ///< what stopped the run; empty when nothing did
  bool complete_ = false;   ///< the run came to its end
  bool unsolved_ = false;   ///< no solution was found at some step
  bool started_ = false;    ///< the first configuration was found
  bool wrong_ = false;      ///< the energy balance shows that the solutions are wrong
  bool unwritten_ = false;  ///< results could not be written
};

}  // namespace engrane::app
