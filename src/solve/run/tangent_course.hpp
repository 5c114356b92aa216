// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "solve/schemes/equilibrium_tangent.hpp"

namespace engrane::solve {

/// The tangent along the path of equilibria through one of them, to the first order in the time θ from it: K + θ K₁. K₁ has what
/// stresses, loads and reactions change, and no rotations of members (Element::turns_with_nodes()), as is usual in linearised
/// buckling. A stiff direction that turns by φ loses a part of its stiffness in proportion to φ and gains one in proportion to
/// φ²: to the first order a member would buckle that only bends.
class TangentCourse {
 public:
  /// Throws SolutionFailure if the tangent is singular at the equilibrium. Collective, like all functions that are not const.
  TangentCourse(SolverContext& context, const Configuration& equilibrium);

  /// Whether anything changes with time.
  bool loaded() const;
  /// Finds K₁ by the forward difference of order 4, exact where the tangent is a polynomial of that degree.
  void differentiate(double step);
  /// y = −K⁻¹ K₁ x
  void respond(Vec x, Vec y);
  /// Largest angle by which a member turns per unit of time, in radians.
  double fastest_turn() const { return fastest_turn_; }
  /// Part of its stiffness against the loads that the structure gains or loses per unit of time by the rotations that are left
  /// out.
  double left_out();

 private:
  /// The equilibrium later by θ, if everything goes on as it does.
  const Configuration& at(double theta);
  /// k A + Aᵀ k of an element, minus the change of its tangent that comes from the displacements of its nodes and not from
  /// stress: rigid-body motions of the element as it will stand meet no resistance, as they do not where it stands. 0 for
  /// elements whose tangent does not turn.
  void set_to_rotation(int part, std::span<double> k);

  SolverContext& context_;
  EquilibriumTangent tangent_;
  Owned<Mat> change_, rotations_;
  Owned<Vec> product_, way_;
  Configuration moved_;
  double fastest_turn_ = 0;
  std::vector<double> along_, motion_;  ///< ẋ, by equation and by motion slot
};

}  // namespace engrane::solve
