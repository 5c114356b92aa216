// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace engrane::observe {

/// Values of one component of a field among all field values of an element: at one place, or at all.
struct FieldValues {
  std::size_t first = 0, count = 1, stride = 1;

  /// The value of largest magnitude, with its sign; of opposite ones the positive.
  double largest(std::span<const double> all) const;
};

/// A history that a field gives.
struct FieldChannel {
  Channel channel;
  FieldValues values;
};

/// `STRESS:XX`, or the name of a scalar field, for each component of a field.
std::vector<std::string> component_names(const std::string& field, const std::vector<std::string>& components);

/// Channels of an element from its fields, one per component: of several points or nodes the value of largest magnitude.
std::vector<FieldChannel> field_channels(const Element& element, std::size_t nodes);
/// One of these channels by its name, or the component at one place: `STRESS:XX:3` at the third point.
std::optional<FieldChannel> field_channel(const Element& element, std::size_t nodes, const std::string& name);

/// The first element with averaged fields (Element::section) that each node of Model::nodes belongs to; nullptr: none.
std::vector<const Element*> elements_averaged(const Model& model);
/// Channels of a node of this element from the fields that are averaged there: one per component, of the sections that meet at
/// the node the value of largest magnitude.
std::vector<Channel> averaged_channels(const Element& element);

}  // namespace engrane::observe
