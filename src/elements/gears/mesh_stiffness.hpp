// SPDX-License-Identifier: BSD-3-Clause
// Tooth stiffness: the mean from the geometry, and its variation as teeth enter and leave contact.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "model/function.hpp"
#include "user/routine.hpp"

namespace engrane::elements::gears {

/// Step from 0 to 1 over |x| < width/2 by a quintic polynomial, with continuous value, slope and curvature.
Function::Jet smooth_step(double x, double width);

/// Σ a_n cos(n angle) + b_n sin(n angle) with the coefficients a₁ b₁ a₂ b₂ …
Function::Jet fourier_series(const std::vector<double>& coefficients, double angle);

/// Variation of the tooth stiffness over the mesh phase τ, 2π per tooth: a factor on k_m with mean 1.
struct MeshStiffness {
  enum class Kind {
    constant,
    fourier,  ///< 1 + Σ a_n cos nτ + b_n sin nτ
    table,    ///< a function of τ/2π with period 1
    user,     ///< a user routine of τ/2π and the deflection
    square    ///< number of pairs in contact, alternating between the integers below and above the contact ratio
  };
  Kind kind = Kind::constant;
  std::vector<double> coefficients;    ///< a₁ b₁ a₂ b₂ …
  const Function* function = nullptr;  ///< of the table
  std::shared_ptr<const user::Routine> routine;
  bool loaded = false;       ///< depends on the deflection
  double contact_ratio = 1;  ///< for the square wave
  double edge = 0.05;        ///< transition width of the square wave as a fraction of a pitch; C²
  double middle = 0.25;      ///< τ/2π at the middle of the square wave's plateau with one more pair

  bool varies() const { return kind != Kind::constant; }
  /// The factor and its derivatives with respect to τ.
  Function::Jet at(double phase) const;
  /// The factor of a user routine for teeth pressed in by `deflection`: its value, its first two derivatives with respect to τ,
  /// and its derivative with respect to the deflection.
  user::Results at(double phase, double deflection) const;

 private:
  Function::Jet square_wave(double cycle) const;
};

/// Input of ISO 6336-1 (method B) for a pair on parallel axles.
struct IsoMesh {
  std::array<int, 2> teeth{1, 1};
  std::array<bool, 2> ring{false, false};
  double helix = 0;                            ///< at the reference cylinder, radians
  double pressure_angle = 0;                   ///< normal, of the basic rack, radians
  std::array<double, 2> shift{};               ///< x; ignored for a ring
  std::array<double, 2> dedendum{1.25, 1.25};  ///< of the basic rack, over m_n
  /// α_wt and β_w at the working pitch circles; if not given, those of the reference circles are used.
  std::optional<double> working_pressure_angle, working_helix;
  double contact_ratio = 1;   ///< transverse, ε_α
  double width = 0;           ///< face width
  std::array<double, 2> E{};  ///< Young's moduli
};

/// Tooth stiffness by ISO 6336-1: force per face width and deflection along the transverse line of action.
struct IsoStiffness {
  double single = 0;  ///< c′, of a single pair of teeth
  double mesh = 0;    ///< c_γ, mean over the mesh
};

/// ISO 6336-1 (2006), 9.3, method B: q′ = C₁ + C₂/z_n1 + C₃/z_n2 + C₄ x₁ + C₅ x₁/z_n1 + C₆ x₂ + C₇ x₂/z_n2 + C₈ x₁² + C₉ x₂²
/// (mm µm/N), C = 0.04723, 0.15551, 0.25791, −0.00635, −0.11654, −0.00193, −0.24188, 0.00529, 0.00182; z_n = z/cos³β, and a
/// ring counts as a rack, z_n = ∞ with x = 0. c′ = 0.8 C_B cosβ/q′ with C_B = (1 + 0.5 (1.2 − h_fP)) (1 − 0.02 (20° − α_n)),
/// using the mean h_fP if the dedendums of the wheels differ; c_γ = c′ (0.75 ε_α + 0.25). The standard is for steel, E = 206
/// 000 N/mm²; other materials scale the result by 2 E₁E₂/((E₁ + E₂) 206 000), so that E carries the units.
IsoStiffness iso_stiffness(const IsoMesh& mesh);

/// Mean mesh stiffness along the circumference, k_m. c_γ refers to the transverse line of action: k_m = c_γ b
/// (cosα_wt/cosβ_w)².
double iso_mesh_stiffness(const IsoMesh& mesh);

}  // namespace engrane::elements::gears
