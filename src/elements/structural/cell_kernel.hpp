// SPDX-License-Identifier: BSD-3-Clause
// Forces and tangent of one plane cell, summed over its Gauss points, in total Lagrangian form: the linear cell is the
// derivative of the one with large displacements at rest, by the same lines.
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>

#include "elements/materials/plane_elasticity.hpp"
#include "elements/structural/cell_shapes.hpp"

namespace engrane::elements::structural {

/// The cell of four nodes has two displacement modes of its own, 1 − ξ² and 1 − η², each along x and y.
constexpr int internal_modes(int nodes) { return nodes == 4 ? 2 : 0; }

/// N nodes; `Axi`: round the y axis, where x is the radius. Nodes and internal modes stand side by side as columns.
template <int N, bool Axi>
class CellKernel {
 public:
  static constexpr int modes = internal_modes(N);
  static constexpr int columns = N + modes;
  static constexpr int strains = Axi ? 4 : 3;
  static constexpr int size = 2 * columns;

  using Places = Eigen::Matrix<double, 2, N>;
  using Moves = Eigen::Matrix<double, 2, columns>;  ///< displacements of the nodes, amplitudes of the modes
  using Forces = Eigen::Matrix<double, size, 1>;
  using Tangent = Eigen::Matrix<double, size, size>;
  using Strain = Eigen::Matrix<double, strains, 1>;
  using Stiffness = Eigen::Matrix<double, strains, strains>;

  /// Geometry of a Gauss point in the reference configuration.
  struct Point {
    double volume = 0;  ///< that the point stands for
    Eigen::Matrix<double, 2, columns> gradient;
    Eigen::Matrix<double, 1, columns> hoop;  ///< strain round the axis of each column's displacement along x; Axi only
  };
  static constexpr int most_points = 4;

  /// Round an axis one point would leave the cell of three nodes a motion without strain.
  static const std::vector<QuadraturePoint>& points() {
    return Axi && N == 3 ? CellTraits<N>::load_points() : CellTraits<N>::stiffness_points();
  }

  CellKernel(const Places& places, double thickness) {
    static const auto& at = points();
    static const auto samples = tabulate<N>(at);
    for (const ShapeSample<N>& s : samples) {
      const Eigen::Matrix2d jacobian = s.slope * places.transpose();  // rows: along ξ and η
      const Eigen::Matrix2d inverse = jacobian.inverse();
      Point& p = points_[count_];
      p.gradient.template leftCols<N>() = inverse * s.slope;
      p.volume = s.weight * std::abs(jacobian.determinant()) * thickness;
      double radius = 0;
      if constexpr (Axi) {
        radius = places.row(0).dot(s.value);
        p.volume *= 2 * std::numbers::pi * radius;
        p.hoop.template leftCols<N>() = s.value.transpose() / radius;
      }
      if constexpr (modes > 0) {
        const QuadraturePoint& place = at[static_cast<std::size_t>(count_)];
        Eigen::Matrix2d slope = Eigen::Matrix2d::Zero();
        slope(0, 0) = -2 * place.xi;
        slope(1, 1) = -2 * place.eta;
        p.gradient.template rightCols<modes>() = inverse * slope;
        if constexpr (Axi)
          p.hoop.template rightCols<modes>() << (1 - place.xi * place.xi) / radius, (1 - place.eta * place.eta) / radius;
      }
      ++count_;
    }
    if constexpr (modes > 0) remove_mean();
  }

  int count() const { return count_; }
  const Point& point(int i) const { return points_[i]; }

  /// Deformation at a point: F in the plane and, round an axis, its entry of the circumference.
  struct Deformation {
    Eigen::Matrix2d F;
    double hoop = 1;
  };
  Deformation deformation(const Point& p, const Moves& moves) const {
    Deformation d;
    d.F = Eigen::Matrix2d::Identity() + moves * p.gradient.transpose();
    if constexpr (Axi) d.hoop += moves.row(0).dot(p.hoop);
    return d;
  }

  /// Strain of Green and Lagrange, or its linear part.
  static Strain strain(const Deformation& d, bool linear) {
    const Eigen::Matrix2d H = d.F - Eigen::Matrix2d::Identity();
    Eigen::Matrix2d E = (H + H.transpose()) / 2;
    if (!linear) E += H.transpose() * H / 2;
    Strain e;
    e[0] = E(0, 0);
    e[1] = E(1, 1);
    e[strains - 1] = 2 * E(0, 1);
    if constexpr (Axi) {
      const double h = d.hoop - 1;
      e[2] = linear ? h : h + h * h / 2;
    }
    return e;
  }

  static Stiffness reduced(const Eigen::Matrix4d& full) {
    if constexpr (Axi) {
      return full;
    } else {
      Stiffness k;
      k << full(0, 0), full(0, 1), full(0, 3), full(1, 0), full(1, 1), full(1, 3), full(3, 0), full(3, 1), full(3, 3);
      return k;
    }
  }

