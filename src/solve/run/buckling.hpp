// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "solve/schemes/solver_context.hpp"

namespace engrane::solve {

/// A load time at which the tangent is singular, if it goes on changing as it does at one equilibrium.
struct BucklingMode {
  double load_time = 0;
  std::vector<Vec3> displacement;  ///< of each node, global; the largest component of all is 1
  std::vector<Vec3> rotation;      ///< of each node, global, in the same scale
  std::string largest;             ///< largest components of the mode, by name
  double turn = 0;                 ///< largest angle by which a member turns before, in radians
  double left_out = 0;  ///< stiffness against the loads that rotations change before, which are left out, over the whole
};

/// Linearised buckling (`.BUCKLING`): the `count` load times nearest to that of the equilibrium at which K + θ K₁ is singular, in
/// order of distance. K is the tangent at the equilibrium, K₁ its change with time along the path, by stresses, loads and
/// reactions (TangentCourse). SLEPc finds the largest eigenvalues 1/θ of −K⁻¹K₁. Returns fewer if there are no more. Throws
/// SolutionFailure if K is singular. Collective.
std::vector<BucklingMode> find_buckling(SolverContext& context, const Configuration& equilibrium, int count);

}  // namespace engrane::solve
