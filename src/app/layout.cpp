// SPDX-License-Identifier: BSD-3-Clause
#include "app/layout.hpp"

#include <algorithm>

#include "app/model_json.hpp"
#include "app/version.hpp"

namespace engrane::app {

output::ResultsLayout results_layout(const Reading& reading, const observe::Observer& observer, std::size_t expected_samples) {
  const Model& model = reading.model;
  output::ResultsLayout layout;
  layout.title = model.title;
  layout.analysis = model.commands.analysis.type.tag;
  layout.deck_text = deck::canonical_text(reading.deck);
  layout.model_json = model_json(model);
  layout.version = version;
  layout.libraries = library_versions();
  layout.units = model.units;
  for (std::size_t i = 1; i < model.nodes.size(); ++i) {
    layout.node_ids.push_back(model.nodes[i].id);
    layout.points.push_back(model.nodes[i].x);
  }
  for (const Model::Part& part : model.parts) {
    output::Cell cell{{}, part.element->id(), false};
    for (const int node : part.nodes)
      if (node > 0 && std::find(cell.points.begin(), cell.points.end(), node - 1) == cell.points.end())
        cell.points.push_back(node - 1);
    if (!cell.points.empty()) layout.cells.push_back(std::move(cell));
  }
  for (const observe::Table& table : observer.tables())
    layout.history.push_back({table.path, table.type, table.ids, table.channels});
  layout.history.push_back({"run", "", {}, observer.run_channels()});
  layout.velocities = observer.moves();
  layout.expected_samples = expected_samples;
  return layout;
}

output::FrameValues frame_values(const observe::NodalFields& fields) {
  return {fields.displacement,     fields.rotation,       fields.velocity,
          fields.angular_velocity, fields.reaction_force, fields.reaction_torque};
}

}  // namespace engrane::app
