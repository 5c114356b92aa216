// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/mumps_analysis.hpp"

#include <algorithm>
#include <cmath>

#include "solve/algebra/rows.hpp"

namespace engrane::solve {

namespace {

/// Dense rows with less work than this do not matter: some milliseconds.
constexpr double least_work = 1e6;

/// Operations of factors beside the work of dense rows for which minimum degree is best (docs/decisions/0031-links-to-meshes.md).
constexpr double small_factors = 1 / 30.0;

enum class Order : unsigned char {
  usual,    ///< MUMPS chooses
  dissect,  ///< MUMPS chooses, without a matching of rows to columns before
  degree    ///< minimum degree that puts dense rows aside (QAMD)
};

/// The room is larger by up to this factor where multipliers stand in dense rows, since most of their pivots are delayed.
constexpr int room_for_delayed = 4;

/// ICNTL(7) in PETSc's options, where the user has not set it, for the lifetime of this object. On one rank PETSc's interface
/// takes the ordering from there only.
class OrderOption {
 public:
  explicit OrderOption(Order order) {
    if (order != Order::degree) return;
    PetscBool given = PETSC_FALSE;
    check_petsc(PetscOptionsHasName(nullptr, nullptr, name, &given));
    if (given) return;
    check_petsc(PetscOptionsSetValue(nullptr, name, "6"));
    set_ = true;
  }
  ~OrderOption() {
    if (set_) (void)PetscOptionsClearValue(nullptr, name);
  }
  OrderOption(const OrderOption&) = delete;
  OrderOption& operator=(const OrderOption&) = delete;

 private:
  static constexpr const char* name = "-mat_mumps_icntl_7";
  bool set_ = false;
};

struct Analysis {
  Mat matrix;
  bool symmetric;
  int room;
  const std::function<void(Mat)>& set_options;

  void make(Order order, Owned<Mat>& factors) const {
    factors = {};
    check_petsc(MatGetFactor(matrix, MATSOLVERMUMPS, symmetric ? MAT_FACTOR_CHOLESKY : MAT_FACTOR_LU, factors.out()));
    set_options(factors);
    check_petsc(MatMumpsSetIcntl(factors, 14, room));
    if (order != Order::usual) check_petsc(MatMumpsSetIcntl(factors, 12, 1));
    const OrderOption option(order);
    MatFactorInfo info;
    check_petsc(MatFactorInfoInitialize(&info));
    check_petsc(symmetric ? MatCholeskyFactorSymbolic(factors, matrix, nullptr, &info)
                          : MatLUFactorSymbolic(factors, matrix, nullptr, nullptr, &info));
  }
};

}  // namespace

DenseRows dense_rows(Mat matrix) {
  const auto columns = static_cast<double>(rows_of(matrix));
  const double dense = std::max(16.0, 10 * std::sqrt(columns));
  double work = 0, longest = 0;
  for (const PetscInt entries : lengths_of_rows(matrix)) {
    const auto length = static_cast<double>(entries);
    if (length <= dense) continue;
    work += length * length;
    longest = std::max(longest, length);
  }
  MPI_Allreduce(MPI_IN_PLACE, &work, 1, MPI_DOUBLE, MPI_SUM, comm_of(matrix));
  MPI_Allreduce(MPI_IN_PLACE, &longest, 1, MPI_DOUBLE, MPI_MAX, comm_of(matrix));
  return {work, longest / columns};
}

void analyse_for_mumps(Mat matrix, bool symmetric, int room, Owned<Mat>& factors, const std::function<void(Mat)>& set_options) {
  const DenseRows dense = dense_rows(matrix);
  if (dense.work < least_work) return Analysis{matrix, symmetric, room, set_options}.make(Order::usual, factors);
  const int enlarged = static_cast<int>(room * (1 + (room_for_delayed - 1) * dense.share));
  const Analysis analysis{matrix, symmetric, enlarged, set_options};
  // The time of the matching and of the nested dissection grows with this work, that of minimum degree does not. Where factors
  // are not small beside it, as those of solids, minimum degree loses more in each factorisation than it saves.
  analysis.make(Order::degree, factors);
  PetscReal operations = 0;
  check_petsc(MatMumpsGetRinfog(factors, 1, &operations));
  if (operations > small_factors * dense.work) analysis.make(Order::dissect, factors);
}

}  // namespace engrane::solve
