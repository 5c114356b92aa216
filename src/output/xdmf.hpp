// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "output/results_layout.hpp"

namespace engrane::output {

/// Returns the XDMF index of a result file, in a form that ParaView, VTK and meshio all read: a temporal collection of uniform
/// grids over one mixed topology, with a dataset per frame and field. `h5_name` is the file name without folders. Each grid
/// also refers to the first `modes` modes of `/modes`.
std::string xdmf_index(const ResultsLayout& layout, const std::string& h5_name, std::span<const double> frame_times,
                       std::size_t modes = 0);

}  // namespace engrane::output
