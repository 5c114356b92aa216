// SPDX-License-Identifier: BSD-3-Clause
// Forces and tangent of one cell by Gauss quadrature, total Lagrangian. The same code serves small displacements, as the
// linearisation at rest.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "elements/structural/cell_shapes.hpp"
#include "elements/structural/cell_strain.hpp"
#include "elements/structural/columns.hpp"

namespace engrane::elements::structural {

/// Number of incompatible modes per direction. Four-node quadrilaterals have 1 − ξ² and 1 − η², eight-node hexahedra also
/// 1 − ζ², each in all directions; other shapes have none.
constexpr int internal_modes(CellShape shape) {
  return shape == CellShape::quadrilateral ? 2 : shape == CellShape::hexahedron ? 3 : 0;
}

/// Solves a x = b. Overwrites b with x, and a with its factors.
void solve_in_place(Eigen::Map<Eigen::MatrixXd> a, Eigen::Map<Eigen::MatrixXd> b);

/// `Axi`: axisymmetric about the y axis, with x as the radius. Matrices have one column per node, then one per internal mode.
template <CellShape S, bool Axi>
class CellKernel : public CellStrain<CellTraits<S>::dimension, Axi> {
 public:
  using Traits = CellTraits<S>;
  static constexpr int N = Traits::nodes, D = Traits::dimension;
  static constexpr int modes = internal_modes(S);
  static constexpr int columns = N + modes;
  static constexpr int size = D * columns, nodal = D * N, own = D * modes;  ///< unknowns: all, of the nodes, of the modes

  using Local = CellStrain<D, Axi>;
  using Local::normals, Local::shears, Local::strains;
  using typename Local::Deformation, typename Local::Expansion, typename Local::Square, typename Local::Stiffness,
      typename Local::Strain;

  using Places = Eigen::Matrix<double, D, N>;
  using Moves = Eigen::Matrix<double, D, columns>;  ///< displacements of the nodes, then amplitudes of the modes
  using Forces = Moves;
  /// Square matrix in column-major order.
  using Tangent = std::array<double, static_cast<std::size_t>(size* size)>;
  using NodalTangent = std::array<double, static_cast<std::size_t>(nodal* nodal)>;

  /// Geometry of a Gauss point in the reference configuration.
  struct Point {
    double volume = 0;  ///< including the quadrature weight
    Eigen::Matrix<double, D, columns> gradient;
    std::array<double, static_cast<std::size_t>(columns)> hoop;  ///< hoop strain for unit radial displacement of each column
  };
  static constexpr int most_points = S == CellShape::hexahedron20 ? 27 : D == 3 ? 9 : 4;

  /// With one point, the axisymmetric three-node cell would have a zero-energy mode.
  static const QuadratureRule& points() {
    return Axi && S == CellShape::triangle ? Traits::load_points() : Traits::stiffness_points();
  }
  using Samples = std::vector<typename Traits::Sample>;
  static const Samples& samples() {
    static const Samples all = tabulate<S>(points());
    return all;
  }
  /// Samples at the points where stresses are reported.
  static const Samples& result_samples() {
    static const Samples all = tabulate<S>(Traits::result_points() ? *Traits::result_points() : points());
    return all;
  }

  /// `at` may differ from the stiffness points only for cells without modes: the mean of the modes is removed over these
  /// points.
  CellKernel(const Places& places, double thickness, std::span<const typename Traits::Sample> at = samples()) {
    for (const auto& s : at) {
      const Square jacobian = dyads(s.slope, places);  // rows: derivatives by ξ, η, ζ
      const Square inverse = jacobian.inverse();
      Point& p = points_[count_];
      for (int n = 0; n < N; ++n) column(p.gradient, n) = inverse * column(s.slope, n);
      p.volume = s.weight * std::abs(jacobian.determinant()) * thickness;
      double radius = 0;
      if constexpr (Axi) {
        for (int n = 0; n < N; ++n) radius += places(0, n) * s.value[n];
        p.volume *= 2 * std::numbers::pi * radius;
        for (int n = 0; n < N; ++n) p.hoop[static_cast<std::size_t>(n)] = s.value[n] / radius;
      }
      if constexpr (modes > 0) {
        const QuadraturePoint& q = points()[static_cast<std::size_t>(count_)];
        const double place[3] = {q.xi, q.eta, q.zeta};
        for (int i = 0; i < modes; ++i) {
          column(p.gradient, N + i) = -2 * place[i] * inverse.col(i);
          if constexpr (Axi) p.hoop[static_cast<std::size_t>(N + i)] = (1 - place[i] * place[i]) / radius;
        }
      }
      ++count_;
    }
    if constexpr (modes > 0) remove_mean();
  }

  int count() const { return count_; }
  const Point& point(int i) const { return points_[i]; }

