// SPDX-License-Identifier: BSD-3-Clause
// Damping of one cell after Kelvin and Voigt: stresses in proportion to the rates of strain (docs/elements/structural/cell.md).
#pragma once

#include <algorithm>
#include <utility>

#include "elements/structural/cell_kernel.hpp"
#include "model/element.hpp"

namespace engrane::elements::structural {

/// Forces of the second Piola–Kirchhoff stresses V Ė of a cell, with moduli V that do not change with time. The internal modes
/// have rates of their own. These make the power smallest, so that the stresses do no work on them: with small displacements and
/// V = τ D the forces are τ times the stiffness, with its modes condensed, times the velocities.
template <CellShape S, bool Axi>
class CellDamping {
  using Kernel = CellKernel<S, Axi>;
  using Point = typename Kernel::Point;
  using Deformation = typename Kernel::Deformation;
  using Places = typename Kernel::Places;
  using Moves = typename Kernel::Moves;
  using Square = typename Kernel::Tangent;
  using Strain = typename Kernel::Strain;
  static constexpr int size = Kernel::size, nodal = Kernel::nodal, own = Kernel::own, strains = Kernel::strains;

 public:
  /// `moves`: displacements and amplitudes. The kernel and the moves must outlive this.
  CellDamping(const Kernel& kernel, typename Kernel::PointModuli moduli, bool linear, const Moves& moves,
              const Places& velocities)
      : kernel_(kernel), moduli_(std::move(moduli)), linear_(linear), moves_(moves) {
    std::copy_n(velocities.data(), nodal, rates_.data());
    if constexpr (own > 0) {
      std::fill_n(rates_.data() + nodal, own, 0);
      const Moves forces = resistance();
      Square viscous;
      add_viscous(nodal, viscous);
      double square[own * own], rates[own];
      take_modes(viscous, square);
      std::copy_n(forces.data() + nodal, own, rates);
      solve_in_place({square, own, own}, {rates, own, 1});
      for (int m = 0; m < own; ++m) rates_.data()[nodal + m] = -rates[m];
    }
  }

  /// Velocities of the nodes and rates of the modes.
  const Moves& rates() const { return rates_; }

  /// Power that is dissipated.
  double power() const {
    double sum = 0;
    for (int i = 0; i < kernel_.count(); ++i) sum += kernel_.point(i).volume * rate(i).dot(moduli_.at(i) * rate(i));
    return sum;
  }

  /// Adds the forces of the nodes.
  void add_forces(double* r) const {
    const Moves forces = resistance();
    for (int j = 0; j < nodal; ++j) r[j] += forces.data()[j];
  }

  /// Adds the derivatives of the forces by displacements and velocities to the row-major `k`. `slopes`: minus the derivatives of
  /// the amplitudes by the displacements, own × nodal, column-major.
  void add_tangent(const Weights& weights, const double* slopes, double* k) const {
    Square viscous, sum{};  // of all columns, by displacements
    add_viscous(0, viscous);
    if (!linear_ && weights.q != 0) add_by_place(sum);
    for (int j = 0; j < nodal; ++j) {
      double* to = sum.data() + size * j;
      for (int i = 0; i < size; ++i) {
        double by_place = to[i];
        for (int m = 0; m < own; ++m) by_place -= sum[at(i, nodal + m)] * slopes[own * j + m];
        to[i] = weights.q * by_place + weights.v * viscous[i <= j ? at(i, j) : at(j, i)];
      }
    }
    if constexpr (own > 0) {
      double square[own * own], solved[own * nodal];
      take_modes(viscous, square);
      for (int j = 0; j < nodal; ++j) std::copy_n(sum.data() + size * j + nodal, own, solved + own * j);
      solve_in_place({square, own, own}, {solved, own, nodal});
      for (int j = 0; j < nodal; ++j)
        for (int m = 0; m < own; ++m)
          for (int i = 0; i < nodal; ++i) sum[at(i, j)] -= viscous[at(i, nodal + m)] * solved[own * j + m];
    }
    for (int i = 0; i < nodal; ++i)
      for (int j = 0; j < nodal; ++j) k[nodal * i + j] += sum[at(i, j)];
  }

 private:
  static constexpr std::size_t at(int row, int column) { return static_cast<std::size_t>(size * column + row); }

  Deformation deformation(int i) const { return linear_ ? Deformation{} : kernel_.deformation(kernel_.point(i), moves_); }

  Strain rate(int i) const { return Kernel::strain_rate(deformation(i), kernel_.rate(kernel_.point(i), rates_)); }

  /// Forces of nodes and modes.
  Moves resistance() const {
    Moves forces = zero<Moves>();
    double b[strains][size];
    for (int i = 0; i < kernel_.count(); ++i) {
      const Strain load = kernel_.point(i).volume * (moduli_.at(i) * rate(i));
      Kernel::strain_by(kernel_.point(i), deformation(i), b);
      for (int n = 0; n < strains; ++n)
        for (int j = 0; j < size; ++j) forces.data()[j] += b[n][j] * load[n];
    }
    return forces;
  }

  /// Sets the derivatives by the rates, the upper triangle in the columns from `first` on.
  void add_viscous(int first, Square& viscous) const {
    std::fill(viscous.begin() + size * first, viscous.end(), 0);
    double b[strains][size];
    for (int i = 0; i < kernel_.count(); ++i) {
      Kernel::strain_by(kernel_.point(i), deformation(i), b);
      Kernel::add_material(b, kernel_.point(i).volume * moduli_.at(i), first, viscous);
    }
  }

  /// Adds the derivatives by displacements and amplitudes at given rates.
  void add_by_place(Square& sum) const {
    Square geometric{};  // upper triangle
    double b[strains][size], turned[strains][size];
    for (int i = 0; i < kernel_.count(); ++i) {
      const Point& p = kernel_.point(i);
      Kernel::strain_by(p, deformation(i), b);
      Kernel::strain_by(p, kernel_.rate(p, rates_), turned);
      const typename Kernel::Stiffness moduli = p.volume * moduli_.at(i);
      Kernel::add_geometric(p, moduli * rate(i), 0, geometric);
      for (int j = 0; j < size; ++j) {
        Strain c = Strain::Zero();
        for (int n = 0; n < strains; ++n)
          for (int m = 0; m < strains; ++m) c[n] += moduli(n, m) * turned[m][j];
        for (int n = 0; n < strains; ++n)
          for (int row = 0; row < size; ++row) sum[at(row, j)] += b[n][row] * c[n];
      }
    }
    for (int j = 0; j < size; ++j)
      for (int row = 0; row < size; ++row) sum[at(row, j)] += geometric[row <= j ? at(row, j) : at(j, row)];
  }

  /// The block of the modes.
  static void take_modes(const Square& viscous, double* square) {
    for (int m = 0; m < own; ++m)
      for (int n = 0; n <= m; ++n) square[own * m + n] = square[own * n + m] = viscous[at(nodal + n, nodal + m)];
  }

  const Kernel& kernel_;
  typename Kernel::PointModuli moduli_;
  bool linear_;
  const Moves& moves_;
  Moves rates_;
};

}  // namespace engrane::elements::structural
