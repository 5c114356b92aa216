// SPDX-License-Identifier: BSD-3-Clause
#include "elements/beams/beam_section.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "elements/beams/section_shape.hpp"
#include "elements/common/material.hpp"
#include "math/matrix6.hpp"

namespace engrane::elements::beams {

namespace {

/// Stays as it is when turned about axis 1.
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

/// Records of `.BPR` by number, and the sections made of them so far.
class SectionBook {
 public:
  explicit SectionBook(const std::vector<deck::Record>* records) {
    if (!records) return;
    for (const deck::Record& record : *records)
      if (record.get<deck::ProfileCard>()) profiles_[record.id] = &record;
  }

  std::shared_ptr<const BeamSection> section(int profile, int material, double damping, const BuildContext& context) const {
    std::shared_ptr<const BeamSection>& section = (*sections_)[{profile, material, damping}];
    if (!section)
      if (auto made = make(profile, material, damping, context)) section = std::make_shared<const BeamSection>(std::move(*made));
    return section;
  }

 private:
  std::optional<BeamSection> make(int profile, int material, double damping, const BuildContext& context) const;

  using Key = std::tuple<int, int, double>;
  std::map<int, const deck::Record*> profiles_;
  std::shared_ptr<std::map<Key, std::shared_ptr<const BeamSection>>> sections_ =
      std::make_shared<std::map<Key, std::shared_ptr<const BeamSection>>>();
};

/// σ = C ε of stretch and bending about the centroid, shear and twist about the shear centre.
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

/// Strains there by those at the line of the nodes.
Mat6 strains_at(const Eigen::Vector2d& centroid, const Eigen::Vector2d& shear_center) {
  Mat6 moved = Mat6::Identity();
  moved(0, 4) = centroid[1];
  moved(0, 5) = -centroid[0];
  moved(1, 3) = -shear_center[1];
  moved(2, 3) = shear_center[0];
  return moved;
}

std::optional<BeamSection> SectionBook::make(int profile, int material, double damping, const BuildContext& context) const {
  const auto found = profiles_.find(profile);
  if (found == profiles_.end()) {
    context.diagnostics.missing(".BPR", context.record.where("BPR"), fmt::format("section {} does not exist", profile),
                                fmt::format(".BPR I {} CIRCLE d, or another shape", profile));
    return {};
  }
  const auto& card = *found->second->get<deck::ProfileCard>();
  const bool has_shape = card.shape.given() || card.area;
  if (has_shape != (material != 0)) {
    context.error(has_shape ? "BPR" : "MAT",
                  has_shape ? fmt::format("section {} is a shape, and the beam has no MAT", profile)
                            : fmt::format("section {} has a stiffness of its own: MAT means nothing", profile),
                  has_shape ? "MAT the number of a .MAT" : "leave MAT out");
    return {};
  }
  BeamSection section;
  section.damping = damping;
  if (has_shape) {
    const deck::MaterialCard* made_of = isotropic_material(context, material, "beams");
    if (!made_of) return {};
    const double young = made_of->young.front(), poisson = made_of->poisson.front(), shear = young / (2 * (1 + poisson));
    const double density = made_of->density.value_or(0);
    const SectionShape shape = shape_of(card, poisson);
    const Eigen::Vector2d centroid = card.offset ? Eigen::Vector2d(card.offset->data()) : Eigen::Vector2d::Zero();
    const Mat6 own = stiffness_of(shape, young, shear), moved = strains_at(centroid, centroid + shape.shear_center);
    section.stiffness = moved.transpose() * own * moved;
    section.own_stiffness = own.diagonal();
    section.mass = density * shape.area;
    section.center << 0, centroid;
    section.inertia(0, 0) = density * shape.moments.trace();
    section.inertia(1, 1) = density * shape.moments(1, 1);
    section.inertia(2, 2) = density * shape.moments(0, 0);
    section.inertia(1, 2) = section.inertia(2, 1) = -density * shape.moments(0, 1);
    section.young = young;
    section.radius = shape.radius;
    section.middle = centroid;
    for (const Eigen::Vector2d& corner : shape.outline) section.outline.push_back(centroid + corner);
  } else {
    if (card.stiffness.empty())
      section.stiffness.diagonal() << *card.stretching, (*card.shearing)[0], (*card.shearing)[1], *card.twisting,
          (*card.bending)[0], (*card.bending)[1];
    else
      section.stiffness = *symmetric_6(card.stiffness);
    section.own_stiffness = section.stiffness.diagonal();
    section.mass = card.mass.value_or(0);
    const std::vector<double>& j = card.inertia;
    if (!j.empty()) section.inertia.diagonal() << j[0], j.size() == 1 ? j[0] / 2 : j[1], j.size() == 1 ? j[0] / 2 : j[2];
  }
  if (card.center) section.center = Vec3(0, (*card.center)[0], (*card.center)[1]);
  section.is_round = is_round(section);
  return section;
}

}  // namespace

std::shared_ptr<const BeamSection> section_of(int profile, int material, double damping, const BuildContext& context) {
  const auto make = [&context] { return SectionBook(context.records); };
  return context.notes ? context.notes->get<SectionBook>(make).section(profile, material, damping, context)
                       : make().section(profile, material, damping, context);
}

}  // namespace engrane::elements::beams
