// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "deck/cards/card_chapters.hpp"
#include "deck/cards/cards.hpp"
#include "deck/schema/card.hpp"

namespace engrane::deck {

namespace {

constexpr const char* analysis_chapter = "Analysis";
constexpr const char* result_chapter = "Results and checks";

void check_analysis(AnalysisCard& analysis, Record& record, Diagnostics& diagnostics) {
  const bool chung = analysis.scheme.is("CHUNG");
  const bool damped = analysis.scheme.is("HHT") || analysis.scheme.is("BOSSAK");
  if (analysis.rho && !chung)
    diagnostics.error(record.where("RHO"), "RHO belongs to SCHEME CHUNG, not to " + analysis.scheme.tag);
  if (analysis.alpha && !damped)
    diagnostics.error(record.where("ALPHA"), "ALPHA belongs to the schemes HHT and BOSSAK, not to " + analysis.scheme.tag);
  if (!analysis.events.values.empty() && !(analysis.events.values[0] > 0 && analysis.events.values[0] <= 0.01))
    diagnostics.error(record.where("EVENTS"), "the tolerance of EVENTS is a fraction of H, from above 0 to 0.01");
  if (analysis.restart_time && analysis.restart.empty())
    diagnostics.error(record.where("T"), "T is the time of a restart point, and there is no RESTART",
                      "give RESTART \"prefix\" T t");
  if (analysis.scheme.is("RADAU") && record.given("TANGENT"))
    diagnostics.warning(record.where("TANGENT"), "TANGENT has no effect on SCHEME RADAU, which always keeps its factors");
  if (analysis.accuracy.given() && analysis.type.is("DYNAMIC")) {
    analysis.scheme_is_free = !record.given("SCHEME") && !analysis.rho && !analysis.alpha;
    if (analysis.scheme_is_free) analysis.scheme.tag = "RADAU";
    if (!record.given("SOLVER")) analysis.solver.tag = "AUTO";
    if (!record.given("PLANE")) analysis.plane.tag = "AUTO";
  }
  if (analysis.type.is("DYNAMIC")) return;
  for (const char* keyword : {"ACCURACY", "SCHEME", "RHO", "ALPHA", "START", "EVENTS", "ENERGY", "TANGENT"})
    if (record.given(keyword))
      diagnostics.warning(record.where(keyword), std::string(keyword) + " has no effect on a " + analysis.type.tag + " analysis");
}

Schema analysis_card() {
  Card<AnalysisCard> card(".SAM", {".ANALYSIS", ".ANALYSE"}, "Kind of analysis, time integration and solver");
  card.chapter(analysis_chapter).once();
  card.add("TYPE", &AnalysisCard::type, "kind of analysis")
      .option({"STATIC", {"STATIQUE"}, "equilibrium, step by step along the loading"})
      .option({"KINEMATIC", {"CINEMATIQUE"}, "motion of a mechanism whose drives leave it no freedom"})
      .option({"DYNAMIC", {"DYNAMIQUE"}, "motion in time with inertia"});
  card.add("SCHEME", &AnalysisCard::scheme, "time integration of a DYNAMIC analysis")
      .synonyms({"SCHEMA"})
      .option({"CHUNG", {}, "generalised-alpha of Chung and Hulbert, damping set by RHO"})
      .option({"NEWMARK", {}, "Newmark, without damping"})
      .option({"HHT", {}, "Hilber, Hughes and Taylor, damping set by ALPHA"})
      .option({"BOSSAK", {}, "Wood, Bossak and Zienkiewicz, damping set by ALPHA"})
      .option({"RADAU", {}, "Radau IIA of order 5: accurate results with long steps"});
  card.add("ACCURACY", &AnalysisCard::accuracy,
           "how accurate a DYNAMIC analysis is to be: chooses scheme, TOL of .SUB, PREC, solver and PLANE where the deck does "
           "not; "
           "a preliminary run with longer steps estimates the error of the requested results, relative to their range")
      .synonyms({"EXACTITUDE"})
      .option({"FAST", {"RAPIDE"}, "1E-2"})
      .option({"NORMAL", {}, "1E-3"})
      .option({"FINE", {"FIN"}, "1E-5"})
      .option({"REFERENCE", {}, "1E-8"});
  card.add("RHO", &AnalysisCard::rho, "CHUNG: spectral radius at infinite frequency; 1 damps nothing, 0 most")
      .at_least(0)
      .at_most(1);
  card.add("ALPHA", &AnalysisCard::alpha, "HHT and BOSSAK: numerical damping; 0 damps nothing").at_least(0).at_most(1.0 / 3.0);
  card.add(
          "SOLVER", &AnalysisCard::solver,
          "solver of the linear systems. With several processes, one of them solves systems of up to 3000 equations, with any of "
          "these; all together solve larger ones, with MUMPS, BLR or CG")
      .synonyms({"SOLVEUR"})
      .option({"MUMPS", {}, "multifrontal"})
      .option(
          {"AUTO", {}, "the cheaper one of KLU and MUMPS, as their operations foretell; MUMPS where processes solve together"})
      .option({"KLU", {}, "fastest for mechanisms"})
      .option({"UMFPACK", {}, "multifrontal, serial"})
      .option({"SUPERLU", {}, "supernodal, serial"})
      .option(
          {"BLR",
           {},
           "MUMPS with blocks of low rank (tolerance 1E-9, solutions refined): less memory for factors of a million equations "
           "and more; of full rank where a solution is not good enough"})
      .option({"CG",
               {},
               "conjugate gradients with algebraic multigrid, on any number of processes: for meshes of solids whose factors do "
               "not fit into memory"});
  card.add("START", &AnalysisCard::start, "state from which a DYNAMIC analysis starts")
      .synonyms({"DEPART"})
      .option({"AS_GIVEN", {}, "the given positions, brought to satisfy the joints"})
      .option({"STATIC", {"STATIQUE"}, "static equilibrium under the loads of the first instant"});
  card.add("PREC", &AnalysisCard::precision,
           "precision of Newton's iterations, relative to the largest force in the model; 1E-9 when not given, and with SCHEME "
           "RADAU a hundredth of TOL")
      .synonyms({"PRECISION"})
      .positive()
      .below(1);
  card.add("TANGENT", &AnalysisCard::tangent,
           "how often a DYNAMIC analysis computes and factors the tangent of Newton's iterations")
      .synonyms({"TANGENTE", "JACOBIAN"})
      .option({"FULL", {"COMPLET"}, "in each iteration: convergence is quadratic, and ends far below PREC"})
      .option({"KEPT", {"MODIFIED", "MODIFIE"}, "factors are reused for as long as this saves time; iterations end at PREC"});
  card.add("ITMA", &AnalysisCard::iterations, "most Newton iterations before a step is cut")
      .synonyms({"ITMAX", "ITERATIONS"})
      .at_least(1)
      .at_most(1000);
  card.add("CUTS", &AnalysisCard::cuts, "how often a step may be halved").synonyms({"COUPES"}).at_least(0).at_most(50);
  card.add("DISPLACEMENTS", &AnalysisCard::displacements,
           "of the cells of a mesh: small, so that forces are linear in them, or of any size; SMALL when the deck has neither "
           "TYPE "
           "nor `.SUB`, and then the analysis is one step; else LARGE")
      .synonyms({"DEPLACEMENTS"})
      .option({"SMALL", {"PETITS", "LINEAR"}, "strains and forces of the undeformed configuration"})
      .option({"LARGE", {"GRANDS", "NONLINEAR"}, "the strains of Green and Lagrange"});
  card.add("MASS", &AnalysisCard::mass, "of the cells of a mesh, for inertia, weight and centrifugal loads alike")
      .synonyms({"MASSE"})
      .option({"CONSISTENT", {"COHERENTE"}, "by the shape functions of the displacements"})
      .option({"LUMPED", {"CONCENTREE", "DIAGONAL"}, "at the nodes, so that the mass matrix is diagonal"});
  card.add("PLANE", &AnalysisCard::plane,
           "whether the mechanism is solved in a plane: three unknowns a node, and no constraints out of it")
      .synonyms({"PLAN"})
      .option({"NO", {"NON"}, "in space"})
      .option({"AUTO", {}, "in the coordinate plane that all motion stays in; in space where there is none"})
      .option({"XY", {}, "in the plane XY; an error names what leads out of it"})
      .option({"YZ", {}, "the same in the plane YZ"})
      .option({"ZX", {"XZ"}, "the same in the plane ZX"});
  card.add("EVENTS", &AnalysisCard::events, "whether a DYNAMIC analysis ends steps where teeth begin and cease to touch")
      .synonyms({"EVENEMENTS"})
      .option({"YES",
               {"OUI"},
               "each such instant is located, to a fraction of the step that may follow (1E-6; "
               "with TOL half of it), as far as rounding lets it",
               0,
               1})
      .option({"NO", {"NON"}, "steps pass over them"});
  card.add(
          "ENERGY", &AnalysisCard::energy,
          "a DYNAMIC analysis ends with an error when its energy balance is off by more than this part of the energy that was in "
          "the machine at the start or has passed through it since, and warns above 5 per cent of that energy; 0: neither")
      .synonyms({"ENERGIE"})
      .at_least(0);
  card.add("SCALE", &AnalysisCard::scale, "scale factor of the constraint equations; automatic when not given")
      .synonyms({"ECHELLE"})
      .positive();
  card.add("PENALTY", &AnalysisCard::penalty,
           "penalty p of the constraint equations, beside the multipliers; none when not given")
      .synonyms({"PENALITE"})
      .at_least(0);
  card.add(
          "RESTART", &AnalysisCard::restart,
          "continue these results (a path without .h5, from the folder where the program is started) from a restart point; "
          "`.SUB`, "
          "`.SAM`, `.SAI`, "
          "checks, loads and temperatures (all of `.CLM` but FIX and DEP) "
          "and functions may differ from the run that wrote them; the model may not, and supports and elements of `.MCE` such as "
          "FORCE are part of it. Drives must begin where the restart point stands; where their speeds differ from those up to "
          "there, "
          "velocities change as in an impact with TOL or ACCURACY, and fixed steps are warned of. `.INI` has no effect")
      .synonyms({"REPRISE"});
  card.add("T", &AnalysisCard::restart_time,
           "RESTART: time of the restart point, the last one up to then; the last of all when not given")
      .synonyms({"TIME", "TEMPS"})
      .unit(dimension::time);
  card.finish(check_analysis);
  card.example(".SAM TYPE STATIC")
      .example(".SAM TYPE DYNAMIC ACCURACY NORMAL")
      .example(".SAM TYPE DYNAMIC SCHEME CHUNG RHO 0.8")
      .example(".SAM TYPE DYNAMIC RESTART \"first_run\" T 0.5");
  return card.schema();
}

Schema stepping_card() {
  Card<SteppingCard> card(".SUB", {".STEPS"}, "The span of time and the step");
  card.chapter(analysis_chapter).once();
  card.describe("In a static analysis time is the parameter of the loading.");
  card.add("TF", &SteppingCard::end, "final time").unit(dimension::time).required();
  card.add("H", &SteppingCard::step, "time step; steps that do not converge are cut")
      .synonyms({"DT", "PAS"})
      .unit(dimension::time)
      .positive()
      .required();
  card.add(
          "TOL", &SteppingCard::tolerance,
          "DYNAMIC and STATIC: the program chooses steps whose local error is at most this part of the range of each motion, and "
          "ends them at corners of functions of time and at the points of a SPLINE; H is then the first step and the time "
          "between results")
      .synonyms({"TOLERANCE"})
      .positive()
      .below(1);
  card.add("HMAX", &SteppingCard::longest, "longest step with TOL or ACCURACY; a 50th of the time span when not given")
      .unit(dimension::time)
      .positive();
  card.add("TI", &SteppingCard::start, "initial time").unit(dimension::time);
  card.finish([](SteppingCard& stepping, Record& record, Diagnostics& diagnostics) {
    if ((stepping.end - stepping.start) / stepping.step > 1e9)
      diagnostics.error(record.where("H"), "H makes more than 1e9 steps");
    // a thousand times the spacing of numbers at that time: steps are cut and accumulate
    const double resolution = std::numeric_limits<double>::epsilon() * std::max(std::abs(stepping.start), std::abs(stepping.end));
    if (stepping.step < 1000 * resolution)
      diagnostics.error(record.where("H"),
                        fmt::format("H is too short to be added to a time of {:g}: numbers there are {:.2g} apart",
                                    std::max(std::abs(stepping.start), std::abs(stepping.end)), resolution),
                        "count time from nearer to the motion (TI 0), or take a longer step");
  });
  card.example(".SUB TF 0.03 H 1D-6").example(".SUB TF 2 H 0.01 TOL 1E-4");
  return card.schema();
}

void check_archive(ArchiveCard& archive, Record& record, Diagnostics& diagnostics) {
  if (!archive.keep.given()) return;
  for (const char* keyword : {"ELEMENT", "TYPE", "NOEUD", "GROUP"})
    if (record.given(keyword))
      diagnostics.error(record.where(keyword),
                        std::string(keyword) + " selects histories, and KEEP " + archive.keep.tag + " does too",
                        "leave one of them out");
}

Schema archive_card() {
  Card<ArchiveCard> card(".SAI", {".ARCHIVE", ".SAVE"}, "What is archived, and how often");
  card.chapter(result_chapter);
  card.add("FIELDS", &ArchiveCard::field_step, "time between archived fields; a 200th of the time span when not given")
      .synonyms({"CHAMPS"})
      .filler({"DT"})
      .unit(dimension::time)
      .positive();
  card.add("HISTORY", &ArchiveCard::history_step, "time between samples of the histories; 0: every step")
      .synonyms({"HISTOIRE", "HISTORIQUE"})
      .filler({"DT"})
      .unit(dimension::time)
      .at_least(0);
  card.add("ARCHIVE", &ArchiveCard::archives, "a word of BACON before STYP, without effect").repeats();
  card.add("STRUCTURE", &ArchiveCard::of_structure, "likewise").repeats();
  // by the labels of SAMCEF that Muscat 2.5.2 (IO/SamcefOutputReader.py) copies; docs/legacy.md has other sources
  const char* const stress_at_nodes = "STRESS at nodes";
  const char* const strain_at_nodes = "STRAIN at nodes";
  const char* const stress_of_cells = "STRESS of cells";
  const char* const strain_of_cells = "STRAIN of cells";
  card.add("STYP", &ArchiveCard::codes,
           "result codes of SAMCEF, below zero not to archive; all results are archived, whatever the codes, and codes without "
           "a result here are skipped with a warning. What the results hold for a code:")
      .repeats()
      .codes({{163, "displacement"},
              {191, "rotation"},
              {221, "reaction_force"},
              {223, "reaction_force"},
              {224, "reaction_torque"},
              {901, "the times of the histories"},
              {981, "KINETIC_ENERGY of the run"},
              {982, "POTENTIAL_ENERGY of the run"},
              {984, "EXTERNAL_WORK of the run"},
              {985, "STEP of the run"},
              {1411, stress_at_nodes},
              {1421, strain_at_nodes},
              {1431, stress_at_nodes},
              {1435, stress_at_nodes},
              {1436, stress_at_nodes},
              {1445, strain_at_nodes},
              {1446, strain_at_nodes},
              {3411, stress_of_cells},
              {3421, strain_of_cells},
              {3431, stress_of_cells},
              {3435, stress_of_cells},
              {3436, stress_of_cells},
              {3445, strain_of_cells},
              {3446, strain_of_cells}});
  card.add("ELEMENT", &ArchiveCard::elements, "elements whose histories are kept: ids and ranges")
      .synonyms({"MCE", "ELEMENTS"})
      .refers(Reference::element)
      .at_least(1);
  card.add("TYPE", &ArchiveCard::kinds,
           "types of elements whose histories are kept; several in double quotes: \"GEAR\" \"HINGE\"");
  card.add("NOEUD", &ArchiveCard::nodes, "nodes whose histories are kept: ids and ranges")
      .synonyms({"NOEUDS", "NODES"})
      .refers(Reference::node)
      .at_least(1);
  card.add("GROUP", &ArchiveCard::groups, "groups of nodes or elements whose histories are kept: names or numbers")
      .refers(Reference::group);
  card.add("CHANNEL", &ArchiveCard::channels, "of those, only these histories; several in double quotes: \"NORMAL_FORCE\" \"UX\"")
      .synonyms({"GRANDEUR", "CHANNELS"});
  card.add("KEEP", &ArchiveCard::keep,
           "whose histories are kept where nothing selects them; with no more than 300 elements and nodes all")
      .synonyms({"GARDER"})
      .option({"ALL", {"TOUT"}, "of all elements and nodes, however many"})
      .option({"NONE", {"RIEN"}, "only of the run and of what .CHK asks for"});
  card.add("RESTART", &ArchiveCard::restart_step,
           "time between restart points that stay in the results; there is always one at the end")
      .synonyms({"REPRISE"})
      .filler({"DT"})
      .unit(dimension::time)
      .positive();
  card.add("NEWTON", &ArchiveCard::newton, "the listing shows every Newton iteration");
  card.describe(
      "Histories are kept of all elements and nodes while these are no more than 300 together. Of larger models only those of "
      "the "
      "run, those that .CHK compares, and those that ELEMENT, TYPE, NOEUD and GROUP select. Where these select, nothing else is "
      "kept, in "
      "small models too; CHANNEL alone selects from all elements and nodes. Several records add up. Cells that are selected keep "
      "their fields: each component of STRESS, STRAIN, …, of the points of a cell the value of largest magnitude. CHANNEL names "
      "what else "
      "is wanted: \"STRESS:XX:3\" at point 3, and for nodes \"VON_MISES\" or \"STRESS:XX\", averaged there.");
  card.finish(check_archive);
  card.example(".SAI FIELDS DT 0.001 HISTORY DT 0.0001 NEWTON");
  card.example(".SAI TYPE GEAR NOEUD 4 10 A 20 CHANNEL \"NORMAL_FORCE\" \"UX\" RESTART DT 0.1");
  return card.schema();
}

void check_check(CheckCard& check, Record& record, Diagnostics& diagnostics) {
  const int subjects = (check.element ? 1 : 0) + (check.node ? 1 : 0) + (check.run ? 1 : 0);
  if (subjects != 1)
    diagnostics.error(record.location, subjects == 0 ? "this check has no subject" : "this check has more than one subject",
                      "a check starts with ELEMENT id, NODE id or RUN");
  if (!check.relative && !check.absolute)
    diagnostics.error(record.location, "this check has no tolerance", "give RTOL (relative) or ATOL (absolute)");
  if (check.relative && !check.absolute && check.value == 0)
    diagnostics.error(record.where("RTOL"), "a relative tolerance of the value 0 lets nothing pass", "give ATOL");
  if (check.time && !check.measure.is("VALUE"))
    diagnostics.error(record.where("T"), "T asks for one instant, " + check.measure.tag + " for many",
                      "give WINDOW t0 t1 instead");
  if (!check.window.empty() && check.measure.is("VALUE"))
    diagnostics.error(record.where("WINDOW"), "WINDOW needs a measure", "give MIN, MAX, MEAN, RMS or AMPLITUDE");
  if (check.window.size() == 2 && check.window[1] <= check.window[0])
    diagnostics.error(record.where("WINDOW"), "the window ends before it starts");
}

Schema check_card() {
  Card<CheckCard> card(".CHK", {".CHECK", ".VERIFICATION"}, "Expected results");
  card.chapter(result_chapter);
  card.describe(
      "A check compares one number of the results with a known value. The run prints each check with PASS or FAIL; a failed one "
      "sets "
      "the exit status. A check passes when the difference is at most ATOL or at most RTOL times the value. "
      "ELEMENT, NODE or RUN starts a check. Fields are quantities too, by their names in pictures: of an element VON_MISES or "
      "STRESS:XX is the value of largest magnitude at its points, with its sign, and VON_MISES:3 or STRESS:XX:3 that at point 3; "
      "of a node it is the average of the cells there.");
  card.add("ELEMENT", &CheckCard::element, "the element whose quantity is checked")
      .synonyms({"MCE"})
      .refers(Reference::element)
      .at_least(1)
      .leads();
  card.add("NODE", &CheckCard::node, "the node whose quantity is checked")
      .synonyms({"NOEUD", "NOE"})
      .refers(Reference::node)
      .at_least(1)
      .leads();
  card.add("RUN", &CheckCard::run, "a quantity of the whole model is checked").synonyms({"CALCUL"}).leads();
  card.add("QUANTITY", &CheckCard::quantity, "name of the quantity: NORMAL_FORCE, UX, ENERGY_ERROR, VON_MISES, STRESS:XX, …")
      .synonyms({"GRANDEUR"})
      .positional()
      .required();
  card.add("MEASURE", &CheckCard::measure, "what of the quantity's history; VALUE stands for V where MEASURE is left out")
      .synonyms({"MESURE"})
      .positional()
      .option({"VALUE", {"VALEUR"}, "the value at the time T, or at the end"})
      .option({"MIN", {"MINIMUM"}, "the least"})
      .option({"MAX", {"MAXIMUM"}, "the largest"})
      .option({"MEAN", {"MOYENNE"}, "the mean over time"})
      .option({"RMS", {}, "the root of the mean square over time"})
      .option({"AMPLITUDE", {}, "half of the largest less the least"});
  card.add("T", &CheckCard::time, "the time; the end when not given").synonyms({"TIME", "TEMPS"}).unit(dimension::time);
  card.add("WINDOW", &CheckCard::window, "from when to when a measure is taken; all the time when not given")
      .synonyms({"FENETRE"})
      .unit(dimension::time)
      .values(2, 2);
  card.add("V", &CheckCard::value, "the right value").required();
  card.add("RTOL", &CheckCard::relative, "relative tolerance").at_least(0);
  card.add("ATOL", &CheckCard::absolute, "absolute tolerance").at_least(0);
  card.add("REF", &CheckCard::reference, "where the right value comes from").synonyms({"REFERENCE"});
  card.finish(check_check);
  card.example(
      ".CHK\n ELEMENT 1 NORMAL_FORCE T 1 V 1064.2 RTOL 1e-4 REF \"F = M/(rB cos alpha)\"\n"
      " NODE 4 UX MAX WINDOW 0.5 1 V 0.02 ATOL 1e-6\n RUN ENERGY_ERROR V 0 ATOL 1e-9");
  card.example(".CHK\n ELEMENT 12 VON_MISES MAX V 2.1E8 RTOL 0.01\n NODE 4 STRESS:XX V 1.5E8 RTOL 0.01");
  return card.schema();
}

}  // namespace

const AnalysisCard* last_analysis(const std::vector<Record>& records) {
  const AnalysisCard* last = nullptr;
  for (const Record& record : records)
    if (const auto* card = record.get<AnalysisCard>()) last = card;
  return last;
}

bool says_analysis(const std::vector<Record>& records) {
  return std::any_of(records.begin(), records.end(), [](const Record& record) {
    return record.get<SteppingCard>() || record.get<PathCard>() || record.get<BucklingCard>() ||
           (record.get<AnalysisCard>() && record.given("TYPE"));
  });
}

bool has_small_displacements(const std::vector<Record>& records) {
  const AnalysisCard* last = last_analysis(records);
  return last && last->displacements.given() ? last->displacements.is("SMALL") : !says_analysis(records);
}

bool has_lumped_masses(const std::vector<Record>& records) {
  const AnalysisCard* last = last_analysis(records);
  return last && last->mass.is("LUMPED");
}

std::vector<Schema> analysis_cards() { return {analysis_card(), stepping_card(), archive_card(), check_card()}; }

}  // namespace engrane::deck
