// SPDX-License-Identifier: BSD-3-Clause
#include "model/short_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <map>

#include "deck/cards/profile_card.hpp"
#include "model/frames.hpp"

namespace engrane {

namespace {

/// Positions of the nodes of a deck. Faults are reported when the model is built.
NodePositions positions_of(const deck::Deck& deck) {
  Diagnostics unheard;
  Frames frames;
  for (const deck::Record& record : deck.records)
    if (const auto* card = record.get<deck::FrameCard>()) frames.add(record, *card, unheard);
  std::vector<NodePositions::Node> nodes = {{0, Vec3::Zero()}};
  for (const deck::Record& record : deck.records)
    if (const auto* card = record.get<deck::NodeCard>(); card && record.id > 0)
      nodes.push_back({record.id, frames.to_global(record, *card, unheard)});
  return NodePositions(std::move(nodes));
}

}  // namespace

bool has_nodes_named(const deck::Record& record, const NodePositions& nodes, Diagnostics& diagnostics, std::set<int>* named) {
  bool good = true;
  for (const deck::Field& field : record.schema->fields) {
    if (field.reference != deck::Reference::node) continue;
    for (const double value : field.load(record.data).numbers) {
      const int id = static_cast<int>(value);
      if (named) named->insert(id);
      if (nodes.contains(id)) continue;
      diagnostics.missing(".NOE", record.where(field.keyword),
                          fmt::format("node {} of {} {} does not exist", id, record.schema->name, record.id));
      good = false;
    }
  }
  return good;
}

void ShortForm::add(std::string_view card, int id, std::any data) {
  const deck::Schema* schema = cards_.find(card);
  assert(schema);
  deck::Record made;
  made.schema = schema;
  made.id = id;
  made.location = record.location;
  for (const deck::FieldLocation& given : record.field_locations)
    if (const deck::Field* same = schema->find(given.field->keyword)) made.field_locations.push_back({same, given.where});
  made.data = std::move(data);
  made_.push_back(std::move(made));
}

int ShortForm::add_node(const Vec3& place, std::array<int, 2> between, double part) {
  const int id = free_.node++;
  add(".NOE", id, deck::NodeCard{{place[0], place[1], place[2]}, 0});
  made_nodes_.push_back({id, between, part, record.location});
  return id;
}

bool ShortForm::has_numbers(int count) const {
  const int first = record.id, last = first + count - 1;
  const auto found = std::find_if(deck_.records.begin(), deck_.records.end(), [&](const deck::Record& other) {
    return &other != &record && other.schema->command() == ".MCE" && other.id >= first && other.id <= last;
  });
  if (found == deck_.records.end()) return true;
  const std::string& name = found->schema->name;
  diagnostics.error(record.location,
                    fmt::format("the {} elements of {} {} have the numbers {} to {}, but {} is a {}", count, record.schema->name,
                                first, first, last, found->id, name),
                    fmt::format("give the {} another number", name));
  return false;
}

WrittenOut write_out(const deck::Deck& deck, const std::vector<ElementType>& types, Diagnostics& diagnostics) {
  std::map<const deck::Schema*, const ElementType*> forms;  // by schema: its type if it is a short form
  const auto form_of = [&](const deck::Record& record) {
    const auto [entry, fresh] = forms.try_emplace(record.schema, nullptr);
    for (const ElementType& type : types)
      if (fresh && type.expand && type.schema.name == record.schema->name) entry->second = &type;
    const ElementType* form = entry->second;
    return form && form->is_short && !form->is_short(record) ? nullptr : form;
  };
  ShortForm::FreeNumbers free;
  bool any = false;
  for (const deck::Record& record : deck.records) {
    any = form_of(record) || any;
    if (record.get<deck::NodeCard>()) free.node = std::max(free.node, record.id + 1);
    if (record.get<deck::ProfileCard>()) free.profile = std::max(free.profile, record.id + 1);
  }
  if (!any) return {};

  const NodePositions nodes = positions_of(deck);
  const deck::Catalogue cards = catalogue(types);
  WrittenOut result;
  const auto out = std::make_shared<deck::Deck>(deck);
  out->records.clear();
  for (const deck::Record& record : deck.records) {
    const ElementType* type = form_of(record);
    if (!type) {
      out->records.push_back(record);
    } else if (has_nodes_named(record, nodes, diagnostics, &result.named)) {
      ShortForm form(record, deck, cards, nodes, free, out->records, result.made, diagnostics);
      type->expand(form);
    }
  }
  result.deck = out;
  return result;
}

}  // namespace engrane
