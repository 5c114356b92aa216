// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "base/diagnostics.hpp"
#include "deck/cards/cards.hpp"
#include "deck/schema/schema.hpp"

namespace engrane {

/// Merges a record of `.SAI` into the settings of those before it, except for its nodes, which are not resolved yet.
/// Contradictory settings are errors.
void add_archive(deck::ArchiveCard& all, const deck::Record& record, Diagnostics& diagnostics);

/// Tells once, for all records of `.SAI`, which results the codes of STYP stand for.
void tell_codes(const std::vector<deck::Record>& records, Diagnostics& diagnostics);

}  // namespace engrane
