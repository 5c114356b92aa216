// SPDX-License-Identifier: BSD-3-Clause
// Cut cylindrical involute teeth with profile shift: DIN 3960 (1987) and ISO 21771 (2007).
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace engrane::elements::gears {

/// inv α = tanα − α
double involute(double angle);
/// The angle, radians, whose involute function is `value` ≥ 0.
double inverse_involute(double value);

/// Cutting data of the teeth of two cylindrical wheels on parallel axles. Entry 0 is wheel A, entry 1 wheel B. Lengths in the
/// units of the deck, angles in radians; factors are multiples of the normal module.
///
/// A ring's shift has the sign of ISO 21771: positive makes its teeth thicker and its tip circle smaller.
struct CutTeeth {
  std::array<int, 2> teeth{1, 1};              ///< z > 0; 0: a rack
  std::array<bool, 2> ring{false, false};      ///< internal teeth
  double normal_module = 1;                    ///< m_n of the basic rack
  double pressure_angle = 0;                   ///< α_n of the basic rack
  std::array<double, 2> helix{};               ///< β at the reference cylinder, the paper's sign
  std::array<double, 2> shift{};               ///< x
  std::array<double, 2> addendum{1, 1};        ///< h_aP of the basic rack
  std::array<double, 2> dedendum{1.25, 1.25};  ///< h_fP
  std::array<double, 2> tip{};                 ///< tip radii; set_tips() computes them from the rest
  double working_pressure_angle = 0;           ///< α_wt, transverse

  double transverse_module() const;
  /// α_t: tanα_t = tanα_n/cosβ
  double transverse_pressure_angle() const;
  /// d/2 = z m_t/2
  double reference_radius(std::size_t wheel) const;
  /// d_b/2 = d/2 cosα_t
  double base_radius(std::size_t wheel) const;
  /// d_w/2 = d_b/2 / cosα_wt; for a pinion on a rack the reference radius
  double working_radius(std::size_t wheel) const;
  /// d_f/2 = d/2 ∓ m_n (h_fP − x), upper sign for external teeth
  double root_radius(std::size_t wheel) const;
  /// a_d = |z_A ± z_B| m_t/2: centre distance without profile shift
  double reference_distance() const;
  /// a = a_d cosα_t/cosα_wt
  double distance() const;
  /// Tooth thickness at the reference circle, normal: s_n = m_n (π/2 + 2 x tanα_n)
  double thickness(std::size_t wheel) const;
  /// The same at any radius, along that circle: s = 2 r (s_t/d ± (inv α_t − inv α_r)), cosα_r = r_b/r
  double thickness_at(std::size_t wheel, double radius) const;
  /// Tooth thickness at the tip circle, normal.
  double tip_thickness(std::size_t wheel) const;
  /// Distance between the wheel's tip circle and the mate's root circle.
  double tip_clearance(std::size_t wheel) const;
  /// How far the tips reach past each other on the line of centres; not positive: the teeth do not reach each other. The tips of
  /// a rack are at h_aP − x from the plane that rolls on the pinion's reference circle.
  double tip_overlap() const;
  /// Whether the tip circle of an external wheel lies within its base circle, so that no part of its flank is an involute.
  bool without_involute(std::size_t wheel) const;
  /// k: tip radius beyond that of addendum x + h_aP, in units of m_n.
  double tip_alteration(std::size_t wheel) const;
  /// Smallest shift without undercut by a rack tool: x = h − z sin²α_t/(2cosβ), where h = h_fP − 0.25 is the straight part of
  /// the tool's addendum.
  double least_shift(std::size_t wheel) const;
  /// k = (a − a_d)/m_n − Σx: the tip alteration of external teeth that keeps the tip clearance h_fP − h_aP; 0 with a ring or a
  /// rack.
  double clearance_alteration() const;

  /// Tip radii d_a/2 = d/2 ± m_n (h_aP + x + k).
  void set_tips(const std::array<double, 2>& k);

  /// α_wt for a sum of shifts: inv α_wt = inv α_t + 2 Σx tanα_n/(z_A + z_B), z of a ring negative. Returns nothing if the
  /// wheels would have to be so close that their base circles touch.
  std::optional<double> working_angle_of(double sum_of_shifts) const;
  /// α_wt for a centre distance: cosα_wt = a_d cosα_t/a. Returns nothing if the involutes do not meet.
  std::optional<double> working_angle_at(double distance) const;
  /// Sum of shifts for zero backlash at α_wt: Σx = (z_A + z_B)(inv α_wt − inv α_t)/(2tanα_n).
  double sum_of_shifts_at(double working_angle) const;

 private:
  double outward(std::size_t wheel) const { return ring[wheel] ? -1 : 1; }
  /// z_A + z_B, z of a ring negative.
  double teeth_sum() const { return outward(0) * teeth[0] + outward(1) * teeth[1]; }
};

}  // namespace engrane::elements::gears
