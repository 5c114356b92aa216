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

/// What is told where events are too dense to be located.
std::string chatter_note(double time);

/// An earlier run, and the restart point from which this run continues it.
struct Resumption {
  output::RestartFile earlier;
  output::RestartPoint point;
};

/// Everything that rank 0 writes during a run.
class Writer {
 public:
  /// `resumed`: what this run continues, or nullptr.
  Writer(const Reading& reading, const observe::Observer& observer, const Schedule& schedule, const Options& options,
         const std::string& prefix, const Resumption* resumed, RunSummary& summary);

  void begin(const solve::SolverContext& context, int ranks);
  void resumed(const Resumption& from);
  /// Adds a restart point to the results: with each batch, where the deck asks for one, and at the end.
  void remember(const Configuration& c, const solve::Runner& runner, bool kept, bool last);
  void started(const solve::StartReport& start);
  void step(const Configuration& c, const solve::StepReport& step, const Schedule::Due& due, const Numbering& numbering);
  /// Writes an instant within the step that the next call of step() reports.
  void between(double time, const Schedule::Due& due);
  /// For the listing and the summary.
  void conditioning(const Conditioning& found) { summary_.conditioning = found; }
  /// The estimated error of the results, for the listing and the summary. `target` is the error that ACCURACY asks for;
  /// `sharper_failed` tells how a run with a sharper tolerance failed, if one did.
  void accuracy(const ErrorEstimate& estimate, double target, const std::string& sharper_failed);
  /// Completes the listing and the results; returns the exit status.
  int finish(output::RunStatus status, const std::string& failure, const output::TimeSplit& times);

  const std::string& path() const { return results_.path(); }
  bool holds_samples() const { return results_.holds_samples(); }
  /// Current names of the results, their index and the listing, without those that do not exist: a run without frames has no
  /// index, nor has one whose disk was full.
  std::vector<std::string> paths() const;
  /// The files written, and commands that show what they hold.
  std::string closing_lines() const;
  void note(const std::string& text) { progress_.note(text); }
  /// Modes of linearised buckling at an equilibrium, of `asked` ones wanted.
  void buckling(const std::vector<solve::BucklingMode>& modes, int asked, const Configuration& equilibrium);
  /// Shows a warning on the terminal and puts it into the remarks of the listing.
  void warn(Diagnostic warning);
  void warn(const std::string& text) { warn({.severity = Severity::warning, .location = {}, .message = text, .hint = {}}); }
  const std::vector<Diagnostic>& warnings() const { return warnings_; }

 private:
  /// path() without its extension.
  std::string stem() const;
  std::string wanted_table() const;
  /// Updates the resultants of the ground forces, and the peaks.
  void follow(double time, bool corner);
  output::GroundRow ground(double time) const;
  void show(double time, bool regular, const Schedule::Due& due, bool corner = false);
  void note_events(const Configuration& c, const solve::StepReport& step);
  void note_critical(const solve::CriticalPoint& point);
  void collect_remarks(const Configuration& c, const Numbering& numbering);
  void write_newton(const Configuration& c, const solve::StepReport& step, const Numbering& numbering);
  std::vector<output::EnergyRow> thinned_energies() const;
  /// Writes a section of the listing, unless the text is empty.
  void section(const char* title, const std::string& text);
  // the end of the listing
  void list_results();
  /// Lists checks and results asked for; false if a check failed. `talk`: checks are shown on the terminal as well.
  bool list_checks(bool talk);
  void list_accuracy();
  void list_effort(const output::TimeSplit& times);

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
  std::vector<output::GroundRow> ground_;  ///< the last, that with the largest force, and that with the largest moment
  std::vector<output::EnergyRow> energies_;
  std::vector<output::ModeShape> modes_;
  std::string events_, critical_, buckling_, accuracy_;
  std::vector<Diagnostic> warnings_;
  bool frame_between_ = false;  ///< a frame was due within the step
  bool continues_ = false;      ///< an earlier run, whose part of a path this one does not know
  std::size_t marked_ = 0;      ///< number of channels marked as not unique so far
  long steps_ = 0, iterations_ = 0, cuts_ = 0, event_count_ = 0, listed_events_ = 0, locating_ = 0, coupled_ = 0;
};

}  // namespace engrane::app
