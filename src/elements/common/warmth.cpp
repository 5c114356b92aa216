// SPDX-License-Identifier: BSD-3-Clause
#include "elements/common/warmth.hpp"

#include <fmt/format.h>

namespace engrane::elements {

NodeWarmth warmth_of(const std::vector<int>& nodes, bool expands, const char* what, const BuildContext& context) {
  if (!context.temperatures || context.temperatures->empty()) return nullptr;
  std::vector<Warmth> found(nodes.size());
  bool any = false;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (const auto at = context.temperatures->find(nodes[i]); at != context.temperatures->end()) {
      found[i] = at->second;
      any = true;
    }
  if (!any) return nullptr;
  if (expands) return std::make_shared<const std::vector<Warmth>>(std::move(found));
  context.diagnostics.warning_once(
      fmt::format("warm {}", what), context.record.location,
      fmt::format("the material of {} {} does not expand: TEMP has no effect on it", what, context.record.id),
      "A of its .MAT is the coefficient of thermal expansion");
  return nullptr;
}

}  // namespace engrane::elements
