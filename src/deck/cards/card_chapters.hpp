// SPDX-License-Identifier: BSD-3-Clause
// The general commands by chapter; combined by general_commands().
#pragma once

#include <vector>

#include "deck/schema/schema.hpp"

namespace engrane::deck {

std::vector<Schema> model_cards();      ///< `.UNIT` `.TITRE` `.NOE` `.FRAME` `.SEL` `.MAT`
std::vector<Schema> mesh_cards();       ///< `.HYP` `.PHP` `.AEL`
Schema profile_card();                  ///< `.BPR`
std::vector<Schema> condition_cards();  ///< `.CLM` `.FCT` `.INI`
std::vector<Schema> analysis_cards();   ///< `.SAM` `.SUB` `.SAI` `.CHK`
std::vector<Schema> stability_cards();  ///< `.PATH` `.BUCKLING`

}  // namespace engrane::deck
