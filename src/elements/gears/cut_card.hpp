// SPDX-License-Identifier: BSD-3-Clause
// Card data on how teeth are cut: profile shift, addendum and dedendum, tip diameters.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "elements/gears/gear_geometry.hpp"
#include "model/registry.hpp"

namespace engrane::elements::gears {

/// Card data of the cut of cylindrical teeth; a base of the cards' structs. Two values are for A and B; in a rack-and-pinion
/// pair A is the pinion.
struct CutData {
  std::vector<double> shift;               ///< X
  std::vector<double> addendum, dedendum;  ///< factors; one value for both
  std::vector<double> tip_diameter;        ///< TIP
  std::vector<double> tip_alteration;      ///< TIPALTER, one value for both

  /// Whether the card describes the cut. If not, the teeth have addendum m_n and no profile shift.
  bool describes_cut() const {
    return !(shift.empty() && addendum.empty() && dedendum.empty() && tip_diameter.empty() && tip_alteration.empty());
  }
  bool operator==(const CutData&) const = default;
};

/// The keywords of CutData, each with whether it is given.
std::vector<std::pair<std::string_view, bool>> given_cut_keywords(const CutData& data);

/// The teeth of `reference`, with its reference pressure angle as working angle and the factors of the card. Shifts are those
/// given, else 0.
CutTeeth reference_cut(const GearDesign& reference, const CutData& data);

/// Sets the tip radii from TIP, TIPALTER or the factors, once shifts and working pressure angle are known. Reports an error for
/// pointed tips, for tips inside the root circle and for teeth that do not reach each other. `names` are the wheels in messages;
/// a rack is skipped.
bool set_tips(CutTeeth& cut, const CutData& data, const std::array<std::string, 2>& names, const BuildContext& context);

/// The same checks for parallel wheels whose card does not describe the cut, so that they have addendum m_n and no shift.
bool check_plain_tips(const GearDesign& design, const std::array<std::string, 2>& names, const BuildContext& context);

/// Warns of tips of such wheels that are thinner than 0.2 m_n.
void warn_about_plain_tips(const GearDesign& design, const std::array<std::string, 2>& names, const BuildContext& context);

/// Warns of undercut, tips thinner than 0.2 m_n (DIN 3960, 3.9), tips within the base circle and tips that reach the mate's
/// root, each with a remedy.
void warn_about_cut(const CutTeeth& cut, const CutData& data, const std::array<std::string, 2>& names,
                    const BuildContext& context);

/// Adds the keywords of CutData to a card. With `rack`, A is a pinion and B a rack, which has no profile shift and no tip circle.
template <class Data>
void add_cut_keywords(deck::Card<Data>& c, bool rack = false) {
  using namespace dimension;
  const int most = rack ? 1 : 2;
  c.add("X", &CutData::shift,
        rack ? "profile shift factor of the pinion"
             : "profile shift factors; of a pair one value is A's, and the centre distance decides B's")
      .synonyms({"DEPORT", "SHIFT"})
      .values(1, most)
      .above(-5)
      .below(5);
  c.add("ADDENDUM", &CutData::addendum, "addendum of the basic rack in modules; 1 when not given")
      .synonyms({"SAILLIE"})
      .values(1, 2)
      .positive();
  c.add("DEDENDUM", &CutData::dedendum, "dedendum of the basic rack in modules; 1.25 when not given")
      .synonyms({"CREUX"})
      .values(1, 2)
      .positive();
  c.add("TIP", &CutData::tip_diameter,
        rack ? "tip diameter of the pinion, instead of that which follows from X and ADDENDUM"
             : "tip diameters, instead of those that follow from X and ADDENDUM")
      .synonyms({"DIAMETRE_TETE", "TIPDIAMETER"})
      .unit(length)
      .values(1, most)
      .positive();
  c.add("TIPALTER", &CutData::tip_alteration,
        rack ? "tip alteration k of the pinion in modules; 0 when not given"
             : "tip alteration k in modules; when not given, outside what keeps the tip clearance, in a ring 0")
      .synonyms({"TRONCATURE"})
      .values(1, most);
}

}  // namespace engrane::elements::gears
