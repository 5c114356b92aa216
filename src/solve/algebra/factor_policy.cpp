// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/factor_policy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace engrane::solve {

namespace {

/// A contraction weaker than this does not lead to a solution.
constexpr double worst_contraction = 0.5;

}  // namespace

double FactorPolicy::corrections(double residual, double theta) {
  if (!(theta < worst_contraction)) return std::numeric_limits<double>::infinity();
  return std::max(1.0, std::ceil(std::log(residual) / -std::log(theta)));
}

void FactorPolicy::begin(double residual, double renewal) {
  residual_ = residual;
  renewal_ = renewal;
  contraction_ = 0;
  made_ = 0;
  ++age_;
}

bool FactorPolicy::due() const {
  if (!usable_) return true;
  // the first solution after that for which they were made shows how good they are
  if (made_ == 0) return age_ > 1 && corrections(residual_, theta_ * age_ / (age_ - 1)) * (age_ - 1) > spent_;
  return contraction_ > 0 && corrections(residual_, contraction_) > renewal_ + 1;
}

void FactorPolicy::renewed() {
  usable_ = true;
  theta_ = contraction_ = 0;
  age_ = 0;
  spent_ = renewal_;
}

void FactorPolicy::corrected(double residual) {
  ++made_;
  spent_ += 1;
  contraction_ = std::max(contraction_, residual / residual_);
  residual_ = residual;
}

void FactorPolicy::end(bool converged) {
  if (!converged) return forget();
  if (age_ > 0) theta_ = contraction_;
}

void FactorPolicy::save(Snapshot& snapshot) const {
  snapshot.put("newton/factors", {usable_ ? 1.0 : 0.0, theta_, static_cast<double>(age_), spent_});
}

void FactorPolicy::load(const Snapshot& snapshot) {
  const std::vector<double>& kept = snapshot.array("newton/factors");
  usable_ = kept.at(0) != 0;
  theta_ = kept.at(1);
  age_ = static_cast<int>(kept.at(2));
  spent_ = kept.at(3);
}

}  // namespace engrane::solve
