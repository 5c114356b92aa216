// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "app/read.hpp"
#include "output/results_layout.hpp"
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

/// Numbers that determine the size of a result file, together with its layout.
struct ResultCounts {
  std::size_t samples = 0, frames = 0;
  std::size_t restarts = 0;  ///< restart points, of which a run leaves at least one
  double nonzeros = 0;       ///< of the matrix, which restart points hold
};

/// Size of the result file in bytes: histories, fields, restart points, the description of the model, and what HDF5 adds to each
/// of them. Small files are met to about 15 per cent; how far large fields can be compressed is not known before.
double expected_result_bytes(const output::ResultsLayout& layout, const ResultCounts& counts);

}  // namespace engrane::app
