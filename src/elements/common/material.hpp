// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "model/registry.hpp"

namespace engrane::elements {

/// The material of a `.MAT` with one Young's modulus and one Poisson's ratio. nullptr, with an error at MAT, where it is none;
/// `who` needs it: "beams". Records are looked up once in a model.
const deck::MaterialCard* isotropic_material(const BuildContext& context, int number, std::string_view who);

}  // namespace engrane::elements