  Deformation deformation(const Point& p, const Moves& moves) const {
    Deformation d;
    add_moves(p, moves, d);
    return d;
  }
  /// Rate of the deformation for velocities of the nodes and rates of the modes.
  Deformation rate(const Point& p, const Moves& rates) const {
    Deformation d{Square::Zero(), 0};
    add_moves(p, rates, d);
    return d;
  }

  /// Moduli at the points.
  struct PointModuli {
    Stiffness alike;
    std::vector<Stiffness> each;  ///< empty: `alike` at all points

    const Stiffness& at(int point) const { return each.empty() ? alike : each[static_cast<std::size_t>(point)]; }
  };

  /// The law with the moduli and the thermal expansion at each point.
  struct Law : Local::Law {
    PointModuli moduli;
    bool is_warm = false;
    std::array<Expansion, static_cast<std::size_t>(most_points)> free{};

    const Expansion* free_at(int point) const { return is_warm ? &free[static_cast<std::size_t>(point)] : nullptr; }
  };

  static typename Local::Response respond(const Law& law, int point, const Deformation& now) {
    return Local::respond(law, law.moduli.at(point), law.free_at(point), now);
  }

  /// Internal forces of nodes and modes for given displacements and amplitudes and, unless `k` is nullptr, their tangent. Of
  /// the symmetric tangent only the upper triangle is computed, in the columns from `first` on.
  void sum(const Law& law, const Moves& moves, Forces& r, Tangent* k, int first = 0) const {
    std::fill_n(r.data(), size, 0);
    if (k) std::fill(k->begin() + size * first, k->end(), 0);
    double b[strains][size];
    for (int i = 0; i < count_; ++i) {
      const Point& p = points_[i];
      const Deformation now = deformation(p, moves);
      const auto response = respond(law, i, now);
      const Strain stress = p.volume * response.stress;
      strain_by(p, law.linear ? Deformation{} : now, b);
      for (int n = 0; n < strains; ++n)
        for (int j = 0; j < size; ++j) r.data()[j] += b[n][j] * stress[n];
      if (!k) continue;
      add_material(b, p.volume * response.moduli, first, *k);
      if (!law.linear) add_geometric(p, stress, first, *k);
    }
  }

  /// Derivatives of the strain by displacements and amplitudes. With a rate() in place of the deformation, those of its rate.
  static void strain_by(const Point& p, const Deformation& at, double (&b)[strains][size]) {
    for (int j = 0; j < columns; ++j)
      for (int a = 0; a < D; ++a) {
        const int slot = D * j + a;
        for (int n = 0; n < D; ++n) b[n][slot] = at.F(a, n) * p.gradient(n, j);
        for (int n = 0; n < shears; ++n) {
          const int m = (n + 1) % D;
          b[normals + n][slot] = at.F(a, n) * p.gradient(m, j) + at.F(a, m) * p.gradient(n, j);
        }
        if constexpr (Axi) b[2][slot] = a == 0 ? at.hoop * p.hoop[static_cast<std::size_t>(j)] : 0;
      }
  }

  /// Result of static condensation of the modes.
  struct Condensed {
    Moves moves;  ///< with the amplitudes of the modes
    Places forces;
    NodalTangent tangent;  ///< upper triangle
    /// With a tangent: minus the derivatives of the amplitudes by the displacements, own × nodal, column-major.
    std::array<double, static_cast<std::size_t>(own* nodal)> slopes;
  };

  /// Condenses the modes: nodal forces for given nodal displacements. The amplitudes of the modes are found by Newton's
  /// iteration from zero, so that the forces depend on the displacements alone. If it does not converge, the forces are NaN.
  void condense(const Law& law, const Places& displacements, bool wants_tangent, Condensed& out) const {
    std::copy_n(displacements.data(), nodal, out.moves.data());
    if constexpr (modes == 0) {
      sum(law, out.moves, out.forces, wants_tangent ? &out.tangent : nullptr);
    } else {
      constexpr int most = 25;
      // its square is at rounding level: the last correction is applied to the forces to first order
      constexpr double small = 1e-9;
      const double slope = Eigen::Map<const Eigen::VectorXd>(points_[0].gradient.data() + nodal, own).norm();
      std::fill_n(out.moves.data() + nodal, own, 0);
      Forces r;
      Tangent k;
      double square[own * own], solved[own * (nodal + 1)];  // last column: forces of the modes
      double strain = 1;                                    // strain due to the last correction
      for (int iteration = 0; iteration < most; ++iteration) {
        // quadratic convergence predicts the last iteration; only there is the nodal part of the tangent needed
        const bool whole = wants_tangent && (law.linear || strain * strain < small);
        sum(law, out.moves, r, &k, whole ? 0 : nodal);
        for (int m = 0; m < own; ++m) {
          const double* above = k.data() + size * (nodal + m);
          for (int j = 0; whole && j < nodal; ++j) solved[own * j + m] = above[j];
          for (int n = 0; n <= m; ++n) square[own * m + n] = square[own * n + m] = above[nodal + n];
          solved[own * nodal + m] = r.data()[nodal + m];
        }
        double* back = solved + own * nodal;  // minus the correction of the modes
        if (whole)
          solve_in_place({square, own, own}, {solved, own, nodal + 1});
        else
          solve_in_place({square, own, own}, {back, own, 1});
        for (int m = 0; m < own; ++m) out.moves.data()[nodal + m] -= back[m];
        strain = Eigen::Map<const Eigen::VectorXd>(back, own).norm() * slope;
        if (!law.linear && !(strain < small)) continue;
        if (wants_tangent && !whole) continue;
        std::copy_n(r.data(), nodal, out.forces.data());
        for (int m = 0; m < own; ++m)
          for (int i = 0; i < nodal; ++i) out.forces.data()[i] -= k.data()[size * (nodal + m) + i] * back[m];
        if (wants_tangent) {
          take_tangent(k, solved, out.tangent);
          std::copy_n(solved, own * nodal, out.slopes.begin());
        }
        return;
      }
      entries(out.forces).setConstant(std::numeric_limits<double>::quiet_NaN());
      out.tangent.fill(std::numeric_limits<double>::quiet_NaN());
    }
  }

