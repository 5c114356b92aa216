// SPDX-License-Identifier: BSD-3-Clause
// What `engrane check` says of a gear pair, and what its teeth would not do well.
#pragma once

#include <string>
#include <vector>

#include "elements/gears/gear_card.hpp"
#include "elements/gears/gear_geometry.hpp"
#include "elements/gears/gear_teeth.hpp"
#include "model/registry.hpp"

namespace engrane::elements::gears {

/// Adds diameters, thicknesses, clearances and angles of teeth whose cut the card describes; a rack has none of its own.
void put_cut(std::vector<Derived>& list, const CutTeeth& cut, const std::array<std::string, 2>& names);

/// What a drawing of a wheel needs besides, at its working pitch circle of the given radius: `, "addendum": …`.
std::string drawn_cut(const CutTeeth& cut, std::size_t wheel, double radius);

/// Every quantity that follows from the card. `width` is the face width, 0 when not given.
std::vector<Derived> gear_report(const GearDesign& design, const PitchFrames& frames, const ToothLaw& teeth, double width);

/// Teeth of the cylindrical wheel that has the tooth shape of a bevel wheel (Tredgold), z/cosγ; negative for a ring.
double virtual_teeth(const GearDesign& design, std::size_t wheel);

/// Least number of (virtual) teeth that a rack tool with addendum m_n does not undercut: 2 cosβ/sin²α_t.
double least_teeth(const GearDesign& design, std::size_t wheel);

/// Turns of wheel A until the same two teeth meet again.
int hunting_period(const std::array<int, 2>& teeth);

/// How the tips of an internal pair pass each other; each is negative where they touch on the way.
struct InternalClearance {
  double involute = 0;  ///< of the ring's tip from the start of the pinion's involute, along the path of contact
  double tips = 0;      ///< of the tips as they leave each other, an angle of the pinion times its teeth
};

/// Of an internal pair of parallel axles whose ring has an involute up to its tip; otherwise nothing. `tips` after the
/// condition z₁(inv α_a1 + δ₁) − z₂(inv α_a2 + δ₂) + (z₂ − z₁) inv α ≥ 0 with δ the angles from the line of centres to where
/// the tip circles cross (Litvin & Fuentes, Gear
/// Geometry and Applied Theory, chapter 11); the unit test compares it with the path of a tip corner through the ring.
std::optional<InternalClearance> internal_clearance(const GearDesign& design);

/// Contact ratio of what is left of the path of contact where tips would reach beyond the start of the mate's involute: undercut
/// takes that part away. Nothing where contact_ratio() gives nothing.
std::optional<double> usable_contact_ratio(const GearDesign& design);

/// A wheel of too few teeth; `who` is its name in the message: "wheel A".
void warn_about_undercut(const GearDesign& design, std::size_t wheel, const std::string& who, const BuildContext& context);
/// Teeth that at times would not touch.
void warn_about_contact_ratio(double usable, const BuildContext& context);

/// Undercut, contact ratio below 1 and interference of internal pairs, each a warning with its cure. Of equal pairs in a deck
/// only the first is spoken of.
void warn_about_teeth(const GearDesign& design, const GearData& data, const BuildContext& context);

}  // namespace engrane::elements::gears
