// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/regularity.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <cmath>
#include <limits>

#include "solve/constraints/leaves.hpp"

namespace engrane::solve {

Regularity::Regularity(Assembler& assembler, const Configuration& c)
    : gradient_(with_columns_scaled(ConstraintMatrix(assembler, at_start_of_step(c), ConstraintColumns::gradients).matrix,
                                    constraint_sizes(assembler).cwiseInverse())) {
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(gradient_ * gradient_.transpose());
  Eigen::VectorXd motion(gradient_.rows());
  for (Eigen::Index i = 0; i < motion.size(); ++i) motion[i] = std::cos(2.3 * static_cast<double>(i));  // a generic one
  // two steps of inverse iteration; close to a singular position a third would change nothing
  amplification_ = factors.info() == Eigen::Success ? std::sqrt(factors.solve(factors.solve(motion).normalized()).norm())
                                                    : std::numeric_limits<double>::infinity();
}

bool Regularity::same_side(const Regularity& other) const {
  if (singular() || other.singular()) return true;
  const Eigen::SparseMatrix<double> product = gradient_ * other.gradient_.transpose();
  Eigen::SparseLU<Eigen::SparseMatrix<double>> factors(product);
  return factors.info() != Eigen::Success || factors.signDeterminant() >= 0;
}

}  // namespace engrane::solve
