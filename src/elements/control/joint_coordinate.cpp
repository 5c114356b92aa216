// SPDX-License-Identifier: BSD-3-Clause
#include "elements/control/joint_coordinate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/text.hpp"

namespace engrane::elements::control {

PlacedCoordinate::PlacedCoordinate(Coordinate wanted, Layout& layout)
    : coordinate(std::move(wanted)), history(static_cast<std::size_t>(layout.history)) {
  for (std::size_t end = 0; end < 2; ++end) {
    const auto found = std::find(layout.nodes.begin(), layout.nodes.end(), coordinate.nodes[end]);
    node[end] = static_cast<std::size_t>(found - layout.nodes.begin());
    if (found == layout.nodes.end()) {
      layout.nodes.push_back(coordinate.nodes[end]);
      layout.needs.push_back(coordinate.need(end));
    } else if (coordinate.need(end) == NodeNeed::both) {
      layout.needs[node[end]] = NodeNeed::both;
    }
  }
  layout.history += coordinate.history();
}

void PlacedCoordinate::commit(const State& state, std::span<double> next) const {
  if (coordinate.history() == 0) return;
  coordinate.commit(state.nodes[node[0]], state.nodes[node[1]], committed(state), next.subspan(history, turn_count::history));
}

std::optional<Coordinate> find_coordinate(const BuildContext& context, std::string_view keyword, int id,
                                          std::string_view name_keyword, const std::string& name) {
  const BuildContext::Found found = context.find_element ? context.find_element(id) : BuildContext::Found{};
  if (!found.record) {
    context.diagnostics.missing(".MCE", context.record.where(keyword), fmt::format("element {} does not exist", id),
                                "name a joint or a SENSOR of .MCE by its number");
    return {};
  }
  if (found.faulty) {
    context.error(keyword, fmt::format("{} {} has faults of its own", found.record->schema->name, id), "mend it first");
    return {};
  }
  const auto* owner = dynamic_cast<const joints::CoordinateOwner*>(found.element);
  const std::vector<Coordinate> all = owner ? owner->coordinates() : std::vector<Coordinate>{};
  if (all.empty()) {
    context.error(keyword, fmt::format("{} {} has no coordinate", found.record->schema->name, id),
                  "name a joint with a free coordinate, such as HINGE or PRISMATIC, or a SENSOR");
    return {};
  }
  if (name.empty()) return all.front();
  std::vector<std::string> names;
  for (const Coordinate& c : all) {
    if (same_word(c.name, name)) return c;
    names.push_back(c.name);
  }
  context.error(name_keyword, fmt::format("{} {} has no coordinate {}", found.record->schema->name, id, name),
                fmt::format("it has {}", fmt::join(names, ", ")));
  return {};
}

}  // namespace engrane::elements::control
