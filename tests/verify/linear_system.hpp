// SPDX-License-Identifier: BSD-3-Clause
// Small dense matrices for tests of the packages that factor them.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "base/snapshot.hpp"
#include "solve/algebra/linear.hpp"

namespace engrane::test {

/// A sequential matrix whose pattern stays, with LinearSolver on it.
class LinearSystem {
 public:
  explicit LinearSystem(const Eigen::MatrixXd& a, const std::string& package = "KLU",
                        const std::vector<unsigned char>& kinds = {})
      : n_(static_cast<int>(a.rows())) {
    check_petsc(MatCreateSeqAIJ(PETSC_COMM_SELF, n_, n_, n_, nullptr, matrix_.out()));
    check_petsc(MatCreateVecs(matrix_, right_.out(), solution_.out()));
    set(a);
    solver_ = std::make_unique<solve::LinearSolver>(matrix_, package, kinds);
  }

  void set(const Eigen::MatrixXd& a) {
    a_ = a;
    for (int i = 0; i < n_; ++i)
      for (int j = 0; j < n_; ++j) check_petsc(MatSetValue(matrix_, i, j, a(i, j), INSERT_VALUES));
    check_petsc(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
    check_petsc(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
  }

  bool solve(const Eigen::VectorXd& b) {
    for (int i = 0; i < n_; ++i) check_petsc(VecSetValue(right_, i, b[i], INSERT_VALUES));
    if (!solver_->solve(right_, solution_)) return false;
    x.resize(n_);
    for (int i = 0; i < n_; ++i) check_petsc(VecGetValues(solution_, 1, &i, &x[i]));
    error = ((b - a_ * x).cwiseAbs().array() / (a_.cwiseAbs() * x.cwiseAbs() + b.cwiseAbs()).array()).maxCoeff();
    return true;
  }

  double condition() { return solver_->condition().value(); }
  /// What the solver keeps for the next solution.
  Snapshot memory() const {
    Snapshot snapshot;
    solver_->save(snapshot);
    return snapshot;
  }

  Eigen::VectorXd x;
  double error = 0;  ///< backward, largest over the rows

 private:
  int n_;
  Eigen::MatrixXd a_;
  Owned<Mat> matrix_;
  Owned<Vec> right_, solution_;
  std::unique_ptr<solve::LinearSolver> solver_;
};

/// [M −Bᵀ; −B 0] with entries of very different sizes.
inline Eigen::MatrixXd saddle_point(std::mt19937& random, int motions, int constraints) {
  std::uniform_real_distribution<double> entry(-1, 1), decade(-3, 3);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(motions + constraints, motions + constraints);
  for (int i = 0; i < motions; ++i) a(i, i) = std::pow(10, decade(random));
  for (int i = motions; i < motions + constraints; ++i)
    for (int j = 0; j < motions; ++j) a(i, j) = a(j, i) = entry(random);
  return a;
}

}  // namespace engrane::test
