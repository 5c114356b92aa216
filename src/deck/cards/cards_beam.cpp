// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "deck/cards/card_chapters.hpp"
#include "deck/cards/profile_card.hpp"
#include "deck/schema/card.hpp"
#include "math/matrix6.hpp"

namespace engrane::deck {

namespace {

constexpr const char* how = "CIRCLE, TUBE, RECTANGLE, H, U, L, BOX or POLYGON; AREA, INERTIA, TORSION; EA, GA, GJ, EI; or K";

/// Whether the segments from a to b and from c to d cross or touch.
bool cross(const double* a, const double* b, const double* c, const double* d) {
  const auto side = [](const double* from, const double* to, const double* point) {
    return (to[0] - from[0]) * (point[1] - from[1]) - (to[1] - from[1]) * (point[0] - from[0]);
  };
  return side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0;
}

/// Describes the fault in the corners of a polygon and its hole; empty if there is none.
std::string fault_of_polygon(const std::vector<double>& outer, const std::vector<double>& hole) {
  struct Side {
    const double *from, *to;
  };
  std::vector<Side> sides;
  for (const std::vector<double>* loop : {&outer, &hole}) {
    if (loop->size() % 2 != 0) return "a corner has one coordinate";
    if (!loop->empty() && loop->size() < 6) return "fewer than three corners";
    for (std::size_t i = 0; i < loop->size(); i += 2) {
      const Side side{&(*loop)[i], &(*loop)[(i + 2) % loop->size()]};
      if (side.from[0] == side.to[0] && side.from[1] == side.to[1]) return "a corner stands twice in turn";
      sides.push_back(side);
    }
  }
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (std::size_t j = i + 1; j < sides.size(); ++j)
      if (sides[i].to != sides[j].from && sides[j].to != sides[i].from &&
          cross(sides[i].from, sides[i].to, sides[j].from, sides[j].to))
        return "two of its sides cross or touch";
  bool within = false;  // ray casting from the first corner of the hole: an odd number of crossings is inside
  for (std::size_t i = 0; !hole.empty() && i < outer.size() / 2; ++i) {
    const auto [from, to] = sides[i];
    if ((from[1] > hole[1]) != (to[1] > hole[1]) &&
        hole[0] < from[0] + (hole[1] - from[1]) / (to[1] - from[1]) * (to[0] - from[0]))
      within = !within;
  }
  if (!hole.empty() && !within) return "its hole is not within";
  return {};
}

/// Describes the fault in the dimensions of a shape; empty if there is none.
std::string fault_of_shape(const ProfileCard& card) {
  const std::vector<double>& size = card.shape.values;
  if (card.shape.is("POLYGON")) return fault_of_polygon(size, card.hole);
  for (const double value : size)
    if (!(value > 0)) return fmt::format("a size is {}", value);
  if (card.shape.is("TUBE") && !(size[1] < size[0])) return "the inner diameter is not below the outer one";
  const bool flanges = card.shape.is("H") || card.shape.is("U"), box = card.shape.is("BOX"), angle = card.shape.is("L");
  if (flanges && !(2 * size[3] < size[0] && size[2] < size[1])) return "web and flanges fill the section";
  if ((box || angle) && !((box ? 2 : 1) * size[2] < std::min(size[0], size[1]))) return "the walls fill the section";
  return {};
}

const char* size_help(const std::string& shape) {
  if (shape == "POLYGON") return "corners in turn round it, a HOLE within; sides meet at corners only";
  if (shape == "TUBE") return "TUBE outer inner";
  if (shape == "H" || shape == "U") return "h b web flange: 2 flange below h, web below b";
  return shape == "L" || shape == "BOX" ? "h b t: walls thinner than the section" : "sizes are positive";
}

/// Checks that a section is given in exactly one way, and completely.
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
  if (card.shape.given())
    if (const std::string fault = fault_of_shape(card); !fault.empty())
      diagnostics.error(record.where("SHAPE"), fmt::format("{}, {}: {}", name, card.shape.tag, fault), size_help(card.shape.tag));
  if (!card.hole.empty() && !card.shape.is("POLYGON"))
    diagnostics.error(record.where("HOLE"), name + " is no POLYGON, and has a HOLE", "a TUBE or a BOX is hollow by itself");
  if (card.offset && !by_material) diagnostics.error(record.where("OFFSET"), "OFFSET moves a shape", "give all of K, and CG");
  if (card.inertia.size() == 2) diagnostics.error(record.where("J"), "J has 2 values", "one (about axis 1) or three");
  if (card.center && !card.mass)
    diagnostics.error(record.where("CG"), by_material ? "the mass of a shape is at its centroid" : "CG without mass",
                      by_material ? "OFFSET moves the centroid" : "give M, or leave CG out");
  if (card.stiffness.empty()) return;
  constexpr double least = 1e-12;
  if (const auto matrix = symmetric_6(card.stiffness); !matrix)
    diagnostics.error(record.where("K"), fmt::format("K has {} values", card.stiffness.size()),
                      "6 (the diagonal: EA GA2 GA3 GJ EI2 EI3) or 21 (the upper triangle, row by row)");
  else if (!(definiteness(*matrix) > least))
    diagnostics.error(record.where("K"), "the matrix K is not positive: some deformation would cost no energy",
                      fmt::format("its eigenvalues must be positive: the least is {:.6g} times the largest in size, with rows "
                                  "scaled to a unit diagonal",
                                  definiteness(*matrix)));
}

}  // namespace

