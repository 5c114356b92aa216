// SPDX-License-Identifier: BSD-3-Clause
#include "output/results.hpp"

#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <utility>

#include "output/restart_file.hpp"
#include "output/result_file.hpp"
#include "output/xdmf.hpp"

namespace engrane::output {

namespace {

/// Limits the share of run time spent on writing: the next batch waits at least this many times as long as the last one took.
constexpr int share_of_time = 20;

}  // namespace

Results::Results(const std::string& prefix, ResultsLayout layout)
    : layout_(std::move(layout)),
      name_(prefix),
      path_(name_.path(".h5")),
      gathered_(std::make_unique<Batch>()),
      last_(std::make_unique<Batch>()) {
  create(nullptr, nullptr);
}

Results::Results(const std::string& prefix, ResultsLayout layout, const RestartFile& earlier, const RestartPoint& from)
    : layout_(std::move(layout)),
      name_(prefix),
      path_(name_.path(".h5")),
      gathered_(std::make_unique<Batch>()),
      last_(std::make_unique<Batch>()) {
  create(&earlier, &from);
}

void Results::create(const RestartFile* earlier, const RestartPoint* from) {
  // A run that writes the file with this name holds a lock on it. Take our own lock before writing anything.
  { const FileLock nobody_else(path_); }
  shown_lock_ = FileLock::create(spare_path(), path_);
  try {
    { const FileLock nobody_came_first(path_); }
    ResultFile file(spare_path(), layout_, path_, ResultFile::Mode::create);
    if (earlier) {
      frame_times_ = file.copy_from(earlier->id(), from->samples, from->frames);
      samples_ = shown_samples_ = from->samples;
      frames_ = frame_times_.size();
      file.write_latest(*from, false);
    }
    file.close();
    if (earlier) shown_lock_.sync(path_);  // it may replace the file it was copied from
    unlink(name_.path(".xdmf").c_str());
    rename_over(spare_path(), path_);
  } catch (...) {
    unlink(spare_path().c_str());
    throw;
  }
  // large, and in the file from now on; assigning an empty string would keep the memory
  std::string().swap(layout_.deck_text);
  std::string().swap(layout_.model_json);
  for (PointField& field : layout_.point_fields) field.forget();
  set_pace(pace_);
}

void Results::set_pace(Pace pace) {
  pace_ = pace;
  due_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(pace_.time);
}

Results::~Results() {
  if (over_) return;
  try {
    write_batch();
  } catch (const OutputError&) {
    // the caller that abandons an unfinished run reports its own error
  }
  if (has_spare_) unlink(spare_path().c_str());
}

void Results::sample(double time, std::span<const double> values) {
  assert(values.size() == layout_.channel_count());
  gathered_->times.push_back(time);
  gathered_->values.insert(gathered_->values.end(), values.begin(), values.end());
  ++samples_;
}

void Results::frame(double time, FrameValues values) {
  assert(values.nodes.size() == layout_.node_fields.size());
  assert(values.cells.size() == layout_.cell_fields.size());
  assert(values.points.size() == layout_.point_fields.size());
  assert(values.averages.size() == layout_.averages.size());
  gathered_->frames.push_back({time, std::move(values)});
  ++frames_;
}

void Results::restart_point(double time, Snapshot memory, bool keep) {
  RestartPoint point{time, samples_, frames_, std::move(memory)};
  if (keep)
    gathered_->restarts.push_back(std::move(point));
  else
    latest_ = std::make_unique<RestartPoint>(std::move(point));
}

bool Results::full() const { return gathered_->bytes() >= pace_.bytes; }

bool Results::due() const { return gathered_->times.size() >= pace_.samples || full() || Clock::now() >= due_; }

void Results::flush() {
  if (over_) return;
  const Clock::time_point start = Clock::now();
  try {
    write_batch();
    if (frame_times_.size() > indexed_frames_ && start >= index_due_) {
      const Clock::time_point index_start = Clock::now();
      write_index(path_, name_.path(".xdmf"));
      // the index of a long run is large and always rewritten completely: limit its share of the time
      index_due_ = Clock::now() + 50 * (Clock::now() - index_start);
    }
  } catch (...) {
    give_up();
    throw;
  }
  const Clock::duration pause = std::chrono::duration_cast<Clock::duration>(pace_.time);
  due_ = Clock::now() + std::max(pause, share_of_time * (Clock::now() - start));
}

void Results::give_up() {
  over_ = true;
  if (has_spare_) unlink(spare_path().c_str());
}

void Results::write_spare(const char* status) {
  if (!has_spare_) {
    spare_lock_ = FileLock::create(spare_path(), path_);
    has_spare_ = true;
    copy_contents(path_, spare_path(), path_);
    marked_spare_ = marked_shown_;
  }
  ResultFile file(spare_path(), layout_, path_, ResultFile::Mode::append);
  // written frames are kept only in the shown file, not in memory
  const bool shown_has_frames = !last_->frames.empty();
  const hdf5::Handle shown = shown_has_frames ? hdf5::open_for_reading(path_) : hdf5::Handle();
  if (shown_has_frames && shown.id() < 0) hdf5::fail(path_);
  file.append(*last_, shown.id());
  file.append(*gathered_);
  if (latest_) file.write_latest(*latest_, status != nullptr);
  if (not_unique_.size() != marked_spare_) file.mark_not_unique(not_unique_);
  if (status) {
    file.write_checks(checks_);
    if (!modes_.empty()) file.write_modes(modes_);
    indexed_modes_ = modes_.size();
    file.set_status(status);
  }
  file.close();
  spare_lock_.sync(path_);
  marked_spare_ = not_unique_.size();
  for (const Batch::Frame& frame : gathered_->frames) frame_times_.push_back(frame.time);
}

void Results::write_batch() {
  if (gathered_->empty() && !latest_) return;
  write_spare(nullptr);
  exchange_names(path_, spare_path());
  shown_samples_ = samples_;
  std::swap(shown_lock_, spare_lock_);
  std::swap(marked_shown_, marked_spare_);
  std::swap(last_, gathered_);
  for (Batch::Frame& frame : last_->frames) {
    frame.values = {};
    frame.written = true;
  }
  *gathered_ = {};
}

void Results::write_index(const std::string& h5_path, const std::string& xdmf_path) {
  if (frame_times_.empty() || layout_.points.empty()) return;
  const std::string h5_name = std::filesystem::path(h5_path).filename().string();
  replace_text(xdmf_path, xdmf_index(layout_, h5_name, frame_times_, indexed_modes_));
  indexed_frames_ = frame_times_.size();
}

void Results::finish(RunStatus status) {
  if (over_) return;
  const bool complete = status == RunStatus::complete;
  try {
    write_spare(complete ? "complete" : "failed");
    const std::string before = path_, index_before = name_.path(".xdmf");
    const std::string after = complete ? name_.final_path(".h5") : before;
    const std::string index_after = complete ? name_.final_path(".xdmf") : index_before;
    rename_over(spare_path(), after);
    shown_samples_ = samples_;
    has_spare_ = false;
    over_ = true;
    if (after != before) {
      unlink(before.c_str());
      unlink(index_before.c_str());
    }
    path_ = after;
    // an index from an earlier run would refer to frames that may not exist
    if (frame_times_.empty()) unlink(index_after.c_str());
    write_index(after, index_after);
  } catch (...) {
    if (!over_) give_up();
    throw;
  }
}

}  // namespace engrane::output
