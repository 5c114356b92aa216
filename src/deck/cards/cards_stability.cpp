// SPDX-License-Identifier: BSD-3-Clause
#include "deck/cards/card_chapters.hpp"
#include "deck/cards/cards.hpp"
#include "deck/schema/card.hpp"

namespace engrane::deck {

namespace {

constexpr const char* stability_chapter = "Analysis";

Schema path_card() {
  Card<PathCard> card(".PATH", {".RIKS"}, "Equilibria are followed by the length of their path, past limit loads");
  card.chapter(stability_chapter).once();
  card.describe(
      "Of a STATIC analysis. The time of functions is one more unknown, and may fall: channel LOAD_TIME of the run. The time of "
      "the "
      "results is the length of the path, in such a unit that at the start it passes as LOAD_TIME does. H of `.SUB` is the first "
      "step; the others follow the curvature of the path and the iterations. The run ends where LOAD_TIME is TF, or before, "
      "where "
      "NODE or STEPS ask for it. Functions should go on changing outside of the run as well, as EXPR \"T\" does: a TABLE holds "
      "its first value before its first point, and a path that comes back there cannot go on. Limit points and bifurcation "
      "points are located and listed, with their modes.");
  card.add("STEPS", &PathCard::steps, "the run ends after so many steps at the latest").synonyms({"PAS"}).at_least(1);
  card.add("NODE", &PathCard::node, "the run ends where component C of the displacement of this node is V")
      .synonyms({"NOEUD"})
      .refers(Reference::node)
      .at_least(1);
  card.add("C", &PathCard::component, "NODE: component, 1 to 3").synonyms({"COMP"}).at_least(1).at_most(3);
  card.add("V", &PathCard::displacement, "NODE: displacement from the reference").synonyms({"VAL"}).unit(dimension::length);
  card.add("BRANCH", &PathCard::branch,
           "at this bifurcation point, counted from 1, the path goes on along the mode: the other path that crosses there")
      .synonyms({"BRANCHE"})
      .at_least(1);
  card.add("AMPLITUDE", &PathCard::amplitude,
           "BRANCH: largest displacement of a node in the step along the mode; its sign chooses the side")
      .unit(dimension::length);
  card.finish([](PathCard& path, Record& record, Diagnostics& diagnostics) {
    if (path.node && !(path.component && path.displacement))
      diagnostics.error(record.where("NODE"), "NODE needs C, a component, and V, the displacement at which the run ends");
    if (!path.node)
      for (const char* keyword : {"C", "V"})
        if (record.given(keyword))
          diagnostics.error(record.where(keyword), std::string(keyword) + " belongs to NODE, and there is none");
    if (path.branch && !path.amplitude)
      diagnostics.error(record.where("BRANCH"), "BRANCH needs AMPLITUDE, the displacement to leave the first path by",
                        "a thousandth of the size of the model is a start");
    if (path.amplitude && !path.branch)
      diagnostics.error(record.where("AMPLITUDE"), "AMPLITUDE belongs to BRANCH, and there is none", "give BRANCH 1");
    if (path.amplitude && *path.amplitude == 0) diagnostics.error(record.where("AMPLITUDE"), "AMPLITUDE must not be 0");
  });
  card.example(".PATH").example(".PATH NODE 21 C 2 V -95").example(".PATH BRANCH 1 AMPLITUDE 0.5 STEPS 60");
  return card.schema();
}

Schema buckling_card() {
  Card<BucklingCard> card(".BUCKLING", {".FLAMBEMENT"}, "Linearised buckling: the loads that make the tangent singular");
  card.chapter(stability_chapter).once();
  card.describe(
      "Of a STATIC analysis. The tangent matrix is continued along the loads as it changes at one equilibrium, and the times of "
      "functions "
      "nearest to it at which it is singular are found, with their modes. With loads in proportion to time and BASE START these "
      "times "
      "are factors of the loads at time 1. Displacements of members before they buckle are left out, as usual; a warning tells "
      "where they count.");
  card.add("MODES", &BucklingCard::modes, "how many").synonyms({"NOMBRE", "NVAL"}).at_least(1).at_most(1000);
  card.add("BASE", &BucklingCard::base, "the equilibrium that the tangent is continued from")
      .option({"START", {"DEBUT"}, "the first, at TI, with the loads that do not grow from zero"})
      .option({"END", {"FIN"}, "the last, with all loads: nearer to a buckling load its change is better known"});
  card.example(".BUCKLING MODES 4").example(".BUCKLING MODES 1 BASE END");
  return card.schema();
}

}  // namespace

std::vector<Schema> stability_cards() { return {path_card(), buckling_card()}; }

}  // namespace engrane::deck
