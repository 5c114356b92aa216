// SPDX-License-Identifier: BSD-3-Clause
#include "app/read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/plausibility.hpp"
#include "app/selection.hpp"

namespace engrane::app {

namespace {

/// Constraints at index 3 need some damping at high frequency: without, rounding grows with the square of the number of
/// steps (Cardona and Géradin 1989).
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

}  // namespace

Reading read_deck(const std::string& path) {
  Reading reading;
  std::filesystem::path file = path;
  // `engrane gear` finds gear.dat, as INPUT does
  if (!std::filesystem::exists(file) && !file.has_extension()) file += ".dat";
  reading.deck = deck::read_file(file, catalogue(element_types()), reading.sources, reading.diagnostics);
  const bool syntax_good = reading.good();
  Diagnostics building;
  reading.model = build_model(reading.deck, element_types(), building);
  if (syntax_good) check_targets(reading.deck, reading.model, building);
  if (!building.has_errors()) warn_of_undamped_constraints(reading.deck, reading.model, building);
  if (syntax_good && !building.has_errors()) warn_of_unit_slips(reading.deck, reading.model, building);
  // a record that could not be read leaves a hole: what the model then misses is an echo, not a fault of its own. But
  // what is wrong with records that were read is wrong all the same
  for (const Diagnostic& d : building.all()) {
    const bool echo = !syntax_good && d.message.find("does not exist") != std::string::npos;
    if (echo) continue;
    if (d.severity == Severity::error)
      reading.diagnostics.error(d.location, d.message, d.hint);
    else
      reading.diagnostics.warning(d.location, d.message, d.hint);
  }
  return reading;
}

}  // namespace engrane::app
