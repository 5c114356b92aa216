// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "app/read.hpp"
#include "solve/schemes/solver_context.hpp"

namespace engrane::app {

/// Describes the expected cost of running a deck: the share of each kind of element, the times of an iteration, a step and the
/// run, and the sizes of the matrix, its factors and the result file.
///
/// Times are measured on the spot: the tangents of each kind of element, one factorisation and one solution. Each is repeated
/// for a few milliseconds of processor time, and the shortest time is taken. A step is assumed to need two iterations (one
/// tangent, factorisation, solution and residual each), plus a fifth for the scheme, histories and files. Rejected steps,
/// events and contact cost more.
std::string describe_price(const Reading& reading, solve::SolverContext& context, const Configuration& c);

/// Size of the result file in bytes, to a factor of two: channels times samples, fields of nodes times frames, and the
/// description of the model.
double expected_result_bytes(std::size_t channels, std::size_t samples, std::size_t nodes, std::size_t frames);

}  // namespace engrane::app
