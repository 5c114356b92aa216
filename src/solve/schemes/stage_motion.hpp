// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "math/extrapolation.hpp"
#include "solve/schemes/collocation.hpp"
#include "solve/schemes/solver_context.hpp"

namespace engrane::solve {

/// The motion at the stages of a collocation step, on coordinates of the step: rotation vectors, displacements and scalars from
/// its beginning. One entry for each stage.
class StageMotion {
 public:
  StageMotion(const SolverContext& context, const Collocation& collocation);

  /// Call before the others for a step of h: finds what drives prescribe at its stages.
  void begin(const Configuration& from, double h);
  /// Predicts increments and multipliers from the accelerations and multipliers of earlier steps.
  void predict(const Configuration& from, double h, const Extrapolation& earlier_accelerations,
               const Extrapolation& earlier_multipliers);
  /// Velocities and accelerations from the increments, including what is prescribed.
  void differentiate(const Configuration& from, double h);

  std::vector<std::vector<double>> y, v, a;      ///< increments, velocities, accelerations by motion slot
  std::vector<std::vector<double>> multipliers;  ///< kλ

 private:
  bool has_equation(std::size_t slot) const { return context_.numbering.equation(static_cast<int>(slot)) >= 0; }

  const SolverContext& context_;
  const Collocation& collocation_;
  std::vector<std::vector<MotionSlots::Prescribed>> prescribed_;
};

}  // namespace engrane::solve
