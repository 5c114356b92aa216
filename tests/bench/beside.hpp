// SPDX-License-Identifier: BSD-3-Clause
// What benchmarks that compare two ways to the same numbers have in common.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>

namespace engrane::bench {

/// Time that `work` takes: the least of many rounds.
template <class Work>
double microseconds(const Work& work) {
  constexpr int rounds = 200, times = 200;
  double least = 1e9;
  for (int round = 0; round < rounds; ++round) {
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < times; ++i) work();
    least = std::min(least, std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count() / times);
  }
  return least;
}

/// The largest difference of residuals r, s and tangents k, l, over the largest entry of k.
template <class R, class K>
double difference(const R& r, const K& k, const R& s, const K& l) {
  double apart = 0, largest = 0;
  for (std::size_t i = 0; i < k.size(); ++i) {
    apart = std::max(apart, std::abs(k[i] - l[i]));
    largest = std::max(largest, std::abs(k[i]));
  }
  for (std::size_t i = 0; i < r.size(); ++i) apart = std::max(apart, std::abs(r[i] - s[i]));
  return apart / largest;
}

}  // namespace engrane::bench
