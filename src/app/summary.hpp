// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "assembly/numbering.hpp"
#include "output/listing.hpp"
#include "solve/schemes/solver_context.hpp"

namespace engrane::app {

/// Counts of what was built from the deck, for the listing and `engrane check`.
output::BuiltSummary summarize(const Model& model, const Numbering& numbering);

/// "DYNAMIC, CHUNG rho 0.8, t = 0 to 0.03, 15000 steps of 2e-06, MUMPS"
std::string describe_analysis(const solve::SolverContext& context);

/// Table of the derived geometry of each element that has any. Consecutive equal elements are listed once.
std::string describe_geometry(const Model& model);

/// Table of masses, centres and inertias of at most `most` bodies, and of the whole model; empty if nothing has mass.
std::string describe_masses(const Model& model, std::size_t most);

}  // namespace engrane::app
