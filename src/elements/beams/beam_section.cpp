// SPDX-License-Identifier: BSD-3-Clause
#include "elements/beams/beam_section.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <optional>

#include "elements/beams/section_shape.hpp"
#include "elements/common/material.hpp"
#include "math/matrix6.hpp"

namespace engrane::elements::beams {

namespace {

/// Whether the section is invariant under rotation about axis 1.
bool is_round(const BeamSection& section) {
  const Mat3 turn = Eigen::AngleAxisd(1, Vec3::UnitX()).toRotationMatrix();
  Mat6 both = Mat6::Zero();
  both.topLeftCorner<3, 3>() = both.bottomRightCorner<3, 3>() = turn;
  const Mat6 change = both * section.stiffness * both.transpose() - section.stiffness;
  constexpr double rounding = 1e-9;
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = 0; j < 6; ++j)
      if (std::abs(change(i, j)) > rounding * std::sqrt(section.stiffness(i, i) * section.stiffness(j, j))) return false;
  const Mat3 other = turn * section.inertia * turn.transpose() - section.inertia;
  return section.center.isZero(0) && other.norm() <= rounding * section.inertia.norm();
}

/// `section` for a piece of two nodes of this length.
std::shared_ptr<const BeamSection> bent(const BeamSection& section, double length) {
  auto own = std::make_shared<BeamSection>(section);
  own->stiffness = with_bending_within(section.stiffness, length);
  return own;
}

/// Records of `.BPR` by number, and a cache of the sections made from them.
class SectionBook {
 public:
  explicit SectionBook(const std::vector<deck::Record>* records) {
    if (!records) return;
    for (const deck::Record& record : *records)
      if (record.get<deck::ProfileCard>()) profiles_[record.id] = &record;
  }

  std::optional<SectionLine> line(const SectionChoice& choice, const BuildContext& context) const {
    const auto found = lines_->find(choice);
    if (found != lines_->end()) return found->second;
    auto line = make_line(choice, context);
    if (line) lines_->emplace(choice, *line);
    return line;
  }

 private:
  std::optional<SectionLine> make_line(const SectionChoice& choice, const BuildContext& context) const;
  const deck::ProfileCard* profile(int number, const char* keyword, const BuildContext& context) const;

