// SPDX-License-Identifier: BSD-3-Clause
#include "observe/field_channels.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "observe/fields.hpp"

namespace engrane::observe {

namespace {

/// Magnitudes that differ by this part of them are alike: opposite stresses at the points of a cell that is bent.
constexpr double alike = 1e-9;

/// An equivalent stress is the root of a quadratic form of stresses, which are smooth themselves.
Channel channel_of(const std::string& name, const Named& field) {
  Channel channel{{name, field.dimension, field.help}};
  if (field.name != "VON_MISES") return channel;
  channel.course = Channel::Course::size;
  channel.low = 0;
  return channel;
}

/// Splits `STRESS:XX:3` into the component and the number of a place, 0 if it has none.
std::pair<std::string, std::size_t> split_place(const std::string& name) {
  const std::size_t colon = name.rfind(':');
  std::size_t place = 0;
  if (colon == std::string::npos) return {name, 0};
  const char* const end = name.data() + name.size();
  const auto [read, error] = std::from_chars(name.data() + colon + 1, end, place);
  if (error != std::errc() || read != end || place == 0) return {name, 0};
  return {name.substr(0, colon), place};
}

}  // namespace

double FieldValues::largest(std::span<const double> all) const {
  double found = all[first];
  for (std::size_t i = 1; i < count; ++i) {
    const double value = all[first + i * stride], more = std::abs(value) - std::abs(found);
    if (more > alike * std::abs(value) || (value > found && more > -alike * std::abs(value))) found = value;
  }
  return found;
}

std::vector<std::string> component_names(const std::string& field, const std::vector<std::string>& components) {
  if (components.empty()) return {field};
  std::vector<std::string> names;
  for (const std::string& component : components) names.push_back(field + ":" + component);
  return names;
}

std::vector<FieldChannel> field_channels(const Element& element, std::size_t nodes) {
  std::vector<FieldChannel> all;
  std::size_t first = 0;
  for (const Field& field : element.fields()) {
    const std::size_t width = field.width(), size = field.size(nodes), places = size / width;
    for (const std::string& name : component_names(field.name, field.components))
      all.push_back({channel_of(name, field), {first++, places, width}});
    first += size - width;
  }
  return all;
}

std::optional<FieldChannel> field_channel(const Element& element, std::size_t nodes, const std::string& name) {
  if (element.fields().empty()) return {};
  std::vector<FieldChannel> all = field_channels(element, nodes);
  const auto find = [&all](const std::string& wanted) {
    return std::find_if(all.begin(), all.end(), [&](const FieldChannel& one) { return one.channel.name == wanted; });
  };
  // a component may have a number for a name: `PRINCIPAL:1`
  if (const auto found = find(name); found != all.end()) return *found;
  const auto [component, place] = split_place(name);
  const auto found = find(component);
  if (place == 0 || found == all.end() || place > found->values.count) return {};
  FieldChannel one = *found;
  one.values = {found->values.first + (place - 1) * found->values.stride, 1, 1};
  one.channel.name = name;
  return one;
}

std::vector<const Element*> elements_averaged(const Model& model) {
  std::vector<const Element*> all(model.nodes.size(), nullptr);
  for (const Model::Part& part : model.parts)
    if (part.element->section() >= 0)
      for (const int node : part.nodes)
        if (const Element*& first = all[static_cast<std::size_t>(node)]; !first) first = part.element.get();
  return all;
}

std::vector<Channel> averaged_channels(const Element& element) {
  std::vector<Channel> channels;
  for (const Field& field : element.fields())
    if (is_averaged(field))
      for (const std::string& name : component_names(field.name, field.components)) channels.push_back(channel_of(name, field));
  return channels;
}

}  // namespace engrane::observe
