// SPDX-License-Identifier: BSD-3-Clause
#include "deck/schema/schema.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "base/text.hpp"

namespace engrane::deck {

namespace {

/// Synonyms that BACON gives a keyword wherever it occurs, so that no card needs to repeat them.
const std::array<std::pair<std::string_view, std::vector<std::string>>, 7>& common_synonyms() {
  static const std::array<std::pair<std::string_view, std::vector<std::string>>, 7> synonyms{{
      {"V", {"VAL", "VALUE"}},
      {"C", {"COMP"}},
      {"N", {"NOEUDS", "NODES"}},
      {"GROUP", {"GR", "GROUPE"}},
      {"NOEUD", {"NOE", "NODE"}},
      {"MAILLE", {"MAI"}},
      {"STYP", {"STYPE"}},
  }};
  return synonyms;
}

}  // namespace

Field::Field() = default;
Field::Field(const Field&) = default;
Field::Field(Field&&) noexcept = default;
Field& Field::operator=(const Field&) = default;
Field& Field::operator=(Field&&) noexcept = default;
Field::~Field() = default;

Schema::Schema() = default;
Schema::Schema(const Schema&) = default;
Schema::Schema(Schema&&) noexcept = default;
Schema& Schema::operator=(const Schema&) = default;
Schema& Schema::operator=(Schema&&) noexcept = default;
Schema::~Schema() = default;

const Field* Schema::find(std::string_view keyword) const {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& field) { return field.keyword == keyword; });
  return found == fields.end() ? nullptr : &*found;
}

std::string_view Schema::command() const {
  if (name.empty() || name.front() != '.') return ".MCE";
  return std::string_view(name).substr(0, name.find(' '));
}

std::string_view Schema::key() const {
  const std::size_t blank = name.find(' ');
  if (name.empty() || name.front() != '.' || blank == std::string::npos) return {};
  return std::string_view(name).substr(blank + 1);
}

const FieldLocation* Record::find(std::string_view keyword) const {
  const auto found = std::find_if(field_locations.begin(), field_locations.end(),
                                  [&](const FieldLocation& given) { return given.field->keyword == keyword; });
  return found == field_locations.end() ? nullptr : &*found;
}

bool Record::given(const Field& field) const {
  return std::any_of(field_locations.begin(), field_locations.end(),
                     [&](const FieldLocation& given) { return given.field == &field; });
}

Location Record::where(std::string_view keyword) const {
  const FieldLocation* found = find(keyword);
  return found ? found->where : location;
}

std::vector<std::string> collect_spellings(const Field& field) {
  std::vector<std::string> words{field.keyword};
  const auto add = [&](const std::vector<std::string>& more) {
    for (const std::string& word : more)
      if (std::none_of(words.begin(), words.end(), [&](const std::string& w) { return same_word(w, word); }))
        words.push_back(word);
  };
  add(field.synonyms);
  for (const auto& [keyword, synonyms] : common_synonyms())
    if (keyword == field.keyword) add(synonyms);
  return words;
}

std::string deck_unit(Dimension dimension) {
  if (dimension == dimension::angle) return "degrees";
  return UnitSystem{}.label(dimension);
}

namespace {

void find_field_faults(const Schema& schema, const Field& field, std::set<std::string>& words, std::vector<std::string>& faults) {
  static const std::set<std::string> reserved{"MODE", "INPUT", "ABRE", "RETURN", "EXIT"};
  const std::string prefix = schema.name + " " + field.keyword + ": ";
  const std::vector<std::string> own = spellings(field);
  for (const std::string& word : own) {
    if (word.empty() || word != upper(word)) faults.push_back(prefix + "`" + word + "` is not upper case");
    if (reserved.contains(word) || (schema.numbered && word == schema.record_key))
      faults.push_back(prefix + "`" + word + "` is reserved");
    if (!words.insert(word).second) faults.push_back(prefix + "`" + word + "` is used twice");
  }
  if (field.help.empty()) faults.push_back(prefix + "has no help");
  if (field.type == FieldType::choice && field.options.empty()) faults.push_back(prefix + "has no options");
  if (field.min_values > field.max_values) faults.push_back(prefix + "wants more values than it takes");
  if (!field.whole.empty() && schema.find(field.whole) == nullptr) faults.push_back(prefix + "is part of nothing");
  std::set<std::string> option_words;
  for (const Option& option : field.options) {
    if (option.help.empty()) faults.push_back(prefix + option.name + " has no help");
    std::vector<std::string> names = option.synonyms;
    names.push_back(option.name);
    for (const std::string& name : names) {
      if (name != upper(name)) faults.push_back(prefix + "`" + name + "` is not upper case");
      if (!option_words.insert(name).second) faults.push_back(prefix + "option `" + name + "` is used twice");
    }
  }
  const Field::Values defaults = field.load(schema.make());
  const auto has_tag = [&](const Option& option) { return option.name == defaults.tag; };
  if (field.type == FieldType::choice && defaults.present && std::none_of(field.options.begin(), field.options.end(), has_tag))
    faults.push_back(prefix + "the default `" + defaults.tag + "` is no option");
}

}  // namespace

std::vector<std::string> schema_faults(const Schema& schema) {
  std::vector<std::string> faults;
  if (schema.name.empty() || schema.name != upper(schema.name))
    faults.push_back("`" + schema.name + "` is not an upper-case name");
  if (schema.summary.empty()) faults.push_back(schema.name + ": no summary");
  if (schema.chapter.empty()) faults.push_back(schema.name + ": no chapter");
  if (!schema.make) return faults;
  std::set<std::string> words;
  for (const Field& field : schema.fields) find_field_faults(schema, field, words, faults);
  return faults;
}

}  // namespace engrane::deck
