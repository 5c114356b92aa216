// SPDX-License-Identifier: BSD-3-Clause
#include "app/layout.hpp"

#include <algorithm>

#include "app/model_json.hpp"
#include "app/version.hpp"

namespace engrane::app {

namespace {

/// Whether the mesh has a cell for the part; its points are all nodes of the part except the ground.
bool has_cell(const Model::Part& part) {
  return part.element->in_mesh() && std::any_of(part.nodes.begin(), part.nodes.end(), [](int node) { return node > 0; });
}

}  // namespace

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
  for (const int node : observer.points().copies()) {
    layout.node_ids.push_back(model.node(node).id);
    layout.points.push_back(model.node(node).x);
  }
  for (const Model::Part& part : model.parts) {
    if (!has_cell(part)) continue;
    output::Cell cell{{}, part.element->id(), part.element->cell_shape()};
    for (std::size_t i = 0; i < part.nodes.size(); ++i) {
      if (part.nodes[i] == 0) continue;
      const int point = observer.points().at(part, i);
      if (std::find(cell.points.begin(), cell.points.end(), point) == cell.points.end()) cell.points.push_back(point);
    }
    layout.cells.push_back(std::move(cell));
  }
  for (const observe::Table& table : observer.tables())
    layout.history.push_back({table.path, table.type, table.ids, table.channels});
  layout.history.push_back({"run", "", {}, observer.run_channels()});
  for (std::size_t f = 0; f < observer.element_fields().size(); ++f) {
    const observe::ElementField& field = observer.element_fields()[f];
    layout.cell_fields.push_back({field.named, field.components});
    if (field.place_count == 0) continue;
    output::PointField& points = layout.point_fields.emplace_back(output::PointField{layout.cell_fields.back(), {}, {}});
    points.elements.reserve(field.place_count);
    points.points.reserve(field.place_count);
    for (const int part : observer.place_parts(f)) {
      const int id = model.part(part).element->id();
      points.points.push_back(!points.elements.empty() && points.elements.back() == id ? points.points.back() + 1 : 0);
      points.elements.push_back(id);
    }
  }
  for (const observe::AveragedField& field : observer.averages()) layout.averages.push_back({field.named, field.components});
  layout.node_fields = observe::nodal_field_names(observer.moves());
  layout.expected_samples = expected_samples;
  return layout;
}

output::FrameValues frame_values(const Model& model, const observe::Observer& observer) {
  output::FrameValues values;
  const std::vector<int>& copies = observer.points().copies();
  for (const observe::NodalField& field : observer.fields()) {
    std::vector<double>& rows = values.nodes.emplace_back();
    rows.reserve(field.rows.size() + 3 * copies.size());
    rows = field.rows;
    for (const int node : copies) {
      const auto row = field.rows.begin() + 3 * (node - 1);
      rows.insert(rows.end(), row, row + 3);
    }
  }
  for (const observe::AveragedField& field : observer.averages()) values.averages.push_back(field.rows);
  for (const observe::ElementField& field : observer.element_fields()) {
    std::vector<double>& rows = values.cells.emplace_back();
    rows.reserve(model.parts.size() * field.width());
    for (std::size_t p = 0; p < model.parts.size(); ++p)
      if (has_cell(model.parts[p]))
        for (std::size_t k = 0; k < field.width(); ++k) rows.push_back(field.rows[p * field.width() + k]);
    if (field.place_count > 0) values.points.push_back(field.places);
  }
  return values;
}

}  // namespace engrane::app
