// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "base/text.hpp"
#include "deck/cards/card_chapters.hpp"
#include "deck/cards/cards.hpp"
#include "deck/cards/initial_motion.hpp"
#include "deck/cards/mesh_cards.hpp"
#include "deck/schema/card.hpp"

namespace engrane::deck {

namespace {

constexpr const char* chapter = "Boundary conditions, loads and functions";

constexpr const char* clm_text =
    "`.CLM` alone starts afresh: the records of an earlier `.CLM` are dropped, and a warning says so. `.CLM ADD` adds to them. "
    "NOEUD and GROUP stand before the word of the record or behind it: `NOEUD 1 FIX C 1 2 3` is `FIX NOEUD 1 C 1 2 3`. Given "
    "again behind other keywords they start the next record, of the same kind where no other is named: "
    "`FIX NOEUD 1 C 1 2 3 NOEUD 4 C 2` holds two records. Components that the model does not have, such as 3 to 6 of a plane "
    "mesh, "
    "are held without effect.";

template <class Data>
void add_target(Card<Data>& card) {
  card.add("NOEUD", &Data::nodes, "nodes: numbers and ranges")
      .synonyms({"NOEUDS", "NODES"})
      .refers(Reference::node)
      .at_least(1)
      .positional()
      .leads();
  card.add("GROUP", &Data::groups, "groups of nodes: names or numbers").refers(Reference::group).values(1, any_number).leads();
}

template <class Data>
void add_components(Card<Data>& card, std::string what) {
  card.add("C", &Data::components, std::move(what))
      .synonyms({"COMPONENTS", "COMPOSANTES"})
      .at_least(1)
      .at_most(6)
      .values(1, 6)
      .required();
}

/// Checks that a record names nodes or groups, and each component once. Checks that need the model are made when it is built.
template <class Data>
void check_target(const Data& data, const Record& record, Diagnostics& diagnostics) {
  if (data.nodes.empty() && data.groups.empty())
    diagnostics.error(record.location, record.schema->name + " names no nodes", "give NOEUD numbers or GROUP names");
  if constexpr (requires { data.components; }) {
    std::vector<int> sorted = data.components;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      diagnostics.error(record.where("C"), "a component is named twice", "C takes each of 1 to 6 once");
  }
}

template <class Data>
void finish_with_target(Card<Data>& card) {
  card.finish([](Data& data, Record& record, Diagnostics& diagnostics) { check_target(data, record, diagnostics); });
}

Schema fix_card() {
  Card<FixCard> card(".CLM FIX", {".BOUNDARY", "FIXATION", "FIXED"}, "Nodes held at their initial position");
  card.chapter(chapter).describe(clm_text).redefines();
  add_target(card);
  add_components(card, "components that are held: 1 to 3 translations, 4 to 6 rotations, along the global axes");
  finish_with_target(card);
  card.example(".CLM\n NOEUD 1 FIX C 1 2 3 4 5 6\n GROUP \"frame\" FIX C 1 2 3");
  return card.schema();
}

Schema displacement_card() {
  Card<DisplacementCard> card(".CLM DEP", {".BOUNDARY", "DEPLACEMENT", "DISPLACEMENT"}, "Prescribed displacements and rotations");
  card.chapter(chapter).redefines();
  card.describe(
      "The value times the function NF of time; without a function the value holds from the start. Rotations are in degrees, "
      "about the global axes through the node. A node is turned about one axis: of its three rotations one may be given and the "
      "others held at zero (C 4 5 6 V 0 0 30, or FIX). Two may be held at zero: the node turns freely about the third axis. One "
      "rotation alone is refused, and so are three of which several are other than zero: turns of any size about several axes "
      "depend on their order. Where one is free and another is not zero, a DYNAMIC analysis takes the derivatives of what is "
      "given for the components of the angular velocity along the axes of the node, which turn with it (not with SCHEME RADAU); "
      "STATIC and KINEMATIC refuse that, since the result would depend on the number of steps. HINGEs on each other, with "
      "DRIVEs, turn a node about several axes.");
  add_target(card);
  add_components(card, "components: 1 to 3 translations, 4 to 6 rotations, along the global axes");
  card.add("V", &DisplacementCard::values, "displacement, or rotation in degrees: one for all components or one for each")
      .values(1, 6)
      .required();
  card.add("NF", &DisplacementCard::function, "number of the function of time; 0: constant").refers(Reference::function);
  finish_with_target(card);
  card.example(".CLM\n NOEUD 7 DEP C 1 V 0.02 NF 1");
  return card.schema();
}

Schema load_card() {
  Card<LoadCard> card(".CLM CHA", {".BOUNDARY", "CHARGE", "LOAD"}, "Forces and moments on nodes, fixed in space");
  card.chapter(chapter).redefines();
  card.describe(
      "The value times the function NF of time; without a function the value holds from the start. Loads on one node add up. "
      "The load of each node has "
      "the histories FORCE_X to FORCE_Z if it has a force and MOMENT_X to MOMENT_Z if it has a moment, as an element of type CHA "
      "with a number after those of all others.");
  add_target(card);
  add_components(card, "components: 1 to 3 forces, 4 to 6 moments, along the global axes");
  card.add("V", &LoadCard::values, "force or moment: one for all components or one for each").values(1, 6).required();
  card.add("NF", &LoadCard::function, "number of the function of time; 0: constant").refers(Reference::function);
  finish_with_target(card);
  card.example(".CLM\n NOEUD 4 CHA C 6 V -945.8");
  return card.schema();
}

Schema temperature_card() {
  Card<TemperatureCard> card(".CLM TEMP", {".BOUNDARY", "TEMPERATURE"}, "Temperatures of nodes");
  card.chapter(chapter).redefines();
  card.describe(
      "Cells, membranes and beams expand by A of their `.MAT` times the value; nothing else does. Between the nodes of an "
      "element "
      "the shape functions interpolate the temperature; nodes without a record have no temperature rise. Of several records on a "
      "node the last holds.");
  add_target(card);
  card.add("V", &TemperatureCard::rise, "temperature rise above the stress-free temperature, in degrees")
      .synonyms({"VAL"})
      .required();
  card.add("NF", &TemperatureCard::function, "number of the function of time, a factor; 0: constant").refers(Reference::function);
  finish_with_target(card);
  card.example(".CLM\n GROUP \"rim\" TEMP V 80.\n NOEUD 1 TEMP V 20. NF 3");
  return card.schema();
}

Schema gravity_card() {
  Card<GravityCard> card(".CLM STRU", {".BOUNDARY", "STRUCTURE"}, "Acceleration of gravity on all masses");
  card.chapter(chapter).redefines();
  card.describe(
      "Constant gravity has a potential, which POTENTIAL_ENERGY contains. Gravity with a function of time does work, as other "
      "loads do, and EXTERNAL_WORK contains it.");
  card.add("ACC", &GravityCard::acceleration, "acceleration of gravity")
      .synonyms({"ACCELERATION"})
      .unit(dimension::acceleration)
      .filler({"VAL", "V"})
      .required();
  card.add("NF", &GravityCard::function, "number of the function of time; 0: constant").refers(Reference::function);
  card.example(".CLM\n STRU ACC VAL 0 0 -9.81");
  return card.schema();
}

Schema rotation_card() {
  Card<RotationCard> card(".CLM ROT", {".BOUNDARY", "ROTATION"}, "Centrifugal load of cells that turn about an axis");
  card.chapter(chapter).redefines();
  card.describe(
      "Statics in axes that turn with the body: a force of density times the square of the speed times the distance from the "
      "axis, "
      "outwards. With large displacements the distance is that of the moved point. Of several records on a cell the last "
      "holds.");
  card.add("GROUP", &RotationCard::groups, "groups of cells: names or numbers")
      .refers(Reference::group)
      .values(1, any_number)
      .required()
      .leads();
  card.add("VAL", &RotationCard::speed, "speed, radians per unit of time")
      .synonyms({"V"})
      .unit(dimension::angular_velocity)
      .required();
  card.add("AXE", &RotationCard::axis, "direction of the axis").synonyms({"AXIS"}).required();
  card.add("AT", &RotationCard::point, "a point on the axis; by itself the origin").unit(dimension::length);
  card.add("NF", &RotationCard::function, "number of the function of time that multiplies the speed; 0: constant")
      .refers(Reference::function);
  card.finish([](RotationCard& data, Record& record, Diagnostics& diagnostics) {
    if (data.axis == std::array<double, 3>{})
      diagnostics.error(record.where("AXE"), "the axis of ROT has no direction", "AXE 0 0 1 is the z axis");
  });
  card.example(".CLM\n GROUP \"disc\" ROT VAL 100. AXE 0 0 1");
  return card.schema();
}

Schema function_card() {
  Card<FunctionCard> card(".FCT", {".FUNCTION", ".FONCTION"}, "Functions of time");
  card.chapter(chapter).numbered();
  card.describe(
      "A function has one shape. Before the first and behind the last point of a TABLE the end values hold, unless it has a "
      "PERIOD.");
  card.add("NOM", &FunctionCard::name, "name").synonyms({"NAME"});
  card.add("TABLE", &FunctionCard::table, "abscissa and ordinate in turn, joined by straight lines").values(4, any_number);
  card.add("SPLINE", &FunctionCard::spline, "join the TABLE by a cubic spline with continuous curvature");
  card.add("PERIOD", &FunctionCard::period, "the TABLE repeats with this period").synonyms({"PERIODE"}).positive();
  card.add("SINUS", &FunctionCard::sinus, "amplitude, frequency (per unit of time), phase (degrees), mean")
      .synonyms({"SINE"})
      .values(2, 4);
  card.add("RAMP", &FunctionCard::ramp, "t0 y0 t1 y1: constant, a straight line, constant").synonyms({"RAMPE"}).values(4, 4);
  card.add("STEP", &FunctionCard::step, "t0 y0 t1 y1: constant, a polynomial with continuous curvature, constant")
      .synonyms({"ECHELON"})
      .values(4, 4);
  card.add("EXPR", &FunctionCard::expression,
           "a formula of the time T, with PI and the functions of the deck's arithmetic (radians); for LAW EXPR of an elongation "
           "D, its rate V and the time T")
      .synonyms({"EXPRESSION", "FORMULE"});
  card.add("USER", &FunctionCard::user,
           "library and name of a routine in Fortran or C: a function, or for LAW USER, STIFF USER and FRICTION USER a law")
      .synonyms({"UTILISATEUR"})
      .values(2, 2);
  card.add("PARAM", &FunctionCard::parameters, "numbers that a USER routine is given")
      .synonyms({"PARAMETRES", "PARAMETERS"})
      .values(1, 10000);
  card.add("SCALE", &FunctionCard::scale,
           "of a USER routine: range of each argument over which the result changes; sets the step of the differences; 0: "
           "chosen by the element, and 50 steps H for functions of time")
      .synonyms({"ECHELLE"})
      .values(1, 3)
      .at_least(0);
  card.example(".FCT\n I 1 TABLE 0 0  1 1\n I 2 NOM \"swell\" SINUS 0.5 10. 90. 1.\n I 3 EXPR \"sin(2*PI*T)**2\"");
  card.example(".FCT\n I 4 USER \"libmine.so\" \"hardening\" PARAM 2.0D4 3.0D8");
  return card.schema();
}

/// Checks that a record gives nodes with components, nodes with a rotation axis, or the coordinate of an element.
void check_initial(const InitialMotionCard& data, const Record& record, Diagnostics& diagnostics) {
  const bool nodes = !data.nodes.empty() || !data.groups.empty();
  const char* one = data.element ? "a coordinate of an element" : "a turn about an axis";
  if (data.element && (nodes || data.axis)) {
    diagnostics.error(record.where("ELEMENT"),
                      "ELEMENT stands with NOEUD, GROUP or AXIS: either a joint or nodes have initial values",
                      "write two records");
    return;
  }
  if (!data.element && !data.axis) {
    check_target(data, record, diagnostics);
    if (data.components.empty())
      diagnostics.error(record.location, record.schema->name + " needs C", "C takes the components 1 to 6");
    if (record.given("COORDINATE") || record.given("AT"))
      diagnostics.error(record.where(record.given("AT") ? "AT" : "COORDINATE"),
                        record.given("AT") ? "AT is a point of an AXIS, and there is none"
                                           : "COORDINATE is one of an ELEMENT, and none is named");
    return;
  }
  if (!data.element && !nodes)
    diagnostics.error(record.location, record.schema->name + " names no nodes", "give NOEUD numbers or GROUP names");
  if (!data.components.empty()) diagnostics.error(record.where("C"), fmt::format("{} has no components C", one), "leave C out");
  if (data.values.size() > 1) diagnostics.error(record.where("V"), fmt::format("{} takes one value V", one));
}

Schema initial_card(const char* name, Words synonyms, const char* summary, const char* tag, const char* values) {
  const bool velocity = std::string_view(tag) == "VELOCITY";
  Card<InitialMotionCard> card(name, synonyms, summary);
  InitialMotionCard data;
  data.kind.tag = tag;
  card.initial(data);
  card.chapter(chapter);
  card.describe(
      std::string("Values of nodes are a starting guess: where joints or drives do not allow them, the nearest state that they "
                  "allow is taken. With IMPOSED this is an error. The value of a joint (ELEMENT) always holds exactly, or is an "
                  "error: the nodes follow, and joints of which nothing is said ") +
      (velocity ? "move as the least kinetic energy has it. Several records on a node add up." : "move as little as possible.") +
      " Meshes and beams follow joints and drives as rigid bodies, unless their nodes are given values." +
      " With `.SAM RESTART` the state comes from the restart point: a warning tells that the values have no effect, with IMPOSED "
      "an error.");
  add_target(card);
  card.add("ELEMENT", &InitialMotionCard::element, "a joint or SENSOR, whose coordinate has the value V instead of a node")
      .synonyms({"JOINT", "LIAISON"})
      .refers(Reference::element)
      .leads();
  card.add("COORDINATE", &InitialMotionCard::coordinate,
           "which of the element's coordinates, as its channel is named: ANGLE, SLIDE; default: its first")
      .synonyms({"COORDONNEE"});
  card.add("C", &InitialMotionCard::components, "components of nodes: 1 to 3 translations, 4 to 6 rotations")
      .synonyms({"COMPONENTS", "COMPOSANTES"})
      .at_least(1)
      .at_most(6)
      .values(1, 6);
  if (velocity) {
    card.add("AXIS", &InitialMotionCard::axis, "instead of C: the nodes turn about an axis of this direction as one rigid body")
        .synonyms({"AXE"});
    card.add("AT", &InitialMotionCard::at, "a point of that axis; default: the origin").unit(dimension::length);
  }
  card.add("V", &InitialMotionCard::values, values).values(1, 6).required();
  card.add("IMPOSED", &InitialMotionCard::imposed, "must hold exactly").synonyms({"IMPOSE"});
  card.finish(
      [](InitialMotionCard& read, Record& record, Diagnostics& diagnostics) { check_initial(read, record, diagnostics); });
  return card.schema();
}

}  // namespace

std::vector<Schema> condition_cards() {
  Schema position = initial_card(".INI DEP", {".INITIAL", "DEPLACEMENT", "DISPLACEMENT"}, "Initial displacements and rotations",
                                 "DISPLACEMENT", "displacement, or rotation in degrees: one for all components or one for each");
  Schema velocity =
      initial_card(".INI VIT", {".INITIAL", "VITESSE", "VELOCITY"}, "Initial velocities", "VELOCITY",
                   "velocity, or angular velocity in radians per unit of time: one for all components or one for each");
  position.examples = {".INI\n DEP NOEUD 3 C 4 V 5.", ".INI\n DEP ELEMENT 2 V 30.\n DEP ELEMENT 4 COORDINATE SLIDE V 0.1"};
  velocity.examples = {".INI\n VIT GROUP \"rotor\" C 6 V (12000*PI/30)",
                       ".INI\n VIT ELEMENT 2 V 40.\n VIT GROUP \"carriage\" AXIS 0 0 1  AT 0.5 0 0  V 10."};
  return {fix_card(),      displacement_card(), load_card(),         temperature_card(), gravity_card(),
          rotation_card(), function_card(),     std::move(position), std::move(velocity)};
}

}  // namespace engrane::deck
