// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
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

/// Largest magnitude; NaN if a value is not a number.
inline double largest(std::span<const double> values) {
  double most = 0;
  for (const double x : values) most = std::isnan(x) ? x : std::max(most, std::abs(x));
  return most;
}

class CarriedBodies;

/// The solution cannot go on; the message is for the user (exit status 2).
struct SolutionFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Makes a configuration satisfy its constraints at the levels of position, velocity and acceleration.
class Start {
 public:
  Start(Assembler& assembler, LinearSolver& solver, const MotionSlots& motion, Redundancy& redundancy);

  /// Moves `c` as little as possible until all constraints are closed at c.time. Throws SolutionFailure naming the loop that
  /// stays open. Initial values imposed by the deck hold, redundant constraints are looked for, and after a long displacement the
  /// position is compared with the one reached by closing the gaps gradually.
  void assemble(Configuration& c, StartReport& report);
  /// Changes the velocities of `c` as little as possible (in kinetic energy, or geometrically) until they satisfy the
  /// constraints and the initial values of the deck.
  void fit_velocities(Configuration& c, Assembler::Metric metric, StartReport& report);
  /// Closes the constraints that a step of an assembled mechanism has opened, whatever the deck's initial values; returns the
  /// number of iterations. Throws SolutionFailure.
  int close_again(Configuration& c);
  /// Changes velocities as little as possible until they satisfy the constraints, whatever the deck's initial values.
  void project_velocities(Configuration& c, Assembler::Metric metric);
  /// Sets accelerations and multipliers from the equations of motion and the second derivatives of the constraints. Few
  /// iterations are enough if those of `c` are close. Fills its phase of `report`, if given. Accelerations of `massless`
  /// motions stay as they are, since no balance of forces determines them.
  void balance_accelerations(Configuration& c, int most_iterations = 12, StartReport* report = nullptr,
                             const MasslessMotions* massless = nullptr);
  /// Imbalance of the equations of motion (minus the residual), by equation, without forces on `massless` motions. For a
  /// multiplier: the second derivative of its constraint or, if it is released, what it lacks of the released value.
  std::vector<double> out_of_balance(const Configuration& c, const MasslessMotions* massless);
  /// Replaces balanced accelerations of what vibrates with a period shorter than 2 h by the mean over a step of h, which leads
  /// near to its equilibrium; those of an instant would overshoot it by the square of h over the period. Accelerations of what
  /// steps resolve change by a part of second order. False, with `c` unchanged, if nothing vibrates so fast or no such mean is
  /// found.
  bool soften(Configuration& c, double h, StartReport* report = nullptr, const MasslessMotions* massless = nullptr);
  /// The same for the states of controllers with a lag shorter than a step of h resolves: their rates would overshoot by the step
  /// over the lag. True if there are any, whatever they do at the moment.
  bool soften_signals(Configuration& c, double h) const;
  /// Places states with lags far shorter than a step of h where they are after these lags, for which `later`, `c` after the time
  /// `span`, tells how fast that changes. True if there are any.
  bool settle_signals(Configuration& c, const Configuration& later, double span, double h) const;

  /// Moment below which a force in `c` is but rounding of accelerations, times what stands for the inertia of motions without
  /// any (Assembler::missing_inertia). All forces are, where nothing has inertia and nothing is loaded.
  double noise_of_missing_inertia(const Configuration& c) const;

 private:
  /// Accuracy of closed constraints; away() times that far from the origin.
  static constexpr double rounding_ = 32 * std::numeric_limits<double>::epsilon();
  /// Longest motion between two positions of a path, over the extent or in radians: no loop folds over in it, and far less than
  /// half a turn, so that turns can be counted.
  static constexpr double longest_step_ = 0.2;

  /// assemble() with the teeth as soft as they are, or as held as they can be (holds_teeth_).
  void assemble_once(Configuration& c, StartReport& report);
  /// fit_velocities() or, without a report, project_velocities().
  void fit(Configuration& c, Assembler::Metric metric, StartReport* report);
  /// The same where teeth of `c`, assembled from `given`, are pressed in too far.
  void assemble_teeth(const Configuration& given, Configuration& c, StartReport& report);
  /// Gives elastic bodies the velocities of rigid bodies, as far as constraints, held equations and the coordinates `free` allow.
  /// `c` is to fit these, and the matrix is their projection.
  void carry(Configuration& c, Assembler::Metric metric, std::span<const int> held,
             const std::vector<StartCoordinates::Wanted>& free, CarriedBodies& bodies);
  /// Tells which bodies were carried along, and warns of torn ones: `what` moves them, `remedy` is what moves a whole one.
  void note_bodies(const CarriedBodies& bodies, const std::string& what, const std::string& remedy, StartReport& report) const;
  /// A pair of elastic teeth and how far they are pressed in, over their module; no part if none is.
  struct PressedTeeth {
    int part = -1;
    double deflection = 0;  ///< a length
    double modules = 0;
  };
  PressedTeeth most_pressed_teeth(const Configuration& c) const;
  /// Indices into Configuration::scalars of the deformations of all elastic teeth.
  std::vector<std::size_t> tooth_deformations() const;

