// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/mode_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace engrane::solve {

bool is_translation(const Numbering& numbering, std::size_t equation) {
  const Unknown& u = numbering.unknown(static_cast<int>(equation));
  return u.node >= 0 && u.item < 3;
}

std::string largest_components(const Numbering& numbering, std::span<const double> vector) {
  constexpr std::size_t most = 3;
  std::vector<std::size_t> order;
  const auto take = [&](bool translations) {
    order.clear();
    for (std::size_t i = 0; i < vector.size(); ++i)
      if (!numbering.unknown(static_cast<int>(i)).multiplier && is_translation(numbering, i) == translations) order.push_back(i);
  };
  take(true);
  if (std::all_of(order.begin(), order.end(), [&](std::size_t i) { return vector[i] == 0; })) take(false);
  const std::size_t shown = std::min(most, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(shown), order.end(),
                    [&](std::size_t a, std::size_t b) {
                      const double one = std::abs(vector[a]), other = std::abs(vector[b]);
                      return one != other ? one > other : a < b;
                    });
  std::string text;
  for (std::size_t k = 0; k < shown; ++k)
    text += fmt::format("{}{} {:.3g}", k == 0 ? "" : ", ", numbering.describe(static_cast<int>(order[k])),
                        vector[order[k]] / vector[order[0]]);
  return text;
}

}  // namespace engrane::solve
