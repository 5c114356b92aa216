// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "app/schedule.hpp"
#include "observe/observer.hpp"
#include "solve/run/runner.hpp"

namespace engrane::app {

/// Hands on the even instants within a controlled step at which something is due, and returns what is due at its end; a restart
/// point that was due on the way is due there. `from`: the end of the step before.
Schedule::Due show_between(Schedule& schedule, observe::Observer& observer, double from, const Configuration& end,
                           const solve::StepReport& step,
                           const std::function<void(const Configuration&, const Schedule::Due&)>& show);

}  // namespace engrane::app
