// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "solve/schemes/equilibrium_tangent.hpp"
#include "solve/schemes/load_derivative.hpp"
#include "solve/schemes/statics.hpp"

namespace engrane::solve {

/// A path of equilibria followed by its length (`.PATH`): the load time is one more unknown, and may decrease.
/// Configuration::time is the length s of the path. Displacements are measured by the root of their sum of squares,
/// translations over the extent of the model and rotations in radians, in a unit in which s increases as fast as the load time
/// at the start.
///
/// Planes and angles, which steer the steps, have another measure: each node counts against what it has travelled so far. The end
/// of a soft spring, which moves far, would otherwise hide what snaps behind it.
///
/// A step begins on the tangent and stays in the plane normal to it at its end (Riks 1979, Int. J. Solids Struct. 15; Keller
/// 1977). There the tangent matrix is factored anew: the number of its negative eigenvalues shows whether the step has passed a
/// critical point. This point is then located, and the eigenvector of the smallest eigenvalue is the mode there.
class ArcLength final : public Statics, private Border {
 public:
  explicit ArcLength(SolverContext& context);

  StartReport start(Configuration& c) override;
  Outcome attempt(const Configuration& from, double h, Configuration& to) override;
  void accept() override;
  const Course* course() const override { return &course_; }
  void save(Snapshot& snapshot) const override;
  void load(const Snapshot& snapshot) override;

 private:
  /// Data of an equilibrium.
  struct Point {
    std::vector<double> way;  ///< tangent of the path, by equation (multipliers scaled), over its length
    double load = 1;          ///< change of the load time over that length
    int negative = 0;         ///< EquilibriumTangent::negative()
    bool symmetric = true;
  };
  /// The eigenvalue of the tangent of least magnitude, with the weights of the length, and its vector by equation.
  struct Mode {
    double eigenvalue = 0;
    std::vector<double> vector;
  };

  /// Bracket of a point that is sought.
  struct Bracket {
    struct Side {
      Point point;
      double load_time = 0, value = 0;
    } before, behind;
  };

  /// Finds the equilibrium at the length h from that of here_, or, with `at_end`, at the load time at which the run ends.
  NewtonReport follow(const Configuration& from, double h, Configuration& to, bool at_end = false);
  /// Tries to arrive at the end of the run with a step under given loads, of at most h. Beyond the end loads may stay as they
  /// are, and a step that passes it then has no solution.
  std::optional<NewtonReport> arrive(const Configuration& from, double h, Configuration& to);
  void complete(Vec x, Vec step) override;
  bool has_settled(double part) const override;
  /// Finds the tangent at an equilibrium, onwards from `before` (nullptr: loads grow); false if the matrix is singular.
  bool examine(const Configuration& c, const Point* before, Point& point);
  /// Mode of the matrix examined last.
  Mode least_mode();
  double length(std::span<const double> way) const;
  /// Adds to what nodes have travelled a step of h in the direction at a point.
  void travel(const Point& at, double h);
  /// Sets relative_ by what nodes have travelled.
  void weigh();
  /// Looks for nodes that move much farther in a step of h, `chord`, than they have travelled and its beginning leads, as where
  /// something snaps behind a spring so soft that it counts for nothing. From now on they count against what they have travelled,
  /// however little. Returns whether there are any: the step is then to be tried again.
  bool find_leaps(std::span<const double> chord, double h);
  /// Relative length, with the weights relative_ and in the unit measure_.
  double relative(std::span<const double> way) const;
  /// Relative length of the direction at a point, 1 where only the load time goes on: that of a step of 1.
  double pace(const Point& point) const;
  /// Whether the loads of an equilibrium are those of all load times before it, to one span of the run before its begin.
  bool loads_have_ended(const Configuration& c);
  /// Angle between the directions at two points, in the relative measure; the load time counts as measure_ does.
  double angle(const Point& a, const Point& b) const;
  /// Ends the step where `value` is zero, to the fraction `precision` of its larger end value. `first`: the value at the
  /// beginning, of the opposite sign to that at the end.
  Bracket locate(const Configuration& from, double& h, Configuration& to, Point& there, double first, double precision,
                 const std::function<double(const Configuration&, const Point&)>& value);
  /// The deck's conditions that end the path, as numbers.
  std::vector<double> goal() const;
  /// Ends a step that passes a critical point at that point; behind it if that is a bifurcation.
  void find_critical(const Configuration& from, double& h, Configuration& to, Point& there);
  /// Moves a step of h that ends at a bifurcation on behind it, but not beyond where the `whole` step ended; false if nothing is
  /// found there.
  bool pass(const Configuration& from, const Configuration& end, double whole, double& h, Configuration& to);
  /// Sets the direction at a bifurcation, `part` of the way to the end of the step, to one between those at both ends: so near to
  /// it rounding turns the tangent to the other path.
  void keep_direction(const Point& at_end, double part, Point& there) const;
  /// Ends a step that passes the deck's goal at that goal.
  void find_goal(const Configuration& from, double& h, Configuration& to, Point& there);
  /// Sets the direction at a bifurcation to the mode; returns the displacement with which the next step begins.
  double take_branch(const Mode& mode, Point& there);
  /// Number of directions in which the equilibrium is unstable; of an unsymmetric tangent 1 if the number is odd, else 0.
  int unstable(const Point& point) const;
  /// Number of directions by which the stability of two points differs; its parity where the tangent of only one is symmetric.
  int turned(const Point& a, const Point& b) const;

  EquilibriumTangent tangent_;  ///< examined last
  LoadDerivative load_derivative_;
  Owned<Vec> load_, toward_, right_;  ///< derivative of the residual by the load time, solutions, right sides
  std::vector<double> weights_;       ///< of the length, by equation
  std::vector<std::size_t> groups_;   ///< by equation: what travels together, the unknowns of a node
  std::vector<double> travelled_;     ///< by group
  std::vector<double> reach_;         ///< by group: distance to the nearest node that an element joins it to
  std::vector<double> counted_;       ///< by group: 1 for those of find_leaps()
  std::vector<double> relative_;      ///< weights_ over the square of what the group has travelled: of planes and angles
  double measure_ = 1;                ///< relative length that counts as much as the load time
  double unit_ = 1;                   ///< of the length
  double step_ = 0;                   ///< length of the last attempt
  Point here_, there_;                ///< present point of the path, and the end of the last attempt
  int bifurcations_ = 0, next_bifurcations_ = 0, steps_ = 0;
  bool branching_ = false;  ///< the next step leaves a bifurcation along its mode
  double branch_step_ = 0;
  Course course_, next_course_;
  // for one solution by Newton's method
  Configuration* work_ = nullptr;
  double now_ = 0;    ///< load time
  double moved_ = 0;  ///< its last change
  double aim_ = 0;    ///< required product of plane_ with the displacements
  Owned<Vec> plane_;  ///< weights times the direction at the beginning of the step
};

}  // namespace engrane::solve
