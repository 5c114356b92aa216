// SPDX-License-Identifier: BSD-3-Clause
#include "observe/packed_configuration.hpp"

namespace engrane::observe {

namespace {

bool has_position_only(const NodeState& node) {
  const NodeState still;
  return node.R == still.R && node.T == still.T && node.v == still.v && node.W == still.W && node.a == still.a &&
         node.A == still.A;
}

}  // namespace

PackedConfiguration::PackedConfiguration(const Configuration& c) {
  rest_.time = c.time;
  rest_.lead = c.lead;
  rest_.h = c.h;
  rest_.scalars = c.scalars;
  rest_.scalar_rates = c.scalar_rates;
  rest_.scalar_accelerations = c.scalar_accelerations;
  rest_.remainders = c.remainders;
  rest_.multipliers = c.multipliers;
  rest_.history = c.history;
  positions_.reserve(c.nodes.size());
  for (std::size_t i = 0; i < c.nodes.size(); ++i) {
    positions_.push_back(c.nodes[i].x);
    if (!has_position_only(c.nodes[i])) others_.emplace_back(static_cast<int>(i), c.nodes[i]);
  }
}

Configuration PackedConfiguration::unpacked() const {
  Configuration c = rest_;
  c.nodes.resize(positions_.size());
  for (std::size_t i = 0; i < positions_.size(); ++i) c.nodes[i].x = positions_[i];
  for (const auto& [index, node] : others_) c.nodes[static_cast<std::size_t>(index)] = node;
  return c;
}

}  // namespace engrane::observe
