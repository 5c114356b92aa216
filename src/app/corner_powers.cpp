// SPDX-License-Identifier: BSD-3-Clause
#include "app/corner_powers.hpp"

#include "model/speed_jumps.hpp"

namespace engrane::app {

CornerPowers::CornerPowers(solve::SolverContext& context, observe::Observer& observer) : context_(context), observer_(observer) {
  const SolverOptions& options = context.options;
  if (options.analysis != SolverOptions::Analysis::dynamics || options.family != SolverOptions::Family::radau ||
      options.tolerance > 0)
    return;
  const Model& model = context.model;
  corners_ = model.joints(model.commands.stepping.start, model.commands.stepping.end);
  std::erase_if(corners_, [&model](double corner) {
    // an impulse is no power
    return speed_jump(model, corner) || !imposed_acceleration_jumps(model, corner);
  });
}

void CornerPowers::observe(const Configuration& end, const solve::StepReport& step) const {
  constexpr double rounding = 1e-9;  // of a step, in multiples of its length
  for (const double corner : corners_) {
    if (corner > end.time || corner < end.time - rounding * step.step || step.settled || !step.events.empty()) continue;
    Configuration before = end;
    before.time = number_before(corner);
    const solve::MasslessMotions massless(context_.assembler, before);
    context_.start.balance_accelerations(before, 2, nullptr, massless.any() ? &massless : nullptr);
    observer_.integrate_inside(context_.out_of_plane.completed(before));
  }
}

}  // namespace engrane::app
