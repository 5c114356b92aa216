// SPDX-License-Identifier: BSD-3-Clause
// Forces and tangent of one cell, summed over its Gauss points, in total Lagrangian form: the linear cell is the derivative of
// the one with large displacements at rest, by the same lines.
#pragma once

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "elements/materials/neo_hookean.hpp"
#include "elements/structural/cell_shapes.hpp"

namespace engrane::elements::structural {

/// Cells of four and eight nodes have displacement modes of their own, 1 − ξ², 1 − η² and, of a solid, 1 − ζ², each along all
/// directions.
constexpr int internal_modes(CellShape shape) {
  return shape == CellShape::quadrilateral ? 2 : shape == CellShape::hexahedron ? 3 : 0;
}

/// `Axi`: round the y axis, where x is the radius. Nodes and internal modes stand side by side as columns.
template <CellShape S, bool Axi>
class CellKernel {
 public:
  using Traits = CellTraits<S>;
  static constexpr int N = Traits::nodes, D = Traits::dimension;
  static constexpr int modes = internal_modes(S);
  static constexpr int columns = N + modes;
  static constexpr int shears = D == 3 ? 3 : 1;
  static constexpr int normals = D == 3 || Axi ? 3 : 2;
  static constexpr int strains = normals + shears;
  static constexpr int size = D * columns;
  /// Where the strains stand among xx, yy, zz, xy, yz, zx.
  static constexpr std::array<Eigen::Index, static_cast<std::size_t>(strains)> components = [] {
    std::array<Eigen::Index, static_cast<std::size_t>(strains)> at{};
    for (int i = 0; i < strains; ++i) at[static_cast<std::size_t>(i)] = i < normals ? i : 3 + i - normals;
    return at;
  }();

  using Places = Eigen::Matrix<double, D, N>;
  using Moves = Eigen::Matrix<double, D, columns>;  ///< displacements of the nodes, amplitudes of the modes
  using Forces = Eigen::Matrix<double, size, 1>;
  using Tangent = Eigen::Matrix<double, size, size>;
  using Strain = Eigen::Matrix<double, strains, 1>;
  using Stiffness = Eigen::Matrix<double, strains, strains>;
  using Square = Eigen::Matrix<double, D, D>;

  /// Geometry of a Gauss point in the reference configuration.
  struct Point {
    double volume = 0;  ///< that the point stands for
    Eigen::Matrix<double, D, columns> gradient;
    Eigen::Matrix<double, 1, columns> hoop;  ///< strain round the axis of each column's displacement along x; Axi only
  };
  static constexpr int most_points = S == CellShape::hexahedron20 ? 27 : D == 3 ? 9 : 4;

  /// Round an axis one point would leave the cell of three nodes a motion without strain.
  static const QuadratureRule& points() {
    return Axi && S == CellShape::triangle ? Traits::load_points() : Traits::stiffness_points();
  }
  using Samples = std::vector<typename Traits::Sample>;
  static const Samples& samples() {
    static const Samples all = tabulate<S>(points());
    return all;
  }
  /// Those where stresses are given.
  static const Samples& result_samples() {
    static const Samples all = tabulate<S>(Traits::result_points() ? *Traits::result_points() : points());
    return all;
  }

  /// `at` other than the points of the stiffness: only of cells without modes, whose mean is that over the cell.
  CellKernel(const Places& places, double thickness, std::span<const typename Traits::Sample> at = samples()) {
    for (const auto& s : at) {
      const Square jacobian = s.slope * places.transpose();  // rows: along ξ, η, ζ
      const Square inverse = jacobian.inverse();
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
        const QuadraturePoint& q = points()[static_cast<std::size_t>(count_)];
        const double place[3] = {q.xi, q.eta, q.zeta};
        for (int i = 0; i < modes; ++i) {
          p.gradient.col(N + i) = -2 * place[i] * inverse.col(i);
          if constexpr (Axi) p.hoop[N + i] = (1 - place[i] * place[i]) / radius;
        }
      }
      ++count_;
    }
    if constexpr (modes > 0) remove_mean();
  }

  int count() const { return count_; }
  const Point& point(int i) const { return points_[i]; }

  /// Deformation at a point: F and, round an axis, its entry of the circumference.
  struct Deformation {
    Square F = Square::Identity();
    double hoop = 1;
  };
  Deformation deformation(const Point& p, const Moves& moves) const {
    Deformation d;
    d.F += moves * p.gradient.transpose();
    if constexpr (Axi) d.hoop += moves.row(0).dot(p.hoop);
    return d;
  }

  /// Strain of Green and Lagrange, or its linear part.
  static Strain strain(const Deformation& d, bool linear) {
    const Square H = d.F - Square::Identity();
    Square E = (H + H.transpose()) / 2;
    if (!linear) E += H.transpose() * H / 2;
    Strain e;
    for (int i = 0; i < D; ++i) e[i] = E(i, i);
    for (int i = 0; i < shears; ++i) e[normals + i] = 2 * E(i, (i + 1) % D);
    if constexpr (Axi) {
      const double h = d.hoop - 1;
      e[2] = linear ? h : h + h * h / 2;
    }
    return e;
  }

  /// What the cell is made of: stresses are stiffness · (strain − free), with the strain that warmth alone gives at each point.
  struct Law {
    Stiffness stiffness;
    std::array<Strain, static_cast<std::size_t>(most_points)> free{};
    bool is_warm = false;
    bool linear = true;                                  ///< small displacements
    const materials::NeoHookean* neo_hookean = nullptr;  ///< instead
    materials::Hypothesis hypothesis = materials::Hypothesis::solid;
  };
  static Stiffness reduced(const materials::Moduli& full) { return full(components, components); }
  static Strain reduced(const materials::Voigt& full) { return full(components); }

