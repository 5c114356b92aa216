// SPDX-License-Identifier: BSD-3-Clause
// Card data of the teeth of a gear pair, or of a pinion and its rack.
#pragma once

#include <fmt/format.h>

#include <array>
#include <optional>
#include <vector>

#include "elements/common/friction_card.hpp"
#include "elements/gears/profile_shift.hpp"
#include "elements/gears/tooth_contact.hpp"
#include "model/registry.hpp"

namespace engrane::elements::gears {

/// Card data of the tooth contact, angles in degrees; a base of the cards' structs.
struct TeethData {
  std::optional<double> width;
  std::optional<double> stiffness;
  deck::Tagged course;                                                           ///< STIFF
  std::vector<double> moduli;                                                    ///< E of A and B, one value for both
  std::vector<double> exponent;                                                  ///< p and x₀
  std::vector<double> tip_relief_a, tip_relief_b, root_relief_a, root_relief_b;  ///< amount, length, exponent
  std::optional<double> crown;
  std::optional<double> damping_ratio;
  std::optional<double> damping;
  deck::Tagged damping_mode;
  std::optional<double> backlash, normal_backlash, center_backlash;
  std::vector<double> thickness_allowance;  ///< ASN of A and B, one value for both; not above 0
  std::optional<double> onset;
  deck::Tagged error;
  std::vector<double> eccentricity_a, eccentricity_b;  ///< amplitude and phase
  int pitch_a = 0, pitch_b = 0;                        ///< functions of the cumulative pitch error
  std::optional<double> phase;
  deck::Tagged friction;
  std::optional<double> friction_width;
  bool sticks = false;
  deck::Tagged sliding;
  double rolling = 0;
  deck::Tagged separation{"YES", {}};
  bool running = false;
  int slices = 1;
};

/// Data of the pair that the tooth law depends on. Entry 0 is wheel A, entry 1 wheel B or the rack.
struct TeethOwner {
  std::array<int, 2> nodes{0, 0};
  std::array<Vec3, 2> axle{Vec3::Zero(), Vec3::Zero()};
  std::array<int, 2> teeth{1, 1};  ///< 0: a rack
  std::array<bool, 2> ring{false, false};
  std::array<double, 2> lever{1, 1};  ///< r cosβ, along which u_m is measured; 1 for a rack
  bool parallel = true;               ///< axles are parallel, so that involute relations hold
  bool path_known = true;  ///< the path of contact is known: parallel axles, or intersecting ones by their virtual wheels
  ContactGeometry geometry;
  MeshPhase mesh;
  std::optional<CutTeeth> cut;  ///< if the card describes the cut
};

/// Tooth law and contact options of a card.
struct Teeth {
  ToothLaw law;  ///< stiffness is 0 for rigid teeth, without `KM` or `STIFF ISO`
  ContactOptions options;
};
/// Reads the teeth of a card. Returns nothing, with errors, if the data are invalid.
std::optional<Teeth> read_teeth(const TeethData& data, const TeethOwner& owner, const BuildContext& context);

/// Warns of a pressure angle, in degrees, that was probably given in radians.
void warn_of_radians(double alpha, const BuildContext& context);

/// Adds the keywords of TeethData to a card. With `rack`, A is a pinion and B a rack: its errors are not functions of an angle,
/// so that `ECCB` and `PITCHB` are left out.
template <class Data>
void add_teeth_keywords(deck::Card<Data>& c, bool rack = false) {
  using namespace dimension;
  const char *const a = rack ? "the pinion" : "A", *const b = rack ? "the rack" : "B";
  const char *const wheel_a = rack ? "the pinion" : "wheel A", *const both = rack ? "pinion and rack" : "both wheels";
  c.add("WIDTH", &TeethData::width,
        "face width: STIFF ISO and SLICES need it; for overlap ratio and drawing 10 m_n when not given")
      .synonyms({"LARGEUR"})
      .unit(length)
      .positive();
  c.add("KM", &TeethData::stiffness, "tooth stiffness along the circumference")
      .synonyms({"RAIDEUR"})
      .unit(dimension::stiffness)
      .positive();
  c.add("STIFF", &TeethData::course, "variation of the mesh stiffness over a tooth pitch")
      .synonyms({"RIGIDITE", "STIFFNESS"})
      .option({"CONST", {"CONSTANT"}, "KM at all times"})
      .option({"ISO", {}, "constant, computed by ISO 6336-1 (method B) from geometry, WIDTH and E instead of KM"})
      .option({"FOURIER", {}, "a1 b1 a2 b2 ...: KM (1 + sum of a_n cos n tau + b_n sin n tau), tau 2 pi per tooth", 2, 200})
      .option({"TABLE", {"FCT", "NF"}, "f: KM times function f of tau/(2 pi), repeating with 1", 1, 1})
      .option({"USER",
               {"UTILISATEUR"},
               "f: KM times routine f of .FCT, of tau/(2 pi) from 0 to 1 and of the deflection of the teeth",
               1,
               1})
      .option({"SQUARE",
               {"CARRE"},
               "[eps [edge]]: pairs in contact, of contact ratio eps (geometry's when not given), changing over edge (0.05) of "
               "a pitch; KM is the mean",
               0,
               2});
  c.add("E", &TeethData::moduli,
        rack ? "Young's modulus, one of both or those of pinion and rack, for STIFF ISO"
             : "Young's modulus, of both wheels or of A and B, for STIFF ISO")
      .synonyms({"YT", "YOUNG"})
      .unit(dimension::pressure)
      .values(1, 2)
      .positive();
  c.add("EXPONENT", &TeethData::exponent, "p x0: the force grows with x^p, and is KM x0 at the deflection x0")
      .synonyms({"EXPOSANT"})
      .values(2, 2)
      .positive();
  const char* const relief =
      "C L [p]: {} relief of {}, C normal to the flank over L of the path of contact, growing with power p (2)";
  c.add("TIPRELA", &TeethData::tip_relief_a, fmt::format(fmt::runtime(relief), "tip", a))
      .synonyms({"DEPOUILLE_TETE_A"})
      .values(2, 3)
      .positive();
  c.add("TIPRELB", &TeethData::tip_relief_b, fmt::format(fmt::runtime(relief), "tip", b))
      .synonyms({"DEPOUILLE_TETE_B"})
      .values(2, 3)
      .positive();
  c.add("ROOTRELA", &TeethData::root_relief_a, fmt::format(fmt::runtime(relief), "root", a))
      .synonyms({"DEPOUILLE_PIED_A"})
      .values(2, 3)
      .positive();
  c.add("ROOTRELB", &TeethData::root_relief_b, fmt::format(fmt::runtime(relief), "root", b))
      .synonyms({"DEPOUILLE_PIED_B"})
      .values(2, 3)
      .positive();
  c.add("CROWN", &TeethData::crown, fmt::format("crowning of {} together, normal to the flank at the ends of the face", both))
      .synonyms({"BOMBE"})
      .unit(length)
      .positive();
  c.add("XI", &TeethData::damping_ratio,
        rack ? "damping ratio against the inertia of two wheels: refused with a rack, give CM"
             : "damping ratio of the teeth against the inertia of both wheels")
      .at_least(0);
  c.add("CM", &TeethData::damping, "tooth damping along the circumference, instead of XI").unit(dimension::damping).at_least(0);
  c.add("JEU", &TeethData::backlash,
        "backlash along the circumference, in the normal section: the transverse one times cos(helix)")
      .synonyms({"BACKLASH"})
      .unit(length)
      .at_least(0);
  c.add("JEUN", &TeethData::normal_backlash, "backlash normal to the flanks, instead of JEU")
      .synonyms({"NORMAL_BACKLASH"})
      .unit(length)
      .at_least(0);
  c.add("JEUA", &TeethData::center_backlash,
        rack ? "backlash as the way of the rack towards the pinion that takes it up, instead of JEU"
             : "backlash as the reduction of the centre distance (in a ring its increase) that takes it up, instead of JEU")
      .synonyms({"CENTRE_BACKLASH", "CENTER_BACKLASH"})
      .unit(length)
      .at_least(0);
  c.add("ASN", &TeethData::thickness_allowance,
        fmt::format(
            "tooth-thickness allowances A_sn of {} and {}, or one value for both: normal, at the reference circle, negative; "
            "instead of JEU",
            a, b))
      .synonyms({"ALLOWANCE", "ECART_EPAISSEUR"})
      .unit(length)
      .values(1, 2)
      .at_most(0);
  c.add("SMOOTH", &TeethData::onset, "width over which contact comes on; 0, the exact corner, when not given")
      .synonyms({"LISSAGE"})
      .unit(length)
      .at_least(0);
  c.add("DAMP", &TeethData::damping_mode, "when the teeth damp; CONTACT with JEU and ALWAYS without when not given")
      .synonyms({"AMORTISSEMENT"})
      .option({"ALWAYS", {"TOUJOURS"}, "at all times, the paper's law"})
      .option({"CONTACT", {}, "only while they touch, against their approach, and never so that they pull"});
  c.add("ERR", &TeethData::error, "transmission error under static load, along the circumference")
      .synonyms({"ERREUR", "ERROR"})
      .option({"COS", {}, "X: X (1 - cos z_A psi_A)", 1, 1, length})
      .option({"FOURIER", {}, "a1 b1 a2 b2 ...: sum of a_n cos(n z_A psi_A) + b_n sin(n z_A psi_A)", 2, 200, length})
      .option({"TABLE", {"FCT", "NF"}, "f: function f of psi_A in degrees, repeating with the turn", 1, 1});
  c.add("ECCA", &TeethData::eccentricity_a,
        fmt::format("e [phase]: runout of {}, e (a length) times the sine of its turn and the phase (degrees), along the "
                    "circumference",
                    wheel_a))
      .synonyms({"EXCENTRICITE_A", "ECCENTRICITY_A"})
      .values(1, 2);
  if (!rack)
    c.add("ECCB", &TeethData::eccentricity_b, "e [phase]: runout of wheel B")
        .synonyms({"EXCENTRICITE_B", "ECCENTRICITY_B"})
        .values(1, 2);
  c.add("PITCHA", &TeethData::pitch_a,
        fmt::format("function of the cumulative pitch error of {} over its turn in degrees, PERIOD 360", wheel_a))
      .synonyms({"PAS_A"})
      .refers(deck::Reference::function);
  if (!rack) c.add("PITCHB", &TeethData::pitch_b, "the same of wheel B").synonyms({"PAS_B"}).refers(deck::Reference::function);
  c.add("PHASE", &TeethData::phase,
        rack ? "mesh phase at the start, 360 per tooth; 0 when not given"
             : "mesh phase at the start, 360 per tooth; follows from the train when not given")
      .unit(angle);
  add_friction_options(c.add("FRICTION", &TeethData::friction, "sliding friction between the flanks"));
  c.add("VREG", &TeethData::friction_width, "regularises friction below this sliding speed: flanks that should stick creep")
      .synonyms({"V0"})
      .unit(velocity)
      .positive();
  c.add("STICK", &TeethData::sticks, "Coulomb's law at every speed, flanks that stop are held exactly; the default without VREG")
      .synonyms({"ADHERENCE"});
  c.add("SLIDING", &TeethData::sliding, "where the flanks slide")
      .synonyms({"GLISSEMENT"})
      .option({"PITCH", {"PRIMITIF"}, "at the pitch point: axles that cross or pass each other"})
      .option({"PROFILE", {"PROFIL"}, "each pair of flanks along the path of contact (axles that are parallel or meet)"});
  c.add("ROLLING", &TeethData::rolling, "lever of the rolling resistance").synonyms({"ROULEMENT"}).unit(length).at_least(0);
  c.add("SEPARATION", &TeethData::separation,
        fmt::format("the radial part of the tooth force, which pushes {} apart", rack ? both : "the wheels"))
      .option({"YES", {"OUI"}, "with it"})
      .option({"NO", {"NON"}, "without: tangential and axial parts only"});
  c.add("RUNNING", &TeethData::running,
        rack ? "flanks and radial force follow the running distance of the rack from the pinion"
             : "pressure angle and flanks follow the running centre distance (parallel axles)")
      .synonyms({"ENTRAXE_COURANT"});
  c.add("SLICES", &TeethData::slices, "slices along WIDTH that see the tilt of the axles (parallel axles, elastic teeth)")
      .synonyms({"TRANCHES"})
      .at_least(1)
      .at_most(200);
}

}  // namespace engrane::elements::gears
