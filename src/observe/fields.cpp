// SPDX-License-Identifier: BSD-3-Clause
#include "observe/fields.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

#include "math/rotation.hpp"
#include "math/stress.hpp"

namespace engrane::observe {

namespace {

/// A kind of nodal field. To add one, add a row to the table.
struct NodalKind {
  Named named;
  bool of_motion;  ///< only for analyses with motion
  Vec3 (*value)(const Vec3& displacement, const NodeState& node, const Reaction& reaction);
};

const std::vector<NodalKind>& nodal_kinds() {
  static const std::vector<NodalKind> kinds = {
      {{"displacement", dimension::length, "displacement"},
       false,
       [](const Vec3& displacement, const NodeState&, const Reaction&) -> Vec3 { return displacement; }},
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

bool begins_with(const std::vector<std::string>& all, const std::vector<std::string>& first) {
  return first.empty() == all.empty() && first.size() <= all.size() && std::equal(first.begin(), first.end(), all.begin());
}

}  // namespace

/// Element field that is computed from the stress where that is averaged at nodes, or has more components than the element gives.
struct DerivedKind {
  const char* name;
  void (*value)(std::span<const double> stress, double* out);
};

namespace {

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
  const std::map<std::string, std::size_t> known = merge_declarations();
  // elements of a block share one vector of fields, so its address identifies the declarations
  std::map<std::pair<const std::vector<Field>*, std::size_t>, int> kinds;
  kind_of_part_.reserve(model.parts.size());
  for (const Model::Part& part : model.parts) {
    const std::vector<Field>& declared = part.element->fields();
    const auto [kind, is_new] = kinds.try_emplace({&declared, part.nodes.size()}, static_cast<int>(kinds_.size()));
    if (is_new) kinds_.push_back(make_kind(part, known));
    kind_of_part_.push_back(kind->second);
    for (const Use& use : kinds_[static_cast<std::size_t>(kind->second)].uses) fields_[use.field].place_count += use.places;
    for (const Field& field : declared)
      if (field.averaged) averages_.declare(field, fields_[known.at(field.name)].components, part);
  }
  // fields with one value per part need no second list
  for (std::size_t f = 0; f < fields_.size(); ++f)
    if (std::none_of(kinds_.begin(), kinds_.end(), [f](const Kind& kind) {
          return std::any_of(kind.uses.begin(), kind.uses.end(),
                             [f](const Use& use) { return use.field == f && use.places > 1; });
        }))
      fields_[f].place_count = 0;
  if (averages_.empty()) return;
  for (const DerivedKind& kind : derived_kinds())
    if (const auto at = known.find(kind.name); at != known.end()) {
      const ElementField& field = fields_[at->second];
      averages_.derive(stress, {field.named, field.components, {}}, kind.value);
    }
  stress_ = known.at(stress);
  error_ = fields_.size();
  fields_.push_back({{"ERROR", dimension::energy, "strain energy of the estimated error of the stress"}, {}, {}, {}, 0});
}

std::map<std::string, std::size_t> ElementFields::merge_declarations() {
  std::map<std::string, std::size_t> known;
  std::map<std::string, std::size_t> components;  // of all fields of the elements that declare a field, the most so far
  const std::vector<Field>* last = nullptr;
  for (const Model::Part& part : assembler_.model().parts) {
    const std::vector<Field>& declared = part.element->fields();
    if (std::exchange(last, &declared) == &declared) continue;
    std::size_t all = 0;
    for (const Field& field : declared) all += field.width();
    for (const Field& field : declared) {
      const auto [at, is_new] = known.try_emplace(field.name, fields_.size());
      if (is_new) fields_.emplace_back();
      if (std::size_t& most = components[field.name]; all > most) {
        most = all;
        fields_[at->second] = {field, field.components, {}, {}, 0};
      }
    }
  }
  return known;
}

ElementFields::Kind ElementFields::make_kind(const Model::Part& part, const std::map<std::string, std::size_t>& known) {
  Kind kind;
  std::optional<Use> of_stress;
  for (const Field& field : part.element->fields()) {
    const std::size_t at = known.at(field.name), size = field.size(part.nodes.size()), width = field.width();
    const auto derived = std::find_if(derived_kinds().begin(), derived_kinds().end(),
                                      [&](const DerivedKind& one) { return one.name == field.name; });
    if (begins_with(fields_[at].components, field.components)) {
      kind.uses.push_back({at, kind.size, size / width, field.averaged, width});
      if (field.name == stress) of_stress = kind.uses.back();
    } else if (derived != derived_kinds().end() && of_stress) {
      kind.uses.push_back({at, of_stress->first, of_stress->places, false, of_stress->width, &*derived});
    }
    kind.size += size;
  }
  return kind;
}

std::span<const double> ElementFields::rows_of(const Use& use, std::span<const double> values) {
  const std::size_t width = fields_[use.field].width();
  const auto own = values.subspan(use.first, use.places * use.width);
  if (use.width == width && !use.derived) return own;
  scratch_.assign(use.places * width, 0.0);
  for (std::size_t place = 0; place < use.places; ++place) {
    const auto given = own.subspan(place * use.width, use.width);
    double* row = scratch_.data() + place * width;
    if (!use.derived) {
      std::copy(given.begin(), given.end(), row);
      continue;
    }
    std::array<double, 6> all{};  // the components that a plane stress lacks are zero
    std::copy(given.begin(), given.end(), all.begin());
    use.derived->value(all, row);
  }
  return scratch_;
}

std::vector<int> ElementFields::place_parts(std::size_t field) const {
  std::vector<int> parts;
  if (fields_[field].place_count == 0) return parts;
  parts.reserve(fields_[field].place_count);
  for (std::size_t p = 0; p < kind_of_part_.size(); ++p)
    for (const Use& use : kinds_[static_cast<std::size_t>(kind_of_part_[p])].uses)
      if (use.field == field) parts.insert(parts.end(), use.places, static_cast<int>(p));
  return parts;
}

bool ElementFields::has(std::size_t field, std::size_t part) const {
  const auto declares = [&](std::size_t wanted) {
    const std::vector<Use>& uses = kinds_[static_cast<std::size_t>(kind_of_part_[part])].uses;
    return std::any_of(uses.begin(), uses.end(), [wanted](const Use& use) { return use.field == wanted; });
  };
  if (field != error_) return declares(field);
  return assembler_.model().parts[part].element->section() >= 0 && declares(stress_);
}

void ElementFields::evaluate_own(const Configuration& c) {
  const Model& model = assembler_.model();
  std::vector<double> values;
  std::vector<std::size_t> next(fields_.size(), 0);  // first row of the next part among the places of each field
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const Model::Part& part = model.parts[p];
    const Kind& kind = kinds_[static_cast<std::size_t>(kind_of_part_[p])];
    const bool is_own = !kind.uses.empty() && assembler_.owns(static_cast<int>(p));
    if (is_own) {
      values.assign(kind.size, 0.0);
      part.element->evaluate_fields(assembler_.view(static_cast<int>(p), c), values);
    }
    for (const Use& use : kind.uses) {
      const std::size_t first = std::exchange(next[use.field], next[use.field] + use.places);
      if (!is_own) continue;
      ElementField& field = fields_[use.field];
      const std::span<const double> own = rows_of(use, values);
      double* row = field.rows.data() + p * field.width();
      for (std::size_t place = 0; place < use.places; ++place)
        for (std::size_t k = 0; k < field.width(); ++k)
          row[k] += own[place * field.width() + k] / static_cast<double>(use.places);
      if (field.place_count > 0)
        std::copy(own.begin(), own.end(), field.places.begin() + static_cast<std::ptrdiff_t>(first * field.width()));
      if (use.averaged) averages_.add(field.named.name, part, own);
    }
  }
}

void ElementFields::estimate_errors(const Configuration& c) {
  energies_.assign(2, 0.0);
  for (const int p : assembler_.own_parts()) {
    const Model::Part& part = assembler_.model().part(p);
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
  // zero, so that summing over ranks collects the values; parts without the field become NaN below
  for (ElementField& field : fields_) {
    field.rows.assign(model.parts.size() * field.width(), 0.0);
    field.places.assign(field.place_count * field.width(), 0.0);
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
      if (!has(f, p))
        std::fill_n(field.rows.begin() + static_cast<std::ptrdiff_t>(p * field.width()), field.width(),
                    std::numeric_limits<double>::quiet_NaN());
  }
}

bool is_averaged(const Field& field) {
  const auto& kinds = derived_kinds();
  return field.averaged || std::any_of(kinds.begin(), kinds.end(), [&](const auto& kind) { return field.name == kind.name; });
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
      const Vec3 displacement = c.nodes[i].x - model.nodes[i].x + Eigen::Map<const Vec3>(&c.remainders[6 * i]);
      const Vec3 value = kind.value(displacement, c.nodes[i], reaction_of[i] ? *reaction_of[i] : none);
      field.rows.insert(field.rows.end(), value.data(), value.data() + 3);
    }
  }
  return fields;
}

}  // namespace engrane::observe
