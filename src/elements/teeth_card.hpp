// SPDX-License-Identifier: BSD-3-Clause
// What a card says of the teeth of a gear pair, or of a pinion and its rack.
#pragma once

#include <array>
#include <optional>

#include "elements/gear_teeth.hpp"
#include "model/registry.hpp"

namespace engrane {

/// The part of a card that describes how teeth touch. Cards derive their struct from it.
struct TeethData {
  std::optional<double> stiffness;
  std::optional<double> damping_ratio;
  std::optional<double> damping;
  deck::Tagged damping_mode;
  std::optional<double> backlash;
  std::optional<double> onset;
  deck::Tagged error;
};

/// What the tooth law needs to know of the pair whose teeth these are. Entry 0 is wheel A, entry 1 wheel B.
struct TeethOwner {
  std::array<int, 2> nodes{0, 0};
  std::array<Vec3, 2> axle{Vec3::Zero(), Vec3::Zero()};
  std::array<int, 2> teeth{1, 1};
  std::array<double, 2> lever{1, 1};  ///< r cosβ, along which u_m is measured
};

/// The tooth law; rigid teeth, without `KM`, have stiffness 0. Faults go to the context's diagnostics; then there is no result.
std::optional<ToothLaw> tooth_law(const TeethData& data, const TeethOwner& owner, const BuildContext& context);

/// Adds the keywords of TeethData to a card.
template <class Data>
void add_teeth_keywords(deck::Card<Data>& c) {
  using namespace dimension;
  c.add("KM", &TeethData::stiffness, "tooth stiffness along the circumference")
      .synonyms({"RAIDEUR"})
      .unit(dimension::stiffness)
      .positive();
  c.add("XI", &TeethData::damping_ratio, "damping ratio of the teeth against the inertia of both wheels").at_least(0);
  c.add("CM", &TeethData::damping, "tooth damping along the circumference, instead of XI").unit(dimension::damping).at_least(0);
  c.add("JEU", &TeethData::backlash, "backlash along the circumference").synonyms({"BACKLASH"}).unit(length).at_least(0);
  c.add("SMOOTH", &TeethData::onset, "width over which contact comes on; JEU/1000 when not given")
      .synonyms({"LISSAGE"})
      .unit(length)
      .at_least(0);
  c.add("DAMP", &TeethData::damping_mode, "when the teeth damp; CONTACT with JEU and ALWAYS without when not given")
      .synonyms({"AMORTISSEMENT"})
      .option({"ALWAYS", {"TOUJOURS"}, "at all times, the paper's law"})
      .option({"CONTACT", {}, "only while they touch, and never so that they pull"});
  c.add("ERR", &TeethData::error, "transmission error under static load, along the circumference")
      .synonyms({"ERREUR", "ERROR"})
      .option({"COS", {}, "X: X (1 - cos z_A psi_A)", 1, 1, length})
      .option({"FOURIER", {}, "a1 b1 a2 b2 ...: sum of a_n cos(n z_A psi_A) + b_n sin(n z_A psi_A)", 2, 200, length})
      .option({"TABLE", {"FCT", "NF"}, "f: function f of psi_A in degrees, repeating with the turn", 1, 1});
}

}  // namespace engrane