  /// Adds the upper triangle of bᵀ · moduli · b from column `first` on. Inner loops run along rows of `b` for vectorisation.
  static void add_material(const double (&b)[strains][size], const Stiffness& moduli, int first, Tangent& k) {
    double c[strains][size] = {};
    for (int n = 0; n < strains; ++n)
      for (int m = 0; m < strains; ++m)
        for (int j = first; j < size; ++j) c[n][j] += moduli(n, m) * b[m][j];
    for (int j = first; j < size; ++j) {
      double* to = k.data() + size * j;
      for (int i = 0; i <= j; ++i) {
        double entry = 0;
        for (int n = 0; n < strains; ++n) entry += b[n][i] * c[n][j];
        to[i] += entry;
      }
    }
  }

  /// Adds the geometric stiffness. `stress` includes the volume.
  static void add_geometric(const Point& p, const Strain& stress, int first, Tangent& k) {
    Square second;
    for (int i = 0; i < D; ++i) second(i, i) = stress[i];
    for (int i = 0; i < shears; ++i) second(i, (i + 1) % D) = second((i + 1) % D, i) = stress[normals + i];
    for (int j = first / D; j < columns; ++j) {
      const Eigen::Matrix<double, D, 1> across = second * column(p.gradient, j);
      for (int i = 0; i <= j; ++i) {
        const double g = across.dot(column(p.gradient, i));
        double* to = k.data() + size * D * j + D * i;
        for (int a = 0; a < D; ++a) to[(size + 1) * a] += g;
        if constexpr (Axi) to[0] += stress[2] * p.hoop[static_cast<std::size_t>(i)] * p.hoop[static_cast<std::size_t>(j)];
      }
    }
  }

 private:
  /// Schur complement of the modes. `solved`: the inverse of the modes' tangent times the coupling of modes and nodes.
  static void take_tangent(const Tangent& k, const double* solved, NodalTangent& out) {
    for (int j = 0; j < nodal; ++j) {
      double* to = out.data() + nodal * j;
      std::copy_n(k.data() + size * j, j + 1, to);
      for (int m = 0; m < own; ++m) {
        const double* above = k.data() + size * (nodal + m);
        for (int i = 0; i <= j; ++i) to[i] -= above[i] * solved[own * j + m];
      }
    }
  }

  /// Removes the mean of the modes' gradients, so that a constant stress does no work on them for any shape of the cell (patch
  /// test; Ibrahimbegović and Wilson 1991, Commun. Appl. Numer. Methods 7).
  void remove_mean() {
    for (int m = N; m < columns; ++m) {
      double volume = 0, hoop = 0;
      Eigen::Matrix<double, D, 1> gradient = Eigen::Matrix<double, D, 1>::Zero();
      for (int i = 0; i < count_; ++i) {
        volume += points_[i].volume;
        gradient += points_[i].volume * column(points_[i].gradient, m);
        if constexpr (Axi) hoop += points_[i].volume * points_[i].hoop[static_cast<std::size_t>(m)];
      }
      for (int i = 0; i < count_; ++i) {
        column(points_[i].gradient, m) -= gradient / volume;
        if constexpr (Axi) points_[i].hoop[static_cast<std::size_t>(m)] -= hoop / volume;
      }
    }
  }

  void add_moves(const Point& p, const Moves& moves, Deformation& d) const {
    d.H = dyads(moves, p.gradient);
    d.F += d.H;
    if constexpr (Axi) {
      for (int n = 0; n < columns; ++n) d.hoop_strain += moves(0, n) * p.hoop[static_cast<std::size_t>(n)];
      d.hoop += d.hoop_strain;
    }
  }

  Point points_[most_points];
  int count_ = 0;
};

}  // namespace engrane::elements::structural
