// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "math/dual.hpp"
#include "math/taylor.hpp"

namespace engrane {

/// Functions of the square u = a² of a rotation angle,
///
///     φ_n(u) = Σ_k (−u)^k/(2k + n)!:   φ_1 = sin a/a,   φ_2 = (1 − cos a)/a²,   φ_3 = (a − sin a)/a³
///
/// and their derivatives with respect to u, indexed by n. Accurate to rounding for angles up to about 3, including zero.
struct RotationSeriesDerivatives {
  std::array<double, 10> phi{};
  std::array<double, 8> first{};
  std::array<double, 6> second{};
  std::array<double, 4> third{};

  explicit RotationSeriesDerivatives(double u) {
    constexpr std::size_t count = 10, terms = 12;
    static constexpr auto inverse = [] {  // 1/n!
      std::array<double, count> all{1};
      for (std::size_t n = 1; n < count; ++n) all[n] = all[n - 1] / static_cast<double>(n);
      return all;
    }();
    static constexpr auto shrink = [] {  // 1/(m (m − 1)) for term k, m = 2k + n, of the two largest n
      std::array<std::array<double, terms + 1>, 2> all{};
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t k = 1; k <= terms; ++k) {
          const auto m = static_cast<double>(2 * k + count - 2 + i);
          all[i][k] = 1 / (m * (m - 1));
        }
      return all;
    }();
    // the two largest n by their series, the others by the recurrence φ_n = 1/n! − u φ_{n+2}
    for (std::size_t i = 0; i < 2; ++i) {
      double sum = 1;
      for (std::size_t k = terms; k > 0; --k) sum = 1 - u * shrink[i][k] * sum;
      phi[count - 2 + i] = inverse[count - 2 + i] * sum;
    }
    for (std::size_t n = count - 2; n-- > 0;) phi[n] = inverse[n] - u * phi[n + 2];
    // dφ_n/du = ½ (n φ_{n+2} − φ_{n+1})
    const auto derive = [](const auto& of, auto& to) {
      for (std::size_t n = 0; n < to.size(); ++n) to[n] = (static_cast<double>(n) * of[n + 2] - of[n + 1]) / 2;
    };
    derive(phi, first);
    derive(first, second);
    derive(second, third);
  }
};

/// φ_1, φ_2, φ_3 and the slopes dφ_2/du, dφ_3/du in the scalar type of the element.
template <class T>
struct RotationSeries {
  T f1, f2, f3;
  T f2_slope, f3_slope;

  explicit RotationSeries(const T& u) {
    const RotationSeriesDerivatives at(value_of(u));
    f1 = compose(u, at.phi[1], at.first[1], at.second[1]);
    f2 = compose(u, at.phi[2], at.first[2], at.second[2]);
    f3 = compose(u, at.phi[3], at.first[3], at.second[3]);
    f2_slope = compose(u, at.first[2], at.second[2], at.third[2]);
    f3_slope = compose(u, at.first[3], at.second[3], at.third[3]);
  }
};

}  // namespace engrane
