// SPDX-License-Identifier: BSD-3-Clause
// Strain and stress at a point of a plane, axisymmetric or solid cell, independent of the shape of the cell.
#pragma once

#include <Eigen/LU>
#include <array>
#include <cstddef>
#include <limits>

#include "elements/materials/neo_hookean.hpp"

namespace engrane::elements::structural {

/// `Axi`: axisymmetric about the y axis, with x as the radius.
template <int D, bool Axi>
struct CellStrain {
  static constexpr int shears = D == 3 ? 3 : 1;
  static constexpr int normals = D == 3 || Axi ? 3 : 2;
  static constexpr int strains = normals + shears;
  /// Indices of the strains in xx, yy, zz, xy, yz, zx.
  static constexpr std::array<Eigen::Index, static_cast<std::size_t>(strains)> components = [] {
    std::array<Eigen::Index, static_cast<std::size_t>(strains)> at{};
    for (int i = 0; i < strains; ++i) at[static_cast<std::size_t>(i)] = i < normals ? i : 3 + i - normals;
    return at;
  }();

  using Strain = Eigen::Matrix<double, strains, 1>;
  using Stiffness = Eigen::Matrix<double, strains, strains>;
  using Square = Eigen::Matrix<double, D, D>;

  static Stiffness reduced(const materials::Moduli& full) { return full(components, components); }
  static Strain reduced(const materials::Voigt& full) { return full(components); }

  /// Deformation at a point: the gradient F and, in axisymmetry, the circumferential stretch. Both also less what they are
  /// without displacements, as small strains would be rounding in them.
  struct Deformation {
    Square F = Square::Identity();
    double hoop = 1;
    Square H = Square::Zero();  ///< F − 1
    double hoop_strain = 0;     ///< hoop − 1

    bool is_right_way_round() const { return F.determinant() > 0 && hoop > 0; }
  };

  /// Green–Lagrange strain, or its linear part.
  static Strain strain(const Deformation& d, bool linear) {
    Square E = (d.H + d.H.transpose()) / 2;
    if (!linear) E += d.H.transpose() * d.H / 2;
    Strain e;
    for (int i = 0; i < D; ++i) e[i] = E(i, i);
    for (int i = 0; i < shears; ++i) e[normals + i] = 2 * E(i, (i + 1) % D);
    if constexpr (Axi) {
      const double h = d.hoop_strain;
      e[2] = linear ? h : h + h * h / 2;
    }
    return e;
  }

  /// Rate of the Green–Lagrange strain at `d`; `rate` holds Ḟ and the rate of `hoop`. At Deformation{} that of its linear part.
  static Strain strain_rate(const Deformation& d, const Deformation& rate) {
    const Square half = d.F.transpose() * rate.F;
    Strain e;
    for (int i = 0; i < D; ++i) e[i] = half(i, i);
    for (int i = 0; i < shears; ++i) e[normals + i] = half(i, (i + 1) % D) + half((i + 1) % D, i);
    if constexpr (Axi) e[2] = d.hoop * rate.hoop;
    return e;
  }

  /// Material law: stress = stiffness · (strain − free thermal strain). The stiffness may differ from point to point.
  struct Law {
    bool linear = true;                                  ///< small displacements
    const materials::NeoHookean* neo_hookean = nullptr;  ///< if not nullptr, replaces the stiffness
    materials::Hypothesis hypothesis = materials::Hypothesis::solid;
  };

  /// Free thermal expansion at a point.
  struct Expansion {
    Strain strain = Strain::Zero();  ///< linear materials
    double growth = 0;               ///< neo-Hookean materials: the stretch in all directions, minus 1
  };

  /// Second Piola–Kirchhoff stress, its derivative by the strain and the strain energy per unit reference volume.
  struct Response {
    Strain stress;
    Stiffness moduli;
    double energy;
    double by_growth = 0;  ///< derivative of the energy by Expansion::growth
  };
  /// `free`: nullptr for no expansion. With large displacements the response is NaN where the cell is inverted.
  static Response respond(const Law& law, const Stiffness& stiffness, const Expansion* free, const Deformation& now) {
    Strain e = strain(now, law.linear);
    // the Green–Lagrange strain cannot detect inversion
    if (!law.linear && !now.is_right_way_round()) e.setConstant(std::numeric_limits<double>::quiet_NaN());
    if (law.neo_hookean) {
      materials::Voigt all = materials::Voigt::Zero();
      all(components) = e;
      const materials::Response found = materials::respond(*law.neo_hookean, law.hypothesis, all, free ? free->growth : 0);
      return {reduced(found.stress), reduced(found.moduli), found.energy, found.by_growth};
    }
    if (free) e -= free->strain;
    const Strain stress = stiffness * e;
    return {stress, stiffness, e.dot(stress) / 2};
  }
};

}  // namespace engrane::elements::structural
