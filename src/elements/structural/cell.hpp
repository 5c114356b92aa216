// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "deck/schema/schema.hpp"
#include "model/registry.hpp"

namespace engrane::elements::structural {

/// `.MAI I id [AT a 0] N n1 -m12 n2 …`: a cell of a mesh, as connectivity() reads it.
struct CellData {
  std::vector<int> attribute;  ///< AT: the attribute; the others mean nothing here
  std::vector<int> nodes;      ///< as written
};

ElementType cell_type();

}  // namespace engrane::elements::structural
