// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "assembly/assembler.hpp"
#include "solve/algebra/linear.hpp"
#include "solve/constraints/massless.hpp"
#include "solve/constraints/mobility.hpp"
#include "solve/constraints/motion.hpp"
#include "solve/constraints/start_coordinates.hpp"
#include "solve/constraints/start_report.hpp"

namespace engrane::solve {

/// The largest size; not a number where one is not.
inline double largest(std::span<const double> values) {
  double most = 0;
  for (const double x : values) most = std::isnan(x) ? x : std::max(most, std::abs(x));
  return most;
}

/// The solution cannot go on; the words are for the user (exit status 2).
struct SolutionFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Makes a configuration satisfy its constraints at the levels of position, velocity and acceleration.
class Start {
 public:
  Start(Assembler& assembler, LinearSolver& solver, const MotionSlots& motion, Redundancy& redundancy);

  /// Moves `c` as little as possible until all constraints are closed at c.time. Throws SolutionFailure naming the loop
  /// that stays open. `initial`: what the deck imposes on the start holds here, redundant constraints are looked for, and
  /// after a long way the position is compared with the one that is reached by closing the gaps little by little.
  void assemble(Configuration& c, StartReport& report, bool initial = true);
  /// Changes the velocities in `c` as little as possible (in kinetic energy, or geometrically) until they fit.
  void fit_velocities(Configuration& c, Assembler::Metric metric, StartReport& report, bool initial = true);
  /// Sets accelerations and multipliers from the equations of motion and the constraints' second derivatives. With those in `c`
  /// close to right, few iterations are enough. Fills its phase of a report when there is one. Accelerations of `massless`
  /// motions stay as they are, since no balance of forces gives them.
  void balance_accelerations(Configuration& c, int most_iterations = 12, StartReport* report = nullptr,
                             const MasslessMotions* massless = nullptr);
  /// What the equations of motion lack, by equation, without forces on `massless` motions; for a multiplier the second derivative
  /// of its constraint, or what it lacks where it is released.
  std::vector<double> out_of_balance(const Configuration& c, const MasslessMotions* massless);
  /// Of balanced accelerations: gives what vibrates with a period shorter than 2 h the mean over a step of h, which leads near to
  /// its equilibrium; with those of an instant it would overshoot that by the square of h over its period. What steps resolve
  /// has other accelerations by a part of second order. False where nothing vibrates so fast: `c` is as it was.
  bool soften(Configuration& c, double h, StartReport* report = nullptr, const MasslessMotions* massless = nullptr);

  /// The largest motion, over the extent or in radians, by which constraints open by one are closed: about the inverse of the
  /// smallest singular value of their gradient. Infinite where the matrix cannot be factorised.
  double amplification(const Configuration& c);

 private:
  /// What one closing came to.
  struct Closing {
    bool closed = false;
    bool singular = false;  ///< ended by a matrix that could not be factorised
    bool far = false;       ///< some step was cut, or the way was long: another branch may be nearer
    int iterations = 0;
  };
  /// Damped Newton iteration to Φ = `target` (0 when empty) in the constraints that are not released, and to the wanted
  /// coordinates, which must be independent.
  Closing close(Configuration& c, std::span<const int> held, std::span<const double> target,
                const std::vector<StartCoordinates::Wanted>& wanted = {});
  /// Newton's iteration first; after a long way, or when that fails, also along the path Φ = (1 − s) Φ(given).
  Closing close_initial(Configuration& c, StartReport& report);
  /// Follows that path; returns its number of steps, 0 when it cannot be followed to the end.
  int follow(Configuration& c, std::span<const int> held);
  /// Sign of the determinant of the constraints' gradient where nothing is left free; 0 where that is not so.
  int orientation(const Configuration& c, std::span<const int> held);
  void remark_on_branch(const Configuration& given, const Configuration& c, std::span<const int> held, StartReport& report);
  /// The largest move over the extent, or turn in radians, from one configuration to another, and its node.
  struct Distance {
    double size = 0;
    int node = 0;
  };
  Distance distance(const Configuration& from, const Configuration& to) const;
  /// Accelerations a of (M + give K) a + f(q, v, t) = Bᵀ λ, as if forces were those at places that are give · a away. A law may
  /// end on the way there: behind the loss of a contact it would close again. So K is that at `c`. False where no end is found.
  bool balance_softly(Configuration& c, double give, StartReport* report, const MasslessMotions* massless);
  /// Solves for it with the matrix: returns changes of accelerations, and adds those of multipliers to `c`.
  std::vector<double> solve_balance(std::vector<double>& right, Configuration& c, const MasslessMotions* massless);
  /// Do the accelerations of `c` lead so far in a step of h that forces change by more than those do that vibrate once in it?
  bool overshoots(const Configuration& c, double h) const;
  Configuration moved_along(const Configuration& c, double give) const;
  /// Throws where forces are left that no accelerations balance.
  void verify_balance(const Configuration& c, std::span<const double> unbalanced);
  void note_open(const Configuration& given, StartReport& report);
  void note_moved(const std::vector<NodeState>& begun, const Configuration& c, StartReport& report) const;
  /// Equations of the initial values of one kind that must hold.
  std::vector<int> imposed(bool velocity) const;
  void verify_imposed(const Configuration& c, std::span<const double> wished, bool velocity) const;
  bool solve(std::vector<double>& right, std::vector<double>& solution);

  /// Those of the wanted coordinates (or rates) that constraints, held equations and those before them leave free. Afterwards
  /// the projection is to be made again.
  std::vector<StartCoordinates::Wanted> undecided(const Configuration& c, const std::vector<StartCoordinates::Wanted>& all,
                                                  std::span<const int> held);
  /// Changes a step of the projection in the matrix, so that it also meets these coordinates, or a change of velocities their
  /// rates. False when it cannot.
  bool add_coordinates(const Configuration& c, const std::vector<StartCoordinates::Wanted>& wanted, std::vector<double>& step);
  /// Remarks on the initial displacement that the assembly has changed most, when it is not as good as kept.
  void remark_on_guesses(const Configuration& c, StartReport& report) const;
  /// Moves the closed mechanism to where the deck wants its joints.
  void move_coordinates(Configuration& c, StartReport& report);
  void verify_coordinates(const Configuration& c, const std::vector<StartCoordinates::Wanted>& asked) const;

  Assembler& assembler_;
  LinearSolver& solver_;
  const MotionSlots& motion_;
  Redundancy& redundancy_;
  StartCoordinates coordinates_;
  Owned<Vec> right_, solution_;
};

}  // namespace engrane::solve
