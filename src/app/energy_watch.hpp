// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "observe/observer.hpp"
#include "solve/schemes/solver_context.hpp"

namespace engrane::app {

/// Judges the energy balance of a run.
class EnergyWatch {
 public:
  EnergyWatch(const solve::SolverContext& context, const observe::Observer& observer) : context_(context), observer_(observer) {}

  /// The run continues from a restart point, whose energies the observer has loaded.
  void resume() { handled_ = observer_.energies().handled(); }
  /// Call after each step. Why the run must end there if the error of its energy balance is too large; empty if it is not, or
  /// if later steps may still handle so much energy that it is small.
  std::string failure(const solve::References& references, double time, bool last);
  /// A warning for a complete run: its balance was off by more than results should be, or its equilibria are not on one path.
  /// Empty if there is none.
  std::string remark(const solve::References& references) const;

 private:
  /// Whether the deck asks for the balance to be checked.
  bool judges() const;

  const solve::SolverContext& context_;
  const observe::Observer& observer_;
  double handled_ = 0;  ///< observe::EnergyBalance::handled() after the last step
  int steps_off_ = 0;   ///< number of steps in a row whose energies were off
};

}  // namespace engrane::app
