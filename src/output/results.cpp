// SPDX-License-Identifier: BSD-3-Clause
#include "output/results.hpp"

#include <unistd.h>

#include <cassert>
#include <filesystem>
#include <utility>

#include "output/result_file.hpp"
#include "output/xdmf.hpp"

namespace engrane::output {

Results::Results(const std::string& prefix, ResultsLayout layout)
    : layout_(std::move(layout)),
      name_(prefix),
      path_(name_.path(".h5")),
      gathered_(std::make_unique<Batch>()),
      last_(std::make_unique<Batch>()) {
  // the locks of another run, if it holds any, are on the files of its own
  { const FileLock mine_too(path_), and_spare(spare_path()); }
  try {
    unlink(name_.path(".xdmf").c_str());
    shown_ = std::make_unique<ResultFile>(spare_path(), layout_, path_);
    shown_->flush();
    rename_over(spare_path(), path_);
    spare_ = std::make_unique<ResultFile>(spare_path(), layout_, path_);
    spare_->flush();
    locks_[0] = FileLock(path_);
    locks_[1] = FileLock(spare_path());
  } catch (...) {
    if (shown_) shown_->abandon();
    if (spare_) spare_->abandon();
    unlink(spare_path().c_str());
    throw;
  }
}

Results::~Results() {
  if (!over_) {
    try {
      write_batch();
    } catch (const OutputError&) {
      // whoever destroys an unfinished run has an error of his own to tell
    }
    spare_->abandon();
    shown_->abandon();
    unlink(spare_path().c_str());
  }
}

void Results::sample(double time, std::span<const double> values) {
  assert(values.size() == layout_.channel_count());
  gathered_->times.push_back(time);
  gathered_->values.insert(gathered_->values.end(), values.begin(), values.end());
  write_if_due();
}

void Results::frame(double time, const FrameValues& values) {
  Batch::Frame frame;
  frame.time = time;
  const auto add = [&](std::span<const double> field) {
    assert(field.size() == 3 * layout_.points.size());
    frame.values.insert(frame.values.end(), field.begin(), field.end());
  };
  add(values.displacement);
  add(values.rotation);
  if (layout_.velocities) {
    add(values.velocity);
    add(values.angular_velocity);
  }
  add(values.reaction_force);
  add(values.reaction_torque);
  gathered_->frames.push_back(std::move(frame));
  write_if_due();
}

void Results::write_if_due() {
  if (gathered_->times.size() >= pace_.samples || gathered_->bytes() >= pace_.bytes || Clock::now() - written_ >= pace_.time)
    flush();
}

void Results::flush() {
  if (over_) return;
  try {
    write_batch();
    if (frame_times_.size() > indexed_frames_ && Clock::now() >= index_due_) {
      const Clock::time_point start = Clock::now();
      write_index(path_, name_.path(".xdmf"));
      // the index of a long run is large and always written whole: give it a small share of the time
      index_due_ = Clock::now() + 50 * (Clock::now() - start);
    }
  } catch (...) {
    over_ = true;
    spare_->abandon();
    shown_->abandon();
    unlink(spare_path().c_str());
    throw;
  }
  written_ = Clock::now();
}

void Results::write_batch() {
  if (gathered_->empty()) return;
  spare_->append(*last_);
  spare_->append(*gathered_);
  spare_->mark_not_unique(not_unique_);
  spare_->flush();
  exchange_names(path_, spare_path());
  std::swap(shown_, spare_);
  std::swap(last_, gathered_);
  for (const Batch::Frame& frame : last_->frames) frame_times_.push_back(frame.time);
  gathered_->times.clear();
  gathered_->values.clear();
  gathered_->frames.clear();
}

void Results::write_index(const std::string& h5_path, const std::string& xdmf_path) {
  if (frame_times_.empty() || layout_.points.empty()) return;
  const std::string h5_name = std::filesystem::path(h5_path).filename().string();
  replace_text(xdmf_path, xdmf_index(layout_, h5_name, frame_times_));
  indexed_frames_ = frame_times_.size();
}

void Results::finish(RunStatus status) {
  if (over_) return;
  const bool complete = status == RunStatus::complete;
  const std::string spare = spare_path();
  try {
    spare_->append(*last_);
    spare_->append(*gathered_);
    for (const Batch::Frame& frame : gathered_->frames) frame_times_.push_back(frame.time);
    spare_->mark_not_unique(not_unique_);
    spare_->write_checks(checks_);
    spare_->set_status(complete ? "complete" : "failed");
    spare_->close();
    const std::string before = path_, index_before = name_.path(".xdmf");
    const std::string after = complete ? name_.final_path(".h5") : before;
    const std::string index_after = complete ? name_.final_path(".xdmf") : index_before;
    rename_over(spare, after);
    shown_->abandon();
    over_ = true;
    if (after != before) {
      unlink(before.c_str());
      unlink(index_before.c_str());
    }
    path_ = after;
    // an index of what was here before would point at frames that may not exist
    if (frame_times_.empty()) unlink(index_after.c_str());
    write_index(after, index_after);
  } catch (...) {
    if (!std::exchange(over_, true)) {
      spare_->abandon();
      shown_->abandon();
      unlink(spare.c_str());
    }
    throw;
  }
}

}  // namespace engrane::output
