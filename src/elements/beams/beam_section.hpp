// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "math/matrix6.hpp"
#include "math/vector.hpp"
#include "model/registry.hpp"

namespace engrane::elements::beams {

/// What a section resists with, and its mass, both per unit length. Axes: 1 along the beam, 2 and 3 across it; the origin is the
/// line of the nodes.
struct BeamSection {
  /// Of the forces N, V2, V3 and the moments T, M2, M3 by the strains: stretch, shears, twist and curvatures. Without those that
  /// are held.
  Mat6 stiffness = Mat6::Zero();
  /// Strains that are held at zero, by those at the line of the nodes: the stretch of the centroid, the shears of the shear
  /// centre.
  std::vector<Vec6> held;
  double mass = 0;
  Vec3 center = Vec3::Zero();   ///< of mass; its first coordinate is 0
  Mat3 inertia = Mat3::Zero();  ///< tensor about the centre of mass
  double damping = 0;           ///< a time: forces are those of the strain, and this times those of its rate
  bool is_round = false;        ///< axes 2 and 3 may be any

  Vec6 own_stiffness = Vec6::Zero();     ///< of a shape about its centroid and shear centre, else the diagonal of `stiffness`
  double young = 0;                      ///< Young's modulus; 0: the section is not a shape of one material
  std::vector<Eigen::Vector2d> outline;  ///< corners of the shape on axes 2 and 3; empty: not known
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double radius = 0;  ///< of a round shape about `middle`: what the outline goes round

  bool has_mass() const { return mass > 0 || !inertia.isZero(0); }
};

/// Which sections a beam has.
struct SectionChoice {
  int profile = 0, profile_end = 0;  ///< of `.BPR`, at the first node and at the last; 0: the same
  int material = 0;                  ///< of `.MAT`; 0: none is given
  double damping = 0;
  bool inextensible = false, unshearable = false;

  auto operator<=>(const SectionChoice&) const = default;
};

/// The sections along a beam. Where those of the ends differ, sizes between them change evenly.
class SectionLine {
 public:
  using Make = std::function<std::shared_ptr<const BeamSection>(double part)>;
  SectionLine(std::shared_ptr<const BeamSection> first, Make between) : first_(std::move(first)), between_(std::move(between)) {}

  /// Of a place: 0 at the first node, 1 at the last.
  std::shared_ptr<const BeamSection> at(double part) const { return between_ ? between_(part) : first_; }
  bool is_even() const { return !between_; }
  const BeamSection& first() const { return *first_; }

 private:
  std::shared_ptr<const BeamSection> first_;
  Make between_;  ///< none: all are the first
};

/// The sections of a choice. Faults are reported at the keywords BPR, BPR_END and MAT of the record that is built; nothing then.
/// Records are looked up once in a model.
std::optional<SectionLine> sections_of(const SectionChoice& choice, const BuildContext& context);

}  // namespace engrane::elements::beams
