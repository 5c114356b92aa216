// SPDX-License-Identifier: BSD-3-Clause
#include "app/read.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <filesystem>
#include <set>

#include "app/mesh_plausibility.hpp"
#include "app/mesh_records.hpp"
#include "app/plausibility.hpp"
#include "app/selection.hpp"
#include "elements/beams/beam.hpp"
#include "elements/beams/shaft.hpp"

namespace engrane::app {

namespace {

/// Warns about constraints at index 3 without numerical damping at high frequency: rounding errors then grow with the square of
/// the number of steps (Cardona and Géradin 1989).
void warn_of_undamped_constraints(const deck::Deck& deck, const Model& model, Diagnostics& diagnostics) {
  bool constrained = false;
  for (const Model::Part& part : model.parts) constrained = constrained || !part.element->layout().multipliers.empty();
  const deck::AnalysisCard& a = model.commands.analysis;
  const bool undamped = a.scheme.is("NEWMARK") || (a.scheme.is("CHUNG") && a.rho.value_or(0.8) == 1) ||
                        (!a.scheme.is("CHUNG") && a.alpha && *a.alpha == 0);
  if (!constrained || !undamped || !a.type.is("DYNAMIC")) return;
  for (const deck::Record& record : deck.records)
    if (record.get<deck::AnalysisCard>())
      diagnostics.warning(record.given("RHO") ? record.where("RHO") : record.where("SCHEME"),
                          "a scheme without numerical damping lets rounding grow in joints: accelerations and reactions of "
                          "long runs become noise",
                          "RHO 0.9 or less costs almost no accuracy at the frequencies that the step resolves");
}

/// Warns about undamped beams under ACCURACY: the scheme damps waves in them that are too fast for the steps, in the run as well
/// as in the one used to estimate its error (docs/accuracy.md, Beams).
void warn_of_undamped_beams(const deck::Deck& deck, const Model& model, Diagnostics& diagnostics) {
  const deck::AnalysisCard& a = model.commands.analysis;
  if (!a.accuracy.given() || !a.type.is("DYNAMIC")) return;
  std::set<int> damped;  // materials
  for (const deck::Record& record : deck.records)
    if (const auto* material = record.get<deck::MaterialCard>(); material && material->damping > 0) damped.insert(record.id);
  const auto is_undamped = [&damped](const auto* beams) { return beams && !beams->damping && !damped.contains(beams->material); };
  for (const deck::Record& record : deck.records) {
    if (!is_undamped(record.get<elements::beams::BeamData>()) && !is_undamped(record.get<elements::beams::ShaftData>())) continue;
    diagnostics.warning(
        record.location,
        "the error that ACCURACY estimates leaves out waves along beams without DAMPING that are too fast for the steps",
        "DAMPING 0.002/w takes 0.1 % of critical damping from vibrations of w radians per time, and ends faster ones");
    break;
  }
}

/// Adds what `--result` asks for to the checks of the model. Errors refer to a source named after the option.
void add_wanted(Reading& reading, const std::vector<std::string>& results, Diagnostics& diagnostics) {
  for (const std::string& text : results) {
    const bool one_line = text.find_first_of("\r\n") == std::string::npos;
    const int errors = reading.diagnostics.errors();
    // a value and a tolerance make it a valid record of .CHK; they are never used
    deck::Deck deck = deck::read_text("--result", ".CHK " + (one_line ? text : "") + " V 0 ATOL 0", catalogue(element_types()),
                                      reading.sources, reading.diagnostics);
    if (reading.diagnostics.errors() > errors) continue;
    const deck::CheckCard* check = deck.records.size() == 1 ? deck.records.front().get<deck::CheckCard>() : nullptr;
    if (!check) {
      diagnostics.error({}, "--result takes one quantity, not `" + text + "`",
                        "--result \"ELEMENT 3 NORMAL_FORCE MAX\", as in .CHK without V and tolerance");
      continue;
    }
    check_targets(deck, reading.model, diagnostics);
    reading.model.commands.checks.push_back(*check);
    ++reading.wanted;
  }
}

/// Whether a diagnostic is only a consequence of a record that could not be read.
bool is_echo(const Diagnostic& diagnostic, const deck::Deck& deck) {
  if (diagnostic.missing_from.empty()) return false;
  return deck.incomplete.contains(".*") || deck.incomplete.contains(diagnostic.missing_from);
}

}  // namespace

Reading read_deck(const std::string& path, const Wishes& wishes) {
  Reading reading;
  std::filesystem::path file = path;
  // `engrane gear` finds gear.dat, as INPUT does
  if (!std::filesystem::exists(file) && !file.has_extension()) file += ".dat";
  deck::Catalogue cards = catalogue(element_types());
  cards.read_mesh = mesh_records;
  reading.deck = deck::read_file(file, cards, reading.sources, reading.diagnostics, wishes.overrides);
  const bool syntax_good = reading.good();
  Diagnostics building;
  reading.model = build_model(reading.deck, element_types(), building);
  if (syntax_good && reading.deck.records.empty())
    building.error({}, "the deck `" + file.string() + "` is empty", "docs/guide.md begins with a small one");
  check_targets(reading.deck, reading.model, building);
  if (syntax_good && !building.has_errors()) add_wanted(reading, wishes.results, building);
  warn_of_idle_initial_values(reading.deck, building);
  if (!building.has_errors()) {
    warn_of_undamped_constraints(reading.deck, reading.model, building);
    warn_of_undamped_beams(reading.deck, reading.model, building);
    warn_of_short_pulses(reading.deck, reading.model, building);
    warn_of_speed_jumps(reading.model, building);
  }
  if (syntax_good && !building.has_errors()) {
    warn_of_unit_slips(reading.deck, reading.model, building);
    warn_of_mesh_slips(reading.deck, reading.model, building);
    warn_of_no_load(reading.model, building);
  }
  // errors that only result from unreadable records are dropped; errors in records that were read are still reported
  for (const Diagnostic& d : building.all())
    if (!is_echo(d, reading.deck)) reading.diagnostics.add(d);
  return reading;
}

bool Reading::is_one_solution() const { return has_cells(model) && !deck::says_analysis(deck.records); }

void Reading::forget_mesh() {
  const auto is_of_mesh = [](const deck::Record& record) {
    return record.schema->name == ".NOE" || record.schema->name == ".MAI";
  };
  std::erase_if(deck.records, is_of_mesh);
  deck.records.shrink_to_fit();
  for (Model::Part& part : model.parts) part.record = nullptr;  // the records have moved
  malloc_trim(0);                                               // the freed memory is fragmented
}

std::string Reading::assumptions() const {
  for (const deck::Record& record : deck.records)
    if (record.get<deck::SteppingCard>()) return {};
  if (has_cells(model) && model.commands.stepping.step == model.commands.stepping.end)
    return deck::has_small_displacements(deck.records) ? "the deck has no analysis: linear statics"
                                                       : "the deck has no analysis: statics with large displacements";
  const deck::SteppingCard& s = model.commands.stepping;
  return fmt::format("the deck has no .SUB: t = {:g} to {:g} in steps of {:g}", s.start, s.end, s.step);
}

}  // namespace engrane::app
