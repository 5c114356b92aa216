// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/companion.hpp"
#include "app/fast_turns.hpp"
#include "app/instants.hpp"
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

/// What the user asked for; each attempt at it is a run of the same.
struct Task {
  Reading& reading;
  const Options& options;
  const std::string& prefix;     ///< of the results
  const Resumption* resumption;  ///< what the run continues from, or nullptr
  RunSummary& summary;           ///< to be filled in by rank 0
  MPI_Comm comm;
};

/// One run of a deck on all ranks of a communicator, from the start to its last word. Rank 0 writes the results and speaks.
class Attempt {
 public:
  /// `companion`: with longer steps, tells the error; none where the deck asks for no ACCURACY.
  Attempt(const Task& task, const Trial& trial, std::optional<Companion>& companion);

  /// Makes the run. Collective.
  Verdict make();

 private:
  /// False where the files cannot be made, which every rank then knows.
  bool open_results();
  void announce();
  /// The steps, up to the end or to what stops them.
  void run();
  /// What is done behind each accepted step; false to stop.
  bool after_step(const Configuration& solved, const solve::StepReport& step);
  void find_buckling_modes(const Configuration& solved, const solve::StepReport& step);
  /// Lets the observer see an accepted step, and tells what is due of it.
  Schedule::Due show(const Configuration& solved, const solve::StepReport& step);
  /// The same of a controlled step; the instants within it are written.
  Schedule::Due show_instants(Instants& instants, const Configuration& solved, const solve::StepReport& step);
  /// What is not unique is looked for at the start, after 1, 2, 4, … steps and at the end.
  void observe(const Configuration& seen, const solve::StepReport& step, const Schedule::Due& due);
  /// Has rank 0 do something that may fail on its files. A failure is that of the run.
  template <class Write>
  void write(const Write& write);

  /// The run to make because the error of this one is too large; none where it is not. Collective.
  std::optional<Trial> sharper();
  /// The tolerance and the longest step of that; no tolerance for none. Collective.
  std::array<double, 2> sharper_steps();
  /// Is nearly every step as long as it may be, so that TOL has chosen few?
  bool steps_are_longest() const;
  /// A warning on the part of a continued run that came before, where the rest was repeated.
  std::string looser_before() const;
  void tell_condition();
  /// Ends the results; the exit status. Collective.
  int finish();

  const Task& task_;
  const Trial& trial_;
  std::vector<double> differences_;  ///< Trial::differences, and that of this run; on rank 0
  std::optional<Companion>& companion_;
  int rank_ = 0, ranks_ = 1;
  Times times_;
  solve::SolverContext context_;
  observe::Observer observer_;
  Schedule schedule_;
  FastTurns fast_turns_;
  solve::StabilityWatch stability_;
  std::optional<Writer> writer_;  ///< of rank 0
  std::unique_ptr<solve::Scheme> scheme_;
  std::optional<solve::Runner> runner_;
  double last_time_ = 0;    ///< of the last accepted step
  std::string failure_;     ///< what stopped the run; empty when nothing did
  bool complete_ = false;   ///< the run came to its end
  bool unsolved_ = false;   ///< no solution was found at some step
  bool wrong_ = false;      ///< energies say that solutions are none
  bool unwritten_ = false;  ///< results could not be written
};

}  // namespace engrane::app