  /// Resisting forces and, where wanted, their derivative, of nodes and modes for any amplitudes of the modes.
  void sum(const Stiffness& law, bool linear, const Moves& moves, Forces& r, Tangent* k) const {
    r.setZero();
    if (k) k->setZero();
    for (int i = 0; i < count_; ++i) {
      const Point& p = points_[i];
      const Deformation now = deformation(p, moves);
      const Strain stress = p.volume * (law * strain(now, linear));
      const Deformation at = linear ? Deformation{Eigen::Matrix2d::Identity()} : now;
      Eigen::Matrix<double, strains, size> b;
      for (int j = 0; j < columns; ++j) {
        const double x = p.gradient(0, j), y = p.gradient(1, j);
        for (int a = 0; a < 2; ++a) {
          const double along = at.F(a, 0), across = at.F(a, 1);
          b(0, 2 * j + a) = along * x;
          b(1, 2 * j + a) = across * y;
          b(strains - 1, 2 * j + a) = along * y + across * x;
          if constexpr (Axi) b(2, 2 * j + a) = a == 0 ? at.hoop * p.hoop[j] : 0;
        }
      }
      r.noalias() += b.transpose() * stress;
      if (!k) continue;
      k->noalias() += b.transpose() * (p.volume * law * b);
      if (!linear) add_geometric(p, stress, *k);
    }
  }

  /// What is left of forces and tangent once the modes carry no force.
  struct Condensed {
    Moves moves;  ///< with the amplitudes of the modes
    Eigen::Matrix<double, 2 * N, 1> forces;
    Eigen::Matrix<double, 2 * N, 2 * N> tangent;
  };

  /// Forces on the nodes for their displacements. The modes are found by Newton's iteration, which begins at zero, so that the
  /// forces are a function of the displacements alone; where it finds no balance the forces are not numbers.
  void condense(const Stiffness& law, bool linear, const Places& displacements, bool wants_tangent, Condensed& out) const {
    out.moves.template leftCols<N>() = displacements;
    Forces r;
    Tangent k;
    if constexpr (modes == 0) {
      sum(law, linear, out.moves, r, wants_tangent ? &k : nullptr);
      out.forces = r;
      if (wants_tangent) out.tangent = k;
    } else {
      constexpr int nodal = 2 * N, own = 2 * modes, most = 25;
      // its square is rounding: the last correction is carried over to the forces to first order
      constexpr double small = 1e-9;
      out.moves.template rightCols<modes>().setZero();
      for (int iteration = 0; iteration < most; ++iteration) {
        sum(law, linear, out.moves, r, &k);
        const Eigen::Matrix<double, own, nodal + 1> right =
            (Eigen::Matrix<double, own, nodal + 1>() << k.template bottomLeftCorner<own, nodal>(), r.template tail<own>())
                .finished();
        const Eigen::Matrix<double, own, nodal + 1> solved = k.template bottomRightCorner<own, own>().partialPivLu().solve(right);
        const Eigen::Matrix<double, own, 1> change = -solved.col(nodal);
        out.moves.template rightCols<modes>() += Eigen::Map<const Eigen::Matrix<double, 2, modes>>(change.data());
        if (!linear && !(change.norm() * points_[0].gradient.template rightCols<modes>().norm() < small)) continue;
        out.forces = r.template head<nodal>() + k.template topRightCorner<nodal, own>() * change;
        if (wants_tangent)
          out.tangent = k.template topLeftCorner<nodal, nodal>() -
                        k.template topRightCorner<nodal, own>() * solved.template leftCols<nodal>();
        return;
      }
      out.forces.setConstant(std::numeric_limits<double>::quiet_NaN());
      out.tangent.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }

 private:
  /// Ibrahimbegović and Wilson (1991), Commun. Appl. Numer. Methods 7: a constant stress does no work on modes whose gradients
  /// have no mean, whatever the shape of the cell.
  void remove_mean() {
    double volume = 0;
    Eigen::Matrix<double, 2, modes> gradient = Eigen::Matrix<double, 2, modes>::Zero();
    Eigen::Matrix<double, 1, modes> hoop = Eigen::Matrix<double, 1, modes>::Zero();
    for (int i = 0; i < count_; ++i) {
      volume += points_[i].volume;
      gradient += points_[i].volume * points_[i].gradient.template rightCols<modes>();
      if constexpr (Axi) hoop += points_[i].volume * points_[i].hoop.template rightCols<modes>();
    }
    for (int i = 0; i < count_; ++i) {
      points_[i].gradient.template rightCols<modes>() -= gradient / volume;
      if constexpr (Axi) points_[i].hoop.template rightCols<modes>() -= hoop / volume;
    }
  }

  /// Stress times the second derivative of the strain; `stress` times the volume.
  static void add_geometric(const Point& p, const Strain& stress, Tangent& k) {
    Eigen::Matrix2d S;
    S << stress[0], stress[strains - 1], stress[strains - 1], stress[1];
    const Eigen::Matrix<double, columns, columns> g = p.gradient.transpose() * S * p.gradient;
    for (int j = 0; j < columns; ++j)
      for (int i = 0; i < columns; ++i) {
        double radial = g(i, j);
        if constexpr (Axi) radial += stress[2] * p.hoop[i] * p.hoop[j];
        k(2 * i, 2 * j) += radial;
        k(2 * i + 1, 2 * j + 1) += g(i, j);
      }
  }

  Point points_[most_points];
  int count_ = 0;
};

}  // namespace engrane::elements::structural
