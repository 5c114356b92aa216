// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "math/dual.hpp"

namespace engrane {

template <class T>
inline constexpr bool is_dual = false;
template <int N>
inline constexpr bool is_dual<Dual<N>> = true;

/// Evaluates y = f(x) for a few variables x. If T carries more derivative lanes than there are variables, f is differentiated
/// with respect to x only and the chain rule maps the result to all lanes. That is cheaper than evaluating f in T.
template <std::size_t Out, class T, std::size_t In, class F>
std::array<T, Out> through_few(const std::array<T, In>& x, const F& f) {
  if constexpr (!is_dual<T>) {
    return f(x);
  } else {
    using Own = Dual<static_cast<int>(In)>;
    std::array<Own, In> own;
    for (std::size_t i = 0; i < In; ++i) {
      own[i] = Own(x[i].value);
      own[i].d[i] = 1;
    }
    const std::array<Own, Out> y = f(own);
    std::array<T, Out> out;
    for (std::size_t o = 0; o < Out; ++o) {
      out[o] = T(y[o].value);
      for (std::size_t i = 0; i < In; ++i)
        for (std::size_t lane = 0; lane < out[o].d.size(); ++lane) out[o].d[lane] += y[o].d[i] * x[i].d[lane];
    }
    return out;
  }
}

}  // namespace engrane
