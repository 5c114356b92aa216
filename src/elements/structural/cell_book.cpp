// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/cell_book.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <tuple>

#include "base/text.hpp"
#include "deck/cards/cards.hpp"
#include "deck/cards/mesh_cards.hpp"
#include "elements/structural/cell.hpp"
#include "math/angle.hpp"

namespace engrane::elements::structural {

namespace {

using materials::Hypothesis;

/// Does the word of a deck begin the word of the language, with three letters or more? No word is a beginning of any.
bool begins(std::string_view language, const std::string& word) { return word.size() >= 3 && begins_with_word(language, word); }

/// The formulations that are here; nothing for another.
std::optional<Hypothesis> hypothesis_of(const deck::HypothesisCard& card) {
  const auto variant = [&card](std::string_view wanted) { return card.variant.empty() || begins(wanted, card.variant); };
  if (begins("MEMBRANE", card.formulation) && begins("BIDIM", card.variant)) return Hypothesis::plane_stress;
  if (begins("CONTRAINTE", card.formulation) && variant("PLANE")) return Hypothesis::plane_stress;
  if (begins("DEFORMATION", card.formulation) && variant("PLANE")) return Hypothesis::plane_strain;
  if ((begins("AXISYMETRIQUE", card.formulation) || begins("AXISYMMETRIC", card.formulation)) && card.variant.empty())
    return Hypothesis::axisymmetric;
  return {};
}

/// `"a"`, `"b"`, or all cells.
std::string names_of(const std::vector<std::string>& groups) {
  std::string names;
  for (const std::string& group : groups) names += (names.empty() ? "\"" : ", \"") + group + "\"";
  return groups.empty() ? "all cells" : (groups.size() == 1 ? "group " : "groups ") + names;
}

/// `.SAM` and `.SUB` say what is analysed: without them a deck is one of linear statics.
bool is_linear(const std::vector<deck::Record>& records) {
  bool analysed = false;
  for (const deck::Record& record : records) {
    const auto* analysis = record.get<deck::AnalysisCard>();
    if (analysis && analysis->displacements.given()) return analysis->displacements.is("SMALL");
    analysed = analysed || (analysis && record.given("TYPE")) || record.get<deck::SteppingCard>();
  }
  return !analysed;
}

}  // namespace

CellBook::CellBook(const std::vector<deck::Record>& records, Diagnostics& diagnostics) : diagnostics_(diagnostics) {
  read_cells(records);
  read_groups(records);
  read_properties(records);
  make_sections(is_linear(records));
}

std::shared_ptr<const CellBook> CellBook::of(const BuildContext& context) {
  const auto make = [&context] { return std::make_shared<const CellBook>(*context.records, context.diagnostics); };
  return context.notes ? context.notes->get<std::shared_ptr<const CellBook>>(make) : make();
}

void CellBook::read_cells(const std::vector<deck::Record>& records) {
  for (const deck::Record& record : records)
    if (record.get<CellData>()) cells_.push_back({&record});
  const auto by_number = [](const Cell& a, const Cell& b) { return a.record->id < b.record->id; };
  if (!std::is_sorted(cells_.begin(), cells_.end(), by_number)) std::sort(cells_.begin(), cells_.end(), by_number);
}

std::size_t CellBook::index(int cell) const {
  const auto found =
      std::lower_bound(cells_.begin(), cells_.end(), cell, [](const Cell& one, int wanted) { return one.record->id < wanted; });
  return found == cells_.end() || found->record->id != cell ? cells_.size() : static_cast<std::size_t>(found - cells_.begin());
}

const CellBook::Cell* CellBook::find(int cell) const {
  const std::size_t at = index(cell);
  return at == cells_.size() ? nullptr : &cells_[at];
}

const deck::Record* CellBook::record(int cell) const {
  const Cell* found = find(cell);
  return found ? found->record : nullptr;
}

std::shared_ptr<const CellSection> CellBook::section(int cell) const {
  const Cell* found = find(cell);
  return found ? found->section : nullptr;
}

void CellBook::read_groups(const std::vector<deck::Record>& records) {
  for (const deck::Record& record : records) {
    const auto* card = record.get<deck::GroupCard>();
    if (!card || !card->kind.is("ELEMENTS")) continue;
    Group group;
    const auto chosen = [&](const Cell& cell) {
      if (card->all) return true;
      const std::vector<int>& attribute = cell.record->get<CellData>()->attribute;
      return card->attribute && !attribute.empty() && attribute.front() == *card->attribute;
    };
    for (std::size_t i = 0; (card->all || card->attribute) && i < cells_.size(); ++i)
      if (chosen(cells_[i])) group.push_back(i);
    for (const int id : card->ids)  // a group may hold elements that are no cells
      if (const std::size_t at = index(id); at < cells_.size()) group.push_back(at);
    for (const std::string& name : card->united)
      if (const auto other = groups_.find(name); other != groups_.end())
        group.insert(group.end(), other->second.begin(), other->second.end());
    std::sort(group.begin(), group.end());
    group.erase(std::unique(group.begin(), group.end()), group.end());
    if (!card->name.empty()) groups_[card->name] = group;
    if (card->number != 0) groups_[std::to_string(card->number)] = std::move(group);
  }
}

CellBook::Group CellBook::members(const deck::Record& record, const std::vector<std::string>& names) {
  Group all;
  for (const std::string& name : names) {
    const auto found = groups_.find(name);
    if (found != groups_.end()) {
      all.insert(all.end(), found->second.begin(), found->second.end());
      continue;
    }
    std::vector<std::string> known;
    for (const auto& [key, group] : groups_) known.push_back(key);
    const std::string near = nearest(name, known);
    diagnostics_.missing(".SEL", record.where("GROUP"), fmt::format("there is no group of elements \"{}\"", name),
                         near.empty() ? "declare it with .SEL GROUP n MAILLES" : fmt::format("did you mean \"{}\"?", near));
  }
  return all;
}

void CellBook::read_properties(const std::vector<deck::Record>& records) {
  std::map<int, const deck::Record*> materials;
  std::set<std::string> refused;
  for (const deck::Record& record : records)
    if (record.get<deck::MaterialCard>()) materials[record.id] = &record;
  for (const deck::Record& record : records) {
    if (const auto* hypothesis = record.get<deck::HypothesisCard>()) {
      const std::string words = hypothesis->formulation + (hypothesis->variant.empty() ? "" : " " + hypothesis->variant);
      if (!hypothesis_of(*hypothesis) && refused.insert(upper(words)).second)
        diagnostics_.error(record.where("FORMULATION"),
                           fmt::format("the formulation {} ({}) is not in this version", words, names_of(hypothesis->groups)),
                           "there are MEMB BIDIM and CONT PLAN (plane stress), DEFO PLAN (plane strain) and AXIS");
      if (hypothesis->groups.empty())
        for (Cell& cell : cells_) cell.hypothesis = &record;
      for (const std::size_t i : members(record, hypothesis->groups)) cells_[i].hypothesis = &record;
    }
    if (const auto* property = record.get<deck::PropertyCard>())
      for (const std::size_t i : members(record, property->groups)) cells_[i].thickness = property->thickness.value_or(0);
    if (const auto* assignment = record.get<deck::AssignmentCard>()) {
      Group group = members(record, assignment->groups);
      for (const int id : assignment->cells)
        if (const std::size_t at = index(id); at < cells_.size())
          group.push_back(at);
        else
          diagnostics_.missing(".MAI", record.where("I"), fmt::format("cell {} does not exist", id));
      if (!assignment->material) continue;  // THETA turns nothing of an isotropic material
      const auto material = materials.find(*assignment->material);
      if (material == materials.end()) {
        diagnostics_.missing(".MAT", record.where("MAT"), fmt::format("material {} does not exist", *assignment->material),
                             fmt::format("declare it with .MAT I {}", *assignment->material));
        for (const std::size_t i : group) cells_[i].material = &record;  // told once
        continue;
      }
      for (const std::size_t i : group) cells_[i].material = material->second;
    }
  }
}

template <class Lacks>
void CellBook::report_lack(const Lacks& lacks, const std::string& what, const std::string& cure) {
  const Cell* first = nullptr;
  std::size_t count = 0;
  for (const Cell& cell : cells_) {
    if (!lacks(cell)) continue;
    if (!first) first = &cell;
    ++count;
  }
  if (count == 1) diagnostics_.error(first->record->location, fmt::format("cell {} {}", first->record->id, what), cure);
  if (count > 1)
    diagnostics_.error(first->record->location, fmt::format("cell {} {}, nor have {} others", first->record->id, what, count - 1),
                       cure);
}

void CellBook::make_sections(bool linear) {
  const auto hypothesis = [](const Cell& cell) {
    return cell.hypothesis ? hypothesis_of(*cell.hypothesis->get<deck::HypothesisCard>()) : std::nullopt;
  };
  const auto is_stress = [&](const Cell& cell) { return hypothesis(cell) == Hypothesis::plane_stress; };
  report_lack([](const Cell& cell) { return !cell.hypothesis; }, "has no formulation",
              ".HYP MEMB BIDIM GROUP \"name\" (plane stress), DEFO PLAN (plane strain) or AXIS");
  report_lack([](const Cell& cell) { return !cell.material; }, "has no material", ".AEL I 1 J 9 K 1 MAT 1");
  report_lack([&](const Cell& cell) { return is_stress(cell) && cell.thickness == 0; }, "has no thickness",
              "plane stress needs .PHP GROUP \"name\" THICK VAL t");
  std::set<int> faulty;
  std::map<std::tuple<Hypothesis, int, double>, std::shared_ptr<const CellSection>> sections;
  for (Cell& cell : cells_) {
    const auto formulation = hypothesis(cell);
    const auto* material = cell.material ? cell.material->get<deck::MaterialCard>() : nullptr;
    if (!formulation || !material || (*formulation == Hypothesis::plane_stress && cell.thickness == 0)) continue;
    const double thickness = cell.thickness > 0 ? cell.thickness : 1;
    const deck::Record& of = *cell.material;
    std::shared_ptr<const CellSection>& section = sections[{*formulation, of.id, thickness}];
    if (!section) {
      const bool incompressible = material->poisson && *material->poisson >= 0.5 && *formulation != Hypothesis::plane_stress;
      const bool elastic = begins("ELASTIC", material->behaviour) || begins("ELASTIQUE", material->behaviour);
      if (!material->young || !material->poisson || incompressible || !elastic) {
        if (!faulty.insert(of.id).second) continue;
        if (!elastic)
          diagnostics_.error(of.where("BEHA"), fmt::format("the behaviour \"{}\" is not in this version", material->behaviour),
                             "there is \"ELASTIC\"");
        else if (incompressible)
          diagnostics_.error(of.where("NT"), "a material with NT 0.5 keeps its volume, which these cells cannot",
                             "take NT below 0.5, such as 0.49");
        else
          diagnostics_.error(of.location, fmt::format("material {} of cells needs YT and NT", of.id),
                             "Young's modulus YT and Poisson's ratio NT");
        continue;
      }
      section = std::make_shared<CellSection>(CellSection{
          *formulation, materials::isotropic(*formulation, *material->young, *material->poisson, material->density.value_or(0)),
          *formulation == Hypothesis::axisymmetric ? 1 : thickness, linear});
    }
    cell.section = section;
  }
}

}  // namespace engrane::elements::structural