  std::map<int, const deck::Record*> profiles_;
  std::shared_ptr<std::map<SectionChoice, SectionLine>> lines_ = std::make_shared<std::map<SectionChoice, SectionLine>>();
};

/// C of σ = C ε, with stretch and bending about the centroid, shear and twist about the shear centre.
Mat6 stiffness_of(const SectionShape& shape, double young, double shear) {
  Mat6 own = Mat6::Zero();
  own(0, 0) = young * shape.area;
  own.block<2, 2>(1, 1) = shear * shape.area * shape.shear_factors;
  own(3, 3) = shear * shape.torsion;
  own(4, 4) = young * shape.moments(1, 1);
  own(5, 5) = young * shape.moments(0, 0);
  own(4, 5) = own(5, 4) = -young * shape.moments(0, 1);
  return own;
}

/// Maps strains at the line of nodes to the stretch at the centroid and the shears at the shear centre.
Mat6 strains_at(const Eigen::Vector2d& centroid, const Eigen::Vector2d& shear_center) {
  Mat6 moved = Mat6::Identity();
  moved(0, 4) = centroid[1];
  moved(0, 5) = -centroid[0];
  moved(1, 3) = -shear_center[1];
  moved(2, 3) = shear_center[0];
  return moved;
}

/// Material of a shape; all zero for a section given by its stiffness.
struct Stuff {
  double young = 0, poisson = 0, density = 0, damping = 0, expansion = 0;
};

BeamSection make_section(const deck::ProfileCard& card, const Stuff& stuff, const SectionChoice& choice) {
  BeamSection section;
  section.damping = choice.damping.value_or(stuff.damping);
  section.expansion = stuff.expansion;
  Mat6 own = Mat6::Zero(), moved = Mat6::Identity();
  if (card.shape.given() || card.area) {
    const SectionShape shape = shape_of(card, stuff.poisson);
    const Eigen::Vector2d centroid = card.offset ? Eigen::Vector2d(card.offset->data()) : Eigen::Vector2d::Zero();
    own = stiffness_of(shape, stuff.young, stuff.young / (2 * (1 + stuff.poisson)));
    moved = strains_at(centroid, centroid + shape.shear_center);
    section.mass = stuff.density * shape.area;
    section.center << 0, centroid;
    section.inertia(0, 0) = stuff.density * shape.moments.trace();
    section.inertia(1, 1) = stuff.density * shape.moments(1, 1);
    section.inertia(2, 2) = stuff.density * shape.moments(0, 0);
    section.inertia(1, 2) = section.inertia(2, 1) = -stuff.density * shape.moments(0, 1);
    section.young = stuff.young;
    section.radius = shape.radius;
    section.middle = centroid;
    for (const Eigen::Vector2d& corner : shape.outline) section.outline.push_back(centroid + corner);
  } else {
    if (card.stiffness.empty())
      own.diagonal() << *card.stretching, (*card.shearing)[0], (*card.shearing)[1], *card.twisting, (*card.bending)[0],
          (*card.bending)[1];
    else
      own = *symmetric_6(card.stiffness);
    section.mass = card.mass.value_or(0);
    const std::vector<double>& j = card.inertia;
    if (!j.empty()) section.inertia.diagonal() << j[0], j.size() == 1 ? j[0] / 2 : j[1], j.size() == 1 ? j[0] / 2 : j[2];
  }
  if (card.center) section.center = Vec3(0, (*card.center)[0], (*card.center)[1]);
  section.own_stiffness = own.diagonal();
  section.stiffness = moved.transpose() * own * moved;
  section.is_round = is_round(section);
  for (const Eigen::Index strain : {0, 1, 2})
    if (strain == 0 ? choice.inextensible : choice.unshearable) {
      own.row(strain).setZero();
      own.col(strain).setZero();
      section.held.emplace_back(moved.row(strain));
    }
  if (!section.held.empty()) section.stiffness = moved.transpose() * own * moved;
  return section;
}

/// Interpolates linearly from `to` (part 0) to `other` (part 1), in place. False if only one is given or their sizes differ.
bool mix(double& to, double other, double part) {
  to += part * (other - to);
  return true;
}
template <std::size_t N>
bool mix(std::array<double, N>& to, const std::array<double, N>& other, double part) {
  for (std::size_t i = 0; i < N; ++i) mix(to[i], other[i], part);
  return true;
}
bool mix(std::vector<double>& to, const std::vector<double>& other, double part) {
  if (to.size() != other.size()) return false;
  for (std::size_t i = 0; i < to.size(); ++i) mix(to[i], other[i], part);
  return true;
}
template <class V>
bool mix(std::optional<V>& to, const std::optional<V>& other, double part) {
  return to.has_value() == other.has_value() && (!to || mix(*to, *other, part));
}

/// Interpolates between two cards; nothing if they are not of the same kind.
std::optional<deck::ProfileCard> between(deck::ProfileCard card, const deck::ProfileCard& other, double part) {
  const bool mixed = card.shape.tag == other.shape.tag && mix(card.shape.values, other.shape.values, part) &&
                     mix(card.hole, other.hole, part) && mix(card.offset, other.offset, part) &&
                     mix(card.area, other.area, part) && mix(card.moments, other.moments, part) &&
                     mix(card.torsion, other.torsion, part) && mix(card.factors, other.factors, part) &&
                     mix(card.stretching, other.stretching, part) && mix(card.twisting, other.twisting, part) &&
                     mix(card.shearing, other.shearing, part) && mix(card.bending, other.bending, part) &&
                     mix(card.stiffness, other.stiffness, part) && mix(card.mass, other.mass, part) &&
                     mix(card.inertia, other.inertia, part) && mix(card.center, other.center, part);
  if (!mixed) return {};
  return card;
}

const deck::ProfileCard* SectionBook::profile(int number, const char* keyword, const BuildContext& context) const {
  const auto found = profiles_.find(number);
  if (found != profiles_.end()) return found->second->get<deck::ProfileCard>();
  context.diagnostics.missing(".BPR", context.record.where(keyword), fmt::format("section {} does not exist", number),
                              fmt::format(".BPR I {} CIRCLE d, or another shape", number));
  return nullptr;
}

std::optional<SectionLine> SectionBook::make_line(const SectionChoice& choice, const BuildContext& context) const {
  const deck::ProfileCard* card = profile(choice.profile, "BPR", context);
  const deck::ProfileCard* end = choice.profile_end == 0 ? card : profile(choice.profile_end, "BPR_END", context);
  if (!card || !end) return {};
  const bool has_shape = card->shape.given() || card->area;
  if (has_shape != (choice.material != 0)) {
    context.error(has_shape ? "BPR" : "MAT",
                  has_shape ? fmt::format("section {} is a shape, and the beam has no MAT", choice.profile)
                            : fmt::format("section {} has a stiffness of its own: MAT means nothing", choice.profile),
                  has_shape ? "MAT the number of a .MAT" : "leave MAT out");
    return {};
  }
  if (!between(*card, *end, 0.5)) {
    context.error("BPR_END", fmt::format("sections {} and {} are not of one kind", choice.profile, choice.profile_end),
                  "both are the same shape, or given by the same keywords, with as many numbers");
    return {};
  }
  Stuff stuff;
  if (has_shape) {
    const deck::MaterialCard* made_of = isotropic_material(context, choice.material, "beams");
    if (!made_of) return {};
    stuff = {made_of->young.front(), made_of->poisson.front(), made_of->density.value_or(0), made_of->damping,
             made_of->expansion.empty() ? 0 : made_of->expansion.front()};
  }
  const auto first = std::make_shared<const BeamSection>(make_section(*card, stuff, choice));
  if (card == end) return SectionLine(first, nullptr);
  return SectionLine(first, [card = *card, end = *end, stuff, choice](double part) {
    return std::make_shared<const BeamSection>(make_section(*between(card, end, part), stuff, choice));
  });
}

}  // namespace

