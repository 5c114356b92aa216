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
  if (const auto before = context_.motion.prescribed(now); !before.empty()) {
    const auto after = context_.motion.prescribed(now + later);
    std::vector<double> y(context_.motion.size(), 0.0);
    for (std::size_t i = 0; i < after.size(); ++i) y[after[i].slot] = after[i].u - before[i].u;
    context_.motion.move(c, y, moved_);
  }
  moved_.lead += later;
  context_.assembler.residual(moved_, into);
}

void move_and_rest(const SolverContext& context, const Configuration& from, std::span<const double> y, Configuration& to) {
  to = from;
  context.motion.move(from, y, to);
  for (NodeState& node : to.nodes) node.T.setIdentity();
}

}  // namespace engrane::solve
