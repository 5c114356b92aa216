// SPDX-License-Identifier: BSD-3-Clause
// Geometric constants of a cross-section: area, second moments, torsion and shear.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "deck/cards/profile_card.hpp"

namespace engrane::elements::beams {

/// Coordinates are along axes 2 and 3 of the section, relative to its centroid. BeamSection applies the centroid offset of the
/// deck's card.
struct SectionShape {
  using Vec2 = Eigen::Vector2d;
  using Mat2 = Eigen::Matrix2d;

  double area = 0;
  Mat2 moments = Mat2::Zero();            ///< ∫ r rᵀ dA: (0, 0) is the second moment about axis 3, (1, 1) that about axis 2
  double torsion = 0;                     ///< torsion constant
  Mat2 shear_factors = Mat2::Identity();  ///< shear forces = G A · shear_factors · shear strains
  Vec2 shear_center = Vec2::Zero();       ///< Trefftz: a force through it causes no twist
  std::vector<Vec2> outline;              ///< corners, or points on a circle; empty: section given by its constants
  double radius = 0;                      ///< of a circle, where the bending stress is extreme; otherwise 0
};

/// A closed polygon; the first point is not repeated at the end.
using Loop = std::vector<SectionShape::Vec2>;

/// Returns the constants of a card that gives a shape, or an area and moments. Shear factors of shapes are those of Cowper
/// (1966, J. Appl. Mech. 33), in his closed form for circles, tubes and rectangles, unless the card gives them.
SectionShape shape_of(const deck::ProfileCard& card, double poisson);

/// Loops of a polygonal shape: the outer boundary, counterclockwise, then the hole if any, clockwise. Empty for other shapes.
std::vector<Loop> loops_of(const deck::ProfileCard& card);

/// Constants of a polygon with holes; torsion and shear by boundary elements.
SectionShape polygon_shape(std::vector<Loop> loops, double poisson);

}  // namespace engrane::elements::beams
