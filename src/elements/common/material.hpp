// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "model/registry.hpp"

namespace engrane::elements {

/// The record of a `.MAT`; nullptr, with an error at MAT, where there is none of that number. Records are looked up once in a
/// model.
const deck::Record* material_record(const BuildContext& context, int number);

/// The material of a `.MAT` with one Young's modulus and one Poisson's ratio. nullptr, with an error at MAT, where it is none;
/// `who` needs it: "beams".
const deck::MaterialCard* isotropic_material(const BuildContext& context, int number, std::string_view who);

}  // namespace engrane::elements
