// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "elements/structural/node_link.hpp"

namespace engrane::elements::structural {

/// `I 8 MEAN_LINK N 101 GROUP "rim" [W 1. 2. 1.]`
struct MeanLinkData : LinkData {
  std::vector<double> weights;  ///< of the nodes, in ascending order of their numbers; empty: equal weights
};

ElementType mean_link_type();

}  // namespace engrane::elements::structural