Mat6 with_bending_within(const Mat6& stiffness, double length) {
  if (!(stiffness.diagonal().minCoeff() > 0)) return stiffness;
  // rows in units of their own, which makes the inverses accurate
  const Vec6 size = stiffness.diagonal().cwiseSqrt(), part = size.cwiseInverse();
  const Eigen::LDLT<Mat6> factors(part.asDiagonal() * stiffness * part.asDiagonal());
  if (factors.info() != Eigen::Success || !factors.isPositive()) return stiffness;
  const Mat6 compliance = part.asDiagonal() * factors.solve(Mat6::Identity()) * part.asDiagonal();
  Mat6 slope = Mat6::Zero();
  slope(4, 2) = 1;
  slope(5, 1) = -1;
  const Mat6 scaled =
      size.asDiagonal() * Mat6(compliance + length * length / 12 * slope.transpose() * compliance * slope) * size.asDiagonal();
  const Mat6 inverse = Eigen::LDLT<Mat6>(scaled).solve(Mat6::Identity());
  const Mat6 whole = size.asDiagonal() * inverse * size.asDiagonal();
  return (whole + whole.transpose()) / 2;
}

std::shared_ptr<const BeamSection> SectionLine::at(double part, double length) const {
  auto section = at(part);
  if (!section->held.empty()) return section;
  if (between_) return bent(*section, length);
  auto& own = (*of_pieces_)[length];
  if (!own) own = bent(*section, length);
  return own;
}

std::optional<SectionLine> sections_of(const SectionChoice& choice, const BuildContext& context) {
  const auto make = [&context] { return SectionBook(context.records); };
  return context.notes ? context.notes->get<SectionBook>(make).line(choice, context) : make().line(choice, context);
}

}  // namespace engrane::elements::beams
