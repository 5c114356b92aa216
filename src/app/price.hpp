// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "app/read.hpp"
#include "solve/schemes/solver_context.hpp"

namespace engrane::app {

/// What a run of a deck costs, as known before it: the share of each kind of element, the times of an iteration, a step and the
/// run, the sizes of matrix, factors and result file.
///
/// Times are measured on the spot: the tangents of each kind of element, one factorisation and solution, each repeated for a few
/// milliseconds of processor time, the shortest taken. A step is taken to need two iterations (one tangent, factorisation,
/// solution and residual each), and a fifth more for the scheme, histories and files. Cuts, events and contact cost more.
std::string describe_price(const Reading& reading, solve::SolverContext& context, const Configuration& c);

/// How many bytes the result file has, to a factor of two: channels by samples, fields of nodes by frames, and what describes the
/// model.
double expected_result_bytes(std::size_t channels, std::size_t samples, std::size_t nodes, std::size_t frames);

}  // namespace engrane::app
