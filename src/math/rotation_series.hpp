// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "math/dual.hpp"
#include "math/taylor.hpp"

namespace engrane {

/// The functions of the square u = a² of an angle that rotations are made of,
///
///     φ_n(u) = Σ_k (−u)^k/(2k + n)!:   φ_1 = sin a/a,   φ_2 = (1 − cos a)/a²,   φ_3 = (a − sin a)/a³
///
/// and slopes dφ_n/du, in numbers that elements differentiate. Accurate to rounding for angles up to about 3, zero among them.
template <class T>
struct RotationSeries {
  T f1, f2, f3;          ///< φ_1, φ_2, φ_3
  T f2_slope, f3_slope;  ///< dφ_2/du, dφ_3/du

  explicit RotationSeries(const T& u) {
    constexpr std::size_t count = 10;
    std::array<double, count> phi{}, inverse{};  // φ_n and 1/n!
    inverse[0] = 1;
    for (std::size_t n = 1; n < count; ++n) inverse[n] = inverse[n - 1] / static_cast<double>(n);
    const double x = value_of(u);
    // the last two by their series, the others from these: φ_n = 1/n! − u φ_{n+2}
    constexpr int terms = 12;
    for (const std::size_t n : {count - 2, count - 1}) {
      double sum = 1;
      for (int k = terms; k > 0; --k) {
        const auto m = static_cast<double>(2 * k) + static_cast<double>(n);
        sum = 1 - x / (m * (m - 1)) * sum;
      }
      phi[n] = inverse[n] * sum;
    }
    for (std::size_t n = count - 2; n-- > 0;) phi[n] = inverse[n] - x * phi[n + 2];
    // dφ_n/du = ½ (n φ_{n+2} − φ_{n+1})
    std::array<double, 8> first{};
    std::array<double, 6> second{};
    std::array<double, 4> third{};
    const auto derive = [](const auto& of, auto& to) {
      for (std::size_t n = 0; n < to.size(); ++n) to[n] = (static_cast<double>(n) * of[n + 2] - of[n + 1]) / 2;
    };
    derive(phi, first);
    derive(first, second);
    derive(second, third);
    f1 = compose(u, phi[1], first[1], second[1]);
    f2 = compose(u, phi[2], first[2], second[2]);
    f3 = compose(u, phi[3], first[3], second[3]);
    f2_slope = compose(u, first[2], second[2], third[2]);
    f3_slope = compose(u, first[3], second[3], third[3]);
  }
};

}  // namespace engrane
