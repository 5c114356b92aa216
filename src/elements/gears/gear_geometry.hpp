// SPDX-License-Identifier: BSD-3-Clause
// Pitch geometry of a gear pair after A. Cardona, "Modelado tridimensional de engranajes flexibles" (1995).
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "elements/gears/profile_shift.hpp"
#include "math/vector.hpp"

namespace engrane::elements::gears {

/// Relative difference up to which numbers typed by the user count as equal.
inline constexpr double typing_tolerance = 1e-6;
/// Indices of wheels A and B.
inline constexpr std::array<std::size_t, 2> both_wheels{0, 1};

/// Data that define the pitch surfaces and teeth of a pair, in the paper's conventions (figures 1 and 2). Entry 0 is wheel A,
/// entry 1 wheel B. Angles in radians. With profile shift these are the *working* pitch surfaces, which roll on each other:
/// module, pressure angle and helix are the values there, and `cut` holds the data of the cut teeth.
struct GearDesign {
  std::array<int, 2> teeth{1, 1};
  double normal_module = 1;
  double pressure_angle = 0;      ///< α_n, in the plane normal to the tooth
  std::array<double, 2> cone{};   ///< γ: 0 an external cylinder, π a ring gear
  std::array<double, 2> helix{};  ///< β of the paper, see paper_helix()
  std::optional<CutTeeth> cut;    ///< if the card describes the cut; otherwise addendum m_n and no profile shift

  /// m_n of the tool, which is the module of the pitch surface without profile shift.
  double cut_module() const { return cut ? cut->normal_module : normal_module; }
  /// Helix at the reference cylinder, β of the paper.
  double cut_helix(std::size_t wheel) const { return cut ? cut->helix[wheel] : helix[wheel]; }
  /// r cosβ = z m_n/2: the lever of the tooth force, which converts ψ into motion along the tooth normal (21).
  double lever(std::size_t wheel) const { return 0.5 * teeth[wheel] * normal_module; }
  /// Pitch radius r, from 2 r cosβ = z m_n.
  double radius(std::size_t wheel) const;
  /// Normal module divided by cosβ: the module in the plane of rotation.
  double transverse_module(std::size_t wheel) const;
  /// tanα_t = tanα_n/cosβ
  double transverse_pressure_angle(std::size_t wheel) const;
  /// Kind of a pair on parallel axles: +1 external, −1 B is a ring gear, −2 A is a ring gear; 0 if the axles are not parallel.
  int parallel_kind() const;
};

/// Converts a helix angle from the usual sign, positive for right hand, to the paper's sign; the same function converts it
/// back. By (7) the tooth of a cylinder points along cosβ μ₁ − sinβ μ₃, a left-hand screw for β > 0, so β = −angle. The teeth
/// of a wheel with cosγ < 0 are seen from the inside and keep the sign: β = angle. Parallel axles, for which β_A + β_B = 0,
/// therefore need opposite hands in an external pair and equal hands in an internal one.
double paper_helix(double trade, double cone);

/// Y(γ, β) of (7) for wheel A: columns are the tooth triad η in the components of the wheel's triad.
Mat3 tooth_axes(double cone, double helix);
/// Y_B = Y(γ, β) diag(1, −1, −1), (8). The product is included in Y_B, so that (9) and (26) hold as printed.
Mat3 mating_tooth_axes(double cone, double helix);
/// Z = Y_A Y_Bᵀ of (9): columns are the triad ξ″ of B in the components of μ″. It depends on β_A + β_B only.
Mat3 wheel_to_wheel(const GearDesign& design);

/// The triads and the contact point of a pair in its reference configuration.
struct PitchFrames {
  Mat3 mu;       ///< columns μ₁ (along the axle of A), μ₂ (towards the contact point), μ₃
  Mat3 xi;       ///< the same of wheel B
  Vec3 contact;  ///< the pitch point
};

/// Deviation of the wheel centres from the positions required by the pitch surfaces.
struct Closure {
  double offset_given = 0, offset_needed = 0;  ///< of B from the plane of A, along the axle of A: x_AB·μ₁ = −r_B Z₁₂
  double distance_given = 0, distance_needed = 0;  ///< of B from the axle of A: √(a² + b²)
  double size = 1;                                 ///< length that makes the misfit relative: r_A + r_B

  /// Largest of the two misfits, relative to `size`.
  double misfit() const;
};

/// Evaluates the closure conditions that follow from (12) for the given centres. `axle` is the unit vector μ₁.
Closure closure(const GearDesign& design, const Vec3& x_a, const Vec3& x_b, const Vec3& axle);

/// Triads and contact point from (12)–(14) and (9), with a = r_A − Z₂₂ r_B, b = r_B Z₃₂, w = x_AB + r_B Z₁₂ μ₁: μ₂ = (a w + b
/// μ₁×w)/(a² + b²). The paper prints a² − b² and requires r_A ≥ r_B; in fact only a = b = 0 is impossible (an internal pair
/// with equal radii). Requires closure(); any remaining misfit becomes a distance between the contact points of A and B.
PitchFrames pitch_frames(const GearDesign& design, const Vec3& x_a, const Vec3& x_b, const Vec3& axle);

/// Position of the centre of B for a contact in the direction `toward`, a unit vector perpendicular to the axle of A: the
/// inverse of pitch_frames().
Vec3 centre_of_second_wheel(const GearDesign& design, const Vec3& x_a, const Vec3& axle, const Vec3& toward);

/// Cone angles of two wheels whose axles intersect at the angle `shaft`, from the numbers of teeth: tanγ = sinΣ/(z_other/z +
/// cosΣ), both positive.
std::array<double, 2> cones_of_shaft_angle(double shaft, const std::array<int, 2>& teeth);

/// Angle between the directions from the intersection of two axles to the wheels. Returns nothing if the axles are parallel,
/// skew, or intersect in one of the centres.
std::optional<double> shaft_angle_of_axles(const Vec3& x_a, const Vec3& axle_a, const Vec3& x_b, const Vec3& axle_b);

/// Tip radius: as cut, or with addendum m_n: r + m_n cosγ, that is r − m_n for a ring.
double tip_radius(const GearDesign& design, std::size_t wheel);

/// The pair with the working pitch surfaces that result from `cut`: m_nw = 2 r_w cosβ_w/z, tanβ_w = tanβ r_w/r, tanα_nw =
/// tanα_wt cosβ_w (ISO 21771, 5.3). Cones and numbers of teeth are those of `reference`.
GearDesign working_design(const GearDesign& reference, const CutTeeth& cut);

/// Length of the path of contact from the pitch point to the tip circle of a wheel (tip_radius(); for cones, with addendum m_n,
/// of the virtual cylindrical wheel r/cosγ at the middle of the face, Tredgold). Returns nothing if the tip of a ring lies
/// inside its base circle.
std::optional<double> virtual_path_of_contact(const GearDesign& design, std::size_t wheel);
/// The same, for parallel axles only.
std::optional<double> path_of_contact(const GearDesign& design, std::size_t wheel);
/// Transverse contact ratio of involute teeth; for intersecting axles that of the virtual cylindrical wheels r/cosγ at the
/// middle of the face (Tredgold). Returns nothing for skew axles, or if the tip of a ring lies inside its base circle.
std::optional<double> contact_ratio(const GearDesign& design);

}  // namespace engrane::elements::gears
