// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/branch_watch.hpp"

#include <cmath>
#include <limits>

#include "solve/algebra/probe.hpp"

namespace engrane::solve {

BranchWatch::BranchWatch(SolverContext& context, bool wanted)
    : context_(context),
      active_(wanted && context.solver.direct() && context.numbering.slots() > context.numbering.motion_slots()) {}

void BranchWatch::begin() {
  configurations_ = 0;
  response_ = 0;
}

void BranchWatch::look() {
  // at the second configuration the factors are still those of the first correction
  if (!active_ || ++configurations_ != 2) return;
  constexpr double unbounded = std::numeric_limits<double>::infinity();
  Owned<Vec> load, motion;
  PetscReal size = unbounded;
  if (answer_probe(context_.assembler, context_.solver, load, motion)) check_petsc(VecNorm(motion, NORM_2, &size));
  response_ = std::isfinite(size) ? size : unbounded;
}

bool BranchWatch::doubts() const {
  // The response grows with the reciprocal of the distance from the position. Measured for four bars: 1e15 in it, 18 to 717
  // elsewhere.
  constexpr double singular = 1e8;
  return !last_displacements_.empty() && last_response_ > 0 && response_ > singular * last_response_;
}

std::vector<double> BranchWatch::continued(double h) const {
  std::vector<double> displacements(last_displacements_.size());
  for (std::size_t i = 0; i < displacements.size(); ++i) displacements[i] = h / last_h_ * last_displacements_[i];
  return displacements;
}

void BranchWatch::accept(const std::vector<double>& displacements) {
  if (!active_) return;
  last_displacements_ = displacements;
  last_h_ = tried_h_;
  if (response_ > 0 && std::isfinite(response_)) last_response_ = response_;
}

void BranchWatch::save(Snapshot& snapshot) const {
  if (!active_) return;
  snapshot.put("scheme/last_step", last_displacements_);
  snapshot.put("scheme/last_length_and_response", {last_h_, last_response_});
}

void BranchWatch::load(const Snapshot& snapshot) {
  if (!active_ || !snapshot.has("scheme/last_step")) return;  // of another scheme
  last_displacements_ = snapshot.array("scheme/last_step");
  last_h_ = snapshot.array("scheme/last_length_and_response").at(0);
  last_response_ = snapshot.array("scheme/last_length_and_response").at(1);
}

}  // namespace engrane::solve
