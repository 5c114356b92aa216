// SPDX-License-Identifier: BSD-3-Clause
// End releases of a BEAM.
#pragma once

#include "elements/beams/beam.hpp"
#include "model/short_form.hpp"

namespace engrane::elements::beams {

inline bool has_releases(const BeamData& data) { return !data.release_a.empty() || !data.release_b.empty(); }

/// Expands the beam: each released end gets a new node and a joint from it to the node of the deck. The joint's axes are those
/// of the section there and move with the beam. The joints are numbered after the pieces, A before B.
void write_releases(const BeamData& data, ShortForm& form);

}  // namespace engrane::elements::beams
