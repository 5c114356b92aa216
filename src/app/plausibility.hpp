// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/diagnostics.hpp"
#include "deck/read/reader.hpp"
#include "model/model.hpp"

namespace engrane::app {

/// Warns of numbers that are right by themselves and wrong together: what a slip of a unit by 1000 leaves behind. Looks at
/// the size of bodies against that of the mechanism, at single nodes far away from all others, and at gravity.
void warn_of_unit_slips(const deck::Deck& deck, const Model& model, Diagnostics& diagnostics);

}  // namespace engrane::app
