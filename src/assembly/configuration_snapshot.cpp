// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/configuration_snapshot.hpp"

#include <fmt/format.h>

#include <utility>

namespace engrane {

namespace {

/// Calls use(name, array) for every numeric array of a configuration.
template <class C, class Use>
void for_each_array(C& c, Use&& use) {
  use("remainders", c.remainders);
  use("scalars", c.scalars);
  use("scalar_rates", c.scalar_rates);
  use("scalar_accelerations", c.scalar_accelerations);
  use("multipliers", c.multipliers);
  use("history", c.history);
}

/// Calls use(data, count) for every member of a node's state.
template <class Node, class Use>
void for_each_member(Node& node, Use&& use) {
  for (auto* vector : {&node.x, &node.v, &node.W, &node.a, &node.A}) use(vector->data(), vector->size());
  for (auto* matrix : {&node.R, &node.T}) use(matrix->data(), matrix->size());
}

constexpr std::size_t numbers_of_node = 5 * 3 + 2 * 9;

}  // namespace

void save_configuration(const Configuration& configuration, Snapshot& snapshot) {
  std::vector<double> nodes;
  nodes.reserve(numbers_of_node * configuration.nodes.size());
  for (const NodeState& node : configuration.nodes)
    for_each_member(node, [&](const double* data, Eigen::Index count) { nodes.insert(nodes.end(), data, data + count); });
  snapshot.put("configuration/time", configuration.time);
  snapshot.put("configuration/lead", configuration.lead);
  snapshot.put("configuration/h", configuration.h);
  snapshot.put("configuration/nodes", std::move(nodes));
  for_each_array(configuration, [&](const char* name, const std::vector<double>& values) {
    snapshot.put(fmt::format("configuration/{}", name), values);
  });
}

void load_configuration(const Snapshot& snapshot, Configuration& configuration) {
  const auto fitting = [&](const char* name, std::size_t count) -> const std::vector<double>& {
    const std::vector<double>& values = snapshot.array(fmt::format("configuration/{}", name));
    if (values.size() != count)
      throw std::out_of_range(
          fmt::format("the restart point has {} numbers for the {} of the model, not {}", values.size(), name, count));
    return values;
  };
  const double* at = fitting("nodes", numbers_of_node * configuration.nodes.size()).data();
  for (NodeState& node : configuration.nodes)
    for_each_member(node, [&](double* data, Eigen::Index count) {
      std::copy_n(at, count, data);
      at += count;
    });
  for_each_array(configuration, [&](const char* name, std::vector<double>& values) { values = fitting(name, values.size()); });
  configuration.time = snapshot.number("configuration/time");
  configuration.lead = snapshot.number("configuration/lead");
  configuration.h = snapshot.number("configuration/h");
}

}  // namespace engrane
