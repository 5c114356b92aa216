// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "deck/cards/cards.hpp"
#include "elements/materials/elasticity.hpp"

namespace engrane::elements::structural {

/// Material of a `.MAT` in its own axes. Reports an error and returns nothing if it is invalid.
std::optional<materials::Elastic> elastic_of(const deck::Record& record, materials::Hypothesis hypothesis,
                                             Diagnostics& diagnostics);

}  // namespace engrane::elements::structural
