// SPDX-License-Identifier: BSD-3-Clause
// Results for a gear pair in `engrane check`, and warnings about its teeth.
#pragma once

#include <string>
#include <vector>

#include "elements/gears/gear_card.hpp"
#include "elements/gears/gear_geometry.hpp"
#include "elements/gears/gear_teeth.hpp"
#include "model/registry.hpp"

namespace engrane::elements::gears {

/// Adds diameters, thicknesses, clearances and angles of teeth whose cut is given on the card; a rack has none.
void put_cut(std::vector<Derived>& list, const CutTeeth& cut, const std::array<std::string, 2>& names);

/// Additional drawing data of a wheel with the given working pitch radius: `, "addendum": …`.
std::string drawn_cut(const CutTeeth& cut, std::size_t wheel, double radius);

/// Adds the backlash along the circumference and normal to the flanks, if there is any; `pressure_angle` is the working α_n.
void put_backlash(std::vector<Derived>& list, const ToothLaw& teeth, double pressure_angle);

/// All quantities derived from the card. `width` is the face width, 0 if not given.
std::vector<Derived> gear_report(const GearDesign& design, const PitchFrames& frames, const ToothLaw& teeth, double width);

/// Number of teeth z/cosγ of the cylindrical wheel with the tooth shape of a bevel wheel (Tredgold); negative for a ring.
double virtual_teeth(const GearDesign& design, std::size_t wheel);

/// Smallest (virtual) number of teeth without undercut by a rack tool with addendum m_n: 2 cosβ/sin²α_t.
double least_teeth(const GearDesign& design, std::size_t wheel);

/// Number of turns of wheel A until the same two teeth meet again.
int hunting_period(const std::array<int, 2>& teeth);

/// Clearances of the tips in an internal pair, negative in case of interference.
struct InternalClearance {
  double involute = 0;  ///< of the ring's tip from the start of the pinion's involute, along the path of contact
  double tips = 0;      ///< between the tips where the tip circles cross, as an angle of the pinion times its number of teeth
};

/// For an internal pair on parallel axles whose ring has an involute up to its tip; otherwise nothing. `tips` follows from the
/// condition z₁(inv α_a1 + δ₁) − z₂(inv α_a2 + δ₂) + (z₂ − z₁) inv α ≥ 0, with δ the angles from the line of centres to the
/// crossing of the tip circles (Litvin & Fuentes, Gear Geometry and Applied Theory, chapter 11); the unit test compares it with
/// the path of a tip corner through the ring.
std::optional<InternalClearance> internal_clearance(const GearDesign& design);

/// Contact ratio of the path of contact without the parts where a tip reaches beyond the start of the mate's involute, which
/// undercut removes. Returns nothing where contact_ratio() does.
std::optional<double> usable_contact_ratio(const GearDesign& design);

/// Warns if a wheel has too few teeth; `who` is its name in the message: "wheel A".
void warn_about_undercut(const GearDesign& design, std::size_t wheel, const std::string& who, const BuildContext& context);
/// Warns if the contact ratio is below 1, so that at times, or if it is not positive never, teeth touch.
void warn_about_contact_ratio(double usable, const BuildContext& context);

/// Warns of undercut, contact ratio below 1 and interference of internal pairs, each with a remedy. Of several equal pairs in a
/// deck only the first is reported.
void warn_about_teeth(const GearDesign& design, const GearData& data, const BuildContext& context);

}  // namespace engrane::elements::gears
