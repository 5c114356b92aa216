// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "deck/schema/schema.hpp"
#include "model/registry.hpp"

namespace engrane::elements::structural {

/// `.MAI I id [AT a 0] N n1 -m12 n2 …`: a cell of a mesh, interpreted by connectivity().
struct CellData {
  std::vector<int> attribute;  ///< AT: the first value is the attribute; others are ignored
  std::vector<int> nodes;      ///< as written in the deck
};

ElementType cell_type();

}  // namespace engrane::elements::structural
