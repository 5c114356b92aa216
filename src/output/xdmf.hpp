// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

#include "output/results_layout.hpp"

namespace engrane::output {

/// The XDMF index of a result file: a temporal collection of uniform grids over one mixed topology, a dataset per frame
/// and field, which ParaView, VTK and meshio all read. `h5_name` is the file's name without folders; each grid refers to so many
/// modes of `/modes`.
std::string xdmf_index(const ResultsLayout& layout, const std::string& h5_name, std::span<const double> frame_times,
                       std::size_t modes = 0);

}  // namespace engrane::output
