// SPDX-License-Identifier: BSD-3-Clause
// How the teeth of all gear pairs of a deck stand to each other.
#pragma once

#include <optional>

#include "elements/gears/gear_teeth.hpp"
#include "model/registry.hpp"

namespace engrane::elements::gears {

/// The phase of the pair that is being built, among all gear pairs of the deck.
///
/// A wheel is what several pairs share: node, number of teeth, normal module, axle, cone and helix are the same. Where its
/// teeth stand is one angle; each pair ties those of its two wheels, a tooth of A standing in a space of B:
///
///     z_A (δ_A − θ_A) + z_B (δ_B − θ_B) = π  (mod 2π)
///
/// with δ the angle of a tooth and θ that of the contact point, about each wheel's own axle. The first pair of each train in
/// the order of the deck has a tooth of A at the contact point. Pairs that join wheels not yet joined make their teeth fit;
/// one that closes a loop (a planet between sun and ring) finds them as they stand. What it lacks is its misfit: with elastic
/// teeth an approach of the flanks and a warning, up to a twentieth of a pitch. More, or rigid teeth, is an error, and there
/// is no result. Wheels that share a partner and stand in each other's way are warned about too.
///
/// Only pairs that can be placed take part; what is wrong with others they say themselves.
std::optional<MeshPhase> mesh_phase(const BuildContext& context, bool elastic);

}  // namespace engrane::elements::gears
