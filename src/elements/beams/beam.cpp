// SPDX-License-Identifier: BSD-3-Clause
#include "elements/beams/beam.hpp"

#include <fmt/format.h>

#include <cmath>

#include "elements/beams/beam_piece.hpp"
#include "elements/beams/line_shape.hpp"
#include "elements/common/building.hpp"

namespace engrane::elements::beams {

namespace {

/// What all pieces of a beam share.
struct Plan {
  const BeamData& data;
  std::shared_ptr<const BeamSection> section;
  BuildContext& context;
  Vec3 side;  ///< of axis 2; of a round section without AXIS2, which turns with the beam, for the next piece
};

/// The axes of a section whose first is along `tangent`, as columns; nothing, with an error, where axis 2 would be along it too.
std::optional<Mat3> section_axes(const Plan& plan, const Vec3& tangent) {
  const Vec3 first = tangent.normalized();
  const Vec3 across = plan.side - first.dot(plan.side) * first;
  constexpr double least = 1e-3;
  if (across.norm() < least) {
    plan.context.error("AXIS2",
                       plan.data.axis_2 ? fmt::format("AXIS2 is along beam {}", plan.context.record.id)
                                        : fmt::format("beam {} turns by a right angle within a piece", plan.context.record.id),
                       plan.data.axis_2 ? "a direction across the beam, on the side of axis 2 of its sections" : "more pieces");
    return {};
  }
  Mat3 axes;
  axes << first, across.normalized(), cross(first, across.normalized());
  return axes;
}

template <int Nodes>
std::optional<BeamPiece<Nodes>> make_piece(Plan& plan, const std::array<int, Nodes>& nodes) {
  const auto found = line_places<Nodes>(nodes, plan.context);
  if (!found) return {};
  const std::array<Vec3, Nodes>& places = *found;

  BeamPiece<Nodes> piece;
  piece.section = plan.section;
  const auto& rule = []() -> const auto& {
    if constexpr (Nodes == 2)
      return one_point;
    else
      return two_points;
  }
  ();
  for (std::size_t p = 0; p < rule.size(); ++p) {
    const LineShape<Nodes> shape(rule[p].place);
    const Vec3 along = shape.along(places);
    const double length = along.norm();
    const auto axes = section_axes(plan, along);
    if (!axes) return {};
    auto& point = piece.at[p];
    point.length = rule[p].weight * length;
    point.shape = shape.value;
    for (std::size_t i = 0; i < Nodes; ++i) point.slope[i] = shape.slope[i] / length;
    point.axes = *axes;
  }

  const auto lengths = line_masses<Nodes>(places);
  piece.mass = plan.section->mass * lengths;
  for (std::size_t i = 0; i < Nodes; ++i) {
    const auto axes = section_axes(plan, LineShape<Nodes>(-1 + 2.0 * static_cast<double>(i) / (Nodes - 1)).along(places));
    if (!axes) return {};
    piece.centers[i] = *axes * plan.section->center;
    piece.inertia[i] = lengths.row(static_cast<Eigen::Index>(i)).sum() * (*axes * plan.section->inertia * axes->transpose());
    piece.axes[i] = *axes;
  }
  if (!plan.data.axis_2) plan.side = piece.axes.back().col(1);
  return piece;
}

/// Pieces of so many nodes: the first, and the others into BuildContext::more.
template <int Nodes>
std::unique_ptr<Element> make_pieces(Plan& plan, const LineNodes& line) {
  BlockStore alone;
  const auto block = (plan.context.blocks ? *plan.context.blocks : alone).block<Beams<Nodes>>("");
  std::unique_ptr<Element> first;
  for (std::size_t p = 0; p < line.pieces(); ++p) {
    const auto nodes = line.piece<Nodes>(p);
    auto piece = make_piece<Nodes>(plan, nodes);
    if (!piece) return nullptr;
    auto element = Beams<Nodes>::add(block, plan.context.record.id + static_cast<int>(p), nodes, std::move(*piece));
    if (!first)
      first = std::move(element);
    else if (plan.context.more)
      plan.context.more->push_back(std::move(element));
  }
  return first;
}

std::unique_ptr<Element> build(const BeamData& data, BuildContext& context) {
  const LineNodes line{data.nodes, data.linear};
  if (!line.check(context)) return nullptr;
  Plan plan{data, section_of(data.profile, data.material, data.damping, context), context, Vec3::Zero()};
  if (!plan.section) return nullptr;
  if (!data.axis_2 && !plan.section->is_round) {
    context.error("AXIS2", fmt::format("beam {} has a section that is not round, and no AXIS2", context.record.id),
                  "AXIS2 x y z, a direction across the beam on the side of axis 2 of its sections");
    return nullptr;
  }
  plan.side = data.axis_2 ? Vec3(to_vector(*data.axis_2).stableNormalized())
                          : perpendicular((context.nodes.at(data.nodes[1]) - context.nodes.at(data.nodes[0])).stableNormalized());
  return line.of_two() ? make_pieces<2>(plan, line) : make_pieces<3>(plan, line);
}

}  // namespace

ElementType beam_type() {
  deck::Card<BeamData> card("BEAM", {"POUTRE"}, "Beam: a flexible line of nodes");
  card.numbered()
      .chapter("Beams")
      .describe(
          "Geometrically exact: displacements and rotations of any size, with stretch, shear, twist and bending. Pieces have "
          "three nodes, which stand along the beam and share their ends, so that N 1 2 3 4 5 is two pieces; their numbers count "
          "on from that of the record. The error of the nodes falls with the fourth power of the length of the pieces; with "
          "LINEAR, or two nodes, pieces have two and it falls with the second. Nodes on a curve make a curved beam, which is "
          "relaxed where it stands. The section is one of `.BPR`.")
      .example("I 1 BEAM N 1 2 3 4 5  BPR 1  MAT 1")
      .example("I 9 BEAM N 1 2  BPR 2  AXIS2 0 0 1  DAMPING 1E-4");
  card.add("N", &BeamData::nodes, "the nodes along the beam: 2, 3, 5, 7 …, or with LINEAR any number")
      .synonyms({"NODES", "NOEUDS"})
      .refers(deck::Reference::node)
      .at_least(1)
      .values(2, deck::detail::any_number)
      .required();
  card.add("BPR", &BeamData::profile, "number of the section in `.BPR`").synonyms({"SECTION"}).at_least(1).required();
  card.add("MAT", &BeamData::material, "number of the material in `.MAT`, of a section given by its shape")
      .synonyms({"MATERIAL", "MATERIAU"})
      .at_least(1);
  card.add("AXIS2", &BeamData::axis_2, "across the beam, on the side of axis 2 of its sections, in the reference configuration")
      .synonyms({"AXE2"});
  card.add("DAMPING", &BeamData::damping,
           "material damping (Kelvin and Voigt): the time by which stiffness is multiplied to resist rates of strain")
      .synonyms({"AMORTISSEMENT"})
      .unit(dimension::time)
      .at_least(0);
  card.add("LINEAR", &BeamData::linear, "pieces of two nodes");
  return element_type(card, build);
}

}  // namespace engrane::elements::beams
