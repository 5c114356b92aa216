// SPDX-License-Identifier: BSD-3-Clause
#include "deck/read/recognised.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/text.hpp"
#include "deck/schema/matching.hpp"

namespace engrane::deck {

const std::vector<Recognised>& recognised_commands() {
  static const std::vector<Recognised> all{
      {".COL", "joining nodes that lie closer than a tolerance",
       "use the same node in both parts, or .MCE RIGID, and remove .COL"},
      {".AXL", "local axes of nodes", "give directions by AXIS in .MCE, nodes in a .FRAME, and remove .AXL"},
      {".ASE", "assembly of super-elements", "remove .ASE"},
      {".STO", "storage of super-elements", "remove .STO"},
      {".CLT", "thermal conditions", "remove .CLT"},
      {".CLM LIA", "linear relations between displacements", "write it as a record of .LIA"},
      {".DES", "drawing", ""},
      {".ALG", "settings of the solution algorithms", ""},
      {".GEL", "the temperature of all elements", ""},
  };
  return all;
}

namespace {

/// Splits `.CLM PRE` into `.CLM` and `PRE`; the key of a whole command is empty.
std::pair<std::string_view, std::string_view> parts_of(const Recognised& entry) {
  const std::string_view name = entry.name;
  const std::size_t blank = name.find(' ');
  if (blank == std::string_view::npos) return {name, {}};
  return {name.substr(0, blank), name.substr(blank + 1)};
}

}  // namespace

std::vector<RecognisedKey> recognised_keys(std::string_view command) {
  const std::string name = significant(command);
  std::vector<RecognisedKey> keys;
  for (const Recognised& entry : recognised_commands())
    if (const auto [known, key] = parts_of(entry); known == name && !key.empty()) keys.push_back(key);
  return keys;
}

bool starts_recognised(std::string_view word, RecognisedKey key) { return word.size() >= 3 && begins_with_word(word, key); }

const Recognised* find_recognised(std::string_view command, std::string_view key) {
  const std::string name = significant(command);
  const auto& all = recognised_commands();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Recognised& entry) {
    const auto [known, known_key] = parts_of(entry);
    return known == name && (key.empty() ? known_key.empty() : !known_key.empty() && starts_recognised(key, known_key));
  });
  return found == all.end() ? nullptr : &*found;
}

void check_skipped(const std::vector<SkippedSetting>& settings, const std::vector<Record>& records, Diagnostics& diagnostics) {
  const auto any = [&](const char* card, const char* keyword, std::size_t least) {
    return std::any_of(records.begin(), records.end(), [&](const Record& record) {
      const Field* field = record.schema->name == card ? record.schema->find(keyword) : nullptr;
      return field && record.given(*field) && field->load(record.data).numbers.size() >= least;
    });
  };
  const auto first = [&](std::string_view command, std::string_view start) {
    return std::find_if(settings.begin(), settings.end(), [&](const SkippedSetting& setting) {
      return setting.command == command && upper(setting.word).starts_with(start);
    });
  };
  const auto temperature = first(".GEL", "TEMP"), axes = first(".ALG", "AXE");
  if (temperature != settings.end() && any(".MAT", "A", 1) && any(".CLM TEMP", "V", 1))
    diagnostics.error(temperature->where,
                      "`.GEL TEMP` is skipped, but it matters here: materials have A, and .CLM TEMP warms them",
                      "V of .CLM TEMP is the rise above the state without stress: give such rises there, and remove .GEL");
  if (axes != settings.end() && any(".MAT", "YT", 2))
    diagnostics.error(axes->where,
                      fmt::format("`.ALGO {}` is skipped, but it matters here: a material has axes", upper(axes->word)),
                      "give its axes by THETA or FRAME of .AEL, and remove this");
}

}  // namespace engrane::deck
