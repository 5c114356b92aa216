// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/group_pressure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "elements/structural/pressures.hpp"
#include "model/groups.hpp"

namespace engrane::elements::structural {

namespace {

std::unique_ptr<Element> build(const GroupPressureData& data, BuildContext& context) {
  const Function* function = nullptr;
  if (data.function != 0 && !(function = context.function(data.function, "NF"))) return nullptr;
  const std::shared_ptr<const CellBook> book = CellBook::of(context);
  std::unique_ptr<Element> first;
  int number = context.number;
  std::set<std::pair<int, int>> pushed;  // a face of several groups carries the pressure once
  bool only_empty = true;
  for (const std::string& name : data.groups) {
    const std::vector<int> cells = book->cells(name);
    const auto is_no_skin = [&](int cell) {
      const auto section = book->section(cell);
      return section && !section->skin;
    };
    if (const auto other = std::find_if(cells.begin(), cells.end(), is_no_skin); other != cells.end()) {
      only_empty = false;
      context.error("GROUP", fmt::format("cell {} of group \"{}\" is no membrane", *other, name),
                    "a pressure on other cells is given by .SEL GROUP n FACES");
      continue;
    }
    std::vector<int> of_skins;  // (cell, face) pairs; a membrane has face 1 only
    for (const int cell : cells) of_skins.insert(of_skins.end(), {cell, 1});
    for (const int element : book->other_elements(name))
      if (book->membrane(element)) of_skins.insert(of_skins.end(), {element, 1});
    const std::vector<int>* faces = of_skins.empty() ? book->faces(name) : &of_skins;
    if (!faces && book->has_group(name)) continue;
    only_empty = false;
    if (!faces) {
      context.diagnostics.missing(".SEL", context.record.where("GROUP"), fmt::format("there is no group of faces \"{}\"", name),
                                  "declare it with .SEL GROUP n FACES, and a row `I 57 3` (cell, face) for each");
      continue;
    }
    for (std::size_t i = 0; i + 1 < faces->size(); i += 2) {
      if (!pushed.emplace((*faces)[i], (*faces)[i + 1]).second) continue;
      auto one =
          make_pressure({(*faces)[i], (*faces)[i + 1], data.pressure, function, data.dead}, number, "GROUP", *book, context);
      if (!one) continue;
      ++number;
      if (!first)
        first = std::move(one);
      else if (context.more)
        context.more->push_back(std::move(one));
    }
  }
  if (only_empty) warn_of_no_effect(context.record, data.groups, "elements", context.diagnostics);
  return first;
}

}  // namespace

ElementType group_pressure_type() {
  deck::Card<GroupPressureData> card(".CLM PRE", {".BOUNDARY", "PRESSION", "PRESSURE"}, "Pressure on groups of faces");
  card.chapter("Boundary conditions, loads and functions")
      .redefines()
      .describe(
          "On all faces of groups of faces (`.SEL GROUP n FACES`), of solids or of plane cells, or on groups of membranes, cells "
          "or elements (`.SEL GROUP "
          "n MAILLES`). A positive pressure pushes into the cells, and membranes to the side from which their corners go "
          "round counterclockwise. With large displacements it follows the faces unless it is DEAD.")
      .example(".CLM\n GROUP \"flank\" PRE V 5. DEAD\n PRE GROUP \"bore\" V 2. NF 1");
  card.add("GROUP", &GroupPressureData::groups, "groups of faces, or of membranes: names or numbers")
      .refers(deck::Reference::group)
      .values(1, deck::any_number)
      .required()
      .leads();
  card.add("V", &GroupPressureData::pressure, "pressure, positive into the cells")
      .synonyms({"VAL"})
      .unit(dimension::pressure)
      .required();
  card.add("DEAD", &GroupPressureData::dead, "it keeps the direction and the area of each face in the reference configuration")
      .synonyms({"MORTE"});
  card.add("NF", &GroupPressureData::function, "number of the function of time; 0: constant")
      .refers(deck::Reference::function)
      .at_least(0);
  return element_type(card, build);
}

}  // namespace engrane::elements::structural
