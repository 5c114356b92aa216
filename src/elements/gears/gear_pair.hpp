// SPDX-License-Identifier: BSD-3-Clause
// The gear pair: A. Cardona, "Modelado tridimensional de engranajes flexibles en análisis de mecanismos" (1995).
#pragma once

#include <array>
#include <vector>

#include "elements/gears/gear_card.hpp"
#include "elements/gears/gear_geometry.hpp"
#include "elements/gears/toothed_pair.hpp"

namespace engrane::elements::gears {

/// Two toothed wheels A and B, each rigid and centred on a node; teeth rigid or elastic. One element for every kind of pair.
///
/// Own unknowns: ψ_A, ψ_B, the turns of the wheels about their axles relative to the frame that follows the contact point
/// (16), and with elastic teeth u_m, their deformation along the circumference. ψ is kept within a turn; whole turns are
/// counted in the history, so that no tooth phase is lost however far the wheels turn.
///
/// Multipliers: kλ₁ of the tooth contact φ₁ (21) is the normal tooth force, positive when A drives in the positive sense
/// about its axle; kλ₂ of φ₂ (22) and kλ₃ of φ₃ (23) hold the frame to the contact point.
///
/// Differences from the print, beyond the corrections in docs/elements/gears/gear_pair.md: φ₂ and φ₃ treat both wheels alike,
///
///     φ₂ = (x_C^A − x_C^B)·½(η₃^A + η₃^B),   φ₃ = ½(η₂^A·η₃^B − η₃^A·η₂^B),
///
/// and the separating force acts at the point midway between the contact points of A and B. Where the wheels are aligned
/// this is the paper's; where supports bend, wheels may be exchanged and the pair stays in equilibrium by itself exactly.
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

  /// From the wheel's rotation and turn ψ, by (4), (16) and (6) or (8).
  template <class T>
  ToothedSide<T> wheel(std::size_t i, const Mat3T<T>& R, const T& psi) const;

  template <class T>
  void mesh(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance, ContactReport* report) const;

  /// 2π (z_A n_A + z_B n_B), of the whole turns counted: the integers cancel before they are rounded.
  double counted_phase(std::span<const double> history) const;

  GearDesign design_;
  PitchFrames frames_;
  std::array<Mat3, 2> triad_;     ///< columns μ, ξ in the reference configuration
  std::array<Mat3, 2> tooth_;     ///< Y_A, Y_B
  std::array<double, 2> radius_;  ///< r
};

extern template class ToothedPair<GearPair>;

/// What the contact needs of a pair's geometry. Involute relations, sliding along the profile and slices are of parallel axles
/// only; for others their dimensions stay zero.
ContactGeometry contact_geometry(const GearDesign& design, double width);
/// With what friction at rest needs.
ContactGeometry contact_geometry(const GearDesign& design, const PitchFrames& frames, double width);

ElementType gear_pair_type();

}  // namespace engrane::elements::gears
