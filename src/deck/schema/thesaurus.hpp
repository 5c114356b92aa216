// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace engrane::deck {

/// Words that people look for and no card is called by: those of other programs, and Spanish and French ones.
struct Concept {
  std::vector<std::string_view> words;     ///< upper case, without accents, blanks as `_`
  std::vector<std::string_view> cards;     ///< `HINGE`, `.CLM FIX`; the likeliest first
  std::vector<std::string_view> keywords;  ///< of whichever card has them
  std::vector<std::string_view> terms;     ///< beginnings of the words that texts of cards use for it
  std::string_view advice;                 ///< one more sentence, where a name alone says too little
};

const std::vector<Concept>& concepts();

/// Upper case, without the accents of Spanish and French (UTF-8), a tilde or cedilla dropped; a hyphen or blank as `_`.
std::string plain_word(std::string_view word);

/// The concepts that a word stands for, in any case and with or without accents.
std::vector<const Concept*> find_concepts(std::string_view word);

}  // namespace engrane::deck
