// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/diagnostics.hpp"
#include "deck/read/reader.hpp"
#include "model/model.hpp"

namespace engrane::app {

/// Warns about meshes that are valid but probably not meant: cells without density where inertia or weight counts or without
/// damping under ACCURACY, several cells on the same nodes, and what mesh_seams.hpp looks for. Requires a model without errors,
/// and its deck.
void warn_of_mesh_slips(const deck::Deck& deck, const Model& model, Diagnostics& diagnostics);

}  // namespace engrane::app
