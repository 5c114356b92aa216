// SPDX-License-Identifier: BSD-3-Clause
// The line between two nodes, along which springs and forces act.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "elements/common/building.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements {

/// End points of the line: the nodes, or a fixed point for an end on the ground.
struct LineEnds {
  std::array<int, 2> nodes{};
  std::array<Vec3, 2> anchor{Vec3::Zero(), Vec3::Zero()};  ///< from the origin (ground node) to the end point; else zero

  /// Builds the ends from a card. `at` is the end point on the ground (default: the origin). Reports an error if the ends
  /// coincide, since a line needs a direction, or if `at` is given and neither end is on the ground.
  static std::optional<LineEnds> of(const BuildContext& context, const std::array<int, 2>& nodes,
                                    const std::optional<std::array<double, 3>>& at, std::string_view cure);

  /// An end on the ground away from the origin also needs the moment, so that reactions are complete.
  std::vector<NodeNeed> needs() const {
    const auto need = [](const Vec3& arm) { return arm.isZero(0) ? NodeNeed::translation : NodeNeed::both; };
    return {need(anchor[0]), need(anchor[1])};
  }

  double reference_length(const BuildContext& context) const {
    return (context.nodes.at(nodes[1]) + anchor[1] - context.nodes.at(nodes[0]) - anchor[0]).norm();
  }

  /// Length of the line, its rate and its unit direction from the first end to the second. If the ends coincide all are zero,
  /// and so is every force along the line.
  template <class T>
  struct Reach {
    T length, rate;
    Vec3T<T> direction;
  };

  template <class T, class Nodes>
  Reach<T> reach(const Nodes& node) const {
    const Vec3T<T> arrow = node[1].x - node[0].x + (anchor[1] - anchor[0]).template cast<T>();
    using std::sqrt;
    const T square = dot(arrow, arrow);
    if (value_of(square) == 0) return {T(0), T(0), Vec3T<T>(T(0), T(0), T(0))};
    const T length = sqrt(square);
    const Vec3T<T> direction = arrow * (T(1) / length);
    return {length, dot(direction, Vec3T<T>(node[1].v - node[0].v)), direction};
  }

  /// Adds the resistance of a line that pulls its ends together with `tension`.
  template <class T>
  void pull(const Vec3T<T>& tension, Balance<T, 2>& balance) const {
    balance.force(0, Vec3T<T>(-tension));
    balance.force(1, tension);
    // the ground carries its force at the anchor
    if (!anchor[0].isZero(0)) balance.moment(0, Vec3T<T>(cross(tension, Vec3T<T>(anchor[0].template cast<T>()))));
    if (!anchor[1].isZero(0)) balance.moment(1, Vec3T<T>(cross(Vec3T<T>(anchor[1].template cast<T>()), tension)));
  }
};

}  // namespace engrane::elements
