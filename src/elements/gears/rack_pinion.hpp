// SPDX-License-Identifier: BSD-3-Clause
// Rack and pinion: the gear pair with a straight pitch line in place of wheel B.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "elements/gears/cut_card.hpp"
#include "elements/gears/gear_geometry.hpp"
#include "elements/gears/teeth_card.hpp"
#include "elements/gears/toothed_pair.hpp"

namespace engrane::elements::gears {

/// `I id RACK …` as given in the deck: angles in degrees, helices positive for right hand.
struct RackData : TeethData, CutData {
  std::array<int, 2> nodes{0, 0};  ///< centre of the pinion, body of the rack
  int teeth = 0;
  double normal_module = 0;
  double pressure_angle = 20;
  std::vector<double> helix;  ///< of the pinion and of the rack; one value: that of the rack follows, for parallel axles
  std::array<double, 3> axis{0, 0, 0};
  std::array<double, 3> direction{0, 0, 0};
  std::optional<std::array<double, 3>> at;  ///< a point in the rack's reference plane; default: its node
};

const deck::Card<RackData>& rack_card();

/// A pinion A centred on a node, and a rack B carried by a node anywhere on its body.
///
/// Own unknowns: ψ_A, the pinion's angle relative to the pair's frame; the travel of the rack relative to that frame, positive
/// along `DIR`; and u_m with elastic teeth. All else, including the multipliers, is as in the gear pair, with x_C^B = x_B +
/// R_B(c − s ξ₃) and ξ fixed to the rack: φ₁ = −(r_A cosβ_A ψ_A + s cosβ_B) cosα_n + u_m cosα_n, s the travel along ξ₃.
class RackPinion final : public ToothedPair<RackPinion> {
 public:
  struct Geometry {
    GearDesign design;   ///< wheel A is the pinion; helix B is the rack's, its number of teeth and cone are unused
    PitchFrames frames;  ///< ξ₃ along or against the travel
    Vec3 offset;         ///< from the rack's node to the contact point, reference configuration
    double sense = 1;    ///< of the travel along ξ₃
  };
  RackPinion(int id, std::array<int, 2> nodes, const Geometry& geometry, const ToothLaw& teeth, const ContactOptions& options,
             double width);

  const Geometry& geometry() const { return geometry_; }
  const GearDesign& design() const { return geometry_.design; }

  void count_turns(const State& state, std::span<double> scalars, std::span<double> history) const override;
  void observe(const State& state, std::span<double> values) const override;
  std::vector<Derived> derived() const override;
  Drawing drawing() const override;

 private:
  friend class ToothedPair<RackPinion>;

  template <class T>
  ToothedSide<T> pinion(const Mat3T<T>& R, const T& psi) const;
  template <class T>
  ToothedSide<T> rack(const Mat3T<T>& R, const T& travel) const;
  template <class T>
  void mesh(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance, ContactReport* report) const;

  Geometry geometry_;
  Mat3 tooth_a_, tooth_b_;  ///< Y_A, Y_B
};

extern template class ToothedPair<RackPinion>;

ElementType rack_pinion_type();

}  // namespace engrane::elements::gears
