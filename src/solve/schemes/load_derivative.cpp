// SPDX-License-Identifier: BSD-3-Clause
#include "solve/schemes/load_derivative.hpp"

#include <vector>

namespace engrane::solve {

LoadDerivative::LoadDerivative(SolverContext& context, double step) : context_(context), step_(step) {
  *next_.out() = context.assembler.new_vector();
}

void LoadDerivative::find(const Configuration& c, Vec f) {
  residual(c, 0, f);
  check_petsc(VecScale(f, -3));
  residual(c, step_, next_);
  check_petsc(VecAXPY(f, 4, next_));
  residual(c, 2 * step_, next_);
  check_petsc(VecAXPY(f, -1, next_));
  check_petsc(VecScale(f, 0.5 / step_));
}

void LoadDerivative::change(const Configuration& c, double later, Vec f) {
  residual(c, later, f);
  residual(c, 0, next_);
  check_petsc(VecAXPY(f, -1, next_));
}

void LoadDerivative::residual(const Configuration& c, double later, Vec into) {
  const double now = c.load_time();
  moved_ = c;
  if (!context_.motion.prescribed(now).empty()) {
    std::vector<double> y(context_.motion.size(), 0.0);
    context_.motion.prescribe_increment(now, now + later, y);
    context_.motion.move(c, y, moved_);
  }
  moved_.lead += later;
  context_.assembler.residual(moved_, into);
}

}  // namespace engrane::solve
