// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "deck/read/reader.hpp"

namespace engrane::app {

/// What keeps a run of one deck from going on with another: the first difference between their models, in words, such as "GEAR 7:
/// KM was 1e8 and is 2e8 now"; empty when there is none. Stepping, analysis, output, checks, initial conditions, loads and
/// functions of time may differ: they say what happens to a model, not what it is.
std::string model_difference(const deck::Deck& before, const deck::Deck& now);

}  // namespace engrane::app
