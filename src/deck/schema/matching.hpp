// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "deck/schema/schema.hpp"

namespace engrane::deck {

/// The entries of a list that a word may mean.
template <class Entry>
struct Match {
  const Entry* entry = nullptr;          ///< the entry it means, if unique
  bool exact = false;                    ///< a full spelling rather than a prefix
  std::vector<const Entry*> candidates;  ///< entries of which it is a prefix

  bool ambiguous() const { return candidates.size() > 1; }
};

/// Names of the entries that an ambiguous word may mean.
std::vector<std::string> candidate_names(const Match<Field>& match);
std::vector<std::string> candidate_names(const Match<Option>& match);
std::vector<std::string> candidate_names(const Match<Schema>& match);

/// Matches a keyword of a card: a full spelling first, then an unambiguous prefix.
Match<Field> match_field(const Schema& schema, std::string_view word);

/// Matches a word of a choice field.
Match<Option> match_option(const Field& field, std::string_view word);

/// Matches a card by its name (for `.CLM FIX`, the record key is the name).
Match<Schema> match_schema(const std::vector<const Schema*>& schemas, std::string_view word);

/// Full spellings of all entries, for "did you mean" hints.
std::vector<std::string> field_words(const Schema& schema);
std::vector<std::string> option_words(const Field& field);
std::vector<std::string> schema_words(const std::vector<const Schema*>& schemas);

/// Words that name a card; for `.CLM FIX` those of the record key.
std::vector<std::string> record_words(const Schema& schema);

/// Words that name the command of a card: `.CLM`, `.BOUNDARY`; empty for elements.
std::vector<std::string> command_words(const Schema& schema);

/// The significant part of a command word: the dot and three letters, four after a leading digit; upper case.
std::string significant(std::string_view command_word);

/// Returns "did you mean `ALPHA`?" or an empty string. A candidate with the same meaning as the word comes before one with
/// similar spelling.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

/// The same for names of cards. Names used by other programs and languages lead to a card even if it is not a candidate. With
/// `command`, only cards of that command are suggested from these names.
std::string did_you_mean_card(std::string_view word, const std::vector<std::string>& candidates, std::string_view command = {});

}  // namespace engrane::deck
