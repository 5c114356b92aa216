// SPDX-License-Identifier: BSD-3-Clause
#include "app/instants.hpp"

namespace engrane::app {

Schedule::Due show_between(Schedule& schedule, observe::Observer& observer, double from, const Configuration& end,
                           const solve::StepReport& step,
                           const std::function<void(const Configuration&, const Schedule::Due&)>& show) {
  bool restart = false;
  const auto look = [&](const Configuration& c) {
    const Schedule::Due due = schedule.at(c.time, schedule.even_step(step.step), true);
    restart = restart || due.restart;
    show(c, due);
  };
  const std::vector<double> times = schedule.between(from, end.time);
  if (step.between) {
    step.between(times, look);
  } else {  // a drift is so short that nothing changes in it
    Configuration c = end;
    for (const double time : times) {
      c.time = time;
      look(c);
    }
  }
  if (!times.empty()) observer.back_to_end();
  Schedule::Due due = schedule.at(end.time, schedule.even_step(step.step), schedule.even(end.time));
  due.restart = due.restart || restart;
  return due;
}

}  // namespace engrane::app
