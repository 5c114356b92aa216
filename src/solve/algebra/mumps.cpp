// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/mumps.hpp"

#include <fmt/format.h>

#include "base/memory.hpp"
#include "solve/algebra/mumps_analysis.hpp"
#include "solve/algebra/rows.hpp"
#include "solve/algebra/solver_cost.hpp"

namespace engrane::solve {

namespace {

/// Workspace above the estimate, per cent: for pivots that are not where the analysis expects them, and for work that ranks
/// give one another during the factorisation. Without either the estimate is nearly exact. With too little room the whole
/// factorisation is repeated.
constexpr int some_room = 10, usual_room = 50, most_room = 3000;

/// Blocks are approximated to this, relative to the scaled matrix: one refinement brings the solution to rounding, where 1e-6
/// does not, and saves little more (docs/decisions/0027-solver-ladder.md).
constexpr double low_rank_tolerance = 1e-9;

constexpr double gigabyte = 1e9, megabyte = 1e6;

double infog(Mat factors, PetscInt index) {
  PetscInt value = 0;
  check_petsc(MatMumpsGetInfog(factors, index, &value));
  return static_cast<double>(value);
}

/// A count from MUMPS, which gives large ones in millions, as negative numbers.
double entries(double value) { return value < 0 ? -1e6 * value : value; }

}  // namespace

void Mumps::become(Form form) {
  PackageFactors::forget();
  form_ = form;
  room_ = form == Form::definite && is_sequential(matrix_) ? some_room : usual_room;
}

void Mumps::forget() { become(Form::unknown); }

bool Mumps::analyse() {
  if (factors_) return !failed();
  if (form_ == Form::unknown)
    become(!symmetry_.symmetric() ? Form::general : symmetry_.positive_diagonal() ? Form::definite : Form::symmetric);
  symmetry_.rest();
  if (form_ != Form::definite) note_analysed();  // without a choice of pivots only the pattern matters
  const bool symmetric = form_ != Form::general;
  if (symmetric) check_petsc(MatSetOption(matrix_, MAT_SPD, form_ == Form::definite ? PETSC_TRUE : PETSC_FALSE));
  analyse_for_mumps(matrix_, symmetric, room_, factors_, [this](Mat factors) {
    if (!low_rank_) return;
    check_petsc(MatMumpsSetIcntl(factors, 35, 2));  // low-rank blocks in factors and solutions
    check_petsc(MatMumpsSetCntl(factors, 7, low_rank_tolerance));
  });
  if (failed()) return false;
  refuse_without_memory();
  return true;
}

bool Mumps::factor_as_analysed() {
  MatFactorInfo info;
  check_petsc(MatFactorInfoInitialize(&info));
  check_petsc(form_ == Form::general ? MatLUFactorNumeric(factors_, matrix_, &info)
                                     : MatCholeskyFactorNumeric(factors_, matrix_, &info));
  return !failed();
}

bool Mumps::factor() {
  if (factors_ && form_ != Form::general && !symmetry_.symmetric()) become(Form::general);
  while (true) {
    if (analyse() && factor_as_analysed()) return true;
    if (enlarge()) continue;
    if (form_ != Form::definite) break;
    become(Form::symmetric);  // a diagonal pivot may be zero where others are not
  }
  forget();
  return false;
}

bool Mumps::improve() {
  if (low_rank_) {
    low_rank_ = false;
    left_low_rank_ = true;
    become(form_);
    return factor();
  }
  become(form_ == Form::definite ? Form::symmetric : Form::general);
  return factor();
}

bool Mumps::enlarge() {
  const auto info = static_cast<int>(infog(factors_, 1));
  const bool short_of_room = info == -9 || info == -8 || info == -14 || info == -15;
  if (!short_of_room || room_ > most_room) return false;
  PackageFactors::forget();  // after a failure PETSc's interface no longer factors, and does not say so
  room_ *= 4;
  return true;
}

void Mumps::save(Snapshot& snapshot) const {
  PackageFactors::save(snapshot);
  snapshot.put("solver/MUMPS form", static_cast<int>(form_));
}

void Mumps::load(const Snapshot& snapshot) {
  forget();
  if (snapshot.has("solver/MUMPS form")) become(static_cast<Form>(static_cast<int>(snapshot.number("solver/MUMPS form"))));
  if (half_ && form_ == Form::general) become(Form::unknown);
  PackageFactors::load(snapshot);
}

std::optional<ForeseenFactors> Mumps::foresee() {
  if (!analyse()) return {};
  return foreseen();
}

ForeseenFactors Mumps::foreseen() const {
  PetscReal operations = 0;
  check_petsc(MatMumpsGetRinfog(factors_, 1, &operations));
  return {megabyte * infog(factors_, 17), operations};
}

void Mumps::refuse_without_memory() const {
  // ranks on one machine share its memory
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(comm_of(matrix_), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  int sharing = 1;
  MPI_Comm_size(machine, &sharing);
  MPI_Comm_free(&machine);
  double most[] = {megabyte * infog(factors_, 16) * sharing, -available_memory()};
  MPI_Allreduce(MPI_IN_PLACE, most, 2, MPI_DOUBLE, MPI_MAX, comm_of(matrix_));
  if (most[0] <= -most[1]) return;
  throw MemoryShortage(
      fmt::format("the factors of the {} equations would take {:.3g} GB on one machine, where {:.3g} GB are free: run on more "
                  "machines, or take a "
                  "coarser mesh",
                  rows_of(matrix_), most[0] / gigabyte, -most[1] / gigabyte));
}

std::string Mumps::remark() const {
  return left_low_rank_ ? "SOLVER BLR: a solution with low-rank blocks was not good enough, and the factors are of full rank"
                        : "";
}

SolverWork Mumps::work() const {
  if (!factors_) return {};
  PetscReal operations = 0;
  check_petsc(MatMumpsGetRinfog(factors_, 3, &operations));
  return mumps_work(static_cast<double>(rows_of(matrix_)), entries(infog(factors_, low_rank_ ? 35 : 29)), operations);
}

double Mumps::bytes() const { return factors_ ? megabyte * infog(factors_, 19) : 0; }  // of all ranks, in the factorisation

}  // namespace engrane::solve
