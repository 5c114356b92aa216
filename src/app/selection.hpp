// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "app/read.hpp"
#include "observe/observer.hpp"

namespace engrane::app {

/// Models with at most this many elements and nodes keep all histories if the deck selects none.
constexpr std::size_t most_with_all_histories = 300;

/// Whether the analysis has velocities, accelerations and kinetic energy.
bool moves(const Model& model);

/// Whether `.SAI` selects elements or nodes.
bool selects(const deck::ArchiveCard& archive);

/// The histories to keep: those that `.SAI` selects, and always those that `.CHK` needs.
observe::Selection select_histories(const Model& model);

/// The histories compared by an error estimate: those that `.SAI` names, otherwise those that `.CHK` needs, otherwise all that
/// are kept.
observe::Selection select_compared(const Model& model);

/// Index of the channel of a `.CHK` record in the observer's values; -1 if there is no such channel.
int checked_channel(const observe::Observer& observer, const deck::CheckCard& check);

/// A sentence about histories that are not kept because the model is large; empty if none are left out.
std::string left_out_histories(const Model& model);

/// Reports `.CHK` records and `.SAI` keywords that refer to elements, types, nodes or channels that do not exist, and wrong
/// uses of `.PATH` and `.BUCKLING`.
void check_targets(const deck::Deck& deck, const Model& model, Diagnostics& diagnostics);

}  // namespace engrane::app
