// SPDX-License-Identifier: BSD-3-Clause
#include "deck/schema/matching.hpp"

#include <algorithm>
#include <functional>
#include <type_traits>

#include "base/diagnostics.hpp"
#include "base/text.hpp"
#include "deck/schema/thesaurus.hpp"

namespace engrane::deck {

namespace {

/// Whether the word can be a prefix of the spelling; the first letter decides nearly all comparisons.
bool begins_alike(std::string_view spelling, std::string_view word) {
  constexpr char no_case = '\x20';  // the case bit of ASCII letters; false matches of other characters do no harm
  return !word.empty() && !spelling.empty() && (spelling.front() | no_case) == (word.front() | no_case);
}

/// Compares a word with the spellings of an entry, one after another.
class Comparison {
 public:
  explicit Comparison(std::string_view word) : word_(word) {}

  /// Returns true at a full spelling, which ends the search.
  bool operator()(std::string_view spelling) {
    if (!begins_alike(spelling, word_) || !begins_with_word(spelling, word_)) return false;
    prefix = true;
    return spelling.size() == word_.size();
  }

  bool prefix = false;

 private:
  std::string_view word_;
};

/// A full spelling takes precedence, then a unique entry of which the word is a prefix. `compare(entry, comparison)` returns
/// true at a full spelling.
template <class Entry, class Entries, class Compare>
Match<Entry> match_word(const Entries& entries, std::string_view word, const Compare& compare) {
  Match<Entry> match;
  for (const auto& item : entries) {
    const Entry* entry = nullptr;
    if constexpr (std::is_pointer_v<std::remove_cvref_t<decltype(item)>>)
      entry = item;
    else
      entry = &item;
    Comparison comparison(word);
    if (compare(*entry, comparison)) return {entry, true, {}};
    if (comparison.prefix) match.candidates.push_back(entry);
  }
  if (match.candidates.size() == 1) match.entry = match.candidates.front();
  return match;
}

/// The word that names a card among those of its command.
std::string_view record_name(const Schema& schema) { return schema.key().empty() ? std::string_view(schema.name) : schema.key(); }

bool names_record(const Schema& schema, const std::string& synonym) { return synonym.front() != '.' || schema.key().empty(); }

std::vector<std::string> option_spellings(const Option& option) {
  std::vector<std::string> words{option.name};
  words.insert(words.end(), option.synonyms.begin(), option.synonyms.end());
  return words;
}

std::string did_you_mean_spelling(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string near = nearest(word, candidates);
  return near.empty() ? std::string() : "did you mean `" + near + "`?";
}

}  // namespace

Match<Field> match_field(const Schema& schema, std::string_view word) {
  return match_word<Field>(schema.fields, word, [](const Field& field, Comparison& comparison) {
    return std::any_of(field.spellings.begin(), field.spellings.end(), std::ref(comparison));
  });
}

Match<Option> match_option(const Field& field, std::string_view word) {
  return match_word<Option>(field.options, word, [](const Option& option, Comparison& comparison) {
    return comparison(option.name) || std::any_of(option.synonyms.begin(), option.synonyms.end(), std::ref(comparison));
  });
}

Match<Schema> match_schema(const std::vector<const Schema*>& schemas, std::string_view word) {
  return match_word<Schema>(schemas, word, [](const Schema& schema, Comparison& comparison) {
    return comparison(record_name(schema)) ||
           std::any_of(schema.synonyms.begin(), schema.synonyms.end(),
                       [&](const std::string& synonym) { return names_record(schema, synonym) && comparison(synonym); });
  });
}

std::vector<std::string> candidate_names(const Match<Field>& match) {
  std::vector<std::string> names;
  for (const Field* field : match.candidates) names.push_back(field->keyword);
  return names;
}

std::vector<std::string> candidate_names(const Match<Option>& match) {
  std::vector<std::string> names;
  for (const Option* option : match.candidates) names.push_back(option->name);
  return names;
}

std::vector<std::string> candidate_names(const Match<Schema>& match) {
  std::vector<std::string> names;
  for (const Schema* schema : match.candidates) names.emplace_back(record_name(*schema));
  return names;
}

std::vector<std::string> field_words(const Schema& schema) {
  std::vector<std::string> words;
  for (const Field& field : schema.fields) words.insert(words.end(), field.spellings.begin(), field.spellings.end());
  return words;
}

std::vector<std::string> option_words(const Field& field) {
  std::vector<std::string> words;
  for (const Option& option : field.options)
    for (std::string& word : option_spellings(option)) words.push_back(std::move(word));
  return words;
}

std::vector<std::string> schema_words(const std::vector<const Schema*>& schemas) {
  std::vector<std::string> words;
  for (const Schema* schema : schemas)
    for (std::string& word : record_words(*schema)) words.push_back(std::move(word));
  return words;
}

std::vector<std::string> record_words(const Schema& schema) {
  std::vector<std::string> words{std::string(record_name(schema))};
  for (const std::string& synonym : schema.synonyms)
    if (names_record(schema, synonym)) words.push_back(synonym);
  return words;
}

std::vector<std::string> command_words(const Schema& schema) {
  if (schema.name.empty() || schema.name.front() != '.') return {};
  std::vector<std::string> words{std::string(schema.command())};
  for (const std::string& synonym : schema.synonyms)
    if (synonym.front() == '.') words.push_back(synonym);
  return words;
}

std::string significant(std::string_view command_word) {
  const bool digit = command_word.size() > 1 && command_word[1] >= '0' && command_word[1] <= '9';
  return upper(command_word.substr(0, digit ? 5 : 4));
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  for (const Concept* c : find_concepts(word)) {
    std::vector<std::string> names;
    for (const std::string_view keyword : c->keywords)
      if (std::find(candidates.begin(), candidates.end(), keyword) != candidates.end())
        names.push_back("`" + std::string(keyword) + "`");
    if (!names.empty()) return "did you mean " + join(names, " or ") + "?";
  }
  return did_you_mean_spelling(word, candidates);
}

std::string did_you_mean_card(std::string_view word, const std::vector<std::string>& candidates, std::string_view command) {
  const auto found = find_concepts(word.starts_with('.') ? word.substr(1) : word);
  for (const Concept* c : found) {
    std::vector<std::string> names;
    for (const std::string_view card : c->cards)
      if (card.starts_with(command)) names.push_back("`" + std::string(card) + "`");
    if (names.empty()) continue;
    return "did you mean " + join(names, " or ") + "?" + (c->advice.empty() ? "" : " " + std::string(c->advice));
  }
  return did_you_mean_spelling(word, candidates);
}

}  // namespace engrane::deck
