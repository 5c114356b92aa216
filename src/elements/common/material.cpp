// SPDX-License-Identifier: BSD-3-Clause
#include "elements/common/material.hpp"

#include <fmt/format.h>

#include <map>

namespace engrane::elements {

namespace {

/// Records of `.MAT` by number.
class MaterialBook {
 public:
  explicit MaterialBook(const std::vector<deck::Record>* records) {
    if (!records) return;
    for (const deck::Record& record : *records)
      if (record.get<deck::MaterialCard>()) all_[record.id] = &record;
  }

  const deck::Record* find(int number) const {
    const auto found = all_.find(number);
    return found == all_.end() ? nullptr : found->second;
  }

 private:
  std::map<int, const deck::Record*> all_;
};

}  // namespace

const deck::Record* material_record(const BuildContext& context, int number) {
  const auto make = [&context] { return MaterialBook(context.records); };
  const deck::Record* found = context.notes ? context.notes->get<MaterialBook>(make).find(number) : make().find(number);
  if (!found)
    context.diagnostics.missing(".MAT", context.record.where("MAT"), fmt::format("material {} does not exist", number),
                                fmt::format(".MAT I {} YT … NT … M …", number));
  return found;
}

const deck::MaterialCard* isotropic_material(const BuildContext& context, int number, std::string_view who) {
  const deck::Record* found = material_record(context, number);
  if (!found) return nullptr;
  const auto* card = found->get<deck::MaterialCard>();
  if (card->young.size() == 1 && card->poisson.size() == 1 && card->shear.empty() && card->expansion.size() <= 1) return card;
  const bool elastic = card->young.size() == 1 && card->poisson.size() == 1 && card->shear.empty();
  context.error("MAT", fmt::format("material {} has no {} of one value, which {} need", number, elastic ? "A" : "YT and NT", who),
                elastic ? "A 1.2D-5" : "YT 2.1D11 NT 0.3 M 7850.");
  return nullptr;
}

}  // namespace engrane::elements
