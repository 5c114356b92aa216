// SPDX-License-Identifier: BSD-3-Clause
#include "deck/cards/card_chapters.hpp"
#include "deck/cards/cards.hpp"
#include "deck/cards/mesh_cards.hpp"
#include "deck/schema/card.hpp"

namespace engrane::deck {

namespace {

constexpr const char* mesh_chapter = "Meshes";

Schema hypothesis_card() {
  Card<HypothesisCard> card(".HYP", {".HYPOTHESIS", ".HYPOTHESE"}, "Which formulation the cells of a group get");
  card.chapter(mesh_chapter);
  card.describe(
      "`MEMB BIDIM` (or `CONT PLAN`) is plane stress, `DEFO PLAN` plane strain, `AXIS` axisymmetric about the global y axis with "
      "radius x; `MEMBRANE` alone makes cells in space membranes, as the element MEMBRANE; solids have VOLUME, also without a "
      "record. Cells of two nodes, or three, need `BEAM`, as all but solids need a record. Other formulations of BACON are "
      "refused by their name. Of several records on a cell the last holds.");
  card.add("FORMULATION", &HypothesisCard::formulation,
           "MEMBRANE, CONTRAINTE, DEFORMATION, AXISYMETRIQUE, VOLUME, or BEAM (POUTRE), or their beginning")
      .positional()
      .required();
  card.add("VARIANT", &HypothesisCard::variant, "BIDIM behind MEMBRANE of the plane, PLANE behind the others").positional();
  card.add("GROUP", &HypothesisCard::groups, "groups of cells: names or numbers; none: all cells")
      .refers(Reference::group)
      .values(1, any_number);
  card.example(".HYP BEAM GROUP \"frame\"");
  card.add("TENSION", &HypothesisCard::tension, "of membranes: stress in all directions in the reference configuration")
      .unit(dimension::pressure);
  card.add("WRINKLING", &HypothesisCard::wrinkling, "of membranes: they wrinkle instead of being pressed").synonyms({"PLIS"});
  card.add("SLACK", &HypothesisCard::slack, "part of their stiffness that is left where they wrinkle; without it 1E-4")
      .at_least(0)
      .at_most(1);
  card.example(".HYP MEMB BIDIM GROUP \"web\"").example(".HYP DEFO PLAN GROUP \"dam\"").example(".HYP AXIS GROUP \"ring\"");
  card.example(".HYP MEMBRANE GROUP \"sail\" TENSION 1D4 WRINKLING");
  return card.schema();
}

Schema property_card() {
  Card<PropertyCard> card(".PHP", {".PROPERTIES"}, "Physical properties of cells");
  card.chapter(mesh_chapter);
  card.add("GROUP", &PropertyCard::groups, "groups of cells: names or numbers")
      .refers(Reference::group)
      .values(1, any_number)
      .required()
      .leads();
  card.add("THICK", &PropertyCard::thickness, "thickness; plane strain without it has 1")
      .synonyms({"EPAISSEUR", "THICKNESS"})
      .unit(dimension::length)
      .filler({"VAL", "V"})
      .positive()
      .required();
  card.example(".PHP\n GROUP \"web\" THICK VAL 8.");
  return card.schema();
}

Schema assignment_card() {
  Card<AssignmentCard> card(".AEL", {".ASSIGN"}, "Materials and material axes of cells");
  card.chapter(mesh_chapter);
  card.add("I", &AssignmentCard::cells, "cells: one, or a range `I 1 J 72 K 1`").refers(Reference::element).at_least(1).leads();
  card.add("GROUP", &AssignmentCard::groups, "groups of cells: names or numbers")
      .refers(Reference::group)
      .values(1, any_number)
      .leads();
  card.add("MAT", &AssignmentCard::material, "number of the `.MAT`").synonyms({"MATERIAL", "MATERIAU"}).at_least(1);
  card.add("THETA", &AssignmentCard::theta,
           "angle about the z axis from the x axis to the first axis of the material, in degrees");
  card.add("FRAME", &AssignmentCard::frame,
           "`.FRAME` whose axes are meant instead of the global ones; of a cylindrical one the radial, the circumferential and "
           "the third axis, at each point")
      .synonyms({"REPERE"})
      .at_least(1);
  card.add("BPR", &AssignmentCard::profile, "of beams: number of the section in `.BPR`").synonyms({"SECTION"}).at_least(1);
  card.add("AXIS2", &AssignmentCard::axis_2, "of beams: across them, on the side of axis 2 of their sections").synonyms({"AXE2"});
  card.finish([](AssignmentCard& data, Record& record, Diagnostics& diagnostics) {
    if (data.cells.empty() && data.groups.empty())
      diagnostics.error(record.location, ".AEL names no cells", "I 1 J 72 K 1 MAT 1, or GROUP \"plate\" MAT 1");
    if (!data.material && !data.theta && !data.frame && !data.profile && !data.axis_2)
      diagnostics.error(record.location, ".AEL gives the cells nothing",
                        "MAT the number of a material, THETA an angle, FRAME axes, BPR a section, AXIS2 its direction");
  });
  card.example(".AEL\n GROUP \"frame\" MAT 1 BPR 2 AXIS2 0 0 1");
  card.example(".AEL\n I 1 J 72 K 1 MAT 1\n I 3 THETA 30.");
  return card.schema();
}

}  // namespace

std::vector<Schema> mesh_cards() { return {hypothesis_card(), property_card(), assignment_card()}; }

}  // namespace engrane::deck
