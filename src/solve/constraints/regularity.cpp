// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/regularity.hpp"

#include <klu.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <cmath>
#include <limits>
#include <vector>

#include "solve/constraints/leaves.hpp"

namespace engrane::solve {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Whether det(A Bᵀ) is negative.
bool changes_sign(const Sparse& a, const Sparse& b) {
  if (a.rows() == 1 && a.cols() == 1) return a.coeff(0, 0) * b.coeff(0, 0) < 0;
  const Sparse product = a * Sparse(b.transpose());
  Eigen::SparseLU<Sparse> factors(product);
  return factors.info() == Eigen::Success && factors.signDeterminant() < 0;
}

/// Square matrices as block upper triangular ones, in the same order: the determinant is the product of those of the blocks.
class Blocks {
 public:
  Blocks(const Sparse& a, const Sparse& b) {
    constexpr double rounding = 1e-12;  // of the largest entry: joins no blocks
    Sparse both = a.cwiseAbs() + b.cwiseAbs();
    const double largest = both.nonZeros() > 0 ? both.coeffs().maxCoeff() : 0;
    both.prune([&](Eigen::Index, Eigen::Index, double value) { return value > rounding * largest; });
    both.makeCompressed();
    klu_defaults(&common_);
    symbolic_ = klu_analyze(static_cast<int>(both.rows()), both.outerIndexPtr(), both.innerIndexPtr(), &common_);
    if (symbolic_ == nullptr) return;
    for (int i = 0; i < symbolic_->n; ++i) place_of_row_.push_back(0);
    for (int i = 0; i < symbolic_->n; ++i) place_of_row_[static_cast<std::size_t>(symbolic_->P[i])] = i;
  }
  ~Blocks() { klu_free_symbolic(&symbolic_, &common_); }
  Blocks(const Blocks&) = delete;
  Blocks& operator=(const Blocks&) = delete;

  int count() const { return symbolic_ != nullptr ? symbolic_->nblocks : 0; }
  Sparse block(const Sparse& a, int k) const {
    const int begin = symbolic_->R[k], size = symbolic_->R[k + 1] - begin;
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < size; ++j)
      for (Sparse::InnerIterator entry(a, symbolic_->Q[begin + j]); entry; ++entry)
        if (const int i = place_of_row_[static_cast<std::size_t>(entry.row())] - begin; i >= 0 && i < size)
          entries.emplace_back(i, j, entry.value());
    Sparse block(size, size);
    block.setFromTriplets(entries.begin(), entries.end());
    return block;
  }

 private:
  klu_common common_{};
  klu_symbolic* symbolic_ = nullptr;
  std::vector<int> place_of_row_;
};

}  // namespace

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
  if (gradient_.rows() != gradient_.cols()) return !changes_sign(gradient_, other.gradient_);
  const Blocks blocks(gradient_, other.gradient_);
  if (blocks.count() == 0) return !changes_sign(gradient_, other.gradient_);
  for (int k = 0; k < blocks.count(); ++k)
    if (changes_sign(blocks.block(gradient_, k), blocks.block(other.gradient_, k))) return false;
  return true;
}

}  // namespace engrane::solve
