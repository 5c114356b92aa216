// SPDX-License-Identifier: BSD-3-Clause
#include "observe/fields.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "math/rotation.hpp"
#include "math/stress.hpp"

namespace engrane::observe {

namespace {

/// A kind of field over the nodes. To have another, add a row to the table.
struct NodalKind {
  Named named;
  bool of_motion;  ///< for analyses in which something moves
  Vec3 (*value)(const Vec3& reference, const NodeState& node, const Reaction& reaction);
};

const std::vector<NodalKind>& nodal_kinds() {
  static const std::vector<NodalKind> kinds = {
      {{"displacement", dimension::length, "displacement"},
       false,
       [](const Vec3& reference, const NodeState& node, const Reaction&) -> Vec3 { return node.x - reference; }},
      {{"rotation", dimension::angle, "rotation vector"},
       false,
       [](const Vec3&, const NodeState& node, const Reaction&) -> Vec3 { return rotation_log(node.R); }},
      {{"velocity", dimension::velocity, "velocity"},
       true,
       [](const Vec3&, const NodeState& node, const Reaction&) -> Vec3 { return node.v; }},
      {{"angular_velocity", dimension::angular_velocity, "angular velocity"},
       true,
       [](const Vec3&, const NodeState& node, const Reaction&) -> Vec3 { return node.R * node.W; }},
      {{"reaction_force", dimension::force, "reaction force"},
       false,
       [](const Vec3&, const NodeState&, const Reaction& reaction) -> Vec3 { return reaction.force; }},
      {{"reaction_torque", dimension::moment, "reaction torque"},
       false,
       [](const Vec3&, const NodeState&, const Reaction& reaction) -> Vec3 { return reaction.torque; }},
  };
  return kinds;
}

constexpr const char* stress = "STRESS";

/// A field of elements that, at nodes, is that of the averaged stress.
struct DerivedKind {
  const char* name;
  void (*value)(std::span<const double> stress, double* out);
};

const std::vector<DerivedKind>& derived_kinds() {
  static const std::vector<DerivedKind> kinds = {
      {"VON_MISES", [](std::span<const double> s, double* out) { *out = von_mises(s); }},
      {"PRINCIPAL", [](std::span<const double> s, double* out) { std::ranges::copy(principal_stresses(s), out); }},
  };
  return kinds;
}

}  // namespace

ElementFields::ElementFields(Assembler& assembler) : assembler_(assembler), points_(assembler.model()), averages_(points_) {
  const Model& model = assembler.model();
  std::map<std::string, std::size_t> known;
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    std::size_t first = 0;
    for (const Field& field : model.parts[p].element->fields()) {
      const auto [at, is_new] = known.try_emplace(field.name, fields_.size());
      if (is_new) fields_.push_back({field, field.components, {}, {}, {}});
      const std::size_t size = field.size(model.parts[p].nodes.size());
      const std::size_t width = field.components.empty() ? 1 : field.components.size();
      if (std::vector<int>& parts = fields_[at->second].place_parts; width == fields_[at->second].width()) {
        uses_.push_back({static_cast<int>(p), at->second, first, size / width, parts.size(), field.averaged});
        parts.insert(parts.end(), size / width, static_cast<int>(p));
        if (field.averaged) averages_.declare(field, model.parts[p]);
      }
      first += size;
    }
  }
  // one value in each part needs no second list
  for (std::size_t f = 0; f < fields_.size(); ++f)
    if (std::none_of(uses_.begin(), uses_.end(), [f](const Use& use) { return use.field == f && use.places > 1; }))
      fields_[f].place_parts.clear();
  if (averages_.empty()) return;
  for (const DerivedKind& kind : derived_kinds())
    if (const auto at = known.find(kind.name); at != known.end()) {
      const ElementField& field = fields_[at->second];
      averages_.derive(stress, {field.named, field.components, {}}, kind.value);
    }
  stress_ = known.at(stress);
  error_ = fields_.size();
  fields_.push_back({{"ERROR", dimension::energy, "strain energy of the estimated error of the stress"}, {}, {}, {}, {}});
}

bool ElementFields::has(std::size_t field, const Model::Part& part) const {
  if (field == error_) return part.element->section() >= 0 && has(stress_, part);
  const std::vector<Field>& own = part.element->fields();
  return std::any_of(own.begin(), own.end(), [&](const Field& one) {
    return one.name == fields_[field].named.name && std::max<std::size_t>(1, one.components.size()) == fields_[field].width();
  });
}

