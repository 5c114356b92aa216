// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace engrane::deck {

/// Search words that are not names of cards: terms of other programs, and Spanish and French terms.
struct Concept {
  std::vector<std::string_view> words;     ///< upper case, without accents, blanks as `_`
  std::vector<std::string_view> cards;     ///< `HINGE`, `.CLM FIX`; most likely first
  std::vector<std::string_view> keywords;  ///< of any card
  std::vector<std::string_view> terms;     ///< prefixes of the corresponding words in the texts of cards
  std::string_view advice;                 ///< an additional sentence, if a name alone is not enough
};

const std::vector<Concept>& concepts();

/// Converts to upper case and removes the accents, tildes and cedillas of Spanish and French (UTF-8); a hyphen or blank becomes
/// `_`.
std::string plain_word(std::string_view word);

/// The concepts that a word stands for, ignoring case and accents.
std::vector<const Concept*> find_concepts(std::string_view word);

}  // namespace engrane::deck
