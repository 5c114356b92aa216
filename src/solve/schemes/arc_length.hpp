// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "solve/algebra/tangent_factors.hpp"
#include "solve/schemes/load_derivative.hpp"
#include "solve/schemes/statics.hpp"

namespace engrane::solve {

/// A path of equilibria followed by its length (`.PATH`): the loads' time is one more unknown, and may fall. Configuration::time
/// is the length s of the path. Displacements are measured by their root of a sum of squares, translations over the extent of the
/// model and rotations in radians, in such a unit that at the start s passes as the loads' time does.
///
/// A step begins on the tangent and stays in the plane across its end (Riks 1979, Int. J. Solids Struct. 15; Keller 1977). At its
/// end the tangent matrix is factored anew: the number of its negative eigenvalues tells whether the step has passed a critical
/// point, which is then sought, and its eigenvector of the least eigenvalue is the mode there.
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
  /// What is known of an equilibrium.
  struct Point {
    std::vector<double> way;  ///< tangent of the path, by equation (multipliers scaled), over its length
    double load = 1;          ///< the same of the loads' time
    int negative = 0;         ///< TangentFactors::negative()
    bool symmetric = true;
  };
  /// The least eigenvalue of the tangent in size, with the weights of the length, and its vector by equation.
  struct Mode {
    double eigenvalue = 0;
    std::vector<double> vector;
  };

  /// What a point that is sought lies between.
  struct Bracket {
    struct Side {
      Point point;
      double load_time = 0, value = 0;
    } before, behind;
  };

  /// The equilibrium at the length h from the one of here_.
  NewtonReport follow(const Configuration& from, double h, Configuration& to);
  void complete(Vec x, Vec step) override;
  /// The tangent at an equilibrium, on from `before` (nullptr: loads grow); false where the matrix is singular.
  bool examine(const Configuration& c, const Point* before, Point& point);
  /// Of the matrix examined last.
  Mode least_mode();
  /// Of vectors by equation, with the weights of the length.
  double product(std::span<const double> a, std::span<const double> b) const;
  double length(std::span<const double> way) const;
  /// Between the directions at two points, the loads' time counted as the length is at the start.
  double cosine(const Point& a, const Point& b) const;
  /// Ends the step where `value` is zero, to a part of its larger end; it is `first` at the beginning and has another sign at the
  /// end.
  Bracket locate(const Configuration& from, double& h, Configuration& to, Point& there, double first, double precision,
                 const std::function<double(const Configuration&, const Point&)>& value);
  /// What ends the path, as numbers.
  std::vector<double> goal() const;
  /// Ends a step that passes a critical point there.
  void find_critical(const Configuration& from, double& h, Configuration& to, Point& there);
  /// Ends a step that passes what the deck asks for there.
  void find_goal(const Configuration& from, double& h, Configuration& to, Point& there);
  /// Turns the direction at a bifurcation to the mode; returns the displacement that the next step begins with.
  double take_branch(const Mode& mode, Point& there);
  /// Directions in which the equilibrium is unstable; of an unsymmetric tangent 1 for an odd number of them, else 0.
  int unstable(const Point& point) const;

  TangentFactors factors_;
  LoadDerivative load_derivative_;
  Owned<Vec> load_, toward_, right_;  ///< change of the residual with the loads' time, solutions, right sides
  std::vector<double> weights_;       ///< of the length, by equation
  double unit_ = 1;                   ///< of the length
  Point here_, there_;                ///< where the path has got to, and the end of the last attempt
  int bifurcations_ = 0, next_bifurcations_ = 0, steps_ = 0;
  bool branching_ = false;  ///< the next step leaves a bifurcation along its mode
  double branch_step_ = 0;
  Course course_, next_course_;
  // of one solution by Newton's method
  Configuration* work_ = nullptr;
  double now_ = 0;    ///< loads' time
  double aim_ = 0;    ///< what plane_ times the displacements is to be
  Owned<Vec> plane_;  ///< weights times the direction at the beginning
};

}  // namespace engrane::solve
