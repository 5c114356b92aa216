// SPDX-License-Identifier: BSD-3-Clause
// Ends of a BEAM that do not take all forces and moments of the node there.
#pragma once

#include "elements/beams/beam.hpp"
#include "model/short_form.hpp"

namespace engrane::elements::beams {

inline bool has_releases(const BeamData& data) { return !data.release_a.empty() || !data.release_b.empty(); }

/// Writes the beam out with a node of its own at each end that is released, and the joint from this to the node of the deck. The
/// joint's axes are those of the section there, carried by the beam; the joints are numbered after the pieces, A before B.
void write_releases(const BeamData& data, ShortForm& form);

}  // namespace engrane::elements::beams
