// SPDX-License-Identifier: BSD-3-Clause
// Distorted plane and axisymmetric cells of each kind, for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "elements/structural/make_cell.hpp"
#include "elements/suite.hpp"
#include "math/rotation.hpp"

namespace engrane::elements::structural::plane_cells {

using namespace suite;
using materials::Hypothesis;

inline constexpr double young = 70, poisson = 0.3, density = 2.7, thickness = 0.4;

inline constexpr Hypothesis hypotheses[] = {Hypothesis::plane_stress, Hypothesis::plane_strain, Hypothesis::axisymmetric};

/// What a section has beside its hypothesis.
struct Kind {
  bool linear = false, rubber = false, lumped = false;
  double damping = 0;
  bool warm = false;
  bool curved = false;  ///< an anisotropic material with round_axes()
};
inline constexpr double expansion = 2e-3;

/// Axes of a cylindrical frame, about an axis along z beside the cells.
inline Mat3 round_axes(const Vec3& place) { return rotation_exp(std::atan2(place[1] + 0.7, place[0] - 0.2) * Vec3::UnitZ()); }
inline materials::Elastic orthotropic() {
  materials::Elastic material = materials::orthotropic({Vec3(140, 60, 50), Vec3(0.2, 0.25, 0.15), Vec3(30, 25, 28)});
  material.density = density;
  return material;
}

inline std::string name_of(std::size_t count, Hypothesis hypothesis, Kind kind) {
  return std::to_string(count) + " nodes, hypothesis " + std::to_string(static_cast<int>(hypothesis)) +
         (kind.linear ? ", small" : ", large") + (kind.rubber ? ", neo-Hookean" : "") + (kind.lumped ? ", lumped" : "") +
         (kind.damping > 0 ? ", damped" : "") + (kind.warm ? ", warm" : "") + (kind.curved ? ", curved axes" : "");
}

inline std::shared_ptr<const CellSection> section(Hypothesis hypothesis, Kind kind) {
  materials::Elastic material = kind.curved ? orthotropic() : materials::isotropic(young, poisson);
  material.density = density;
  material.damping = kind.damping;
  if (kind.warm) material.expansion.head<3>() = expansion * Vec3(1, kind.curved ? 0.3 : 1, kind.curved ? 0.6 : 1);
  if (kind.rubber) material.neo_hookean = materials::neo_hookean(young, poisson);
  return std::make_shared<CellSection>(
      CellSection{hypothesis,
                  materials::law_of(hypothesis, material),
                  hypothesis == Hypothesis::axisymmetric ? 1 : thickness,
                  kind.linear,
                  0,
                  kind.lumped,
                  {},
                  kind.curved ? std::optional(CurvedLaw{hypothesis, material, round_axes}) : std::nullopt});
}
inline std::shared_ptr<const CellSection> section(Hypothesis hypothesis, bool linear) {
  return section(hypothesis, Kind{linear});
}

/// A distorted cell of each kind, sides of 6 and 8 nodes curved, away from the axis.
inline std::vector<Eigen::Vector2d> distorted(std::size_t count) {
  std::vector<Eigen::Vector2d> x{{1, 0.1}, {2.3, -0.2}, {2.1, 1.3}};
  if (count == 4 || count == 8) x.emplace_back(0.8, 0.9);
  const std::size_t corners = x.size();
  if (count > corners) {
    const Eigen::Vector2d bend[] = {{0.03, 0.05}, {-0.06, 0.02}, {0.04, -0.03}, {0.02, 0.05}};
    for (std::size_t i = 0; i < corners; ++i) x.emplace_back((x[i] + x[(i + 1) % corners]) / 2 + bend[i]);
  }
  return x;
}

inline std::vector<int> numbers(std::size_t count) {
  std::vector<int> ids;
  for (std::size_t i = 0; i < count; ++i) ids.push_back(static_cast<int>(i) + 1);
  return ids;
}

inline NodeMap node_map(const std::vector<Eigen::Vector2d>& places) {
  NodeMap nodes;
  for (std::size_t i = 0; i < places.size(); ++i) nodes[static_cast<int>(i) + 1] = {places[i][0], places[i][1], 0};
  return nodes;
}

inline CellPlan plan_of(const std::vector<Eigen::Vector2d>& places, const std::shared_ptr<const CellSection>& of) {
  const std::map<std::size_t, CellShape> shapes{
      {3, CellShape::triangle}, {6, CellShape::triangle6}, {4, CellShape::quadrilateral}, {8, CellShape::quadrilateral8}};
  CellPlan plan{1, shapes.at(places.size()), numbers(places.size()), {}, of};
  for (const Eigen::Vector2d& x : places) plan.places.emplace_back(x[0], x[1], 0);
  return plan;
}

inline std::unique_ptr<Element> cell(const std::vector<Eigen::Vector2d>& places, const std::shared_ptr<const CellSection>& of,
                                     double rise = 0) {
  CellPlan plan = plan_of(places, of);
  if (rise != 0) plan.warmth = std::make_shared<const std::vector<Warmth>>(places.size(), Warmth{rise});
  return make_plane_cell(plan, nullptr);
}

/// Moves all nodes by a function of their place.
template <class Move>
StateBuffer moved(const Element& element, const NodeMap& nodes, const Move& move) {
  StateBuffer state(element, nodes);
  for (NodeState& node : state.nodes) {
    const Eigen::Vector2d u = move(Eigen::Vector2d(node.x.head<2>()));
    node.x += Vec3(u[0], u[1], 0);
  }
  return state;
}

/// All values of a field at all points, a row for each point.
inline Eigen::MatrixXd field_of(const Element& element, const StateBuffer& state, const std::string& name) {
  std::vector<double> values;
  std::size_t size = 0, at = 0, width = 0, points = 0;
  for (const Field& field : element.fields()) {
    if (field.name == name) {
      at = size;
      width = std::max<std::size_t>(field.components.size(), 1);
      points = static_cast<std::size_t>(field.points);
    }
    size += field.size(element.node_ids().size());
  }
  values.resize(size);
  element.evaluate_fields(state.view(), values);
  Eigen::MatrixXd rows(points, width);
  for (std::size_t i = 0; i < points; ++i)
    for (std::size_t k = 0; k < width; ++k)
      rows(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = values[at + i * width + k];
  return rows;
}

}  // namespace engrane::elements::structural::plane_cells
