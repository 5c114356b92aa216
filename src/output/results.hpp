// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "output/error.hpp"
#include "output/file_names.hpp"
#include "output/results_layout.hpp"

namespace engrane::output {

class ResultFile;
struct Batch;

enum class RunStatus : unsigned char { complete, failed };

/// The fields of a frame: one row of three global components per node of the layout. Velocities stay empty when the layout
/// has none.
struct FrameValues {
  std::span<const double> displacement, rotation, velocity, angular_velocity, reaction_force, reaction_torque;
};

/// Writes a run's numbers (docs/format.md) and their XDMF index.
///
/// Samples and frames are gathered and written in batches, about once a second. Two files take turns: a batch goes into
/// the one that does not bear the name, and then they change names, so that under the name there is at every moment a
/// whole file with all batches so far, whatever kills the run and even when the disk is full. Everything throws
/// OutputError; after one, nothing more is written and the file under the name stays as it was.
///
/// One per run, on one process; not for several threads.
class Results {
 public:
  /// Creates the files with everything but steps. `prefix` is a path without extension.
  Results(const std::string& prefix, ResultsLayout layout);
  /// Without finish(): writes what was gathered, if it can, and leaves the status at `running`.
  ~Results();
  Results(const Results&) = delete;
  Results& operator=(const Results&) = delete;

  /// Histories at one time: a value for each channel, in the layout's order.
  void sample(double time, std::span<const double> values);
  /// Fields at one time.
  void frame(double time, const FrameValues& values);
  /// Channels whose values are one choice of many, places in the layout's order: their datasets get `unique` = 0 with the
  /// next batch. Those named before may be named again.
  void mark_not_unique(std::vector<int> channels) { not_unique_ = std::move(channels); }
  /// What finish() stores as `/checks`.
  void checks(std::vector<CheckResult> results) { checks_ = std::move(results); }
  /// Writes what was gathered now: before a long pause, or on a signal.
  void flush();
  /// Writes the rest and the status. A complete result takes the final name; a failed one keeps the partial name.
  void finish(RunStatus status);

  /// The HDF5 file, as it is called now.
  const std::string& path() const { return path_; }
  const OutputName& name() const { return name_; }
  const ResultsLayout& layout() const { return layout_; }

  /// How much is gathered before it is written. For tests; the defaults suit any run.
  struct Pace {
    std::size_t samples = 4096;
    std::size_t bytes = std::size_t{64} << 20;
    std::chrono::duration<double> time{1.0};
  };
  void set_pace(Pace pace) { pace_ = pace; }

 private:
  using Clock = std::chrono::steady_clock;
  void write_if_due();
  void write_batch();
  void write_index(const std::string& h5_path, const std::string& xdmf_path);
  std::string spare_path() const { return path_ + "~"; }

  ResultsLayout layout_;
  OutputName name_;
  std::string path_;
  Pace pace_;
  std::unique_ptr<ResultFile> shown_, spare_;  ///< `shown_` bears the name
  FileLock locks_[2];
  std::unique_ptr<Batch> gathered_;  ///< in no file yet
  std::unique_ptr<Batch> last_;      ///< in `shown_`, not yet in `spare_`
  std::vector<double> frame_times_;  ///< of all frames in `shown_`
  std::size_t indexed_frames_ = 0;
  std::vector<CheckResult> checks_;
  std::vector<int> not_unique_;
  Clock::time_point written_ = Clock::now();
  Clock::time_point index_due_ = Clock::now();
  bool over_ = false;  ///< finished, or writing has failed
};

}  // namespace engrane::output
