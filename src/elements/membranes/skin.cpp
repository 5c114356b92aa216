// SPDX-License-Identifier: BSD-3-Clause
// Membranes that are cells of a mesh.
#include "elements/membranes/membrane_cells.hpp"
#include "elements/structural/make_cell.hpp"

namespace engrane::elements::structural {

std::unique_ptr<Element> make_skin(const CellPlan& plan, BlockStore* blocks) {
  const SkinOptions& skin = *plan.section->skin;
  membranes::MembraneSection section{membranes::membrane_law(plan.section->law), plan.section->law.density,
                                     plan.section->thickness, 0, nullptr};
  section.law.tension = skin.tension;
  if (skin.wrinkling) section.law.wrinkling = skin.slack.value_or(membranes::slack_stiffness);
  return membranes::make_membrane(plan.id, plan.shape, plan.nodes, plan.places,
                                  std::make_shared<const membranes::MembraneSection>(std::move(section)), blocks);
}

}  // namespace engrane::elements::structural
