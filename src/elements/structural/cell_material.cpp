// SPDX-License-Identifier: BSD-3-Clause
#include "elements/structural/cell_material.hpp"

#include <fmt/format.h>

#include "base/text.hpp"

namespace engrane::elements::structural {

namespace {

using materials::Elastic;
using materials::Hypothesis;

Vec3 along_axes(const std::vector<double>& values) {
  return values.size() == 3 ? Vec3(values[0], values[1], values[2]) : Vec3::Constant(values.empty() ? 0.0 : values.front());
}

std::optional<Elastic> isotropic_of(const deck::Record& record, const deck::MaterialCard& card, Hypothesis hypothesis,
                                    Diagnostics& diagnostics) {
  const double young = card.young.front(), poisson = card.poisson.front();
  if (!card.shear.empty())
    diagnostics.error(record.where("G"), "the shear modulus of an isotropic material follows from YT and NT",
                      "leave G out, or give three values of YT, NT and G");
  else if (poisson == 0.5 && hypothesis != Hypothesis::plane_stress)
    diagnostics.error(record.where("NT"), "a material with NT 0.5 keeps its volume, which these cells cannot",
                      "take NT below 0.5, such as 0.49");
  else
    return materials::isotropic(young, poisson);
  return {};
}

bool is_neo_hookean(const deck::MaterialCard& card) {
  for (const char* language : {"NEO-HOOKEAN", "NEO_HOOKEAN", "NEO HOOKEAN", "NEOHOOKEAN"})
    if (abbreviates(card.behaviour, language)) return true;
  return false;
}

std::optional<Elastic> neo_hookean_of(const deck::Record& record, const deck::MaterialCard& card, Diagnostics& diagnostics) {
  if (card.young.size() != 1 || card.poisson.size() != 1 || !card.shear.empty())
    diagnostics.error(record.location, fmt::format("the neo-Hookean material {} is isotropic", record.id),
                      "one value of YT, one of NT, no G: those of small strains");
  else if (!(card.poisson.front() >= 0 && card.poisson.front() < 0.5))
    diagnostics.error(record.where("NT"), fmt::format("NT = {} is out of range for a neo-Hookean material", card.poisson.front()),
                      "NT is at least 0 and below 0.5, such as 0.49 for rubber");
  else if (card.expansion.size() > 1)
    diagnostics.error(record.where("A"), fmt::format("the neo-Hookean material {} expands alike in all directions", record.id),
                      "one value of A");
  else {
    Elastic material = materials::isotropic(card.young.front(), card.poisson.front());
    material.neo_hookean = materials::neo_hookean(card.young.front(), card.poisson.front());
    return material;
  }
  return {};
}

std::optional<Elastic> orthotropic_of(const deck::Record& record, const deck::MaterialCard& card, Diagnostics& diagnostics) {
  Elastic material = materials::orthotropic({along_axes(card.young), along_axes(card.poisson), along_axes(card.shear)});
  if (materials::is_stable(material)) return material;
  diagnostics.error(record.where("NT"),
                    fmt::format("material {} would give energy away: its constants are of no elastic material", record.id),
                    "NT holds ν12 ν23 ν13, with ν12² below E1/E2, ν23² below E2/E3 and ν13² below E1/E3");
  return {};
}

}  // namespace

std::optional<Elastic> elastic_of(const deck::Record& record, Hypothesis hypothesis, Diagnostics& diagnostics) {
  const auto& card = *record.get<deck::MaterialCard>();
  const std::size_t count = card.young.size();
  const bool rubber = is_neo_hookean(card);
  std::optional<Elastic> material;
  if (!rubber && !abbreviates(card.behaviour, "ELASTIC") && !abbreviates(card.behaviour, "ELASTIQUE"))
    diagnostics.error(record.where("BEHA"), fmt::format("the behaviour \"{}\" is not in this version", card.behaviour),
                      "there are \"ELASTIC\" and \"NEO-HOOKEAN\"");
  else if (count == 0 || card.poisson.empty())
    diagnostics.error(record.location, fmt::format("material {} of cells needs YT and NT", record.id),
                      "Young's modulus YT and Poisson's ratio NT");
  else if (rubber)
    material = neo_hookean_of(record, card, diagnostics);
  else if (count == 1 && card.poisson.size() == 1 && card.expansion.size() <= 1)
    material = isotropic_of(record, card, hypothesis, diagnostics);
  else if (count == 3 && card.poisson.size() == 3 && card.shear.size() == 3 && card.expansion.size() != 2)
    material = orthotropic_of(record, card, diagnostics);
  else
    diagnostics.error(record.location, fmt::format("material {} is neither isotropic nor orthotropic", record.id),
                      "one value of YT, NT and A, or three each of YT, NT (ν12 ν23 ν13), G (G12 G23 G13) and A");
  if (!material) return {};
  material->density = card.density.value_or(0);
  material->damping = card.damping;
  material->expansion.head<3>() = along_axes(card.expansion);
  return material;
}

}  // namespace engrane::elements::structural