  /// Result of one closing.
  struct Closing {
    bool closed = false;
    bool singular = false;  ///< ended by a matrix that could not be factored
    bool far = false;       ///< a step was limited or halved: another branch may be nearer
    int iterations = 0;
    double first = 0;  ///< largest motion of the first step before it was limited, in half radians or quarters of the extent
  };
  /// Where on a path the constraints are to be closed: Φ = `part` of `gaps`, those at its beginning; 0 if there are none.
  struct Target {
    std::span<const double> gaps = {};
    double part = 0;
    double accuracy = rounding_;  ///< over the sizes of constraints and gaps, near the origin
  };
  /// Distance from the origin over the extent, at least 1: positions are rounded to its size.
  double away(const Configuration& c) const;
  /// Damped Newton iteration to the target in the constraints that are not released, and to the wanted coordinates, which must
  /// be independent.
  Closing close(Configuration& c, std::span<const int> held, const Target& target,
                const std::vector<StartCoordinates::Wanted>& wanted = {});
  /// Newton's iteration first; after a long displacement, or if it fails, also along the path Φ = (1 − s) Φ(given).
  Closing close_initial(Configuration& c, StartReport& report);
  /// Follows that path and counts turns on the way; returns its number of steps, 0 if its end cannot be reached. Throws
  /// SolutionFailure if the end is too far away.
  int follow(Configuration& c, std::span<const int> held);
  /// Part of a path to try after one of length `part` was closed, by a motion `moved` of at most longest_step_.
  static double next_part(double part, const Closing& closing, double moved);
  /// Whether a part of a path that could not be closed, or only by a long motion, is too short to be halved. `shortest` is of
  /// the whole path, which may be many turns long: a part that asks for a motion is no shorter than that motion.
  static bool too_short(double part, double shortest, const Closing& closing);
  /// Whether elements count different turns at two configurations. The first is one whose turns were counted on the way.
  bool turns_differ(const Configuration& counted, Configuration other);
  /// Sign of the determinant of the constraints' gradient if nothing is left free; otherwise 0.
  int orientation(const Configuration& c, std::span<const int> held);
  void remark_on_branch(const Configuration& given, const Configuration& c, std::span<const int> held, StartReport& report);
  /// Largest displacement over the extent, or rotation in radians, between two configurations, and its node.
  struct Distance {
    double size = 0;
    int node = 0;
  };
  Distance distance(const Configuration& from, const Configuration& to) const;
  /// Accelerations a of (M + give K) a + f(q, v, t) = Bᵀ λ, as if forces were those at positions displaced by give · a. K is
  /// that at `c`: a law may end on the way there, and after the loss of a contact would close it again. False if it does not
  /// converge.
  bool balance_softly(Configuration& c, double give, StartReport* report, const MasslessMotions* massless);
  /// One pass of balance_accelerations: changes `a`, the accelerations, and the multipliers until forces balance with reactions
  /// shared as they are, in iterations from `iteration` to `end`. Returns whether they do; `right` is then what is left.
  bool balance_as_shared(Configuration& c, std::vector<double>& a, std::vector<double>& right, int& iteration, int end,
                         StartReport* report, const MasslessMotions* massless);
  /// Solves the balance with the assembled matrix: returns the changes of accelerations, and adds those of multipliers to `c`.
  std::vector<double> solve_balance(std::vector<double>& right, Configuration& c, const MasslessMotions* massless);
  /// Whether the accelerations of `c` lead so far in a step of h that forces change by more than those of a vibration of period
  /// 2 h.
  bool overshoots(const Configuration& c, double h) const;
  Configuration moved_along(const Configuration& c, double give) const;
  /// Largest force on a node, moment over the extent or force on a scalar, whatever the directions of the axes; not finite if one
  /// of them is not. `by_slot`: of length numbering().slots().
  double largest_force(std::span<const double> by_slot) const;
  /// Throws if forces are left that no accelerations balance.
  void verify_balance(const Configuration& c, std::span<const double> unbalanced);
  void note_open(const Configuration& given, StartReport& report);
  void note_moved(const std::vector<NodeState>& begun, const Configuration& c, StartReport& report) const;
  /// Equations of the imposed initial values, of position or of velocity.
  std::vector<int> imposed(bool velocity) const;
  /// Equations that the assembly moves last: imposed positions and, if holds_teeth_, the deformations of teeth.
  std::vector<int> held_positions() const;
  void verify_imposed(const Configuration& c, std::span<const double> wished, bool velocity) const;
  bool solve(std::vector<double>& right, std::vector<double>& solution);

  /// The wanted coordinates (or rates) that are left free by constraints, held equations and the coordinates before
  /// them. The projection must be assembled again afterwards.
  std::vector<StartCoordinates::Wanted> undecided(const Configuration& c, const std::vector<StartCoordinates::Wanted>& all,
                                                  std::span<const int> held);
  /// Changes a step of the projection in the matrix so that it also reaches these coordinates, or a change of velocities so
  /// that it reaches their rates. False if it cannot.
  bool add_coordinates(const Configuration& c, const std::vector<StartCoordinates::Wanted>& wanted, std::vector<double>& step);
  /// Remarks on the initial displacement that the assembly has changed most, unless it is practically kept.
  void remark_on_guesses(const Configuration& c, StartReport& report) const;
  /// Moves the closed mechanism to the joint values of the deck.
  void move_coordinates(Configuration& c, StartReport& report);
  void verify_coordinates(const Configuration& c, const std::vector<StartCoordinates::Wanted>& asked) const;

  Assembler& assembler_;
  LinearSolver& solver_;
  const MotionSlots& motion_;
  Redundancy& redundancy_;
  StartCoordinates coordinates_;
  Owned<Vec> right_, solution_;
  const CarriedBodies* carried_ = nullptr;  ///< bodies that assemble() moves as wholes, if any
  bool holds_teeth_ = false;                ///< wheels turn rather than that their teeth deform
};

}  // namespace engrane::solve
