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
  even_ = archive.history_step.value_or(step_);
  if (archive.field_step) even_ = std::min(even_, *archive.field_step);
  sample_ = {archive.history_step.value_or(controlled_ ? step_ : 0), start_};
  frame_ = {archive.field_step.value_or((end_ - start_) / 200), start_};
  if (archive.restart_step) restart_ = Interval{*archive.restart_step, start_ + *archive.restart_step};
}

void Schedule::ask(std::vector<double> times) {
  wanted_ = std::move(times);
  std::sort(wanted_.begin(), wanted_.end());
  wanted_.erase(std::unique(wanted_.begin(), wanted_.end()), wanted_.end());
}

bool Schedule::beside_even(double time) const {
  return std::binary_search(wanted_.begin(), wanted_.end(), time) && (even_ == 0 || !even(time));
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
  due.sample = sample_.due(early, start_) || last;
  due.frame = frame_.due(early, start_) || last;
  due.restart = restart_ && restart_->due(early, start_);
  return due;
}

bool Schedule::even(double time) const {
  if (time >= end_ || even_ == 0) return true;
  const double place = (time - start_) / even_;
  return std::abs(place - std::round(place)) < on_time;
}

std::vector<double> Schedule::between(double from, double to) const {
  std::vector<double> times;
  for (const double time : wanted_)
    if (time > from && time < to && beside_even(time)) times.push_back(time);
  if (even_ == 0) return times;
  for (double k = std::floor((from - start_) / even_ + on_time) + 1;; ++k) {
    const double time = start_ + k * even_;
    if (time >= to - on_time * even_) break;
    times.push_back(time);
  }
  std::sort(times.begin(), times.end());
  return times;
}

std::size_t Schedule::expected_samples() const {
  if (end_ == start_) return 1;  // a single equilibrium
  return static_cast<std::size_t>(std::min(1e9, (end_ - start_) / std::max(controlled_ ? even_ : step_, sample_.length))) + 2;
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