void ElementFields::evaluate_own(const Configuration& c) {
  const Model& model = assembler_.model();
  std::vector<double> values;
  int evaluated = -1;
  for (const Use& use : uses_) {
    if (!assembler_.owns(use.part)) continue;
    const Model::Part& part = model.parts[static_cast<std::size_t>(use.part)];
    if (use.part != evaluated) {
      std::size_t size = 0;
      for (const Field& field : part.element->fields()) size += field.size(part.nodes.size());
      values.assign(size, 0.0);
      part.element->evaluate_fields(assembler_.view(use.part, c), values);
      evaluated = use.part;
    }
    ElementField& field = fields_[use.field];
    const auto own = std::span<const double>(values).subspan(use.first, use.places * field.width());
    double* row = field.rows.data() + static_cast<std::size_t>(use.part) * field.width();
    for (std::size_t place = 0; place < use.places; ++place)
      for (std::size_t k = 0; k < field.width(); ++k) row[k] += own[place * field.width() + k] / static_cast<double>(use.places);
    if (!field.place_parts.empty())
      std::copy(own.begin(), own.end(), field.places.begin() + static_cast<std::ptrdiff_t>(use.row * field.width()));
    if (use.averaged) averages_.add(field.named.name, part, own);
  }
}

void ElementFields::estimate_errors(const Configuration& c) {
  energies_.assign(2, 0.0);
  for (const int p : assembler_.own_parts()) {
    const Model::Part& part = assembler_.model().parts[static_cast<std::size_t>(p)];
    const std::span<const double> recovered = averages_.at_nodes(stress, part);
    if (recovered.empty()) continue;
    const StressEnergies found = part.element->stress_energies(assembler_.view(p, c), recovered);
    energies_[0] += found.stress;
    energies_[1] += found.difference;
    fields_[*error_].rows[static_cast<std::size_t>(p)] = found.difference;
  }
  MPI_Allreduce(MPI_IN_PLACE, energies_.data(), 2, MPI_DOUBLE, MPI_SUM, assembler_.comm());
}

std::optional<StressError> ElementFields::stress_error() const {
  if (energies_.empty()) return {};
  return StressError{energies_[0], energies_[1]};
}

void ElementFields::evaluate(const Configuration& c) {
  const Model& model = assembler_.model();
  // parts that other ranks evaluate are zero, and so is the sum until it is known who has the field
  for (ElementField& field : fields_) {
    field.rows.assign(model.parts.size() * field.width(), 0.0);
    field.places.assign(field.place_parts.size() * field.width(), 0.0);
  }
  averages_.clear();
  evaluate_own(c);
  if (error_) {
    averages_.finish(assembler_.comm());
    estimate_errors(c);
  }
  const bool root = assembler_.rank() == 0;
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    ElementField& field = fields_[f];
    for (std::vector<double>* all : {&field.rows, &field.places})
      MPI_Reduce(root ? MPI_IN_PLACE : all->data(), all->data(), static_cast<int>(all->size()), MPI_DOUBLE, MPI_SUM, 0,
                 assembler_.comm());
    for (std::size_t p = 0; p < model.parts.size(); ++p)
      if (!has(f, model.parts[p]))
        std::fill_n(field.rows.begin() + static_cast<std::ptrdiff_t>(p * field.width()), field.width(),
                    std::numeric_limits<double>::quiet_NaN());
  }
}

std::vector<Named> nodal_field_names(bool moves) {
  std::vector<Named> names;
  for (const NodalKind& kind : nodal_kinds())
    if (moves || !kind.of_motion) names.push_back(kind.named);
  return names;
}

std::vector<NodalField> nodal_fields(const Model& model, const Configuration& c, const std::vector<Reaction>& reactions,
                                     bool moves) {
  std::vector<const Reaction*> reaction_of(c.nodes.size(), nullptr);
  for (const Reaction& reaction : reactions) reaction_of[static_cast<std::size_t>(reaction.node)] = &reaction;
  const Reaction none;
  std::vector<NodalField> fields;
  for (const NodalKind& kind : nodal_kinds()) {
    if (kind.of_motion && !moves) continue;
    NodalField& field = fields.emplace_back(NodalField{kind.named, {}});
    field.rows.reserve(3 * (c.nodes.size() - 1));
    for (std::size_t i = 1; i < c.nodes.size(); ++i) {
      const Vec3 value = kind.value(model.nodes[i].x, c.nodes[i], reaction_of[i] ? *reaction_of[i] : none);
      field.rows.insert(field.rows.end(), value.data(), value.data() + 3);
    }
  }
  return fields;
}

}  // namespace engrane::observe
