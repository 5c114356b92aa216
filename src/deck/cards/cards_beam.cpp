// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "deck/cards/card_chapters.hpp"
#include "deck/cards/profile_card.hpp"
#include "math/matrix6.hpp"

namespace engrane::deck {

namespace {

constexpr const char* how = "CIRCLE d, TUBE d inner, RECTANGLE height width; AREA, INERTIA, TORSION; EA, GA, GJ, EI; or K";

/// A section is given in one way, and wholly.
void check_profile(ProfileCard& card, Record& record, Diagnostics& diagnostics) {
  const bool by_area = card.area || card.moments || card.torsion;
  const bool by_constants = card.stretching || card.shearing || card.twisting || card.bending;
  const int ways = int{card.shape.given()} + int{by_area} + int{by_constants} + int{!card.stiffness.empty()};
  const std::string name = fmt::format("section {}", record.id);
  if (ways != 1) {
    diagnostics.error(record.location, name + (ways == 0 ? " has no stiffness" : " is given in several ways"), how);
    return;
  }
  if (by_area && !(card.area && card.moments && card.torsion))
    diagnostics.error(record.location, name + " needs AREA, INERTIA and TORSION", "AREA a INERTIA i2 i3 TORSION j");
  if (by_constants && !(card.stretching && card.shearing && card.twisting && card.bending))
    diagnostics.error(record.location, name + " needs EA, GA, GJ and EI", "EA ea GA ga2 ga3 GJ gj EI ei2 ei3");
  const bool by_material = card.shape.given() || by_area;
  if (by_material && (card.mass || !card.inertia.empty()))
    diagnostics.error(record.where(card.mass ? "M" : "J"), name + " has the mass of its material", "leave M and J out");
  if (!by_material && card.factors)
    diagnostics.error(record.where("SHEAR"), "shear factors are those of a shape", "GA holds shear stiffnesses as they are");
  for (const double value : card.shape.values)
    if (!(value > 0))
      diagnostics.error(record.where("SHAPE"), fmt::format("a size of {} is {}", name, value), "sizes are positive");
  if (card.shape.is("TUBE") && !(card.shape.values[1] < card.shape.values[0]))
    diagnostics.error(record.where("SHAPE"), "the inner diameter of the tube is not below the outer one", "TUBE outer inner");
  if (card.inertia.size() == 2) diagnostics.error(record.where("J"), "J has 2 values", "one (about axis 1) or three");
  if (card.center && !card.mass && !by_material)
    diagnostics.error(record.where("CG"), "CG without mass", "give M, or leave CG out");
  if (card.stiffness.empty()) return;
  constexpr double least = 1e-12;
  if (const auto matrix = symmetric_6(card.stiffness); !matrix)
    diagnostics.error(record.where("K"), fmt::format("K has {} values", card.stiffness.size()),
                      "6 (the diagonal: EA GA2 GA3 GJ EI2 EI3) or 21 (the upper triangle, row by row)");
  else if (!(definiteness(*matrix) > least))
    diagnostics.error(record.where("K"), "the matrix K is not positive: some deformation would cost no energy",
                      "every row's diagonal must outweigh what couples it to the others");
}

}  // namespace

Schema profile_card() {
  Card<ProfileCard> card(".BPR", {}, "Sections of beams");
  card.chapter("Beams").numbered().describe(
      "Axis 1 of a section is along its beam, axis 2 is where AXIS2 of the beam says. Of a shape the `.MAT` of the beam makes "
      "stiffness and mass; shear factors are those of Cowper. A section may have stiffness (EA, GA, GJ, EI, or all of K) and "
      "mass per length (M, J) of its own instead. Centroid and shear centre of shapes are on the line of the nodes.");
  card.add("SHAPE", &ProfileCard::shape, "shape and its sizes")
      .synonyms({"FORME"})
      .positional()
      .option({"CIRCLE", {"CERCLE"}, "diameter", 1, 1, dimension::length})
      .option({"TUBE", {}, "outer and inner diameter", 2, 2, dimension::length})
      .option({"RECTANGLE", {}, "height along axis 2, width along axis 3", 2, 2, dimension::length});
  card.add("AREA", &ProfileCard::area, "area of a shape by its constants").synonyms({"AIRE"}).unit({2, 0, 0, 0}).positive();
  card.add("INERTIA", &ProfileCard::moments, "its second moments of area, about axes 2 and 3").unit({4, 0, 0, 0}).positive();
  card.add("TORSION", &ProfileCard::torsion, "its torsion constant").unit({4, 0, 0, 0}).positive();
  card.add("SHEAR", &ProfileCard::factors, "shear factors along axes 2 and 3; default: of Cowper, and 1 with AREA").positive();
  card.add("EA", &ProfileCard::stretching, "stiffness to stretch").unit(dimension::force).positive();
  card.add("GA", &ProfileCard::shearing, "to shear along axes 2 and 3").unit(dimension::force).positive();
  card.add("GJ", &ProfileCard::twisting, "to twist").unit({3, 1, -2, 0}).positive();
  card.add("EI", &ProfileCard::bending, "to bending about axes 2 and 3").unit({3, 1, -2, 0}).positive();
  card.add("K", &ProfileCard::stiffness,
           "all of it: 6 values EA GA2 GA3 GJ EI2 EI3, or the 21 of the upper triangle of the matrix of stretch, shears, twist "
           "and curvatures, row by row")
      .values(6, 21);
  card.add("M", &ProfileCard::mass, "mass per length").unit({-1, 1, 0, 0}).at_least(0);
  card.add("J", &ProfileCard::inertia,
           "moments of inertia per length about axes 1, 2, 3; one value: about 1, half of it about 2 and 3")
      .unit({1, 1, 0, 0})
      .at_least(0)
      .values(1, 3);
  card.add("CG", &ProfileCard::center, "centre of mass on axes 2 and 3").unit(dimension::length);
  card.finish(check_profile);
  card.example(".BPR\n I 1 CIRCLE 0.05\n I 2 TUBE 0.037 0.010 SHEAR 0.9 0.9\n I 3 EA 1D7 GA 4D6 4D6 GJ 8D5 EI 8D5 8D5 M 1");
  return card.schema();
}

}  // namespace engrane::deck
