// SPDX-License-Identifier: BSD-3-Clause
// Two elements that look like real ones, so that the reader is tested without the physics.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "deck/cards/cards.hpp"
#include "deck/read/reader.hpp"
#include "deck/schema/card.hpp"

namespace engrane::deck {

struct FakeGear {
  std::array<int, 2> nodes{};
  std::array<double, 3> axis{0, 0, 1};
  std::array<int, 2> teeth{};
  double module = 1;
  double pressure_angle = 20;
  std::vector<double> radii;
  std::array<double, 2> cone{};
  std::array<double, 2> helix{};
  std::optional<double> mesh_stiffness;
  std::optional<double> damping_ratio;
  Tagged error;
  std::optional<double> backlash;
};

struct FakeHinge {
  std::array<int, 2> nodes{};
  std::array<double, 3> axis{0, 0, 1};
  Tagged drive;
  int function = 0;
};

struct FakeBody {
  std::vector<int> nodes;
  std::array<double, 3> axis{0, 0, 1};
  double mass = 0;
  std::optional<double> inertia, stiffness, damping, value;
};

inline Schema fake_gear() {
  Card<FakeGear> card("GEAR", {"ENGRENAGE"}, "Gear pair");
  card.chapter("Joints").numbered();
  card.add("N", &FakeGear::nodes, "wheels A and B").refers(Reference::node).required();
  card.add("AXIS", &FakeGear::axis, "axis of wheel A").synonyms({"AXE"});
  card.add("Z", &FakeGear::teeth, "numbers of teeth").at_least(3).required();
  card.add("MN", &FakeGear::module, "normal module").unit(dimension::length).positive().required();
  card.add("ALPHA", &FakeGear::pressure_angle, "pressure angle").unit(dimension::angle).above(0).below(90);
  card.add("R", &FakeGear::radii, "pitch radii").unit(dimension::length).positive().values(2, 2);
  card.add("CONE", &FakeGear::cone, "cone angles").unit(dimension::angle);
  card.add("HELIX", &FakeGear::helix, "helix angles, right hand positive").unit(dimension::angle).above(-90).below(90);
  card.add("KM", &FakeGear::mesh_stiffness, "mesh stiffness").unit(dimension::stiffness).positive();
  card.add("XI", &FakeGear::damping_ratio, "damping ratio").at_least(0).below(1);
  card.add("ERR", &FakeGear::error, "transmission error")
      .option({"COS", {"COSINE"}, "amplitude of a cosine per tooth", 1, 2, dimension::length})
      .option({"TABLE", {}, "pairs of angle and error", 4, 100, dimension::length});
  card.add("JEU", &FakeGear::backlash, "backlash").synonyms({"BACKLASH"}).unit(dimension::length).at_least(0);
  card.example(" I 1 GEAR N 1 2 Z 25 50 MN 0.002");
  return card.schema();
}

inline Schema fake_hinge() {
  Card<FakeHinge> card("HINGE", {"CHARNIERE"}, "Hinge between two nodes");
  card.chapter("Joints").numbered();
  card.add("N", &FakeHinge::nodes, "the two nodes; 0 is the ground").refers(Reference::node).required();
  card.add("AXIS", &FakeHinge::axis, "axis").synonyms({"AXE"});
  card.add("DRIVE", &FakeHinge::drive, "motion imposed on the hinge")
      .synonyms({"MOTEUR"})
      .option({"ANGLE", {}, "the angle is the function"})
      .option({"SPEED", {"VITESSE"}, "the speed is the function"});
  card.add("NF", &FakeHinge::function, "number of the function").refers(Reference::function);
  return card.schema();
}

/// RIGID, TORQUE, TSPRING, INERTIA: one struct is enough for the reader.
inline Schema fake_body(const char* name, const char* synonym) {
  Card<FakeBody> card(name, {synonym}, "Something with nodes");
  card.chapter("Bodies").numbered();
  card.add("N", &FakeBody::nodes, "nodes").refers(Reference::node).required();
  card.add("AXIS", &FakeBody::axis, "axis").synonyms({"AXE"});
  card.add("M", &FakeBody::mass, "mass").unit(dimension::mass).at_least(0);
  card.add("J", &FakeBody::inertia, "inertia").unit(dimension::inertia).at_least(0);
  card.add("K", &FakeBody::stiffness, "stiffness").unit(dimension::torsional_stiffness).at_least(0);
  card.add("C", &FakeBody::damping, "damping").unit(dimension::torsional_damping).at_least(0);
  card.add("V", &FakeBody::value, "value");
  return card.schema();
}

inline const Catalogue& fake_catalogue() {
  static const std::vector<Schema> elements{fake_gear(),
                                            fake_hinge(),
                                            fake_body("RIGID", "RIGIDE"),
                                            fake_body("TORQUE", "COUPLE"),
                                            fake_body("TSPRING", "RESSORT_TORSION"),
                                            fake_body("INERTIA", "INERTIE")};
  static const Catalogue catalogue = [] {
    Catalogue all;
    for (const Schema& schema : general_commands()) all.commands.push_back(&schema);
    for (const Schema& schema : elements) all.elements.push_back(&schema);
    return all;
  }();
  return catalogue;
}

}  // namespace engrane::deck
