// SPDX-License-Identifier: BSD-3-Clause
// A coordinate of another element of the deck, a joint or a sensor. Couplings relate such coordinates; controllers measure and
// actuate them.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "elements/joints/coordinate.hpp"
#include "model/registry.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements::control {

using joints::Coordinate;

/// A coordinate as seen by an element that uses it: indices of its nodes in that element's layout and of its turn count in the
/// history.
struct PlacedCoordinate {
  Coordinate coordinate;
  std::array<std::size_t, 2> node{};
  std::size_t history = 0;

  /// Adds the coordinate's nodes and history to a layout.
  PlacedCoordinate(Coordinate wanted, Layout& layout);

  template <class T, class Nodes>
  auto read(const Nodes& nodes, const State& state) const {
    using Node = std::remove_cvref_t<decltype(nodes[0])>;
    return coordinate.template read<T, Node>(nodes[node[0]], nodes[node[1]], committed(state));
  }
  template <class T, class Nodes, class Reading, int Count>
  void act(const Reading& reading, const T& effort, const Nodes& nodes, Balance<T, Count>& balance) const {
    coordinate.act(reading, effort, nodes[node[0]], nodes[node[1]], static_cast<int>(node[0]), static_cast<int>(node[1]),
                   balance);
  }
  void commit(const State& state, std::span<double> history) const;

 private:
  std::span<const double> committed(const State& state) const {
    return state.history.subspan(history, static_cast<std::size_t>(coordinate.history()));
  }
};

/// Finds the coordinate `name` of element `id`, or its first one if the name is empty. Returns nothing, with an error at the
/// keyword, if there is no such element or it has no such coordinate.
std::optional<Coordinate> find_coordinate(const BuildContext& context, std::string_view keyword, int id,
                                          std::string_view name_keyword, const std::string& name);

}  // namespace engrane::elements::control
