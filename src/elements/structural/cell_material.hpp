// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "deck/cards/cards.hpp"
#include "elements/materials/elasticity.hpp"

namespace engrane::elements::structural {

/// The material of a `.MAT`, in its own axes; nothing where it is faulty, which is reported.
std::optional<materials::Elastic> elastic_of(const deck::Record& record, materials::Hypothesis hypothesis,
                                             Diagnostics& diagnostics);

}  // namespace engrane::elements::structural
