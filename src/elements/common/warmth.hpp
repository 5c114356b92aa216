// SPDX-License-Identifier: BSD-3-Clause
// Temperatures of the nodes of an element.
#pragma once

#include <memory>
#include <vector>

#include "model/registry.hpp"
#include "model/temperatures.hpp"

namespace engrane::elements {

/// Temperature rises of the nodes of an element; nullptr if none of them has one.
using NodeWarmth = std::shared_ptr<const std::vector<Warmth>>;

/// Of the nodes with these numbers. If they are warm and the material does not expand, returns nullptr and warns, once for each
/// kind of element: `what`, such as "beam".
NodeWarmth warmth_of(const std::vector<int>& nodes, bool expands, const char* what, const BuildContext& context);

/// Temperature rise at a point with the given shape functions, and its rate.
template <class Shape>
double rise_at(const NodeWarmth& warmth, const Shape& shape, double time) {
  double sum = 0;
  if (warmth)
    for (std::size_t i = 0; i < warmth->size(); ++i) sum += shape[static_cast<decltype(shape.size())>(i)] * (*warmth)[i].at(time);
  return sum;
}
template <class Shape>
double rise_rate_at(const NodeWarmth& warmth, const Shape& shape, double time) {
  double sum = 0;
  if (warmth)
    for (std::size_t i = 0; i < warmth->size(); ++i)
      sum += shape[static_cast<decltype(shape.size())>(i)] * (*warmth)[i].rate(time);
  return sum;
}

}  // namespace engrane::elements
