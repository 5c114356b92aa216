// SPDX-License-Identifier: BSD-3-Clause
#include "elements/gears/gear_bearings.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "elements/common/building.hpp"

namespace engrane::elements::gears {

namespace {

/// Bearings may be tilted on purpose, as far as the teeth tolerate it.
constexpr double most_tilt = 1 * degree;

/// A joint that lets a node turn about one direction, or not at all.
struct Turning {
  int to = 0;         ///< id of the node at its other end
  Vec3 direction;     ///< unit vector; zero: all rotations are held
  std::string joint;  ///< "HINGE 2"
};

/// The direction about which a two-node element lets one node turn while the other is fixed. Zero if it holds all rotations;
/// nothing if it leaves more than one direction free.
std::optional<Vec3> turning_direction(const Element& element, std::size_t node, const BuildContext& context) {
  const Layout& layout = element.layout();
  std::vector<double> scalars(layout.scalars.size()), rates(scalars.size()), none(scalars.size());
  std::vector<double> multipliers(layout.multipliers.size()), history(static_cast<std::size_t>(layout.history));
  std::vector<NodeState> nodes(layout.nodes.size());
  double size = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nodes[i].x = context.nodes.at(layout.nodes[i]);
    size = std::max(size, (nodes[i].x - nodes[0].x).norm());
  }
  if (size == 0) size = 1;  // only scales lengths against rotations
  element.start(scalars, history);
  State state;
  state.nodes = nodes;
  state.scalars = scalars;
  state.scalar_rates = rates;
  state.scalar_accelerations = none;
  state.multipliers = multipliers;
  state.history = history;
  const auto columns = static_cast<Eigen::Index>(6 + scalars.size());
  Eigen::MatrixXd gradient = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(multipliers.size()), columns);
  std::vector<double> phi(multipliers.size()), rate(phi), second(phi);
  for (Eigen::Index k = 0; k < columns; ++k) {
    NodeState& moved = nodes[node];
    moved.v = moved.W = Vec3::Zero();
    std::fill(rates.begin(), rates.end(), 0.0);
    if (k < 3)
      moved.v[k] = size;
    else if (k < 6)
      moved.W[k - 3] = 1;
    else
      rates[static_cast<std::size_t>(k - 6)] = 1;
    element.constraint_rates(state, phi, rate, second);
    for (std::size_t m = 0; m < rate.size(); ++m)
      if (layout.multipliers[m].role != Role::drive && layout.multipliers[m].role != Role::grip)
        gradient(static_cast<Eigen::Index>(m), k) = rate[m];
  }
  for (Eigen::Index m = 0; m < gradient.rows(); ++m)
    if (const double length = gradient.row(m).norm(); length > 0) gradient.row(m) /= length;
  constexpr double rounding = 1e-9;
  const Eigen::JacobiSVD<Eigen::MatrixXd> all(gradient, Eigen::ComputeFullV);
  Eigen::Index rank = 0;
  while (rank < all.singularValues().size() && all.singularValues()[rank] > rounding) ++rank;
  const Eigen::MatrixXd turns = all.matrixV().rightCols(columns - rank).middleRows(3, 3);
  if (turns.cols() == 0) return Vec3(Vec3::Zero());
  const Eigen::JacobiSVD<Eigen::MatrixXd> turning(turns, Eigen::ComputeFullU);
  const auto& values = turning.singularValues();
  if (values.size() > 1 && values[1] > rounding) return {};
  if (values[0] < rounding) return Vec3(Vec3::Zero());
  return Vec3(turning.matrixU().col(0));
}

/// The joints of every node. An element is examined when a wheel is on one of its nodes.
class Bearings {
 public:
  explicit Bearings(const BuildContext& context) {
    for (const deck::Record& record : *context.records) {
      if (record.schema->command() != ".MCE" || !context.find_element) continue;
      const BuildContext::Found found = context.find_element(record.id);
      if (found.record != &record || !found.element) continue;
      const Layout& layout = found.element->layout();
      const std::span<const int> nodes = found.element->node_ids();
      if (nodes.size() != 2 || layout.nodes.size() != 2 || layout.multipliers.empty()) continue;
      if (layout.nodes[0] != nodes[0] || layout.nodes[1] != nodes[1]) continue;  // layout shared by a block of elements
      for (const std::size_t i : {std::size_t{0}, std::size_t{1}})
        joints_[nodes[i]].push_back({found.element, i, fmt::format("{} {}", record.schema->name, record.id)});
    }
  }

  std::vector<Turning> of(int node, const BuildContext& context) const {
    std::vector<Turning> list;
    const auto here = joints_.find(node);
    if (here == joints_.end()) return list;
    for (const Joint& joint : here->second) {
      const Layout& layout = joint.element->layout();
      if (!layout.needs_any(joint.node, NodeNeed::rotation) || !layout.needs_any(1 - joint.node, NodeNeed::rotation)) continue;
      if (const auto direction = turning_direction(*joint.element, joint.node, context))
        list.push_back({layout.nodes[1 - joint.node], *direction, joint.name});
    }
    return list;
  }

 private:
  struct Joint {
    const Element* element;
    std::size_t node;
    std::string name;
  };
  std::unordered_map<int, std::vector<Joint>> joints_;
};

}  // namespace

bool check_bearings(const std::array<int, 2>& nodes, const std::array<Vec3, 2>& axles, const BuildContext& context) {
  if (!context.records) return true;
  BuildNotes own;
  const Bearings& bearings = (context.notes ? *context.notes : own).get<Bearings>([&] { return Bearings(context); });
  const std::array<std::vector<Turning>, 2> joints{bearings.of(nodes[0], context), bearings.of(nodes[1], context)};
  for (const std::size_t wheel : {std::size_t{0}, std::size_t{1}}) {
    if (axles[wheel].isZero()) continue;
    for (const Turning& joint : joints[wheel]) {
      const std::size_t mate = 1 - wheel;
      const bool one_body = joint.to == nodes[mate] || std::any_of(joints[mate].begin(), joints[mate].end(),
                                                                   [&](const Turning& other) { return other.to == joint.to; });
      const double tilt = std::atan2(cross(joint.direction, axles[wheel]).norm(), std::abs(joint.direction.dot(axles[wheel])));
      if (!one_body || joint.direction.isZero() || tilt <= most_tilt) continue;
      const auto shown = [](const Vec3& v) { return fmt::format("({}, {}, {})", number(v[0]), number(v[1]), number(v[2])); };
      context.error(
          "N",
          fmt::format("wheel {} turns about {} by the data of the pair, but {} lets node {} turn about {}, {:.3g} degrees "
                      "away",
                      wheel == 0 ? "A" : "B", shown(axles[wheel]), joint.joint, nodes[wheel], shown(joint.direction),
                      tilt / degree),
          fmt::format("parallel axles need opposite hands (equal hands inside a ring); otherwise turn the axis of {}",
                      joint.joint));
      return false;
    }
  }
  return true;
}

}  // namespace engrane::elements::gears
