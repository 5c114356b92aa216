// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "math/matrix6.hpp"
#include "math/vector.hpp"
#include "model/registry.hpp"

namespace engrane::elements::beams {

/// Stiffness of a section, and its mass per unit length. Axes: 1 along the beam, 2 and 3 across it; the origin is on the line
/// of nodes.
struct BeamSection {
  /// Maps the strains (stretch, shears, twist, curvatures) to the forces N, V2, V3 and moments T, M2, M3. Held strains
  /// contribute nothing.
  Mat6 stiffness = Mat6::Zero();
  /// Strains constrained to zero, as coefficients of the strains at the line of nodes: the stretch at the centroid, the shears
  /// at the shear centre.
  std::vector<Vec6> held;
  double mass = 0;
  Vec3 center = Vec3::Zero();   ///< of mass; its first coordinate is 0
  Mat3 inertia = Mat3::Zero();  ///< tensor about the centre of mass
  double expansion = 0;         ///< coefficient of thermal expansion
  double damping = 0;           ///< Kelvin–Voigt time c: forces are C (ε + c ε̇)
  bool is_round = false;        ///< invariant under rotation about axis 1: axes 2 and 3 are arbitrary

  /// Diagonal stiffness before strains are held: of a shape about its centroid and shear centre, otherwise as on the card.
  Vec6 own_stiffness = Vec6::Zero();
  double young = 0;                      ///< Young's modulus; 0: the section is not a shape of one material
  std::vector<Eigen::Vector2d> outline;  ///< corners of the shape on axes 2 and 3; empty: not known
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double radius = 0;  ///< of the circle about `middle` through the points of `outline`; 0: not a circle

  bool has_mass() const { return mass > 0 || !inertia.isZero(0); }
};

/// Section, material and constraints of a beam as given in the deck; key of the cache of sections.
struct SectionChoice {
  int profile = 0, profile_end = 0;    ///< of `.BPR`, at the first and last node; `profile_end` 0: same as `profile`
  int material = 0;                    ///< of `.MAT`; 0: none given
  std::optional<double> damping = {};  ///< none: that of the material
  bool inextensible = false, unshearable = false;

  auto operator<=>(const SectionChoice&) const = default;
};

/// Sections along a beam. If those of the ends differ, the values of their cards are interpolated linearly.
class SectionLine {
 public:
  using Make = std::function<std::shared_ptr<const BeamSection>(double part)>;
  SectionLine(std::shared_ptr<const BeamSection> first, Make between) : first_(std::move(first)), between_(std::move(between)) {}

  /// Section at a fraction of the length: 0 at the first node, 1 at the last.
  std::shared_ptr<const BeamSection> at(double part) const { return between_ ? between_(part) : first_; }
  /// That section for a piece of two nodes of this length, with the compliance of bending within the piece (with_bending_within).
  /// Sections with held strains are returned as they are.
  std::shared_ptr<const BeamSection> at(double part, double length) const;
  const BeamSection& first() const { return *first_; }

 private:
  std::shared_ptr<const BeamSection> first_;
  Make between_;  ///< empty: constant section
  using ByLength = std::map<double, std::shared_ptr<const BeamSection>>;
  std::shared_ptr<ByLength> of_pieces_ = std::make_shared<ByLength>();  ///< constant section: at(part, length)
};

/// Stiffness of a section for a piece of two nodes, in which strains are constant. Shear forces V bend the piece by moments that
/// change linearly along it, M′ = −e_1 × V: their energy is that of the additional compliance Aᵀ C⁻¹ A L²/12, A being the map
/// from forces to M′. Straight pieces with loads at their ends are then exact (residual bending flexibility: MacNeal, Comput.
/// Struct. 8 (1978) 175, for shells). Returns C itself if it is not positive definite.
Mat6 with_bending_within(const Mat6& stiffness, double length);

/// Returns the sections of a choice, cached per model. Returns nothing after an error, which is reported at the keyword BPR,
/// BPR_END or MAT of the record.
std::optional<SectionLine> sections_of(const SectionChoice& choice, const BuildContext& context);

}  // namespace engrane::elements::beams
