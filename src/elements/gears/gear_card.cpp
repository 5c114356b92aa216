// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gears/gear_card.hpp"

namespace engrane::elements::gears {

const deck::Card<GearData>& gear_card() {
  static const deck::Card<GearData> card = [] {
    using namespace dimension;
    deck::Card<GearData> c("GEAR", {"ENGRENAGE", "GEAR_PAIR"},
                           "Pair of gears: spur, helical, internal, bevel, crossed, hypoid or worm");
    c.chapter("Rigid kinematic joints").numbered();
    c.describe(
        "Two toothed wheels, each at a node that is its centre. The pair passes the normal tooth force between them, with its "
        "tangential, radial and axial parts; bearings and shafts are other elements. The places of the nodes must agree with "
        "Z, MN, HELIX and the cones, unless PLACE puts B where it belongs. KIND is the short way to all common pairs. Teeth are "
        "rigid unless KM is given; XI, CM, JEU, SMOOTH, DAMP and ERR need it. With profile shift X the wheels roll on their "
        "working "
        "pitch circles, and the places of the nodes must agree with the working centre distance. "
        "Right-hand helices are positive. Cone angles are the paper's: 0 an external cylinder, 180 a ring gear, positive "
        "when the wheel widens along its axle.");
    c.add("N", &GearData::nodes, "centres of wheel A and wheel B")
        .synonyms({"NOEUDS", "NODES", "NOEUD"})
        .refers(deck::Reference::node)
        .required();
    c.add("KIND", &GearData::kind, "short form: geometry from what a designer has; without it CONE, SHAFT or INTERNAL and HELIX")
        .synonyms({"GENRE"})
        .option({"SPUR", {"DROIT"}, "parallel axles, straight teeth: Z and one of MN MT DISTANCE; X"})
        .option(
            {"HELICAL", {"HELICOIDAL"}, "parallel axles: Z, two of MN MT HELIX DISTANCE; the nodes' distance may be the second"})
        .option({"INTERNAL",
                 {"INTERNE"},
                 "the wheel with more teeth is a ring: as HELICAL; straight teeth with one of MN MT DISTANCE"})
        .option({"BEVEL", {"CONIQUE"}, "axles that meet, straight teeth: Z, SHAFT (90), one of MN MT DIAMETER"})
        .option({"SPIRAL", {"SPIROCONIQUE"}, "axles that meet: as BEVEL, and HELIX"})
        .option({"CROSSED", {"CROISE"}, "cylinders on crossed axles: Z, one of MN DISTANCE, HELIX twice or HELIX once and SHAFT"})
        .option({"HYPOID", {"HYPOIDE"}, "cones on axles that pass: Z, HELIX of A, OFFSET, SHAFT (90), one of MN DIAMETER"})
        .option({"WORM", {"VIS"}, "A is the worm: STARTS, Z of the wheel, two of LAMBDA LEAD Q DIAMETER DISTANCE MN MX"});
    c.add("Z", &GearData::teeth,
          "numbers of teeth (threads of a worm); one value with STARTS: of the wheel; else of A, and the centre distance decides "
          "B's")
        .synonyms({"DENTS", "TEETH"})
        .values(1, 2)
        .at_least(1)
        .required();
    c.add("MN", &GearData::normal_module, "normal module, of bevel gears at the middle of the face; necessary without KIND")
        .synonyms({"MODULE"})
        .unit(length)
        .positive();
    c.add("MT", &GearData::transverse_module, "transverse module, instead of MN").unit(length).positive();
    c.add("MX", &GearData::axial_module, "axial module of a worm").synonyms({"MA"}).unit(length).positive();
    c.add("STARTS", &GearData::starts, "threads of a worm").synonyms({"FILETS"}).at_least(1);
    c.add("ALPHA", &GearData::pressure_angle, "normal pressure angle").synonyms({"PRESSURE"}).unit(angle).at_least(0).below(90);
    c.add("HELIX", &GearData::helix, "helix or spiral angles at the pitch point, right hand positive; one value: B fits A")
        .synonyms({"HELICE", "BETA"})
        .unit(angle)
        .values(1, 2)
        .above(-90)
        .below(90);
    c.add("AXIS", &GearData::axis, "direction of the axle of wheel A in the reference configuration")
        .synonyms({"AXE"})
        .required();
    c.add("AXISB", &GearData::axis_b, "axle of wheel B, either sense: checked, and used to tell bevel from crossed pairs")
        .synonyms({"AXEB"});
    c.add("HAND", &GearData::hand, "hand of wheel A where its helix follows from other data; RIGHT when not given")
        .synonyms({"MAIN"})
        .option({"RIGHT", {"DROITE"}, "right-hand teeth"})
        .option({"LEFT", {"GAUCHE"}, "left-hand teeth"});
    c.add("DISTANCE", &GearData::center_distance, "centre distance").synonyms({"ENTRAXE"}).unit(length).positive();
    c.add("DIAMETER", &GearData::diameter, "pitch diameter: of the worm; of the larger bevel wheel; of the hypoid ring")
        .synonyms({"DIAMETRE"})
        .unit(length)
        .positive();
    c.add("OFFSET", &GearData::offset, "distance of hypoid axles; positive: the pinion has the larger spiral angle")
        .synonyms({"DESAXAGE"})
        .unit(length);
    c.add("RINGCONE", &GearData::ring_cone,
          "pitch cone angle of a hypoid ring, instead of its apex at the crossing point of the axles")
        .synonyms({"CONECOURONNE"})
        .unit(angle)
        .positive()
        .below(90);
    c.add("LAMBDA", &GearData::lead_angle, "lead angle of a worm").unit(angle).positive().below(90);
    c.add("LEAD", &GearData::lead, "lead of a worm: how far a turn moves its thread").synonyms({"PAS"}).unit(length).positive();
    c.add("Q", &GearData::quotient, "diameter quotient of a worm, DIAMETER/MX").positive();
    c.add("CONE", &GearData::cone, "pitch cone angles").synonyms({"CONICITE", "GAMMA"}).unit(angle).at_least(-360).at_most(360);
    c.add("SHAFT", &GearData::shaft_angle, "angle between the axles; without KIND, of a bevel pair: the cones follow from Z")
        .synonyms({"ARBRES", "SIGMA"})
        .unit(angle)
        .positive()
        .below(180);
    c.add("INTERNAL", &GearData::internal, "the wheel with more teeth is a ring gear").synonyms({"INTERNE", "INTERIEUR"});
    c.add("R", &GearData::radii, "pitch radii, only to be checked against z m_n/(2 cos helix)")
        .synonyms({"RAYONS", "RADII"})
        .unit(length)
        .positive();
    c.add("PLACE", &GearData::place,
          "direction from A's centre to the contact point: node B is positioned so that the wheels mesh")
        .synonyms({"PLACER"});
    add_cut_keywords(c);
    add_teeth_keywords(c);
    c.example("I 1 GEAR N 1 2 AXIS 0 0 1 Z 20 40 MN 2 HELIX 15");
    c.example("I 2 GEAR N 2 3 AXIS 0 0 1 Z 25 25 MN 0.15748 KM 1.477E7 XI 0.1 ERR COS 0.003937 JEU 0.001968");
    c.example("I 3 GEAR N 1 2 AXIS 0 1 0 Z 50 10 MN 0.2 SHAFT 90");
    c.example("I 5 GEAR N 1 2 KIND SPUR Z 12 24 MN 3 X 0.6 0.36 AXIS 0 0 1 PLACE 1 0 0");
    c.example("I 4 GEAR N 1 2 KIND WORM STARTS 2 Z 30 MX 4 Q 10 AXIS 1 0 0 PLACE 0 1 0");
    return c;
  }();
  return card;
}

}  // namespace engrane::elements::gears
