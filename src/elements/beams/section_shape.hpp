// SPDX-License-Identifier: BSD-3-Clause
// Constants of the shape of a section: area, moments, torsion and shear.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "deck/cards/profile_card.hpp"

namespace engrane::elements::beams {

/// Coordinates are on axes 2 and 3 of the section. Where the deck's card puts the centroid is the business of BeamSection: points
/// here are from the centroid.
struct SectionShape {
  using Vec2 = Eigen::Vector2d;
  using Mat2 = Eigen::Matrix2d;

  double area = 0;
  Mat2 moments = Mat2::Zero();            ///< ∫ r rᵀ dA: (0, 0) is the second moment about axis 3, (1, 1) that about axis 2
  double torsion = 0;                     ///< torsion constant
  Mat2 shear_factors = Mat2::Identity();  ///< shear forces are G A times these, times the shears
  Vec2 shear_center = Vec2::Zero();       ///< of Trefftz: a force through it does not twist
  std::vector<Vec2> outline;              ///< corners; of a circle points on it; empty: a shape by its constants
  double radius = 0;                      ///< of a circle: where stress is extreme
};

/// A closed line, without its first point again at the end.
using Loop = std::vector<SectionShape::Vec2>;

/// The shape of a card that has one. Shear factors are those of Cowper (1966, J. Appl. Mech. 33), of circles, tubes and
/// rectangles by his closed forms.
SectionShape shape_of(const deck::ProfileCard& card, double poisson);

/// The loops of a card whose shape is a polygon: the outer one, then a hole; counterclockwise and clockwise. Empty for others.
std::vector<Loop> loops_of(const deck::ProfileCard& card);

/// A polygon with holes, torsion and shear by boundary elements.
SectionShape polygon_shape(std::vector<Loop> loops, double poisson);

}  // namespace engrane::elements::beams
