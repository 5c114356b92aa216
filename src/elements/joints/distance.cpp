// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/distance.hpp"

#include <fmt/format.h>

#include "elements/common/building.hpp"

namespace engrane::elements::joints {

namespace {

/// An end of the rod: as given, or the node itself.
std::optional<Vec3> end(const BuildContext& context, const char* keyword, int node,
                        const std::optional<std::array<double, 3>>& given) {
  if (given) return to_vector(*given);
  if (node != 0) return context.nodes.at(node);
  context.error("N", "the ground has no place", fmt::format("say where the rod ends on it: {} x y z", keyword));
  return {};
}

std::unique_ptr<Element> build_distance(const JointData& data, BuildContext& context) {
  if (!check_nodes(context, {data.nodes[0], data.nodes[1]})) return nullptr;
  const auto from = end(context, "FROM", data.nodes[0], data.from), to = end(context, "TO", data.nodes[1], data.to);
  auto found =
      find_coordinate(context, data.slide(), words::length, Measure::distance, CoordinateNames::of("LENGTH", "LENGTH_SPEED"));
  if (!from || !to || !found) return nullptr;
  JointCoordinate& length = *found;
  length.origin = (*to - *from).norm();
  if (same_place(*from, *to)) {
    context.error("N", "both ends of the rod are in one place", "a rod without length has no direction: use SPHERICAL");
    return nullptr;
  }
  std::optional<JointParts> parts(std::in_place);
  parts->nodes = data.nodes;
  parts->has_axis = parts->drawn_axis = false;
  parts->has_thrust = true;
  parts->frame.arm_a = *from - context.nodes.at(data.nodes[0]);
  parts->frame.arm_b = *to - context.nodes.at(data.nodes[1]);
  release_rotations(*parts, false);
  const bool telescopic = length.sprung() || length.stop.given();
  if (!length.drive.given() && !telescopic) parts->constraints = {{Measure::distance, length.origin}};
  if (data.slide().relaxed == 0) length.relaxed = length.origin;
  parts->coordinates = {length};
  return std::make_unique<Joint>(context.record.id, std::move(*parts));
}

}  // namespace

ElementType distance_type() {
  JointCard card("DISTANCE", {"ROD", "BIELLE"},
                 "A massless rod of constant or driven length between a point of node a and a point of node b");
  card.numbered()
      .chapter("Rigid kinematic joints")
      .describe(
          "The ends are at the nodes, or at FROM on node a and TO on node b, in the reference configuration. The length is that "
          "of the reference configuration unless it is driven; with K, C, a law or stops it is free but for these, and the "
          "spring is relaxed at the length of the reference configuration unless LENGTH0 says otherwise. Where an end is at its "
          "node the joint does not ask for its rotation.")
      .example("I 3 DISTANCE N 1 2")
      .example("I 4 DISTANCE N 0 2  FROM 0 0 0")
      .example("I 5 DISTANCE N 0 2  FROM 0 0 0  DRIVE SPEED NF 1")
      .example("I 6 DISTANCE N 1 2  K 2D4 C 300  MIN 0.2 MAX 0.4 KSTOP 1D6");
  add_joint_nodes(card);
  card.add("FROM", &JointData::from, "end on node a, in the reference configuration").unit(dimension::length);
  card.add("TO", &JointData::to, "end on node b, in the reference configuration").unit(dimension::length);
  add_coordinate<0>(card, words::length);
  return element_type(card, build_distance);
}

}  // namespace engrane::elements::joints
