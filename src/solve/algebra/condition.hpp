// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "solve/algebra/factors.hpp"

namespace engrane::solve {

/// Estimates ‖A⁻¹‖₁ by a few solutions with A and its transpose. It is a lower bound, seldom less than a third of the true
/// value. Hager, SIAM J. Sci. Stat. Comput. 5 (1984) 311; Higham, ACM Trans. Math. Softw. 14 (1988) 381, algorithm 4.1.
double inverse_norm(Factors& factors, Mat matrix);

}  // namespace engrane::solve
