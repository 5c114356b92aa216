// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "deck/read/reader.hpp"

namespace engrane::app {

/// Returns the first difference between two models that prevents a run of one deck from being continued with the other, such as
/// "GEAR 7: KM was 1e8 and is 2e8 now"; empty if there is none. Stepping, analysis, output, checks, initial conditions, loads
/// and functions of time may differ: they say what happens to a model, not what it is.
std::string model_difference(const deck::Deck& before, const deck::Deck& now);

}  // namespace engrane::app
