// SPDX-License-Identifier: BSD-3-Clause
#include "elements/beams/line_shape.hpp"

namespace engrane::elements::beams {

bool LineNodes::check(const BuildContext& context) const {
  const std::size_t count = nodes.size();
  for (std::size_t i = 1; i < count; ++i)
    if (nodes[i] == nodes[i - 1]) {
      context.error("N", fmt::format("node {} stands twice in turn", nodes[i]), "name each node of the line once");
      return false;
    }
  if (!of_two() && count % 2 == 0) {
    context.error("N", fmt::format("{} nodes: pieces have three, and share their ends", count),
                  fmt::format("name {} or {} nodes, or say LINEAR, for pieces of two", count - 1, count + 1));
    return false;
  }
  const int id = context.record.id, last = id + static_cast<int>(pieces()) - 1;
  for (int other = id + 1; other <= last; ++other)
    if (const auto found = context.find_element ? context.find_element(other) : BuildContext::Found{}; found.record) {
      const std::string& name = found.record->schema->name;
      context.error("N",
                    fmt::format("the {} pieces of {} {} have the numbers {} to {}, but {} is a {}", pieces(),
                                context.record.schema->name, id, id, last, other, name),
                    fmt::format("give the {} another number", name));
      return false;
    }
  return true;
}

}  // namespace engrane::elements::beams
