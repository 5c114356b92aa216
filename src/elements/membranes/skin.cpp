// SPDX-License-Identifier: BSD-3-Clause
// Membranes as cells of a mesh. elements/structural only declares make_skin() and does not depend on membranes, which in turn
// use its shape functions and materials.
#include "elements/membranes/membrane.hpp"
#include "elements/membranes/membrane_cells.hpp"
#include "elements/structural/make_cell.hpp"

namespace engrane::elements::membranes {

namespace {

MembraneSection section_of(const structural::CellSection& cell) {
  MembraneSection section{membrane_law(cell.law), cell.law.density, cell.thickness, 0, nullptr};
  section.law.tension = cell.skin->tension;
  if (cell.skin->wrinkling) section.law.wrinkling = cell.skin->slack.value_or(slack_stiffness);
  return section;
}

}  // namespace

}  // namespace engrane::elements::membranes

std::unique_ptr<engrane::Element> engrane::elements::structural::make_skin(const CellPlan& plan, BlockStore* blocks) {
  auto section = std::make_shared<const membranes::MembraneSection>(membranes::section_of(*plan.section));
  return membranes::make_membrane(plan.id, plan.shape, plan.nodes, plan.places, std::move(section), plan.warmth, blocks);
}

const std::vector<int>* engrane::elements::structural::membrane_nodes(const deck::Record& record) {
  const auto* data = record.get<membranes::MembraneData>();
  return data ? &data->nodes : nullptr;
}
