// SPDX-License-Identifier: BSD-3-Clause
#include "observe/fields.hpp"

#include <limits>
#include <map>

#include "math/rotation.hpp"

namespace engrane::observe {

ElementFields::ElementFields(Assembler& assembler) : assembler_(assembler) {
  const Model& model = assembler.model();
  std::map<std::string, std::size_t> known;
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    std::size_t first = 0;
    for (const Field& field : model.parts[p].element->fields()) {
      const auto [at, is_new] = known.try_emplace(field.name, fields_.size());
      if (is_new) fields_.push_back({field, field.components, {}});
      const std::size_t size = field.size(model.parts[p].nodes.size());
      const std::size_t width = field.components.empty() ? 1 : field.components.size();
      if (width == fields_[at->second].width()) uses_.push_back({static_cast<int>(p), at->second, first, size / width});
      first += size;
    }
  }
}

void ElementFields::evaluate(const Configuration& c) {
  const Model& model = assembler_.model();
  // parts that other ranks evaluate are zero, and so is the sum until it is known who has the field
  for (ElementField& field : fields_) field.rows.assign(model.parts.size() * field.width(), 0.0);
  std::vector<double> values;
  int evaluated = -1;
  for (const Use& use : uses_) {
    if (use.part < assembler_.first_part() || use.part >= assembler_.end_part()) continue;
    const Model::Part& part = model.parts[static_cast<std::size_t>(use.part)];
    if (use.part != evaluated) {
      std::size_t size = 0;
      for (const Field& field : part.element->fields()) size += field.size(part.nodes.size());
      values.assign(size, 0.0);
      part.element->evaluate_fields(assembler_.view(use.part, c), values);
      evaluated = use.part;
    }
    ElementField& field = fields_[use.field];
    double* row = field.rows.data() + static_cast<std::size_t>(use.part) * field.width();
    for (std::size_t place = 0; place < use.places; ++place)
      for (std::size_t k = 0; k < field.width(); ++k)
        row[k] += values[use.first + place * field.width() + k] / static_cast<double>(use.places);
  }
  const bool root = assembler_.rank() == 0;
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    ElementField& field = fields_[f];
    const int count = static_cast<int>(field.rows.size());
    MPI_Reduce(root ? MPI_IN_PLACE : field.rows.data(), field.rows.data(), count, MPI_DOUBLE, MPI_SUM, 0, assembler_.comm());
    std::vector<char> has(model.parts.size(), 0);
    for (const Use& use : uses_)
      if (use.field == f) has[static_cast<std::size_t>(use.part)] = 1;
    for (std::size_t i = 0; i < field.rows.size(); ++i)
      if (!has[i / field.width()]) field.rows[i] = std::numeric_limits<double>::quiet_NaN();
  }
}

NodalFields nodal_fields(const Model& model, const Configuration& c, const std::vector<Reaction>& reactions, bool moves) {
  NodalFields fields;
  const auto put = [](std::vector<double>& field, const Vec3& v) { field.insert(field.end(), v.data(), v.data() + 3); };
  for (std::size_t i = 1; i < c.nodes.size(); ++i) {
    const NodeState& node = c.nodes[i];
    put(fields.displacement, node.x - model.nodes[i].x);
    put(fields.rotation, rotation_log(node.R));
    if (!moves) continue;
    put(fields.velocity, node.v);
    put(fields.angular_velocity, node.R * node.W);
  }
  fields.reaction_force.assign(fields.displacement.size(), 0.0);
  fields.reaction_torque.assign(fields.displacement.size(), 0.0);
  for (const Reaction& reaction : reactions) {
    const auto at = 3 * static_cast<std::size_t>(reaction.node - 1);
    for (std::size_t k = 0; k < 3; ++k) {
      fields.reaction_force[at + k] = reaction.force[static_cast<Eigen::Index>(k)];
      fields.reaction_torque[at + k] = reaction.torque[static_cast<Eigen::Index>(k)];
    }
  }
  return fields;
}

}  // namespace engrane::observe
