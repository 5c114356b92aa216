// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gear_card.hpp"

namespace engrane {

const deck::Card<GearData>& gear_card() {
  static const deck::Card<GearData> card = [] {
    using namespace dimension;
    deck::Card<GearData> c("GEAR", {"ENGRENAGE", "GEAR_PAIR"},
                           "Pair of gears: spur, helical, internal, bevel, crossed, hypoid or worm");
    c.chapter("Rigid kinematic joints").numbered();
    c.describe(
        "Two toothed wheels, each at a node that is its centre. The pair passes the normal tooth force between them, with its "
        "tangential, radial and axial parts; bearings and shafts are other elements. The places of the nodes must agree with "
        "Z, MN, HELIX and the cones. Teeth are rigid unless KM is given; XI, CM, JEU, SMOOTH, DAMP and ERR need it. "
        "Right-hand helices are positive. Cone angles are the paper's: 0 an external cylinder, 180 a ring gear, positive "
        "when the wheel widens along its axle.");
    c.add("N", &GearData::nodes, "centres of wheel A and wheel B")
        .synonyms({"NOEUDS", "NODES", "NOEUD"})
        .refers(deck::Reference::node)
        .required();
    c.add("Z", &GearData::teeth, "numbers of teeth (threads of a worm)").synonyms({"DENTS", "TEETH"}).at_least(1).required();
    c.add("MN", &GearData::normal_module, "normal module").synonyms({"MODULE"}).unit(length).positive().required();
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
    c.add("CONE", &GearData::cone, "pitch cone angles").synonyms({"CONICITE", "GAMMA"}).unit(angle).at_least(-360).at_most(360);
    c.add("SHAFT", &GearData::shaft_angle, "angle between the axles of a bevel pair: the cones follow from Z")
        .synonyms({"ARBRES", "SIGMA"})
        .unit(angle)
        .positive()
        .below(180);
    c.add("INTERNAL", &GearData::internal, "the wheel with more teeth is a ring gear").synonyms({"INTERNE", "INTERIEUR"});
    c.add("R", &GearData::radii, "pitch radii, only to be checked against z m_n/(2 cos helix)")
        .synonyms({"RAYONS", "RADII"})
        .unit(length)
        .positive();
    add_teeth_keywords(c);
    c.example("I 1 GEAR N 1 2 AXIS 0 0 1 Z 20 40 MN 2 HELIX 15");
    c.example("I 2 GEAR N 2 3 AXIS 0 0 1 Z 25 25 MN 0.15748 KM 1.477E7 XI 0.1 ERR COS 0.003937 JEU 0.001968");
    c.example("I 3 GEAR N 1 2 AXIS 0 1 0 Z 50 10 MN 0.2 SHAFT 90");
    return c;
  }();
  return card;
}

}  // namespace engrane
