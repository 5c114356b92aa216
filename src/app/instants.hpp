// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "app/schedule.hpp"
#include "observe/observer.hpp"
#include "solve/constraints/out_of_plane.hpp"
#include "solve/run/runner.hpp"

namespace engrane::app {

/// The output instants within one controlled step: observes a few instants in equilibrium before the end of the step is
/// observed, and afterwards produces what is due between its ends.
class Instants {
 public:
  /// `from`: the end of the previous step. All arguments must outlive this object.
  Instants(Schedule& schedule, observe::Observer& observer, solve::OutOfPlane& out_of_plane, double from,
           const Configuration& end, const solve::StepReport& step);

  /// Observes two instants in equilibrium. In a step without output instants only their power counts: nothing is done there
  /// without `work`.
  void observe_inside(bool work = true);
  /// Calls `take` for every output instant within the step: the observer then has its histories, and its fields if a frame is
  /// due. Returns what is due at the end of the step; a restart point due within the step is moved to its end.
  Schedule::Due show(const std::function<void(double, const Schedule::Due&)>& take);

 private:
  void find_fields(const Configuration& c);

  Schedule& schedule_;
  observe::Observer& observer_;
  solve::OutOfPlane& out_of_plane_;
  const Configuration& end_;
  const solve::StepReport& step_;
  std::vector<double> times_;
  std::unique_ptr<solve::Within> within_;
  Configuration c_;
};

}  // namespace engrane::app
