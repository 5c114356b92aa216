// SPDX-License-Identifier: BSD-3-Clause
#include "app/schedule.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace engrane::app {

namespace {

/// Tolerance on even instants, as a fraction of their interval.
constexpr double on_time = 1e-9;

}  // namespace

Schedule::Schedule(const deck::SteppingCard& stepping, const deck::ArchiveCard& archive)
    : start_(stepping.start), end_(stepping.end), step_(stepping.step), controlled_(stepping.tolerance.has_value()) {
  sample_ = {archive.history_step.value_or(controlled_ ? step_ : 0), start_};
  frame_ = {archive.field_step.value_or((end_ - start_) / 200), start_};
  if (controlled_ && sample_.length > 0) even_.push_back(sample_.length);
  if (controlled_ && archive.field_step) even_.push_back(frame_.length);
  fields_even_ = controlled_ && archive.field_step;
  if (archive.restart_step) restart_ = Interval{*archive.restart_step, start_ + *archive.restart_step};
}

void Schedule::ask(std::vector<double> times, int parts) {
  wanted_ = std::move(times);
  parts_ = parts;
  std::sort(wanted_.begin(), wanted_.end());
  wanted_.erase(std::unique(wanted_.begin(), wanted_.end()), wanted_.end());
}

bool Schedule::Interval::due(double time, double start) {
  if (length <= 0) return true;
  if (time < next) return false;
  next = start + (std::floor((time - start) / length) + 1) * length;
  // an interval below the resolution of time is due only once per instant
  if (next <= time) next = std::nextafter(time, INFINITY);
  return true;
}

Schedule::Due Schedule::at(double time, double step, bool regular, bool last) {
  Due due{last, last, false};
  if (!regular) return due;
  // up to half a step early is on time: sums of steps differ from sums of intervals by rounding errors
  const double early = time + 0.5 * step;
  asked_ = early;
  if (controlled_) return even_due(time, early, true, last);
  due.sample = sample_.due(early, start_) || last;
  due.frame = frame_.due(early, start_) || last;
  due.restart = restart_ && restart_->due(early, start_);
  return due;
}

Schedule::Due Schedule::within(double time) {
  if (!on_any(time)) return {};
  asked_ = time + 0.5 * even_.front();
  return even_due(time, asked_, false, false);
}

Schedule::Due Schedule::even_due(double time, double early, bool at_end, bool last) {
  Due due;
  // once at each instant, also where a step ends there before a jump
  const auto even = [&](Interval& interval) {
    return on(interval.length, time) && interval.due(time + 0.5 * interval.length, start_);
  };
  due.sample = (sample_.length > 0 ? even(sample_) : at_end) || last;
  due.frame = (fields_even_ ? even(frame_) : due.sample && frame_.due(early, start_)) || last;
  due.restart = restart_ && restart_->due(early, start_);
  return due;
}

bool Schedule::on(double interval, double time) const {
  const double place = (time - start_) / interval;
  return std::abs(place - std::round(place)) < on_time;
}

bool Schedule::on_any(double time) const {
  return std::any_of(even_.begin(), even_.end(), [&](double interval) { return on(interval, time); });
}

bool Schedule::even(double time) const { return time >= end_ || sample_.length <= 0 || on_any(time); }

std::vector<double> Schedule::between(double from, double to) const {
  std::vector<double> times;
  for (const double time : wanted_)
    if (time > from && time < to && beside_even(time)) times.push_back(time);
  for (int i = 1; i < parts_; ++i)
    if (const double time = from + (to - from) * i / parts_; time > from && time < to && beside_even(time)) times.push_back(time);
  for (const double interval : even_)
    for (double k = std::floor((from - start_) / interval + on_time) + 1;; ++k) {
      const double time = start_ + k * interval;
      if (time >= to - on_time * interval) break;
      times.push_back(time);
    }
  std::sort(times.begin(), times.end());
  // an instant of both intervals is one, whatever rounding makes of it
  const auto same = [this](double a, double b) { return b - a < on_time * even_step(step_); };
  times.erase(std::unique(times.begin(), times.end(), same), times.end());
  return times;
}

std::size_t Schedule::expected_samples() const {
  if (end_ == start_) return 1;  // a single equilibrium
  return static_cast<std::size_t>(std::min(1e9, (end_ - start_) / std::max(step_, sample_.length))) + 2;
}

void Schedule::save(Snapshot& snapshot) const { snapshot.put("schedule/next", {sample_.next, frame_.next, asked_}); }

void Schedule::load(const Snapshot& snapshot) {
  const std::vector<double>& next = snapshot.array("schedule/next");
  sample_.next = next.at(0);
  frame_.next = next.at(1);
  asked_ = next.at(2);
  if (restart_) restart_->due(asked_, start_);
}

}  // namespace engrane::app
