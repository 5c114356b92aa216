// SPDX-License-Identifier: BSD-3-Clause
#include "elements/control/joint_coordinate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "elements/control/sensor.hpp"
#include "elements/joints/joint_card.hpp"

namespace engrane::elements::control {

void Coordinate::commit(const NodeState& a, const NodeState& b, std::span<const double> committed, std::span<double> next) const {
  if (!is_angle()) return;
  turn_count::commit(measure(what, frame, JointPose<double>(frame, a, b)).value, committed, next);
}

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

namespace {

std::vector<Coordinate> coordinates_of(const joints::JointParts& parts) {
  std::vector<Coordinate> all;
  for (const joints::JointCoordinate& c : parts.coordinates)
    all.push_back({c.names.value, parts.nodes, parts.frame, c.measure, parts.point});
  return all;
}

/// The coordinates of the element that a record describes. Its own faults are its own to report: `faulty` then.
std::vector<Coordinate> coordinates_of(const BuildContext& context, const deck::Record& record, bool& faulty) {
  Diagnostics unheard;
  BuildContext other{context.nodes,         context.functions, unheard, record,
                     context.wheel_inertia, context.records,   nullptr, context.notes};
  if (const auto* sensor = record.get<SensorData>()) {
    const auto coordinate = sensor_coordinate(*sensor, other);
    faulty = !coordinate;
    return coordinate ? std::vector{*coordinate} : std::vector<Coordinate>{};
  }
  for (const ElementType& type : element_types()) {
    if (type.schema.name != record.schema->name) continue;
    const auto element = type.build(other);
    faulty = !element;
    if (const auto* joint = dynamic_cast<const joints::Joint*>(element.get())) return coordinates_of(joint->parts());
  }
  return {};
}

}  // namespace

std::optional<Coordinate> find_coordinate(const BuildContext& context, std::string_view keyword, int id,
                                          std::string_view name_keyword, const std::string& name) {
  const deck::Record* found = nullptr;
  if (context.records)
    for (const deck::Record& record : *context.records)
      if (record.id == id && record.schema->command() == ".MCE") found = &record;
  if (!found) {
    context.error(keyword, fmt::format("element {} does not exist", id), "name a joint or a SENSOR of .MCE by its number");
    return {};
  }
  bool faulty = false;
  const std::vector<Coordinate> all = coordinates_of(context, *found, faulty);
  if (faulty) {
    context.error(keyword, fmt::format("{} {} has faults of its own", found->schema->name, id), "mend it first");
    return {};
  }
  if (all.empty()) {
    context.error(keyword, fmt::format("{} {} has no coordinate", found->schema->name, id),
                  "name a joint with a free coordinate, such as HINGE or PRISMATIC, or a SENSOR");
    return {};
  }
  if (name.empty()) return all.front();
  std::vector<std::string> names;
  for (const Coordinate& c : all) {
    if (c.name == name) return c;
    names.push_back(c.name);
  }
  context.error(name_keyword, fmt::format("{} {} has no coordinate {}", found->schema->name, id, name),
                fmt::format("it has {}", fmt::join(names, ", ")));
  return {};
}

}  // namespace engrane::elements::control
