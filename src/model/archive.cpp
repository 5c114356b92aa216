// SPDX-License-Identifier: BSD-3-Clause
#include "model/archive.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

namespace engrane {

namespace {

template <class Value>
void append(std::vector<Value>& all, const std::vector<Value>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

void add_archive(deck::ArchiveCard& all, const deck::Record& record, Diagnostics& diagnostics) {
  const auto& card = *record.get<deck::ArchiveCard>();
  const auto settle = [&](const char* keyword, std::optional<double>& settled, const std::optional<double>& said) {
    if (!said) return;
    if (settled && *settled != *said)
      diagnostics.error(record.where(keyword), fmt::format(".SAI gives {} in two ways", keyword),
                        "records of .SAI add up: leave one of them out");
    settled = said;
  };
  settle("FIELDS", all.field_step, card.field_step);
  settle("HISTORY", all.history_step, card.history_step);
  settle("RESTART", all.restart_step, card.restart_step);
  append(all.codes, card.codes);
  append(all.elements, card.elements);
  append(all.kinds, card.kinds);
  append(all.groups, card.groups);
  append(all.channels, card.channels);
  all.newton = all.newton || card.newton;
  if (card.keep.given()) {
    if (all.keep.given() && all.keep.tag != card.keep.tag)
      diagnostics.error(record.where("KEEP"), ".SAI gives KEEP in two ways", "records of .SAI add up: leave one of them out");
    all.keep = card.keep;
  }
  // within one record, the reader has already checked this
  const bool selects =
      !all.elements.empty() || !all.kinds.empty() || !all.groups.empty() || !all.nodes.empty() || !card.nodes.empty();
  if (all.keep.given() && selects)
    diagnostics.error(record.location,
                      fmt::format("KEEP {} of one .SAI and what another selects exclude each other", all.keep.tag),
                      "leave one of them out");
}

void tell_codes(const std::vector<deck::Record>& records, Diagnostics& diagnostics) {
  const deck::Record* first = nullptr;
  std::map<std::string, std::set<int>> codes;  // by what they stand for
  for (const deck::Record& record : records) {
    const auto* card = record.get<deck::ArchiveCard>();
    if (!card || card->codes.empty()) continue;
    if (!first) first = &record;
    for (const deck::Code& code : record.schema->find("STYP")->codes)
      if (std::find(card->codes.begin(), card->codes.end(), code.number) != card->codes.end())
        codes[code.meaning].insert(code.number);
  }
  if (!first) return;
  std::string list;
  for (const auto& [meaning, numbers] : codes)
    list +=
        fmt::format("{}{} {} {}", list.empty() ? "" : ", ", fmt::join(numbers, " "), numbers.size() == 1 ? "is" : "are", meaning);
  diagnostics.warning(first->where("STYP"), "STYP selects nothing, as all results are archived: " + list);
}

}  // namespace engrane
