// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/pressure.hpp"

#include "elements/structural/pressures.hpp"

namespace engrane::elements::structural {

namespace {

std::unique_ptr<Element> build(const PressureData& data, BuildContext& context) {
  const Function* function = nullptr;
  if (data.function != 0 && !(function = context.function(data.function, "NF"))) return nullptr;
  const PressureOn on{data.face[0], data.face[1], data.pressure, function, data.dead};
  return make_pressure(on, context.number, "I", *CellBook::of(context), context);
}

}  // namespace

ElementType pressure_type() {
  deck::Card<PressureData> card(".CLM ARETE", {".BOUNDARY", "EDGE", "FACE"}, "Pressure on an edge or a face of a cell");
  card.chapter("Boundary conditions, loads and functions")
      .redefines()
      .describe(
          "Edge k of a plane cell goes from its corner k to the next. Face 1 of a solid is its base, then come those on the "
          "sides "
          "of the base in turn, the last one is the top. A positive pressure pushes into the cell, on an edge with its "
          "thickness. "
          "With large displacements it follows the face unless it is DEAD.")
      .example(".CLM\n ARETE I 57 3 PRE V 1000.\n ARETE I 58 3 PRE V 1000. DEAD NF 2")
      .example(".CLM\n FACE I 12 6 PRE V 5.");
  card.add("I", &PressureData::face, "number of the cell and of its edge or face").at_least(1).required().leads();
  card.add("PRE", &PressureData::pressure, "pressure, positive into the cell")
      .synonyms({"PRESSION", "PRESSURE"})
      .unit(dimension::pressure)
      .filler({"V", "VAL"})
      .required();
  card.add("DEAD", &PressureData::dead, "it keeps the direction and the area of the face in the reference configuration")
      .synonyms({"MORTE"});
  card.add("NF", &PressureData::function, "number of the function of time; 0: constant")
      .refers(deck::Reference::function)
      .at_least(0);
  return element_type(card, build);
}

}  // namespace engrane::elements::structural
