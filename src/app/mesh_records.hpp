// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "deck/read/reader.hpp"

namespace engrane::app {

/// The records of `.NOE`, `.MAI` and `.SEL` that stand for a file of a mesh: what deck::Catalogue::read_mesh is to be. A file of
/// another program is refused with the command that converts it.
std::vector<deck::Record> mesh_records(const std::filesystem::path& file, const deck::Catalogue& catalogue, const Location& where,
                                       Diagnostics& diagnostics);

}  // namespace engrane::app
