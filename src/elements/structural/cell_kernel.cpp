// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/cell_kernel.hpp"

#include <Eigen/LU>

namespace engrane::elements::structural {

void solve_in_place(Eigen::Map<Eigen::MatrixXd> a, Eigen::Map<Eigen::MatrixXd> b) {
  b = Eigen::PartialPivLU<Eigen::Ref<Eigen::MatrixXd>>(a).solve(b);
}

}  // namespace engrane::elements::structural
