// SPDX-License-Identifier: BSD-3-Clause
// Profiles for tests of cams.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

namespace engrane::elements::cams {

/// An oval with one flat side, twelve points as POLAR has them: convex everywhere.
inline std::vector<double> oval() {
  std::vector<double> values;
  for (int k = 0; k < 12; ++k) {
    const double a = 30 * k * std::numbers::pi / 180;
    values.push_back(30 * k);
    values.push_back(0.6 + 0.05 * std::cos(a) + 0.02 * std::sin(2 * a));
  }
  return values;
}

/// Six hills with hollows between them.
inline std::vector<double> star() {
  std::vector<double> values = oval();
  for (std::size_t k = 3; k < values.size(); k += 4) values[k] *= 0.7;
  return values;
}

}  // namespace engrane::elements::cams
