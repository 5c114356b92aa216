// SPDX-License-Identifier: BSD-3-Clause
#include "elements/beams/beam.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "elements/beams/beam_piece.hpp"
#include "elements/beams/beam_release.hpp"
#include "elements/beams/line_shape.hpp"
#include "elements/beams/make_beam.hpp"
#include "elements/common/building.hpp"

namespace engrane::elements::beams {

namespace {

/// Data shared by all pieces of a beam while they are built.
struct Plan {
  BeamOptions options;
  SectionLine sections;
  BuildContext& context;
  Vec3 side;                      ///< direction towards axis 2; without AXIS2 it is carried along from piece to piece
  double twist = 0;               ///< rotation of axis 2 about the beam from end to end, rad
  double length = 0, passed = 0;  ///< length of the beam, and of the pieces before the current one
};

/// Axes of a section as columns; the first is along `tangent`. Reports an error and returns nothing if `side` is along it, too.
std::optional<Mat3> section_axes(const BuildContext& context, const Vec3& side, bool given, const Vec3& tangent,
                                 const char* keyword = "AXIS2") {
  const Vec3 first = tangent.normalized();
  const Vec3 across = side - first.dot(side) * first;
  constexpr double least = 1e-3;
  if (across.norm() < least) {
    context.error(keyword,
                  given ? fmt::format("{} is along beam {}", keyword, context.record.id)
                        : fmt::format("beam {} turns by a right angle within a piece", context.record.id),
                  given ? "a direction across the beam, on the side of axis 2 of its sections" : "more pieces");
    return {};
  }
  Mat3 axes;
  axes << first, across.normalized(), cross(first, across.normalized());
  return axes;
}

template <int Nodes>
std::optional<BeamPiece<Nodes>> make_piece(Plan& plan, const std::array<Vec3, Nodes>& places) {
  const Vec3 chord = places.back() - places.front();
  const double length = line_length<Nodes>(places);
  // fraction of the beam's length at ξ
  const auto part = [&](double xi) {
    const LineShape<Nodes> shape(xi);
    Vec3 x = Vec3::Zero();
    for (std::size_t i = 0; i < Nodes; ++i) x += shape.value[i] * (places[i] - places.front());
    return (plan.passed + length * x.dot(chord) / chord.squaredNorm()) / plan.length;
  };
  const auto axes_at = [&](double xi) -> std::optional<Mat3> {
    auto axes = section_axes(plan.context, plan.side, plan.options.axis_2.has_value(), LineShape<Nodes>(xi).along(places));
    if (axes && plan.twist != 0) {
      Mat3 turn = Mat3::Identity();
      turn.bottomRightCorner<2, 2>() = Eigen::Rotation2Dd(plan.twist * part(xi)).toRotationMatrix();
      *axes *= turn;
    }
    return axes;
  };

  BeamPiece<Nodes> piece;
  piece.section = plan.sections.at(part(0));
  const auto& rule = []() -> const auto& {
    if constexpr (Nodes == 2)
      return one_point;
    else
      return two_points;
  }
  ();
  for (std::size_t p = 0; p < rule.size(); ++p) {
    const LineShape<Nodes> shape(rule[p].place);
    const double stretch = shape.along(places).norm();
    const auto axes = axes_at(rule[p].place);
    if (!axes) return {};
    auto& point = piece.at[p];
    point.length = rule[p].weight * stretch;
    point.shape = shape.value;
    for (std::size_t i = 0; i < Nodes; ++i) point.slope[i] = shape.slope[i] / stretch;
    point.axes = *axes;
    const double place = part(rule[p].place);
    point.section = Nodes == 2 ? plan.sections.at(place, length) : plan.sections.at(place);
  }

  const auto lengths = line_masses<Nodes>(places);
  piece.mass = line_masses<Nodes>(places, [&](double xi) { return plan.sections.at(part(xi))->mass; });
  if (plan.options.lumped) piece.mass = Eigen::Matrix<double, Nodes, 1>(piece.mass.rowwise().sum()).asDiagonal();
  for (std::size_t i = 0; i < Nodes; ++i) {
    const double xi = -1 + 2.0 * static_cast<double>(i) / (Nodes - 1);
    const auto axes = axes_at(xi);
    if (!axes) return {};
    const auto section = plan.sections.at(part(xi));
    piece.centers[i] = *axes * section->center;
    piece.inertia[i] = lengths.row(static_cast<Eigen::Index>(i)).sum() * (*axes * section->inertia * axes->transpose());
    piece.axes[i] = *axes;
  }
  if (plan.options.small) piece.small = std::make_shared<const std::array<Vec3, Nodes>>(places);
  if (!plan.options.axis_2) plan.side = piece.axes.back().col(1);
  plan.passed += length;
  return piece;
}

/// Builds the pieces: returns the first and appends the others to BuildContext::more.
template <int Nodes, bool Held>
std::unique_ptr<Element> make_pieces(Plan& plan, const LineNodes& line) {
  BlockStore alone;
  const SectionChoice& choice = plan.options.sections;
  const auto block = (plan.context.blocks ? *plan.context.blocks : alone)
                         .block<Beams<Nodes, Held>>(fmt::format("{} {}", choice.inextensible, choice.unshearable),
                                                    choice.inextensible, choice.unshearable);
  std::vector<std::array<Vec3, Nodes>> places;
  for (std::size_t p = 0; p < line.pieces(); ++p) {
    const auto found = line_places<Nodes>(line.piece<Nodes>(p), plan.context);
    if (!found) return nullptr;
    places.push_back(*found);
    plan.length += line_length<Nodes>(*found);
  }
  if (plan.options.axis_2_end) {
    const Vec3 start = LineShape<Nodes>(1).along(places.back());
    const auto from = section_axes(plan.context, plan.side, true, start),
               to = section_axes(plan.context, plan.options.axis_2_end->stableNormalized(), true, start, "AXIS2_END");
    if (!from || !to) return nullptr;
    plan.twist = std::atan2(from->col(2).dot(to->col(1)), from->col(1).dot(to->col(1)));
  }
  std::unique_ptr<Element> first;
  for (std::size_t p = 0; p < line.pieces(); ++p) {
    auto piece = make_piece<Nodes>(plan, places[p]);
    if (!piece) return nullptr;
    const auto nodes = line.piece<Nodes>(p);
    piece->warmth = warmth_of({nodes.begin(), nodes.end()}, plan.sections.first().expansion != 0, "beam", plan.context);
    if (piece->warmth && choice.inextensible) {
      plan.context.error("INEXTENSIBLE",
                         fmt::format("beam {} does not stretch, and TEMP would expand it", plan.context.record.id),
                         "leave INEXTENSIBLE out, or A out of its material");
      return nullptr;
    }
    auto element =
        Beams<Nodes, Held>::add(block, plan.context.record.id + static_cast<int>(p), line.piece<Nodes>(p), std::move(*piece));
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
  BeamOptions options;
  options.sections = {data.profile, data.profile_end, data.material, data.damping, data.inextensible, data.unshearable};
  if (data.axis_2) options.axis_2 = to_vector(*data.axis_2);
  if (data.axis_2_end) options.axis_2_end = to_vector(*data.axis_2_end);
  return make_beam(line, options, context);
}

}  // namespace

std::unique_ptr<Element> make_beam(const LineNodes& line, const BeamOptions& options, BuildContext& context) {
  const auto sections = sections_of(options.sections, context);
  if (!sections) return nullptr;
  Plan plan{options, *sections, context, Vec3::Zero()};
  if (!options.axis_2 && !(sections->first().is_round && sections->at(1)->is_round)) {
    context.error("AXIS2", fmt::format("beam {} has a section that is not round, and no AXIS2", context.record.id),
                  "AXIS2 x y z, a direction across the beam on the side of axis 2 of its sections");
    return nullptr;
  }
  if (options.axis_2_end && !options.axis_2) {
    context.error("AXIS2_END", fmt::format("beam {} has an AXIS2_END and no AXIS2", context.record.id),
                  "AXIS2 is the direction at the first node, AXIS2_END that at the last");
    return nullptr;
  }
  plan.side = options.axis_2
                  ? options.axis_2->stableNormalized()
                  : perpendicular((context.nodes.at(line.nodes[1]) - context.nodes.at(line.nodes[0])).stableNormalized());
  const bool held = options.sections.inextensible || options.sections.unshearable;
  if (line.of_two()) return held ? make_pieces<2, true>(plan, line) : make_pieces<2, false>(plan, line);
  return held ? make_pieces<3, true>(plan, line) : make_pieces<3, false>(plan, line);
}

ElementType beam_type() {
  deck::Card<BeamData> card("BEAM", {"POUTRE"}, "Beam: a flexible line of nodes");
  card.numbered()
      .chapter("Beams")
      .describe(
          "Geometrically exact: displacements and rotations of any size, with stretch, shear, twist and bending. Pieces have "
          "three nodes, which stand along the beam and share their ends, so that N 1 2 3 4 5 is two pieces; their numbers count "
          "on from that of the record. The error of the nodes falls with the fourth power of the length of the pieces; with "
          "LINEAR, or two nodes, pieces have two and it falls with the second; straight ones are exact for small deflections by "
          "loads at their ends. Nodes on a curve make a curved beam, which is "
          "relaxed where it stands. The section is one of `.BPR`. RELEASE_A and RELEASE_B make hinges and slides at its ends: "
          "the beam is then written out with a node of its own there, and a joint from it to the node of N, which `engrane "
          "check` "
          "lists; the joints are numbered after the pieces.")
      .example("I 1 BEAM N 1 2 3 4 5  BPR 1  MAT 1")
      .example("I 9 BEAM N 1 2  BPR 2  AXIS2 0 0 1  DAMPING 1E-4")
      .example("I 12 BEAM N 1 2 3  BPR 2  AXIS2 0 1 0  RELEASE_A 5 6  RELEASE_B 6");
  card.add("N", &BeamData::nodes, "the nodes along the beam: 2, 3, 5, 7 …, or with LINEAR any number")
      .synonyms({"NODES", "NOEUDS"})
      .refers(deck::Reference::node)
      .at_least(1)
      .values(2, deck::any_number)
      .required();
  card.add("BPR", &BeamData::profile, "number of the section in `.BPR`").synonyms({"SECTION"}).at_least(1).required();
  card.add("BPR_END", &BeamData::profile_end,
           "section at the last node, of the same kind: between the ends sizes change evenly along the beam")
      .synonyms({"SECTION_END"})
      .at_least(1);
  card.add("MAT", &BeamData::material, "number of the material in `.MAT`, of a section given by its shape")
      .synonyms({"MATERIAL", "MATERIAU"})
      .at_least(1);
  card.add("AXIS2", &BeamData::axis_2, "across the beam, on the side of axis 2 of its sections, in the reference configuration")
      .synonyms({"AXE2"});
  card.add("AXIS2_END", &BeamData::axis_2_end,
           "the same at the last node, of a beam twisted by less than half a turn: axis 2 turns evenly along it")
      .synonyms({"AXE2_FIN"});
  card.add("DAMPING", &BeamData::damping,
           "material damping (Kelvin and Voigt): the time by which stiffness is multiplied to resist rates of strain; "
           "by itself that of MAT")
      .synonyms({"AMORTISSEMENT"})
      .unit(dimension::time)
      .at_least(0);
  card.add("LINEAR", &BeamData::linear, "pieces of two nodes");
  card.add("INEXTENSIBLE", &BeamData::inextensible,
           "does not stretch, whatever its EA: a multiplier at each point of Gauss holds it");
  card.add("UNSHEARABLE", &BeamData::unshearable, "does not shear, whatever its GA: sections stay across the line")
      .synonyms({"INCISAILLABLE"});
  card.add("RELEASE_A", &BeamData::release_a,
           "components in the axes of the section that the first end leaves free: 1 N, 2 V2, 3 V3, 4 T, 5 M2, 6 M3")
      .synonyms({"LIBERE_A"})
      .at_least(1)
      .at_most(6);
  card.add("RELEASE_B", &BeamData::release_b, "the same of the last end").synonyms({"LIBERE_B"}).at_least(1).at_most(6);
  ElementType type = element_type(card, build);
  short_where(type, has_releases, write_releases);
  return type;
}

}  // namespace engrane::elements::beams
