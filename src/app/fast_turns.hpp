// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "assembly/configuration.hpp"
#include "model/solver_options.hpp"

namespace engrane::app {

/// Looks for bodies that turn far within a fixed step about an axis that turns itself. Rotations about an axis fixed in space
/// are exact for any step, but gyroscopic forces turn with the body: their directions within a step are resolved no better than
/// its angle.
class FastTurns {
 public:
  FastTurns(const Model& model, const SolverOptions& options);

  /// Takes the start, and each accepted step.
  void take(const Configuration& c);
  /// A warning on the body that turned farthest in a step; empty if there is none.
  std::string remark() const;

 private:
  struct Body {
    int node = 0, part = 0;  ///< indices into Model::nodes and Model::parts
    Mat3 R = Mat3::Identity();
    Vec3 first = Vec3::Zero();             ///< axis before its first large turn, in global axes; zero before
    Vec3 axis = Vec3::Zero();              ///< of its last large turn
    Vec3 rate = Vec3::Zero();              ///< of the axis, as accelerations have it
    Vec3 swing = Vec3::Zero();             ///< its integral over large turns
    double farthest = 0, apart = 0;        ///< largest change of the axis, and distance from `swing`
    double angle = 0, time = 0, step = 0;  ///< largest turn
  };
  bool warns_of(const Body& body) const;

  const Model& model_;
  bool radau_;
  double error_per_square_;  ///< of generalised-α: error of precession over the square of the angle in a step
  double limit_;             ///< angle in a step above which the scheme is inaccurate
  bool begun_ = false;
  std::vector<Body> bodies_;  ///< none if nothing is to be looked for
};

}  // namespace engrane::app
