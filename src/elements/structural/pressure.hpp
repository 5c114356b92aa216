// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "deck/schema/schema.hpp"
#include "model/registry.hpp"

namespace engrane::elements::structural {

/// `.CLM ARETE I cell edge PRE V p [DEAD] [NF f]`, `.CLM FACE I cell face PRE V p`: pressure on an edge of a plane cell or on a
/// face of a solid.
struct PressureData {
  std::array<int, 2> face{0, 0};  ///< number of the cell, and of its edge or face
  double pressure = 0;            ///< positive against the outward normal
  int function = 0;
  bool dead = false;
};

ElementType pressure_type();

}  // namespace engrane::elements::structural
