// SPDX-License-Identifier: BSD-3-Clause
// Groups of elements and of faces, as cells see them.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <utility>

#include "base/text.hpp"
#include "deck/cards/cards.hpp"
#include "elements/structural/cell.hpp"
#include "elements/structural/cell_book.hpp"
#include "model/groups.hpp"
#include "model/short_form.hpp"

namespace engrane::elements::structural {

namespace {

/// Whether all nodes of a cell lie in a box of `.SEL`.
bool lies_in_box(const CellData& cell, const std::vector<double>& box, const NodePositions& nodes) {
  return std::all_of(cell.nodes.begin(), cell.nodes.end(), [&](int written) {
    const int node = std::abs(written);  // mid-side nodes are negative, and a 0 separates base and top
    return node == 0 || (nodes.contains(node) && lies_in(box, nodes.at(node)));
  });
}

/// The elements that are not cells, by number.
std::map<int, const deck::Record*> other_elements(const std::vector<deck::Record>& records) {
  std::map<int, const deck::Record*> elements;
  for (const deck::Record& record : records)
    if (record.id != 0 && (record.schema->command() == ".MCE" || record.schema->name == ".LIA")) elements[record.id] = &record;
  return elements;
}

/// Whether all nodes that an element names lie in a box of `.SEL`.
bool lies_in_box(const deck::Record& element, const std::vector<double>& box, const NodePositions& nodes) {
  Diagnostics unheard;
  std::set<int> named;
  return has_nodes_named(element, nodes, unheard, &named) && !named.empty() &&
         std::all_of(named.begin(), named.end(), [&](int node) { return lies_in(box, nodes.at(node)); });
}

template <class T>
void sort_and_unite(std::vector<T>& members) {
  std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
}

}  // namespace

std::vector<int> CellBook::cells(const std::string& group) const {
  std::vector<int> ids;
  if (const auto found = groups_.find(group); found != groups_.end())
    for (const std::size_t i : found->second.cells) ids.push_back(cells_[i].record->id);
  return ids;
}

std::vector<int> CellBook::other_elements(const std::string& group) const {
  const auto found = groups_.find(group);
  return found == groups_.end() ? std::vector<int>{} : found->second.others;
}

const std::vector<int>* CellBook::membrane(int element) const {
  const auto found = membranes_.find(element);
  return found == membranes_.end() ? nullptr : found->second;
}

const std::vector<int>* CellBook::faces(const std::string& group) const {
  const auto found = faces_.find(group);
  return found == faces_.end() ? nullptr : &found->second;
}

void CellBook::read_groups(const std::vector<deck::Record>& records, const NodePositions& nodes) {
  std::map<int, Group> so_far;  // groups by GroupCard::group: what the records up to here give them
  std::map<int, std::vector<int>> faces_of;
  std::map<int, std::set<std::pair<int, int>>> known_faces;
  std::optional<std::map<int, const deck::Record*>> others;  // filled when first needed
  for (const deck::Record& record : records) {
    const auto* card = record.get<deck::GroupCard>();
    if (card && card->kind.is("FACES")) {
      std::vector<int>& faces = faces_of[card->group];
      std::set<std::pair<int, int>>& known = known_faces[card->group];
      for (std::size_t i = 0; i + 1 < card->ids.size(); i += 2)
        if (known.emplace(card->ids[i], card->ids[i + 1]).second) faces.insert(faces.end(), {card->ids[i], card->ids[i + 1]});
      for (const std::string& name : card->names) faces_[name] = faces;
    }
    if (!card || !card->kind.is("ELEMENTS")) continue;
    Group& group = so_far[card->group];
    add_members(record, *card, nodes, group);
    std::vector<int> unknown;
    for (const int id : card->ids)
      if (!find(id)) unknown.push_back(id);
    const bool chooses = card->all || !card->box.empty();
    if ((chooses || !unknown.empty()) && !others) others = structural::other_elements(records);
    std::erase_if(unknown, [&](int id) {
      if (!others->contains(id)) return false;
      group.others.push_back(id);
      return true;
    });
    if (chooses)
      for (const auto& [id, element] : *others)
        if (card->all || lies_in_box(*element, card->box, nodes)) group.others.push_back(id);
    sort_and_unite(group.others);
    for (const std::string& name : card->names) groups_[name] = group;
    if (!unknown.empty())
      diagnostics_.warning(record.location,
                           fmt::format("element {} of this group does not exist{}", unknown.front(),
                                       unknown.size() > 1 ? fmt::format(" (the first of {})", unknown.size()) : ""));
    else if (group.empty())
      diagnostics_.warning(record.location, "this group has no elements");
  }
}

void CellBook::add_members(const deck::Record& record, const deck::GroupCard& card, const NodePositions& nodes, Group& group) {
  const auto chosen = [&](const Cell& cell) {
    const CellData& data = *cell.record->get<CellData>();
    return card.all || (card.attribute && !data.attribute.empty() && data.attribute.front() == *card.attribute) ||
           (!card.box.empty() && lies_in_box(data, card.box, nodes));
  };
  for (std::size_t i = 0; (card.all || card.attribute || !card.box.empty()) && i < cells_.size(); ++i)
    if (chosen(cells_[i])) group.cells.push_back(i);
  for (const int id : card.ids)
    if (const std::size_t at = index(id); at < cells_.size()) group.cells.push_back(at);
  for (const std::string& name : card.united) {
    if (const auto other = groups_.find(name); other != groups_.end()) {
      group.cells.insert(group.cells.end(), other->second.cells.begin(), other->second.cells.end());
      group.others.insert(group.others.end(), other->second.others.begin(), other->second.others.end());
    } else {
      report_unknown_group(record, "UNION", name);
    }
  }
  sort_and_unite(group.cells);
}

std::vector<std::size_t> CellBook::members(const deck::Record& record, const std::vector<std::string>& names, bool others) {
  std::vector<std::size_t> all;
  bool known = !names.empty();
  for (const std::string& name : names) {
    const auto found = groups_.find(name);
    if (found != groups_.end()) {
      all.insert(all.end(), found->second.cells.begin(), found->second.cells.end());
    } else {
      report_unknown_group(record, "GROUP", name);
      known = false;
    }
  }
  if (known && all.empty() && !others) warn_of_no_effect(record, names, "cells", diagnostics_);
  return all;
}

void CellBook::report_unknown_group(const deck::Record& record, const char* keyword, const std::string& name) {
  unknown_groups_in_.insert(record.schema->command());
  std::vector<std::string> known;
  for (const auto& [key, group] : groups_) known.push_back(key);
  const std::string near = nearest(name, known);
  diagnostics_.missing(".SEL", record.where(keyword), fmt::format("there is no group of elements \"{}\"", name),
                       near.empty() ? "declare it with .SEL GROUP n MAILLES" : fmt::format("did you mean \"{}\"?", near));
}

}  // namespace engrane::elements::structural
