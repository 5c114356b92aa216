// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/diagnostics.hpp"
#include "deck/cards/cards.hpp"
#include "deck/schema/schema.hpp"

namespace engrane {

/// Adds what a record of `.SAI` says to what those before it have said, but for its nodes, which are not looked up yet. Settings
/// that contradict each other are errors.
void add_archive(deck::ArchiveCard& all, const deck::Record& record, Diagnostics& diagnostics);

}  // namespace engrane
