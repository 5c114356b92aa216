// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/error_estimate.hpp"
#include "app/options.hpp"
#include "app/read.hpp"
#include "app/run_summary.hpp"
#include "app/schedule.hpp"
#include "observe/observer.hpp"
#include "output/checks.hpp"
#include "output/listing.hpp"
#include "output/peaks.hpp"
#include "output/progress.hpp"
#include "output/restart_file.hpp"
#include "output/results.hpp"
#include "solve/constraints/start_report.hpp"
#include "solve/run/buckling.hpp"
#include "solve/run/runner.hpp"

namespace engrane::app {

/// An earlier run, and the point of it that this run continues from.
struct Resumption {
  output::RestartFile earlier;
  output::RestartPoint point;
};

/// Everything that rank 0 writes during a run.
class Writer {
 public:
  /// `resumed`: what this run continues from, or nullptr.
  Writer(const Reading& reading, const observe::Observer& observer, const Schedule& schedule, const Options& options,
         const std::string& prefix, const Resumption* resumed, RunSummary& summary);

  void begin(const solve::SolverContext& context, int ranks);
  void resumed(const Resumption& from);
  /// Gives the results what the run could be restarted from: with a batch, where the deck asks for it, and at the end.
  void remember(const Configuration& c, const solve::Runner& runner, bool kept, bool last);
  void started(const solve::StartReport& start);
  void step(const Configuration& c, const solve::StepReport& step, const Schedule::Due& due, const Numbering& numbering);
  /// An instant within the step that the next call of step() is about.
  void between(double time, const Schedule::Due& due);
  /// For the listing and the summary.
  void conditioning(const Conditioning& found) { summary_.conditioning = found; }
  /// What the results are estimated to be off by, for the listing; `target` is what ACCURACY asks for, `sharper_failed` how a
  /// run with a sharper tolerance failed, if one did.
  void accuracy(const ErrorEstimate& estimate, double target, const std::string& sharper_failed);
  /// Ends listing and results; returns the exit status.
  int finish(output::RunStatus status, const std::string& failure, const output::TimeSplit& times);

  const std::string& path() const { return results_.path(); }
  /// Results, their index and the listing, as they are called now.
  std::vector<std::string> paths() const;
  /// What was written, and the commands that show it.
  std::string closing_lines() const;
  void note(const std::string& text) { progress_.note(text); }
  /// Modes of linearised buckling at an equilibrium.
  void buckling(const std::vector<solve::BucklingMode>& modes, const Configuration& equilibrium);
  /// A warning for the terminal and the listing's remarks.
  void warn(const std::string& text);

 private:
  /// path() without its ending.
  std::string stem() const;
  std::string wanted_table() const;
  /// The sums of what the ground exerts, and the peaks.
  void follow(double time);
  output::GroundRow ground(double time) const;
  void show(double time, bool regular, const Schedule::Due& due);
  void note_events(const Configuration& c, const solve::StepReport& step);
  void note_critical(const solve::CriticalPoint& point);
  void collect_remarks(const Configuration& c, const Numbering& numbering);
  void write_newton(const Configuration& c, const solve::StepReport& step, const Numbering& numbering);
  std::vector<output::EnergyRow> thinned_energies() const;

  const Reading& reading_;
  const Options& options_;
  RunSummary& summary_;
  const observe::Observer& observer_;
  const Schedule& schedule_;
  output::Results results_;
  output::Listing listing_;
  output::Checks checks_;
  output::Progress progress_;
  output::Peaks peaks_;
  std::vector<output::GroundRow> ground_;  ///< the last, the one with the largest force, that with the largest moment
  std::vector<output::EnergyRow> energies_;
  std::vector<output::ModeShape> modes_;
  std::string events_, critical_, buckling_, remarks_, accuracy_;
  bool frame_between_ = false;  ///< a frame was due within the step
  std::size_t marked_ = 0;      ///< channels marked as not unique so far
  long steps_ = 0, iterations_ = 0, cuts_ = 0, event_count_ = 0, locating_ = 0, coupled_ = 0;
};

}  // namespace engrane::app
