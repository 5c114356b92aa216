// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace engrane::deck {

/// A command or record of BACON that this version knows but does not carry out.
struct Recognised {
  std::string name;     ///< `.MAI`, `.CLM PRE`
  std::string meaning;  ///< what it would do
  std::string cure;     ///< what to do instead; empty when it is skipped with a warning only

  bool skipped() const { return cure.empty(); }
};

const std::vector<Recognised>& recognised_commands();

/// The word that begins such a record within its command: `PRE` of `.CLM PRE`.
using RecognisedKey = std::string_view;

/// Of all records known of a command: `.CLM`.
std::vector<RecognisedKey> recognised_keys(std::string_view command);

/// Does a word of a deck, three letters or more, begin with the key?
bool starts_recognised(std::string_view word, RecognisedKey key);

/// By command word and record key (`.CLM`, `PRE`; the key is empty for a whole command); nullptr when unknown.
const Recognised* find_recognised(std::string_view command, std::string_view key = {});

}  // namespace engrane::deck
