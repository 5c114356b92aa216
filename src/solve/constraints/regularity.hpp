// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solve/constraints/constraint_factors.hpp"

namespace engrane::solve {

/// How well constraints and drives that leave nothing free determine a position: their gradient B, redundant ones included.
class Regularity {
 public:
  Regularity(Assembler& assembler, const Configuration& c);

  /// Largest motion, over the extent or in radians, that closes constraints open by one: the inverse of the smallest singular
  /// value of B. From singular() on it is no more than large.
  double amplification() const { return amplification_; }
  /// Whether B loses its rank here, as far as rounding allows to see.
  bool singular() const { return !(amplification_ < 1e7); }
  /// Whether two positions are on the same side of the singular ones, where det B changes its sign. With redundant constraints
  /// it also does so where the independent ones would have to be chosen anew; det(B B'ᵀ), the sum of the products of both
  /// determinants over all choices (Cauchy and Binet), does not. Without them loops that do not depend on each other are looked
  /// at one by one: two that have changed at once leave the sign of the whole. True if one of them is singular.
  bool same_side(const Regularity& other) const;

 private:
  Eigen::SparseMatrix<double> gradient_;  ///< a row for each motion, a column for each constraint
  double amplification_ = 0;
};

}  // namespace engrane::solve
