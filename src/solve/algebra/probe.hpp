// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "assembly/assembler.hpp"
#include "solve/algebra/linear.hpp"

namespace engrane::solve {

/// A number between 0.5 and 1.5 for each index: fractional parts of multiples of the golden ratio. No two numbers, sums or
/// differences are alike, and none depends on the ranks.
double probe_value(std::size_t place);
/// `other`: another vector for each number.
void fill_probe(Vec vector, int other = 0);
/// Fills a vector with such numbers as loads of the assembler's equations: moments are these numbers times the extent, as they
/// are in other units of length, too.
void fill_loads(const Assembler& assembler, Vec loads);
/// Fills new vectors with these loads and with what the solver's present factors answer; false if that fails. Collective.
bool answer_probe(const Assembler& assembler, LinearSolver& solver, Owned<Vec>& load, Owned<Vec>& motion);

/// Stiffness of a motion x beside what its unknowns meet one by one: |xᵀKx| / Σ d x², with `load` = K x. d is the magnitude of
/// the diagonal and, for the constraints k Φ = 0 with gradients g, Σ k g²: that of a hinge's turn is zero, or rounding. `matrix`
/// has the equations of the assembler. With fill_loads() for the load, x is all but the softest motion. Collective.
double relative_stiffness(Assembler& assembler, Mat matrix, Vec motion, Vec load);

}  // namespace engrane::solve