  /// The stress at a point, its derivative by the strain, and the energy per volume.
  struct Response {
    Strain stress;
    Stiffness moduli;
    double energy;
  };
  static Response respond(const Law& law, int point, const Deformation& now) {
    Strain e = strain(now, law.linear);
    // strains do not tell a body from one turned inside out
    if (!law.linear && !is_right_way_round(now)) e.setConstant(std::numeric_limits<double>::quiet_NaN());
    if (law.neo_hookean) {
      materials::Voigt all = materials::Voigt::Zero();
      all(components) = e;
      const materials::Response found = materials::respond(*law.neo_hookean, law.hypothesis, all);
      return {reduced(found.stress), reduced(found.moduli), found.energy};
    }
    if (law.is_warm) e -= law.free[static_cast<std::size_t>(point)];
    const Strain stress = law.stiffness * e;
    return {stress, law.stiffness, e.dot(stress) / 2};
  }
  static bool is_right_way_round(const Deformation& now) { return now.F.determinant() > 0 && now.hoop > 0; }

  /// Resisting forces and, where wanted, their derivative, of nodes and modes for any amplitudes of the modes.
  void sum(const Law& law, const Moves& moves, Forces& r, Tangent* k) const {
    r.setZero();
    if (k) k->setZero();
    Eigen::Matrix<double, strains, size> b;
    for (int i = 0; i < count_; ++i) {
      const Point& p = points_[i];
      const Deformation now = deformation(p, moves);
      const Response response = respond(law, i, now);
      const Strain stress = p.volume * response.stress;
      const Deformation at = law.linear ? Deformation{} : now;
      for (int j = 0; j < columns; ++j)
        for (int a = 0; a < D; ++a) {
          const int column = D * j + a;
          for (int n = 0; n < D; ++n) b(n, column) = at.F(a, n) * p.gradient(n, j);
          for (int n = 0; n < shears; ++n) {
            const int m = (n + 1) % D;
            b(normals + n, column) = at.F(a, n) * p.gradient(m, j) + at.F(a, m) * p.gradient(n, j);
          }
          if constexpr (Axi) b(2, column) = a == 0 ? at.hoop * p.hoop[j] : 0;
        }
      r.noalias() += b.transpose() * stress;
      if (!k) continue;
      const Eigen::Matrix<double, strains, size> c = p.volume * response.moduli * b;
      // sums of a few strains: column by column, without what Eigen prepares for long ones
      const Eigen::Matrix<double, size, strains> turned = b.transpose();
      k->noalias() += turned.lazyProduct(c);
      if (!law.linear) add_geometric(p, stress, *k);
    }
  }

  /// What is left of forces and tangent once the modes carry no force.
  struct Condensed {
    Moves moves;  ///< with the amplitudes of the modes
    Eigen::Matrix<double, D * N, 1> forces;
    Eigen::Matrix<double, D * N, D * N> tangent;
  };

  /// Forces on the nodes for their displacements. The modes are found by Newton's iteration, which begins at zero, so that the
  /// forces are a function of the displacements alone; where it finds no balance the forces are not numbers.
  void condense(const Law& law, const Places& displacements, bool wants_tangent, Condensed& out) const {
    out.moves.template leftCols<N>() = displacements;
    Forces r;
    Tangent k;
    if constexpr (modes == 0) {
      sum(law, out.moves, r, wants_tangent ? &k : nullptr);
      out.forces = r;
      if (wants_tangent) out.tangent = k;
    } else {
      constexpr int nodal = D * N, own = D * modes, most = 25;
      // its square is rounding: the last correction is carried over to the forces to first order
      constexpr double small = 1e-9;
      out.moves.template rightCols<modes>().setZero();
      for (int iteration = 0; iteration < most; ++iteration) {
        sum(law, out.moves, r, &k);
        const Eigen::Matrix<double, own, nodal + 1> right =
            (Eigen::Matrix<double, own, nodal + 1>() << k.template bottomLeftCorner<own, nodal>(), r.template tail<own>())
                .finished();
        const Eigen::Matrix<double, own, nodal + 1> solved = k.template bottomRightCorner<own, own>().partialPivLu().solve(right);
        const Eigen::Matrix<double, own, 1> change = -solved.col(nodal);
        out.moves.template rightCols<modes>() += Eigen::Map<const Eigen::Matrix<double, D, modes>>(change.data());
        if (!law.linear && !(change.norm() * points_[0].gradient.template rightCols<modes>().norm() < small)) continue;
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
    Eigen::Matrix<double, D, modes> gradient = Eigen::Matrix<double, D, modes>::Zero();
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
    Square second;
    for (int i = 0; i < D; ++i) second(i, i) = stress[i];
    for (int i = 0; i < shears; ++i) second(i, (i + 1) % D) = second((i + 1) % D, i) = stress[normals + i];
    const Eigen::Matrix<double, columns, columns> g = p.gradient.transpose() * second * p.gradient;
    for (int j = 0; j < columns; ++j)
      for (int i = 0; i < columns; ++i) {
        for (int a = 0; a < D; ++a) k(D * i + a, D * j + a) += g(i, j);
        if constexpr (Axi) k(D * i, D * j) += stress[2] * p.hoop[i] * p.hoop[j];
      }
  }

  Point points_[most_points];
  int count_ = 0;
};

}  // namespace engrane::elements::structural
