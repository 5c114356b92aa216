// SPDX-License-Identifier: BSD-3-Clause
#include "deck/schema/matching.hpp"

#include <algorithm>

#include "base/diagnostics.hpp"
#include "base/text.hpp"

namespace engrane::deck {

namespace {

/// Compares a word with every spelling of every entry; `at(i)` gives entry i, `words` its spellings, `name` its own name.
template <class Entry, class At, class Words, class Name>
Match<Entry> match_word(std::size_t count, At at, Words words, Name name, std::string_view word) {
  Match<Entry> match;
  for (std::size_t i = 0; i < count; ++i) {
    const Entry& entry = at(i);
    bool prefix = false;
    for (const std::string& spelling : words(entry)) {
      if (same_word(spelling, word)) return {&entry, true, {}};
      prefix = prefix || begins_with_word(spelling, word);
    }
    if (!prefix) continue;
    match.entry = &entry;
    match.candidates.emplace_back(name(entry));
  }
  if (match.candidates.size() > 1)
    match.entry = nullptr;
  else
    match.candidates.clear();
  return match;
}

std::vector<std::string> option_spellings(const Option& option) {
  std::vector<std::string> words{option.name};
  words.insert(words.end(), option.synonyms.begin(), option.synonyms.end());
  return words;
}

}  // namespace

Match<Field> match_field(const Schema& schema, std::string_view word) {
  return match_word<Field>(
      schema.fields.size(), [&](std::size_t i) -> const Field& { return schema.fields[i]; }, spellings,
      [](const Field& field) { return field.keyword; }, word);
}

Match<Option> match_option(const Field& field, std::string_view word) {
  return match_word<Option>(
      field.options.size(), [&](std::size_t i) -> const Option& { return field.options[i]; }, option_spellings,
      [](const Option& option) { return option.name; }, word);
}

Match<Schema> match_schema(const std::vector<const Schema*>& schemas, std::string_view word) {
  return match_word<Schema>(
      schemas.size(), [&](std::size_t i) -> const Schema& { return *schemas[i]; }, record_words,
      [](const Schema& schema) { return std::string(schema.key().empty() ? std::string_view(schema.name) : schema.key()); },
      word);
}

std::vector<std::string> field_words(const Schema& schema) {
  std::vector<std::string> words;
  for (const Field& field : schema.fields)
    for (std::string& word : spellings(field)) words.push_back(std::move(word));
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
  std::vector<std::string> words{std::string(schema.key().empty() ? std::string_view(schema.name) : schema.key())};
  for (const std::string& synonym : schema.synonyms)
    if (synonym.front() != '.' || schema.key().empty()) words.push_back(synonym);
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
  const std::string near = nearest(word, candidates);
  return near.empty() ? std::string() : "did you mean `" + near + "`?";
}

}  // namespace engrane::deck
