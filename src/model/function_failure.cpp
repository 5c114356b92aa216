// SPDX-License-Identifier: BSD-3-Clause
#include "model/function_failure.hpp"

#include <cmath>
#include <mutex>
#include <utility>

namespace engrane {

namespace {

std::mutex mutex;
std::string failure;
int failure_order = 0;

}  // namespace

void note_function_failure(int order, std::string text) {
  const std::lock_guard lock(mutex);
  if (!failure.empty() && order > failure_order) return;
  failure = std::move(text);
  failure_order = order;
}

std::string last_function_failure() {
  const std::lock_guard lock(mutex);
  return failure;
}

void forget_function_failures() {
  const std::lock_guard lock(mutex);
  failure.clear();
}

std::string describe_not_finite(double value) { return std::isnan(value) ? "is not a number" : "is infinite"; }

}  // namespace engrane
