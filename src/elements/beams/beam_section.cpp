// SPDX-License-Identifier: BSD-3-Clause
#include "elements/beams/beam_section.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>

#include "deck/cards/profile_card.hpp"
#include "math/matrix6.hpp"

namespace engrane::elements::beams {

namespace {

constexpr double pi = std::numbers::pi;

/// Constants of a shape.
struct Shape {
  double area = 0;
  double moment_2 = 0, moment_3 = 0;  ///< second moments of area about axes 2 and 3
  double torsion = 0;
  double shear_2 = 1, shear_3 = 1;  ///< shear factors
};

/// A circle with a hole of `ratio` times its diameter; shear factors of Cowper (1966, J. Appl. Mech. 33, table 1).
Shape tube(double diameter, double ratio, double poisson) {
  Shape s;
  const double square = diameter * diameter, m = ratio * ratio;
  s.area = pi / 4 * square * (1 - m);
  s.moment_2 = s.moment_3 = pi / 64 * square * square * (1 - m * m);
  s.torsion = 2 * s.moment_2;
  const double whole = (1 + m) * (1 + m);
  s.shear_2 = s.shear_3 = 6 * (1 + poisson) * whole / ((7 + 6 * poisson) * whole + (20 + 12 * poisson) * m);
  return s;
}

/// Torsion: Timoshenko and Goodier (1970), Theory of Elasticity, art. 109; shear factor of Cowper.
Shape rectangle(double height, double width, double poisson) {
  Shape s;
  s.area = height * width;
  s.moment_2 = s.area * width * width / 12;
  s.moment_3 = s.area * height * height / 12;
  const double small = std::min(height, width), large = std::max(height, width);
  double sum = 0;
  constexpr int terms = 41;  // the last below rounding
  for (int n = terms; n > 0; n -= 2) sum += std::tanh(n * pi * large / (2 * small)) / std::pow(n, 5);
  s.torsion = large * small * small * small / 3 * (1 - 192 / std::pow(pi, 5) * small / large * sum);
  s.shear_2 = s.shear_3 = 10 * (1 + poisson) / (12 + 11 * poisson);
  return s;
}

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

/// Records of `.BPR` and `.MAT` by number, and the sections made of them so far.
class SectionBook {
 public:
  explicit SectionBook(const std::vector<deck::Record>* records) {
    if (!records) return;
    for (const deck::Record& record : *records) {
      if (record.get<deck::ProfileCard>()) profiles_[record.id] = &record;
      if (record.get<deck::MaterialCard>()) materials_[record.id] = &record;
    }
  }

  std::shared_ptr<const BeamSection> section(int profile, int material, double damping, const BuildContext& context) const {
    std::shared_ptr<const BeamSection>& section = (*sections_)[{profile, material, damping}];
    if (!section)
      if (auto made = make(profile, material, damping, context)) section = std::make_shared<const BeamSection>(std::move(*made));
    return section;
  }

 private:
  std::optional<BeamSection> make(int profile, int material, double damping, const BuildContext& context) const;
  /// The material's card; nullptr, with an error, where it is none that beams can be made of.
  const deck::MaterialCard* material_of(int material, const BuildContext& context) const;

  using Key = std::tuple<int, int, double>;
  std::map<int, const deck::Record*> profiles_, materials_;
  std::shared_ptr<std::map<Key, std::shared_ptr<const BeamSection>>> sections_ =
      std::make_shared<std::map<Key, std::shared_ptr<const BeamSection>>>();
};

const deck::MaterialCard* SectionBook::material_of(int material, const BuildContext& context) const {
  const auto found = materials_.find(material);
  if (found == materials_.end()) {
    context.diagnostics.missing(".MAT", context.record.where("MAT"), fmt::format("material {} does not exist", material),
                                fmt::format(".MAT I {} YT … NT … M …", material));
    return nullptr;
  }
  const auto* card = found->second->get<deck::MaterialCard>();
  if (card->young.size() == 1 && card->poisson.size() == 1 && card->shear.empty()) return card;
  context.error("MAT", fmt::format("material {} has no YT and NT of one value, which beams need", material),
                "YT 2.1D11 NT 0.3 M 7850.");
  return nullptr;
}

Shape shape_of(const deck::ProfileCard& card, double poisson) {
  Shape shape;
  const auto size = [&card](std::size_t i) { return card.shape.values[i]; };
  if (card.shape.is("CIRCLE"))
    shape = tube(size(0), 0, poisson);
  else if (card.shape.is("TUBE"))
    shape = tube(size(0), size(1) / size(0), poisson);
  else if (card.shape.is("RECTANGLE"))
    shape = rectangle(size(0), size(1), poisson);
  else {
    shape.area = *card.area;
    shape.moment_2 = (*card.moments)[0];
    shape.moment_3 = (*card.moments)[1];
    shape.torsion = *card.torsion;
  }
  if (card.factors) {
    shape.shear_2 = (*card.factors)[0];
    shape.shear_3 = (*card.factors)[1];
  }
  return shape;
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
    const deck::MaterialCard* made_of = material_of(material, context);
    if (!made_of) return {};
    const double young = made_of->young.front(), poisson = made_of->poisson.front(), shear = young / (2 * (1 + poisson));
    const double density = made_of->density.value_or(0);
    const Shape s = shape_of(card, poisson);
    section.stiffness.diagonal() << young * s.area, shear * s.area * s.shear_2, shear * s.area * s.shear_3, shear * s.torsion,
        young * s.moment_2, young * s.moment_3;
    section.mass = density * s.area;
    section.inertia.diagonal() << density * (s.moment_2 + s.moment_3), density * s.moment_2, density * s.moment_3;
  } else {
    if (card.stiffness.empty())
      section.stiffness.diagonal() << *card.stretching, (*card.shearing)[0], (*card.shearing)[1], *card.twisting,
          (*card.bending)[0], (*card.bending)[1];
    else
      section.stiffness = *symmetric_6(card.stiffness);
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
