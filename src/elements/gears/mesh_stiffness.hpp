// SPDX-License-Identifier: BSD-3-Clause
// How stiff teeth are: the mean stiffness from their geometry, and its course while teeth come into contact and leave it.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "model/function.hpp"
#include "user/routine.hpp"

namespace engrane::elements::gears {

/// From 0 to 1 over |x| < width/2 by the polynomial of degree five: value, slope and curvature are continuous.
Function::Jet smooth_step(double x, double width);

/// Σ a_n cos(n angle) + b_n sin(n angle) of the coefficients a₁ b₁ a₂ b₂ …
Function::Jet fourier_series(const std::vector<double>& coefficients, double angle);

/// Course of the tooth stiffness over the mesh phase τ, 2π for each tooth that passes: a factor on k_m with mean 1.
struct MeshStiffness {
  enum class Kind {
    constant,
    fourier,  ///< 1 + Σ a_n cos nτ + b_n sin nτ
    table,    ///< a function of τ/2π that repeats with 1
    user,     ///< a routine of τ/2π and of the deflection
    square    ///< as many pairs as the contact ratio says, alternating between its two neighbours in whole numbers
  };
  Kind kind = Kind::constant;
  std::vector<double> coefficients;    ///< a₁ b₁ a₂ b₂ …
  const Function* function = nullptr;  ///< of the table
  std::shared_ptr<const user::Routine> routine;
  bool loaded = false;       ///< it depends on the deflection
  double contact_ratio = 1;  ///< of the square wave
  double edge = 0.05;        ///< over this part of a tooth pitch the square wave changes, C²
  double middle = 0.25;      ///< τ/2π of the middle of the square wave's plateau with one pair more

  bool varies() const { return kind != Kind::constant; }
  /// The factor and its derivatives with respect to τ.
  Function::Jet at(double phase) const;
  /// Those of a routine where the teeth are pressed in by `deflection`: the factor, its first two derivatives by τ, and that by
  /// the deflection.
  user::Results at(double phase, double deflection) const;

 private:
  Function::Jet square_wave(double cycle) const;
};

/// What ISO 6336-1 (method B) needs of a pair with parallel axles.
struct IsoMesh {
  std::array<int, 2> teeth{1, 1};
  std::array<bool, 2> ring{false, false};
  double helix = 0;                            ///< at the reference cylinder, radians
  double pressure_angle = 0;                   ///< normal, of the basic rack, radians
  std::array<double, 2> shift{};               ///< x; a ring's is not looked at
  std::array<double, 2> dedendum{1.25, 1.25};  ///< of the basic rack, over m_n
  /// Along the circumference of the working pitch circles: α_wt and β_w, those of the reference circles when not given.
  std::optional<double> working_pressure_angle, working_helix;
  double contact_ratio = 1;   ///< transverse, ε_α
  double width = 0;           ///< face width
  std::array<double, 2> E{};  ///< Young's moduli
};

/// Stiffness of teeth by ISO 6336-1, force per face width and deflection along the transverse line of action.
struct IsoStiffness {
  double single = 0;  ///< c′, of one pair of teeth
  double mesh = 0;    ///< c_γ, mean of the mesh
};

/// ISO 6336-1 (2006), 9.3, method B: q′ = C₁ + C₂/z_n1 + C₃/z_n2 + C₄ x₁ + C₅ x₁/z_n1 + C₆ x₂ + C₇ x₂/z_n2 + C₈ x₁² + C₉ x₂²
/// (mm µm/N), C = 0.04723, 0.15551, 0.25791, −0.00635, −0.11654, −0.00193, −0.24188, 0.00529, 0.00182; z_n = z/cos³β, and a ring
/// counts as a rack, z_n = ∞ with x = 0. c′ = 0.8 C_B cosβ/q′ with
/// C_B = (1 + 0.5 (1.2 − h_fP)) (1 − 0.02 (20° − α_n)), the mean of both wheels where their dedendums differ;
/// c_γ = c′ (0.75 ε_α + 0.25). The norm is written for steel, E = 206 000 N/mm²; other wheels scale it by
/// 2 E₁E₂/((E₁ + E₂) 206 000), so that E carries the units.
IsoStiffness iso_stiffness(const IsoMesh& mesh);

/// Mean stiffness of the mesh along the circumference, k_m. c_γ counts along the transverse line of action:
/// k_m = c_γ b (cosα_wt/cosβ_w)².
double iso_mesh_stiffness(const IsoMesh& mesh);

}  // namespace engrane::elements::gears
