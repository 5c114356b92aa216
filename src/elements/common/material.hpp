// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "model/registry.hpp"

namespace engrane::elements {

/// The record of a `.MAT`. Returns nullptr, with an error at MAT, if there is none with that number. The records of a model are
/// indexed once.
const deck::Record* material_record(const BuildContext& context, int number);

/// The isotropic material of a `.MAT`, with one Young's modulus and one Poisson's ratio. Returns nullptr, with an error at MAT,
/// if it is not isotropic. `who` names what needs it in the message: "beams".
const deck::MaterialCard* isotropic_material(const BuildContext& context, int number, std::string_view who);

}  // namespace engrane::elements
