// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "deck/schema/schema.hpp"

namespace engrane::deck {

/// What a word may mean among the entries of a list.
template <class Entry>
struct Match {
  const Entry* entry = nullptr;          ///< the one it means, if it means one
  bool exact = false;                    ///< a full spelling, not a prefix
  std::vector<const Entry*> candidates;  ///< when it is a prefix of several

  bool ambiguous() const { return candidates.size() > 1; }
};

/// The names of the entries that an ambiguous word may mean.
std::vector<std::string> candidate_names(const Match<Field>& match);
std::vector<std::string> candidate_names(const Match<Option>& match);
std::vector<std::string> candidate_names(const Match<Schema>& match);

/// The keyword of a card: a full spelling first, then an unambiguous prefix of one.
Match<Field> match_field(const Schema& schema, std::string_view word);

/// The word of a choice field.
Match<Option> match_option(const Field& field, std::string_view word);

/// A card by its name (for `.CLM FIX` the record key counts as the name).
Match<Schema> match_schema(const std::vector<const Schema*>& schemas, std::string_view word);

/// The full spellings of all entries, for "did you mean".
std::vector<std::string> field_words(const Schema& schema);
std::vector<std::string> option_words(const Field& field);
std::vector<std::string> schema_words(const std::vector<const Schema*>& schemas);

/// The words that name a card: for `.CLM FIX` those of the record key.
std::vector<std::string> record_words(const Schema& schema);

/// The words that name the command of a card: `.CLM`, `.BOUNDARY`; none for elements.
std::vector<std::string> command_words(const Schema& schema);

/// The significant part of a command word: the dot and three letters, four after a leading digit; upper case.
std::string significant(std::string_view command_word);

/// "did you mean `ALPHA`?" or nothing: of the candidates those that the word is another name of, else the one it is spelt like.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

/// The same for names of cards; what other programs and languages call a card leads to it even when it is no candidate. With
/// `command` only cards of that command count.
std::string did_you_mean_card(std::string_view word, const std::vector<std::string>& candidates, std::string_view command = {});

}  // namespace engrane::deck
