// SPDX-License-Identifier: BSD-3-Clause
#include "app/read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/plausibility.hpp"

namespace engrane::app {

namespace {

/// The element of a number, loads aside; nullptr when there is none. Parts are in the order of their numbers.
const Model::Part* find_element(const Model& model, int id) {
  const auto part = std::lower_bound(model.parts.begin(), model.parts.end(), id,
                                     [](const Model::Part& p, int wanted) { return p.element->id() < wanted; });
  return part != model.parts.end() && part->element->id() == id && part->type != "CHA" ? &*part : nullptr;
}

/// Rows of `.CHK` and others that name what only the built model knows.
void check_targets(const deck::Deck& deck, const Model& model, Diagnostics& diagnostics) {
  for (const deck::Record& record : deck.records) {
    const auto* check = record.get<deck::CheckCard>();
    if (!check || !check->element) continue;
    const Model::Part* found = find_element(model, *check->element);
    std::vector<std::string> names;
    if (!found) {
      diagnostics.error(record.where("ELEMENT"), fmt::format("there is no element {}", *check->element));
      continue;
    }
    bool known = false;
    for (const Named& channel : found->element->channels()) {
      names.push_back(channel.name);
      known = known || channel.name == check->quantity;
    }
    if (known) continue;
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : " ") + name;
    const std::string near = nearest(check->quantity, names);
    diagnostics.error(record.where("QUANTITY"),
                      fmt::format("{} {} has no output {}", found->type, *check->element, check->quantity),
                      near.empty() ? "it has " + list : fmt::format("did you mean {}? It has {}", near, list));
  }
}

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
