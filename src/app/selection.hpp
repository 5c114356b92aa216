// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "app/read.hpp"
#include "observe/observer.hpp"

namespace engrane::app {

/// Models with no more elements and nodes than this keep all histories where the deck selects none.
constexpr std::size_t most_with_all_histories = 300;

/// Whether velocities, accelerations and energies of motion exist.
bool moves(const Model& model);

/// Whose histories are kept: what `.SAI` says, and always what `.CHK` compares.
observe::Selection select_histories(const Model& model);

/// The histories that an estimate of the error compares: what `.SAI` names, else what `.CHK` compares, else all.
observe::Selection select_compared(const Model& model);

/// The place of what a row of `.CHK` compares among the observer's values; -1 where there is no such channel.
int checked_channel(const observe::Observer& observer, const deck::CheckCard& check);

/// A sentence about histories that are left out because the model is large; empty when none are.
std::string left_out_histories(const Model& model);

/// Reports rows of `.CHK` and keywords of `.SAI` that name elements, types, nodes or channels that do not exist.
void check_targets(const deck::Deck& deck, const Model& model, Diagnostics& diagnostics);

}  // namespace engrane::app
