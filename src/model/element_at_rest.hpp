// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "model/model.hpp"

namespace engrane {

/// One element of a model in the reference configuration, for evaluation before assembly. Modify members before calling view().
struct ElementAtRest {
  ElementAtRest(const Model& model, const Model::Part& part)
      : nodes(part.nodes.size()),
        scalars(part.element->layout().scalars.size()),
        rates(scalars.size()),
        multipliers(part.element->layout().multipliers.size()),
        history(static_cast<std::size_t>(part.element->layout().history)) {
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i].x = model.node(part.nodes[i]).x;
    part.element->start(scalars, history);
  }

  /// A state that views this object.
  State view() const {
    State state;
    state.nodes = nodes;
    state.scalars = scalars;
    state.scalar_rates = state.scalar_accelerations = rates;
    state.multipliers = multipliers;
    state.history = history;
    return state;
  }

  std::vector<NodeState> nodes;
  std::vector<double> scalars, rates, multipliers, history;
};

}  // namespace engrane
