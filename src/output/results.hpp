// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/snapshot.hpp"
#include "output/error.hpp"
#include "output/file_names.hpp"
#include "output/results_layout.hpp"

namespace engrane::output {

class RestartFile;
struct Batch;
struct RestartPoint;

enum class RunStatus : unsigned char { complete, failed };

/// Writes a run's numbers (docs/format.md) and their XDMF index.
///
/// Samples and frames are gathered and written in batches, about once a second and so that writing takes a small part of the
/// time. Two files take turns: a batch goes into the one that does not bear the name, which is then forced onto the disk, and
/// they change names; under the name there is at every moment a whole file with all batches so far, whatever kills the run or
/// the machine, and even when the disk is full. The second file is made when it is first needed, and no file is open between
/// batches. Everything throws OutputError; after one, nothing more is written and the file under the name stays as it was.
///
/// One per run, on one process; not for several threads.
class Results {
 public:
  /// Creates the file with everything but steps. `prefix` is a path without extension.
  Results(const std::string& prefix, ResultsLayout layout);
  /// Goes on where an earlier run has got to: the file begins with that run's histories, frames and kept restart points up to
  /// the point `from`. `earlier` may bear the same name; it is not needed any more afterwards.
  Results(const std::string& prefix, ResultsLayout layout, const RestartFile& earlier, const RestartPoint& from);
  /// Without finish(): writes what was gathered, if it can, and leaves the status at `running`.
  ~Results();
  Results(const Results&) = delete;
  Results& operator=(const Results&) = delete;

  /// Histories at one time: a value for each channel, in the layout's order.
  void sample(double time, std::span<const double> values);
  /// Fields at one time.
  void frame(double time, FrameValues values);
  /// All channels so far whose values are one choice of many, places in the layout's order: they get `unique` = 0 with the
  /// next batch.
  void mark_not_unique(std::vector<int> channels) { not_unique_ = std::move(channels); }
  /// What finish() stores as `/modes`.
  void modes(std::vector<ModeShape> shapes) { modes_ = std::move(shapes); }
  /// What finish() stores as `/checks`.
  void checks(std::vector<CheckResult> results) { checks_ = std::move(results); }
  /// Whether enough was gathered for a batch. Ask at the end of a step, give a restart point, then flush().
  bool due() const;
  /// Whether so many bytes are gathered that they should be written for the sake of memory.
  bool full() const;
  /// What the run could be restarted from, after all samples and frames of the step. A kept one stays in the file; of the others
  /// there is only the last, `/restart/latest`, which is written with the next batch or by finish().
  void restart_point(double time, Snapshot memory, bool keep = false);
  /// Writes what was gathered now: when it is due, before a long pause, or on a signal.
  void flush();
  /// Writes the rest and the status. A complete result takes the final name; a failed one keeps the partial name.
  void finish(RunStatus status);

  /// The HDF5 file, as it is called now.
  const std::string& path() const { return path_; }
  const OutputName& name() const { return name_; }
  const ResultsLayout& layout() const { return layout_; }

  /// How much is gathered before it is written. For tests; the defaults suit any run.
  struct Pace {
    std::size_t samples = 65536;
    std::size_t bytes = std::size_t{64} << 20;
    std::chrono::duration<double> time{1.0};
  };
  void set_pace(Pace pace);

 private:
  using Clock = std::chrono::steady_clock;
  void create(const RestartFile* earlier, const RestartPoint* from);
  /// Adds all that `shown` has and the spare has not, and what was gathered, to the spare, which is on the disk afterwards.
  void write_spare(const char* status);
  void write_batch();
  void write_index(const std::string& h5_path, const std::string& xdmf_path);
  void give_up();
  std::string spare_path() const { return path_ + "~"; }

  ResultsLayout layout_;
  OutputName name_;
  std::string path_;
  Pace pace_;
  FileLock shown_lock_, spare_lock_;
  bool has_spare_ = false;
  std::unique_ptr<Batch> gathered_;  ///< in no file yet
  std::unique_ptr<Batch> last_;      ///< in the shown file, not yet in the spare
  std::unique_ptr<RestartPoint> latest_;
  std::size_t samples_ = 0, frames_ = 0;  ///< given so far
  std::vector<double> frame_times_;       ///< of all frames in the shown file
  std::size_t indexed_frames_ = 0, indexed_modes_ = 0;
  std::vector<CheckResult> checks_;
  std::vector<ModeShape> modes_;
  std::vector<int> not_unique_;
  std::size_t marked_shown_ = 0, marked_spare_ = 0;  ///< how many channels are marked in the two files
  Clock::time_point due_;
  Clock::time_point index_due_ = Clock::now();
  bool over_ = false;  ///< finished, or writing has failed
};

}  // namespace engrane::output
