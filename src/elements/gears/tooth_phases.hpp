// SPDX-License-Identifier: BSD-3-Clause
// Relative tooth positions of all gear pairs of a deck.
#pragma once

#include <optional>

#include "elements/gears/gear_teeth.hpp"
#include "model/registry.hpp"

namespace engrane::elements::gears {

/// The phase of the pair that is being built, consistent with all gear pairs of the deck.
///
/// Pairs share a wheel if node, number of teeth, normal module, axle, cone, helix and profile shift agree. The position of its
/// teeth is one angle. Each pair relates those of its two wheels, with a tooth of A in a space of B:
///
///     z_A (δ_A − θ_A) + z_B (δ_B − θ_B) = π  (mod 2π)
///
/// with δ the angle of a tooth and θ that of the contact point, about each wheel's own axle. In each train the first pair, in
/// the order of the deck, has a tooth of A at the contact point. Pairs that join wheels not yet connected align their teeth. A
/// pair that closes a loop (a planet between sun and ring) finds its teeth already positioned, and the remaining deviation is
/// its misfit. Up to a twentieth of a pitch, elastic teeth take it as an approach of the flanks, with a warning. A larger
/// misfit, or any with rigid teeth, is an error, and nothing is returned. Wheels that share a partner and overlap are warned
/// about too.
///
/// Pairs that cannot be placed are left out; they report their own errors.
std::optional<MeshPhase> mesh_phase(const BuildContext& context, bool elastic);

}  // namespace engrane::elements::gears
