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

/// Writes the numerical results of a run (docs/format.md) and their XDMF index.
///
/// Samples and frames are collected and written in batches, about once a second and rarely enough that writing takes a small
/// part of the run time. Two files are used alternately. A batch is written to the spare file and synced to disk; then the two
/// files exchange names. So at every moment the file with the result's name is complete and holds all batches so far, even if
/// the run is killed, the machine fails or the disk is full. The spare file is created when it is first needed. No file is open
/// between batches. All members throw OutputError on failure. After a failure nothing more is written, and the file with the
/// result's name stays as it was.
///
/// One per run, on one process; not thread-safe.
class Results {
 public:
  /// Creates the file with everything except steps. `prefix` is a path without extension.
  Results(const std::string& prefix, ResultsLayout layout);
  /// Continues an earlier run: the file starts with that run's histories, frames and kept restart points up to the point
  /// `from`. `earlier` may have the same name; it is not needed afterwards.
  Results(const std::string& prefix, ResultsLayout layout, const RestartFile& earlier, const RestartPoint& from);
  /// Without finish(): writes what was collected, if possible, and leaves the status at `running`.
  ~Results();
  Results(const Results&) = delete;
  Results& operator=(const Results&) = delete;

  /// Adds histories at one time: one value per channel, in the order of the layout.
  void sample(double time, std::span<const double> values);
  /// Adds fields at one time.
  void frame(double time, FrameValues values);
  /// Sets all channels found not to be unique so far, as indices in the order of the layout. They get `unique` = 0 with the
  /// next batch.
  void mark_not_unique(std::vector<int> channels) { not_unique_ = std::move(channels); }
  /// Sets what finish() stores as `/modes`.
  void modes(std::vector<ModeShape> shapes) { modes_ = std::move(shapes); }
  /// Sets what finish() stores as `/checks`.
  void checks(std::vector<CheckResult> results) { checks_ = std::move(results); }
  /// Whether a batch should be written now. If so at the end of a step, add a restart point and call flush().
  bool due() const;
  /// Whether so much has been collected that it should be written to free memory.
  bool full() const;
  /// Adds a restart point; call after all samples and frames of the step. With `keep` it stays in the file. Otherwise it
  /// replaces the latest one, `/restart/latest`, which the next batch or finish() writes.
  void restart_point(double time, Snapshot memory, bool keep = false);
  /// Writes what was collected so far: when it is due, before a long pause, or on a signal.
  void flush();
  /// Writes the rest and the status. A complete result gets the final name; a failed one keeps the partial name.
  void finish(RunStatus status);

  /// Whether the file with the result's name holds samples.
  bool holds_samples() const { return shown_samples_ > 0; }
  /// Current name of the HDF5 file.
  const std::string& path() const { return path_; }
  const OutputName& name() const { return name_; }
  const ResultsLayout& layout() const { return layout_; }

  /// Limits on what is collected before it is written. For tests; the defaults suit any run.
  struct Pace {
    std::size_t samples = 65536;
    std::size_t bytes = std::size_t{64} << 20;
    std::chrono::duration<double> time{1.0};
  };
  void set_pace(Pace pace);

 private:
  using Clock = std::chrono::steady_clock;
  void create(const RestartFile* earlier, const RestartPoint* from);
  /// Appends the last batch, which only the shown file has, and the collected one to the spare file, and syncs it to disk.
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
  std::unique_ptr<Batch> gathered_;  ///< not yet in any file
  std::unique_ptr<Batch> last_;      ///< in the shown file, not yet in the spare
  std::unique_ptr<RestartPoint> latest_;
  std::size_t samples_ = 0, frames_ = 0;  ///< added so far
  std::size_t shown_samples_ = 0;         ///< in the shown file
  std::vector<double> frame_times_;       ///< of all frames in the shown file
  std::size_t indexed_frames_ = 0, indexed_modes_ = 0;
  std::vector<CheckResult> checks_;
  std::vector<ModeShape> modes_;
  std::vector<int> not_unique_;
  std::size_t marked_shown_ = 0, marked_spare_ = 0;  ///< number of channels marked in each of the two files
  Clock::time_point due_;
  Clock::time_point index_due_ = Clock::now();
  bool over_ = false;  ///< finished, or writing has failed
};

}  // namespace engrane::output
