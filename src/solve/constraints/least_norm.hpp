// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/SparseCore>
#include <vector>

namespace engrane::solve {

/// The shortest x' with a x' = a x for each column of `x`, at the cost of one sparse QR of the columns that no leaf takes
/// (take_leaves), whatever their dependence. Q of their transpose does it, Q₁Q₁ᵀx with the columns of Q up to the rank (Golub and
/// Van Loan, Matrix Computations, 5.5), so that no null vectors are formed, which may run through the whole model.
///
/// Rows of `a` that have a remainder shorter than `tolerance` of their length after the others count as dependent. `groups`:
/// as for take_leaves. Throws std::bad_alloc when Q does not fit into memory.
Eigen::MatrixXd shortest_equivalent(const Eigen::SparseMatrix<double>& a, const Eigen::MatrixXd& x, double tolerance,
                                    std::vector<int> groups);

}  // namespace engrane::solve
