// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "app/schedule.hpp"
#include "observe/observer.hpp"
#include "solve/run/runner.hpp"

namespace engrane::app {

/// The even instants within one controlled step: a few instants in balance before its end is observed, and what is due between
/// its ends after that.
class Instants {
 public:
  /// A configuration as it is looked at: with its forces out of the plane where the model is a plane one.
  using InSpace = std::function<const Configuration&(const Configuration&)>;

  /// `from`: the end of the step before. The ends must live as long.
  Instants(Schedule& schedule, observe::Observer& observer, InSpace in_space, double from, const Configuration& end,
           const solve::StepReport& step);

  /// Observes two instants in balance, where something is due in the step.
  void observe_inside();
  /// Hands on the even instants at which something is due, and returns what is due at the end; a restart point that was due on
  /// the way is due there. The observer has the histories of each, and its fields where a frame is due.
  Schedule::Due show(const std::function<void(double, const Schedule::Due&)>& take);

 private:
  void find_fields(const Configuration& c);

  Schedule& schedule_;
  observe::Observer& observer_;
  InSpace in_space_;
  const Configuration& end_;
  const solve::StepReport& step_;
  std::vector<double> times_;
  std::unique_ptr<solve::Within> within_;
  Configuration c_;
};

}  // namespace engrane::app
