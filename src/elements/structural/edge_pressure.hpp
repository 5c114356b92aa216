// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "deck/schema/schema.hpp"
#include "model/registry.hpp"

namespace engrane::elements::structural {

/// `.CLM ARETE I cell edge PRE V p [NF f]`: pressure on an edge of a plane cell.
struct EdgePressureData {
  std::array<int, 2> edge{0, 0};  ///< number of the cell, and of its edge
  double pressure = 0;            ///< positive against the outward normal
  int function = 0;
};

ElementType edge_pressure_type();

}  // namespace engrane::elements::structural
