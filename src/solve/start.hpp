// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

#include "assembly/assembler.hpp"
#include "solve/linear.hpp"
#include "solve/mobility.hpp"
#include "solve/motion.hpp"

namespace engrane {

/// The solution cannot go on; the words are for the user (exit status 2).
struct SolutionFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What the start did, for the listing.
struct StartReport {
  int position_iterations = 0;
  double largest_move = 0;             ///< translation, in the deck's unit of length
  double largest_turn = 0;             ///< rotation, radians
  std::string moved_most;              ///< node that moved or turned most
  double largest_velocity_change = 0;  ///< from the wished initial velocities
  int redundant = 0;                   ///< constraints that follow from others
  std::string mobility;                ///< degrees of freedom and redundant constraints, as a paragraph
};

/// Makes a configuration satisfy its constraints at the levels of position, velocity and acceleration.
class Start {
 public:
  Start(Assembler& assembler, LinearSolver& solver, const MotionSlots& motion, Redundancy& redundancy);

  /// Moves `c` as little as possible until all constraints are closed at c.time. Throws SolutionFailure naming what
  /// stays open. `initial`: what the deck imposes on the start holds here, and redundant constraints are looked for.
  void assemble(Configuration& c, StartReport& report, bool initial = true);
  /// Changes the velocities in `c` as little as possible (in kinetic energy, or geometrically) until they fit.
  void fit_velocities(Configuration& c, Assembler::Metric metric, StartReport& report, bool initial = true);
  /// Sets accelerations and multipliers from the equations of motion and the constraints' second derivatives. With those in `c`
  /// close to right, few iterations are enough.
  void balance_accelerations(Configuration& c, int most_iterations = 12);

 private:
  /// Closes the constraints that are not released, then sees whether the released ones are closed too.
  void close(Configuration& c, StartReport& report, bool initial);
  /// Equations of the initial values of one kind that must hold.
  std::vector<int> imposed(bool velocity) const;
  void verify_imposed(const Configuration& c, std::span<const double> wished, bool velocity) const;
  bool solve(std::vector<double>& right, std::vector<double>& solution);
  std::string explain_open(const std::vector<double>& phi) const;

  Assembler& assembler_;
  LinearSolver& solver_;
  const MotionSlots& motion_;
  Redundancy& redundancy_;
  Owned<Vec> right_, solution_;
};

}  // namespace engrane
