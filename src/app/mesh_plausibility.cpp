// SPDX-License-Identifier: BSD-3-Clause
#include "app/mesh_plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "app/mesh_folds.hpp"
#include "app/mesh_seams.hpp"
#include "app/selection.hpp"
#include "deck/cards/mesh_cards.hpp"
#include "elements/structural/cell_book.hpp"

namespace engrane::app {

namespace {

using elements::structural::CellBook;

/// Numbers of the cells of these groups. `book` has read the groups of the deck again: the model does not keep them.
std::vector<int> cells_of(const CellBook& book, const std::vector<std::string>& groups) {
  std::vector<int> all;
  for (const std::string& group : groups) {
    const std::vector<int> cells = book.cells(group);
    all.insert(all.end(), cells.begin(), cells.end());
  }
  return all;
}

/// Number of cells of each material, by the record of the material.
std::unordered_map<const deck::Record*, std::size_t> cells_by_material(const deck::Deck& deck, const Model& model,
                                                                       const CellBook& book, bool membranes) {
  std::unordered_map<int, const deck::Record*> materials;  // by number; the last of several with one number counts
  for (const deck::Record& record : deck.records)
    if (record.get<deck::MaterialCard>()) materials[record.id] = &record;
  std::unordered_map<int, const deck::Record*> of_cell;
  for (const deck::Record& record : deck.records) {
    const auto* card = record.get<deck::AssignmentCard>();
    if (!card || !card->material || !materials.contains(*card->material)) continue;
    const deck::Record* material = materials.at(*card->material);
    for (const int cell : cells_of(book, card->groups)) of_cell[cell] = material;
    for (const int cell : card->cells) of_cell[cell] = material;
  }
  std::unordered_map<const deck::Record*, std::size_t> count;
  for (const Model::Part& part : model.parts)
    if (const auto found = of_cell.find(part.element->id()); part.is_cell() && found != of_cell.end())
      if (membranes || part.element->keeps_shape()) ++count[found->second];
  return count;
}

/// `material 1 "steel"`
std::string named(const deck::Record& record, const deck::MaterialCard& card) {
  return fmt::format("material {}{}", record.id, card.name.empty() ? "" : fmt::format(" \"{}\"", card.name));
}

/// Warns about materials without density whose cells should have inertia or weight. ROT warns of them by itself.
void look_at_densities(const deck::Deck& deck, const Model& model, const CellBook& book, Diagnostics& diagnostics) {
  const bool motion = moves(model);
  const bool weighs =
      std::any_of(model.gravity.begin(), model.gravity.end(), [](const Gravity& g) { return !g.acceleration.isZero(0); });
  const auto count = cells_by_material(deck, model, book, true);
  for (const deck::Record& record : deck.records) {
    const auto* card = record.get<deck::MaterialCard>();
    if (!card || card->density.value_or(0) > 0) continue;
    const auto found = count.find(&record);
    if (found == count.end()) continue;
    diagnostics.warning(record.location,
                        fmt::format("{} has no density: its {} no {}", named(record, *card),
                                    found->second == 1 ? "cell has" : fmt::format("{} cells have", found->second),
                                    motion && weighs ? "inertia and no weight"
                                    : motion         ? "inertia"
                                                     : "weight"),
                        "M of .MAT is the density");
  }
}

/// Whether densities count in a deck, and one is missing.
bool misses_density(const deck::Deck& deck, const Model& model) {
  if (!moves(model) &&
      std::all_of(model.gravity.begin(), model.gravity.end(), [](const Gravity& g) { return g.acceleration.isZero(0); }))
    return false;
  return std::any_of(deck.records.begin(), deck.records.end(), [](const deck::Record& record) {
    const auto* card = record.get<deck::MaterialCard>();
    return card && !(card->density.value_or(0) > 0);
  });
}

/// Whether the error that ACCURACY estimates counts in a deck, and a material with density has no damping.
bool misses_damping(const deck::Deck& deck, const Model& model) {
  const deck::AnalysisCard& analysis = model.commands.analysis;
  return analysis.accuracy.given() && analysis.type.is("DYNAMIC") &&
         std::any_of(deck.records.begin(), deck.records.end(), [](const deck::Record& record) {
           const auto* card = record.get<deck::MaterialCard>();
           return card && card->density.value_or(0) > 0 && card->damping == 0;
         });
}

/// Warns about undamped cells under ACCURACY: the scheme damps waves that are too fast for the steps, in the run as well as in
/// the one used to estimate its error (docs/accuracy.md, Beams).
void look_at_damping(const deck::Deck& deck, const Model& model, const CellBook& book, Diagnostics& diagnostics) {
  const auto count = cells_by_material(deck, model, book, false);  // membranes have no damping
  for (const deck::Record& record : deck.records) {
    const auto* card = record.get<deck::MaterialCard>();
    if (!card || !(card->density.value_or(0) > 0) || card->damping > 0 || !count.contains(&record)) continue;
    diagnostics.warning(record.location,
                        fmt::format("{} has no DAMPING: the error that ACCURACY estimates leaves out waves in its "
                                    "cells that are too fast for the steps, and forces or accelerations of light parts may be "
                                    "off by more",
                                    named(record, *card)),
                        "DAMPING 0.002/w takes 0.1 % of critical damping from vibrations of w radians per time, and ends faster "
                        "ones; loads that grow from 0 and START STATIC excite few of them");
  }
}

/// A number that depends on the set of nodes, in any order. Different sets may have the same.
std::uint64_t mark_of(std::span<const int> nodes) {
  std::uint64_t sum = 0;
  for (const int node : nodes) {
    auto x = static_cast<std::uint64_t>(node);  // mixed as by SplitMix64 (Steele, Lea and Flood 2014)
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    sum += x ^ (x >> 31U);
  }
  return sum;
}

/// Warns about cells on the same nodes, in any order: stiffness and mass add up.
void look_for_cells_twice(const Model& model, Diagnostics& diagnostics) {
  using Marked = std::pair<std::uint64_t, std::size_t>;  // of a part
  std::vector<Marked> marked;
  for (std::size_t p = 0; p < model.parts.size(); ++p)
    if (model.parts[p].is_cell()) marked.emplace_back(mark_of(model.parts[p].element->node_ids()), p);
  std::sort(marked.begin(), marked.end());
  // nodes and part of the cells with one mark: sorted, those on the same nodes are neighbours
  std::vector<std::pair<std::vector<int>, std::size_t>> alike;
  std::size_t pairs = 0;
  std::pair<std::size_t, std::size_t> first{model.parts.size(), 0};
  for (std::size_t begin = 0, end = 0; begin < marked.size(); begin = end) {
    while (end < marked.size() && marked[end].first == marked[begin].first) ++end;
    if (end == begin + 1) continue;
    alike.clear();
    for (std::size_t i = begin; i < end; ++i) {
      const auto nodes = model.parts[marked[i].second].element->node_ids();
      alike.emplace_back(std::vector<int>(nodes.begin(), nodes.end()), marked[i].second);
      std::sort(alike.back().first.begin(), alike.back().first.end());
    }
    std::sort(alike.begin(), alike.end());
    for (std::size_t i = 1, before = 0; i < alike.size(); ++i) {
      before = alike[i].first == alike[i - 1].first ? before + 1 : 0;
      pairs += before;  // with each of those before it
      if (before == 1) first = std::min(first, {alike[i - 1].second, alike[i].second});
    }
  }
  if (pairs == 0) return;
  const Model::Part &one = model.parts[first.first], &other = model.parts[first.second];
  diagnostics.warning(other.location,
                      fmt::format("cells {} and {} are on the same nodes{}: stiffness and mass of both count", one.element->id(),
                                  other.element->id(), pairs > 1 ? fmt::format(" (the first of {} such pairs)", pairs) : ""),
                      "leave one of them out, unless both are meant");
}

}  // namespace

void warn_of_mesh_slips(const deck::Deck& deck, const Model& model, Diagnostics& diagnostics) {
  if (std::none_of(model.parts.begin(), model.parts.end(), [](const Model::Part& part) { return part.is_cell(); })) return;
  look_for_cells_twice(model, diagnostics);
  warn_of_folded_corners(model, diagnostics);
  warn_of_loose_middles(model, diagnostics);
  warn_of_inner_pressures(model, diagnostics);
  const bool no_density = misses_density(deck, model);
  const bool undamped = misses_damping(deck, model);
  if (!no_density && !undamped) return;
  const NodePositions nodes(model.nodes);
  Diagnostics discarded;  // building the model has reported these faults
  const BuildContext context{nodes, model.functions, discarded, deck.records.front(), nullptr, &deck.records};
  const CellBook book(context);
  if (no_density) look_at_densities(deck, model, book, diagnostics);
  if (undamped) look_at_damping(deck, model, book, diagnostics);
}

}  // namespace engrane::app
