// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "deck/read/reader.hpp"

namespace engrane::app {

/// Implements deck::Catalogue::read_mesh: returns the records of `.NOE`, `.MAI` and `.SEL` that a mesh file stands for. For a
/// file of another program, the error names the command that converts it.
std::vector<deck::Record> mesh_records(const std::filesystem::path& file, const deck::Catalogue& catalogue, const Location& where,
                                       Diagnostics& diagnostics);

}  // namespace engrane::app
