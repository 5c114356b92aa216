// SPDX-License-Identifier: BSD-3-Clause
// The gear pair: A. Cardona, "Modelado tridimensional de engranajes flexibles en análisis de mecanismos" (1995).
#pragma once

#include <array>
#include <vector>

#include "elements/gears/gear_card.hpp"
#include "elements/gears/gear_geometry.hpp"
#include "elements/gears/toothed_pair.hpp"

namespace engrane::elements::gears {

/// Two toothed wheels A and B, each rigid and centred on a node, with rigid or elastic teeth. One element for all kinds of
/// pairs.
///
/// Own unknowns: ψ_A, ψ_B, the angles of the wheels about their axles relative to the frame that follows the contact point
/// (16), and with elastic teeth u_m, their deformation along the circumference. ψ is kept within a turn; whole turns are
/// counted in the history, so that the tooth phase stays exact however far the wheels turn.
///
/// Multipliers: kλ₁ of the tooth contact φ₁ (21) is the normal tooth force, positive when A drives in the positive sense about
/// its axle; kλ₂ of φ₂ (22) and kλ₃ of φ₃ (23) keep the frame at the contact point.
///
/// Differences from the paper, beyond the corrections in docs/elements/gears/gear_pair.md: φ₂ and φ₃ treat both wheels alike,
///
///     φ₂ = (x_C^A − x_C^B)·½(η₃^A + η₃^B),   φ₃ = ½(η₂^A·η₃^B − η₃^A·η₂^B),
///
/// and the separating force acts midway between the contact points of A and B. For aligned wheels this agrees with the paper.
/// With deflected supports, the wheels can be exchanged and the pair remains exactly in equilibrium by itself.
class GearPair final : public ToothedPair<GearPair> {
 public:
  /// `teeth.stiffness` 0: rigid teeth. `width`: face width.
  GearPair(int id, std::array<int, 2> nodes, const GearDesign& design, const PitchFrames& frames, const ToothLaw& teeth,
           const ContactOptions& options, double width);

  const GearDesign& design() const { return design_; }
  const PitchFrames& frames() const { return frames_; }

  void count_turns(const State& state, std::span<double> scalars, std::span<double> history) const override;
  void observe(const State& state, std::span<double> values) const override;
  std::vector<Derived> derived() const override;
  Drawing drawing() const override;

 private:
  friend class ToothedPair<GearPair>;

  /// The wheel in its current configuration, from its rotation and turn ψ, by (4), (16) and (6) or (8).
  template <class T>
  ToothedSide<T> wheel(std::size_t i, const Mat3T<T>& R, const T& psi) const;

  template <class T>
  void mesh(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance, ContactReport* report) const;

  /// 2π (z_A n_A + z_B n_B) of the counted whole turns. The integers cancel before rounding.
  double counted_phase(std::span<const double> history) const;

  GearDesign design_;
  PitchFrames frames_;
  std::array<Mat3, 2> triad_;     ///< columns μ, ξ in the reference configuration
  std::array<Mat3, 2> tooth_;     ///< Y_A, Y_B
  std::array<double, 2> radius_;  ///< r
};

extern template class ToothedPair<GearPair>;

/// Contact data from a pair's geometry. Involute relations, running axles and slices apply to parallel axles only; the path of
/// contact also exists for intersecting axles. Data that do not apply are zero.
ContactGeometry contact_geometry(const GearDesign& design, double width);
/// The same, with the data needed for friction at rest.
ContactGeometry contact_geometry(const GearDesign& design, const PitchFrames& frames, double width);

ElementType gear_pair_type();

}  // namespace engrane::elements::gears
