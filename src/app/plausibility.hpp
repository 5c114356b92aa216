// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "base/diagnostics.hpp"
#include "base/snapshot.hpp"
#include "deck/read/reader.hpp"
#include "model/model.hpp"

namespace engrane::app {

/// Warns about values that are plausible individually but not together, as after a unit error by a factor of 1000. Checks the
/// size of bodies against that of the mechanism, single nodes far away from all others, and gravity.
void warn_of_unit_slips(const deck::Deck& deck, const Model& model, Diagnostics& diagnostics);

/// Warns about functions of time with a pulse so short that steps of the length H pass over it. Steps that follow their error
/// end at its corners.
void warn_of_short_pulses(const deck::Deck& deck, const Model& model, Diagnostics& diagnostics);

/// Warns about drives and supports whose speed jumps, which takes an infinite force for an instant, where steps do not end
/// there. Steps that follow their error pass it as an impact without rebound.
void warn_of_speed_jumps(const Model& model, Diagnostics& diagnostics);

/// A warning about a speed that jumps at a restart point at `time`, where the deck imposes another one than the motion had.
std::optional<Diagnostic> speed_jump_warning(const Model& model, const Snapshot& memory, double time);

/// Tells of initial values in a deck that continues another run: an error where they must hold, otherwise a warning.
void warn_of_idle_initial_values(const deck::Deck& deck, Diagnostics& diagnostics);

/// Warns about statics of a mesh on which nothing acts, at any of its steps: all results are zero.
void warn_of_no_load(const Model& model, Diagnostics& diagnostics);

}  // namespace engrane::app
