// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.hpp"
#include "deck/schema/schema.hpp"

namespace engrane::deck {

/// A command or record of BACON that this version recognises but does not implement.
struct Recognised {
  std::string name;     ///< `.MAI`, `.CLM PRE`
  std::string meaning;  ///< its function in BACON
  std::string cure;     ///< what to do instead; empty: skipped with only a warning

  bool skipped() const { return cure.empty(); }
};

const std::vector<Recognised>& recognised_commands();

/// The word that starts such a record within its command: `PRE` of `.CLM PRE`.
using RecognisedKey = std::string_view;

/// Keys of all recognised records of a command such as `.CLM`.
std::vector<RecognisedKey> recognised_keys(std::string_view command);

/// Whether a word of a deck, of three letters or more, starts with the key.
bool starts_recognised(std::string_view word, RecognisedKey key);

/// Looks up a command word and record key (`.CLM`, `PRE`; empty key for a whole command); nullptr if unknown.
const Recognised* find_recognised(std::string_view command, std::string_view key = {});

/// A word within a command that is skipped: `TEMP` of `.GEL`.
struct SkippedSetting {
  std::string command;
  std::string word;
  Location where;
};

/// Reports as errors the settings that would change the results of a deck with these records.
void check_skipped(const std::vector<SkippedSetting>& settings, const std::vector<Record>& records, Diagnostics& diagnostics);

}  // namespace engrane::deck
