// SPDX-License-Identifier: BSD-3-Clause
#include "app/instants.hpp"

namespace engrane::app {

Instants::Instants(Schedule& schedule, observe::Observer& observer, solve::OutOfPlane& out_of_plane, double from,
                   const Configuration& end, const solve::StepReport& step)
    : schedule_(schedule),
      observer_(observer),
      out_of_plane_(out_of_plane),
      end_(end),
      step_(step),
      times_(schedule.between(from, end.time)) {
  if (step.within && (!times_.empty() || observer.moves())) within_ = step.within();
}

void Instants::observe_inside(bool work) {
  // an event may have changed the accelerations at the end of the step, and a friction the law that balances forces
  if (!within_ || step_.settled || step_.drift || (times_.empty() && (!work || !step_.events.empty()))) return;
  const double begin = within_->from().time;
  // in general the error of the second derivatives of the motion is h⁴ times its sixth derivative, but not at these points
  for (const double part : observe::lobatto_points) {
    const double time = begin + part * (end_.time - begin);
    within_->at(time, c_);
    if (!within_->balance(c_)) return;
    if (times_.empty())
      observer_.integrate_inside(out_of_plane_.completed(c_));
    else
      observer_.observe_inside(out_of_plane_.completed(c_));
  }
}

Schedule::Due Instants::show(const std::function<void(double, const Schedule::Due&)>& take) {
  const double even = schedule_.even_step(step_.step);
  bool restart = false;
  for (const double time : times_) {
    if (within_) {
      within_->at(time, c_);
    } else {
      c_ = end_;
      c_.time = time;
    }
    const Schedule::Due due = schedule_.within(time);
    restart = restart || due.restart;
    observer_.between(out_of_plane_.completed(c_), within_ != nullptr);
    if (within_ && !step_.settled && observer_.has_fine_forces()) {
      Configuration balanced = c_;
      if (within_->balance(balanced)) observer_.take_balance(out_of_plane_.completed(balanced));
    }
    if (due.frame) find_fields(c_);
    take(time, due);
  }
  if (!times_.empty()) observer_.back_to_end();
  Schedule::Due due = schedule_.at(end_.time, even, schedule_.even(end_.time), step_.last);
  due.restart = due.restart || restart;
  if (due.frame) observer_.find_fields(out_of_plane_.completed(end_));
  return due;
}

void Instants::find_fields(const Configuration& c) {
  Configuration balanced = c;
  if (!within_ || (!step_.settled && within_->balance(balanced))) {
    observer_.find_fields(out_of_plane_.completed(balanced));
    return;
  }
  const Configuration from = out_of_plane_.completed(within_->from()), to = out_of_plane_.completed(within_->to());
  observer_.find_fields(out_of_plane_.completed(c), from, to);
}

}  // namespace engrane::app
