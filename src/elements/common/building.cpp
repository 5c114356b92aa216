// SPDX-License-Identifier: BSD-3-Clause
#include "elements/common/building.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace engrane::elements {

std::optional<Vec3> unit_vector(const BuildContext& context, std::string_view keyword, const std::array<double, 3>& v) {
  const Vec3 vector = to_vector(v);
  // scaled by its largest component first, so that the squares neither overflow nor underflow
  const double largest = vector.cwiseAbs().maxCoeff();
  if (!(largest > 0)) {
    context.error(keyword, fmt::format("{} 0 0 0 is not a direction", keyword), "give three components, not all zero");
    return {};
  }
  return Vec3((vector / largest).normalized());
}

bool check_nodes(const BuildContext& context, const std::vector<int>& nodes) {
  if (nodes.empty()) return false;  // already reported by the reader
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (std::count(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(i), nodes[i]) > 0) {
      context.error("N", fmt::format("node {} is named twice", nodes[i]), "give different nodes; 0 is the ground");
      return false;
    }
  if (nodes.size() == 1 && nodes[0] == 0) {
    context.error("N", "the ground alone cannot move", "give a node of the model");
    return false;
  }
  return true;
}

bool find_function(const BuildContext& context, int id, const Function*& function) {
  function = nullptr;
  if (id == 0) return true;
  function = context.function_of_time(id, "NF");
  return function != nullptr;
}

bool same_place(const Vec3& a, const Vec3& b) {
  return (a - b).norm() <= 1e-6 * std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
}

std::string number(double value) { return fmt::format("{:.10g}", std::abs(value) < 1e-12 ? 0.0 : value); }

std::string json(const Vec3& v) { return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]); }

std::string json(const std::vector<int>& ids) { return fmt::format("[{}]", fmt::join(ids, ", ")); }

}  // namespace engrane::elements