Schema profile_card() {
  Card<ProfileCard> card(".BPR", {}, "Sections of beams");
  card.chapter("Beams").numbered().describe(
      "Axis 1 of a section is along its beam, axis 2 is where AXIS2 of the beam says. Of a shape the `.MAT` of the beam makes "
      "stiffness and mass. Torsion, shear factors (of Cowper, 1966) and shear centre of H, U, L, BOX and POLYGON are solved for. "
      "The centroid is on the line of the nodes, or at OFFSET from it; a shear centre elsewhere couples shear and twist. A "
      "section "
      "may have stiffness (EA, GA, GJ, EI, or all of K) and mass per length (M, J) of its own instead.");
  card.add("SHAPE", &ProfileCard::shape, "shape and its sizes")
      .synonyms({"FORME"})
      .positional()
      .option({"CIRCLE", {"CERCLE"}, "diameter", 1, 1, dimension::length})
      .option({"TUBE", {}, "outer and inner diameter", 2, 2, dimension::length})
      .option({"RECTANGLE", {}, "height h along axis 2, width b along axis 3", 2, 2, dimension::length})
      .option({"H", {"DOUBLE_T"}, "I-section: h, b, thickness of the web along axis 2, of the flanges", 4, 4, dimension::length})
      .option({"U",
               {},
               "channel, open towards axis 3: h, b, thickness of the web along axis 2, of the flanges",
               4,
               4,
               dimension::length})
      .option({"L", {}, "angle: leg h along axis 2, leg b along axis 3, thickness", 3, 3, dimension::length})
      .option({"BOX", {"CAISSON"}, "hollow rectangle: h, b, thickness", 3, 3, dimension::length})
      .option(
          {"POLYGON", {"POLYGONE"}, "corners in turn, coordinates on axes 2 and 3 of each: 3 to 100", 6, 200, dimension::length});
  card.add("HOLE", &ProfileCard::hole, "corners of a hole in a POLYGON")
      .synonyms({"TROU"})
      .unit(dimension::length)
      .values(6, 200);
  card.add("OFFSET", &ProfileCard::offset,
           "where the centroid of the shape is on axes 2 and 3; default: on the line of the nodes")
      .synonyms({"EXCENTREMENT"})
      .unit(dimension::length);
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
  card.example(".BPR\n I 1 CIRCLE 0.05\n I 2 H 0.2 0.1 0.0056 0.0085\n I 3 EA 1D7 GA 4D6 4D6 GJ 8D5 EI 8D5 8D5 M 1");
  return card.schema();
}

}  // namespace engrane::deck
