// SPDX-License-Identifier: BSD-3-Clause
#include "app/model_difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "deck/schema/field_text.hpp"

namespace engrane::app {

namespace {

/// Cards that may differ: they say what is done with a model.
bool free_to_change(const deck::Schema& card) {
  static constexpr std::array names{".SAM",     ".SUB",      ".SAI",     ".CHK",      ".TITRE",     ".UNIT",    ".FCT",
                                    ".CLM CHA", ".CLM STRU", ".CLM ROT", ".CLM TEMP", ".CLM ARETE", ".CLM PRE", ".INI"};
  return std::any_of(names.begin(), names.end(), [&](std::string_view name) { return card.name.starts_with(name); });
}

/// Elements that are loads: their values may differ, but not which of them exist.
bool is_load(const deck::Schema& card) { return card.name == "FORCE" || card.name == "TORQUE"; }

std::string name_of(const deck::Record& record) {
  return record.id > 0 ? fmt::format("{} {}", record.schema->name, record.id) : record.schema->name;
}

/// Advice where an element that is a load is one of the differences.
std::string advice(const deck::Record& record) {
  if (!is_load(*record.schema)) return {};
  return " (as an element of .MCE it belongs to the model: its values may change, but only loads of .CLM may come and go)";
}
std::string lost(const deck::Record& record) { return name_of(record) + " was there and is not now" + advice(record); }
std::string added(const deck::Record& record) { return name_of(record) + " is new" + advice(record); }

/// The records that define the model, by card and number; records without a number keep their order.
std::multimap<std::pair<std::string_view, int>, const deck::Record*> model_records(const deck::Deck& deck) {
  std::multimap<std::pair<std::string_view, int>, const deck::Record*> all;
  for (const deck::Record& record : deck.records)
    if (!free_to_change(*record.schema)) all.emplace(std::pair{std::string_view(record.schema->name), record.id}, &record);
  return all;
}

/// Text such as "KM was 1e8 and is 2e8 now" for the first keyword that differs; empty if none does.
std::string keyword_difference(const deck::Record& before, const deck::Record& now) {
  for (const deck::Field& field : now.schema->fields) {
    const deck::Field::Values was = field.load(before.data), is = field.load(now.data);
    const std::string old_text = was.present ? deck::json_value(field, was) : "not given";
    const std::string new_text = is.present ? deck::json_value(field, is) : "not given";
    if (old_text != new_text) return fmt::format("{} was {} and is {} now", field.keyword, old_text, new_text);
  }
  return {};
}

}  // namespace

std::string model_difference(const deck::Deck& before, const deck::Deck& now) {
  const auto old_records = model_records(before), new_records = model_records(now);
  auto was = old_records.begin();
  auto is = new_records.begin();
  while (was != old_records.end() && is != new_records.end()) {
    if (was->first < is->first) return lost(*was->second);
    if (is->first < was->first) return added(*is->second);
    if (!is_load(*is->second->schema))
      if (const std::string difference = keyword_difference(*was->second, *is->second); !difference.empty())
        return fmt::format("{}: {}", name_of(*is->second), difference);
    ++was;
    ++is;
  }
  if (was != old_records.end()) return lost(*was->second);
  if (is != new_records.end()) return added(*is->second);
  return {};
}

}  // namespace engrane::app
