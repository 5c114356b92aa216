// SPDX-License-Identifier: BSD-3-Clause
#include "deck/cards/cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "deck/cards/card_chapters.hpp"
#include "deck/schema/card.hpp"

namespace engrane::deck {

namespace {

constexpr const char* model_chapter = "The model";

Schema unit_card() {
  Card<UnitCard> card(".UNIT", {".UNITE"}, "The units of the deck");
  card.chapter(model_chapter).once();
  card.describe(
      "Numbers are never rescaled: a deck is computed in its own units, which must be consistent. `.UNIT` names them, so that "
      "results and messages carry labels. Without it the units stay unnamed.");
  card.add("SI", &UnitCard::si, "metre, kilogram, second");
  card.add("LENGTH", &UnitCard::length, "metres in one unit of length").synonyms({"LONGUEUR"}).positive();
  card.add("MASS", &UnitCard::mass, "kilograms in one unit of mass").synonyms({"MASSE"}).positive();
  card.add("TIME", &UnitCard::time, "seconds in one unit of time").synonyms({"TEMPS"}).positive();
  card.add("CELSIUS", &UnitCard::celsius, "temperatures are in degrees Celsius");
  card.finish([](UnitCard& unit, Record& record, Diagnostics& diagnostics) {
    const bool factors = record.given("LENGTH") || record.given("MASS") || record.given("TIME");
    if (unit.si && factors)
      diagnostics.error(record.where("SI"), "SI and factors exclude each other", "keep SI, or LENGTH, MASS and TIME");
    if (!unit.si && !factors)
      diagnostics.error(record.location, ".UNIT says nothing", "write .UNIT SI, or .UNIT LENGTH 1e-3 MASS 1e3 TIME 1");
  });
  card.example(".UNIT SI").example(".UNIT LENGTH 0.001 MASS 1000 TIME 1   ! mm, t, s: forces are in newtons");
  return card.schema();
}

Schema title_card() {
  Card<TitleCard> card(".TITRE", {".TITLE"}, "The title of the run");
  card.chapter(model_chapter).once();
  card.add("TEXT", &TitleCard::text, "the title, in double quotes").synonyms({"TEXTE"}).positional().required();
  card.example(".TITRE \"straight bevel pair\"");
  return card.schema();
}

Schema node_card() {
  Card<NodeCard> card(".NOE", {".NODES"}, "Nodes");
  card.chapter(model_chapter).numbered().rows();
  card.describe(
      "A node has a position and, where an element needs it, an orientation. Missing coordinates are 0. A line that starts with "
      "a "
      "number is a node too: its number and up to three coordinates. `.NOE` may be opened several times. "
      "`FRAME n` before the first node holds for all nodes that follow under this `.NOE`.");
  card.add("X", &NodeCard::x, "coordinates: x, or x y, or x y z").unit(dimension::length).positional().values(1, 3);
  card.add_part("Y", "X", 1, &NodeCard::x, "second coordinate").unit(dimension::length);
  card.add_part("Z", "X", 2, &NodeCard::x, "third coordinate").unit(dimension::length);
  card.add("FRAME", &NodeCard::frame, "the `.FRAME` in which the coordinates are given; 0 is the global one")
      .synonyms({"REPERE"})
      .refers(Reference::frame)
      .heading();
  card.example(".NOE\n I 1 X 0 0 5\n I 2 X -10. Z 2.5\n 12 0. 0. 5.");
  return card.schema();
}

Schema frame_card() {
  Card<FrameCard> card(".FRAME", {".REPERE"}, "Frames in which nodes may be given");
  card.chapter(model_chapter).numbered();
  card.describe(
      "The first axis points along V1; the second lies in the plane of V1 and V2, on the side of V2; the third completes a "
      "right-handed frame. In a cylindrical frame the coordinates of a node are radius, angle (degrees) and height; in a "
      "spherical "
      "one radius, longitude and latitude (degrees).");
  card.add("ORIGIN", &FrameCard::origin, "origin").synonyms({"ORIGINE"}).unit(dimension::length);
  card.add("V1", &FrameCard::first, "direction of the first axis");
  card.add("V2", &FrameCard::second, "a direction in the half plane of the second axis");
  card.add("TYPE", &FrameCard::kind, "kind of coordinates")
      .positional()
      .option({"CARTESIAN", {"CARTESIEN"}, "x, y, z"})
      .option({"CYLINDRICAL", {"CYLINDRIQUE"}, "radius, angle in degrees, height"})
      .option({"SPHERICAL", {"SPHERIQUE"}, "radius, longitude and latitude in degrees"});
  card.example(".FRAME\n I 3 ORIGIN 0 0 10 V1 0 1 0 V2 0 0 1 CYL");
  return card.schema();
}

const char* content_of(const GroupCard& group) {
  return group.kind.is("NODES") ? "nodes" : group.kind.is("FACES") ? "faces" : "elements";
}

/// Why two records of one number cannot be one group; empty if they can.
std::string contradiction(const GroupCard& earlier, const GroupCard& later) {
  if (earlier.kind.tag != later.kind.tag) return fmt::format("of {} and of {}", content_of(earlier), content_of(later));
  const bool renamed = !earlier.name.empty() && !later.name.empty() && earlier.name != later.name;
  if (renamed) return fmt::format("named \"{}\" and \"{}\"", earlier.name, later.name);
  if ((earlier.of_file || later.of_file) && earlier.name != later.name) return "in a mesh file and elsewhere";
  return {};
}

/// Groups of one number, or of one name and kind, are one group.
void unite_groups(const std::vector<Record*>& records, Diagnostics& diagnostics) {
  std::vector<std::vector<GroupCard*>> groups;
  struct Known {
    std::size_t group;
    const Record* first;
  };
  std::map<int, Known> by_number;
  std::map<std::pair<std::string, std::string>, Known> by_name;
  const auto find = [](const auto& known, const auto& key) {
    const auto found = known.find(key);
    return found == known.end() ? nullptr : &found->second;
  };
  int largest = 0;
  for (const Record* record : records) largest = std::max(largest, record->id);
  for (Record* record : records) {
    auto& card = std::any_cast<GroupCard&>(record->data);
    const auto name = std::pair(card.kind.tag, card.name);
    const Known* numbered = find(by_number, card.number);
    const Known* named = card.name.empty() ? nullptr : find(by_name, name);
    std::string wrong = numbered ? contradiction(*groups[numbered->group].front(), card) : "";
    if (!wrong.empty() && card.of_file) {
      card.number = record->id = ++largest;
      numbered = nullptr;
      wrong.clear();
    }
    if (wrong.empty() && numbered && named && numbered->group != named->group)
      wrong = fmt::format("and \"{}\" is another group, in line {}", card.name, named->first->location.line);
    if (!wrong.empty()) {
      diagnostics.error(record->location, fmt::format(".SEL {} is given twice, {}", card.number, wrong),
                        fmt::format("first in line {}; records of one number, or of one name and kind, are one group",
                                    numbered->first->location.line));
      record->faulty = true;
      continue;
    }
    const std::size_t group = numbered ? numbered->group : named ? named->group : groups.size();
    if (group == groups.size()) groups.emplace_back();
    groups[group].push_back(&card);
    by_number.try_emplace(card.number, Known{group, record});
    if (!card.name.empty()) by_name.try_emplace(name, Known{group, record});
  }
  for (const std::vector<GroupCard*>& group : groups) {
    std::vector<std::string> names;
    for (const GroupCard* card : group)
      for (const std::string& name : {card->name, std::to_string(card->number)})
        if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    for (GroupCard* card : group) {
      card->group = group.front()->number;
      card->names = names;
    }
  }
}

Schema group_card() {
  Card<GroupCard> card(".SEL", {".SELECTION"}, "Named groups of nodes, elements or faces");
  card.chapter(model_chapter).key("GROUP");
  card.describe(
      "What a group holds is given by numbers and ranges (`1 A 20`, or `I 1 J 20 K 1`: from, to, step; `I 7`), by TOUT, by a "
      "box, by other groups, or by the attribute of elements; several of these add up. Faces are given one by one only, by their "
      "cell and their number there (`I 57 3`), without TOUT, BOITE or UNION. Other cards name a group by its number or by its "
      "name. Records of one number, or of "
      "one "
      "name and kind, are one group: later ones add to it. A condition or load on nodes is for those that the records above it "
      "name.");
  card.add("NOM", &GroupCard::name, "name").synonyms({"NAME"});
  card.add("KIND", &GroupCard::kind, "what the group holds")
      .synonyms({"GENRE"})
      .positional()
      .option({"NODES", {"NOEUDS", "NOEUD"}, "nodes"})
      .option({"ELEMENTS", {"MAILLES", "MAILLE"}, "elements"})
      .option({"FACES", {"FACE", "ARETES", "ARETE"}, "faces of cells, edges in a plane: rows `I cell face`"});
  card.add("IDS", &GroupCard::ids, "numbers and ranges").refers(Reference::node).at_least(1).positional().repeats();
  card.add("TOUT", &GroupCard::all, "all of them").synonyms({"ALL"});
  card.add("UNION", &GroupCard::united, "other groups whose members belong to this one")
      .refers(Reference::group)
      .values(1, any_number);
  card.add("BOITE", &GroupCard::box, "nodes in the box xmin xmax ymin ymax zmin zmax, or cells of which all nodes are in it")
      .synonyms({"BOX"})
      .unit(dimension::length)
      .values(6, 6);
  card.add("AT", &GroupCard::attribute, "elements with this attribute").synonyms({"ATTRIBUTE", "ATTRIBUT"});
  card.unite(unite_groups);
  card.finish([](GroupCard& group, Record& record, Diagnostics& diagnostics) {
    group.number = record.id;
    if (group.kind.is("FACES")) {
      if (group.ids.empty() || group.ids.size() % 2 != 0 || group.all || !group.united.empty() || !group.box.empty() ||
          group.attribute)
        diagnostics.error(record.location, "group " + std::to_string(record.id) + " of faces needs pairs of numbers",
                          "a row `I 57 3` for each: the number of a cell, then that of its face");
      return;
    }
    if (!group.all && group.ids.empty() && group.united.empty() && group.box.empty() && !group.attribute)
      diagnostics.error(record.location, "group " + std::to_string(record.id) + " holds nothing",
                        "give numbers, TOUT, UNION, BOITE or AT");
    for (std::size_t axis = 0; axis + 1 < group.box.size(); axis += 2)
      if (group.box[axis] > group.box[axis + 1])
        diagnostics.error(record.where("BOITE"), "the box ends before it starts", "give xmin xmax ymin ymax zmin zmax");
  });
  card.example(".SEL\n GROUP 1 NOM \"hub\" NOEUDS 1 2 10 A 20\n GROUP 2 NOM \"all\" NOEUDS TOUT");
  return card.schema();
}

Schema material_card() {
  Card<MaterialCard> card(".MAT", {".MATERIAL"}, "Materials");
  card.chapter(model_chapter).numbered();
  card.add("NOM", &MaterialCard::name, "name").synonyms({"NAME"});
  card.add("BEHA", &MaterialCard::behaviour, "behaviour of cells: \"ELASTIC\", or \"NEO-HOOKEAN\" for large strains")
      .synonyms({"BEHAVIOUR", "BEHAVIOR", "COMPORTEMENT"});
  card.add("YT", &MaterialCard::young, "Young's modulus: one, or those along three axes")
      .synonyms({"YOUNG"})
      .unit(dimension::pressure)
      .positive()
      .values(1, 3);
  card.add("NT", &MaterialCard::poisson,
           "Poisson's ratio: one, or ν12 ν23 ν13 (ν12: contraction along axis 2 for a pull along axis 1)")
      .synonyms({"POISSON", "NU"})
      .values(1, 3);
  card.add("G", &MaterialCard::shear, "shear moduli G12 G23 G13 of an orthotropic material")
      .synonyms({"GT"})
      .unit(dimension::pressure)
      .positive()
      .values(1, 3);
  card.add("M", &MaterialCard::density, "mass per volume").synonyms({"DENSITY", "DENSITE"}).unit({-3, 1, 0, 0}).at_least(0);
  card.add("A", &MaterialCard::expansion, "coefficient of thermal expansion, per degree: one, or those along three axes")
      .synonyms({"EXPANSION"})
      .values(1, 3);
  card.add("DAMPING", &MaterialCard::damping,
           "damping of cells and beams (Kelvin and Voigt): the time by which stiffness is multiplied to resist rates of strain")
      .synonyms({"AMORTISSEMENT"})
      .unit(dimension::time)
      .at_least(0);
  card.finish([](MaterialCard& data, Record& record, Diagnostics& diagnostics) {
    for (const auto& [keyword, values] : {std::pair("YT", &data.young), std::pair("NT", &data.poisson),
                                          std::pair("G", &data.shear), std::pair("A", &data.expansion)})
      if (values->size() == 2)
        diagnostics.error(record.where(keyword), std::string(keyword) + " takes 1 or 3 values, 2 given",
                          "one of an isotropic material, three of an orthotropic one");
    if (data.poisson.size() == 1 && !(data.poisson.front() > -1 && data.poisson.front() <= 0.5))
      diagnostics.error(record.where("NT"), fmt::format("NT = {} is out of range", data.poisson.front()),
                        "NT (Poisson's ratio) is greater than -1 and at most 0.5");
  });
  card.example(".MAT\n I 1 NOM \"steel\" BEHA \"ELASTIC\" YT 2.1E+11 NT 0.3 M 7850.");
  card.example(".MAT\n I 2 NOM \"ply\" BEHA \"ELASTIC\" YT 140000. 10000. 10000. NT 0.3 0.45 0.3 G 5000. 3400. 5000.");
  card.example(".MAT\n I 3 NOM \"rubber\" BEHA \"NEO-HOOKEAN\" YT 1.5E+6 NT 0.49 M 1100.");
  return card.schema();
}

}  // namespace

std::vector<Schema> model_cards() {
  return {unit_card(), title_card(), node_card(), frame_card(), group_card(), material_card()};
}

const std::vector<Schema>& general_commands() {
  static const std::vector<Schema> all = [] {
    std::vector<Schema> cards = model_cards();
    for (std::vector<Schema> more : {mesh_cards(), {profile_card()}, condition_cards(), analysis_cards(), stability_cards()})
      cards.insert(cards.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    return cards;
  }();
  return all;
}

}  // namespace engrane::deck
