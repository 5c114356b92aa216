// SPDX-License-Identifier: BSD-3-Clause
#include "app/largest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "output/table.hpp"

namespace engrane::app {

namespace {

constexpr const char* equivalent = "VON_MISES";

/// A largest value, and the row of its field that has it; −1: there is none.
struct Largest {
  double value = 0;
  std::ptrdiff_t row = -1;

  void take(double other, std::size_t at) {
    if (other > value || (row < 0 && !std::isnan(other))) *this = {other, static_cast<std::ptrdiff_t>(at)};
  }
};

Largest largest_of(const std::vector<double>& rows) {
  Largest found;
  for (std::size_t i = 0; i < rows.size(); ++i) found.take(rows[i], i);
  return found;
}

class Rows {
 public:
  explicit Rows(const Model& model) : model_(model) {}

  void add(const char* what, double value, const Named& named, const std::string& where, const Vec3& x) {
    using output::shown;
    table_.row({what, shown(value), model_.units.label(named.dimension), where, shown(x[0]), shown(x[1]), shown(x[2])});
  }
  void add_node(const char* what, double value, const Named& named, int node) {
    add(what, value, named, fmt::format("node {}", model_.node(node).id), model_.node(node).x);
  }
  std::string text() const { return table_.empty() ? "" : table_.text(); }

 private:
  using Align = output::Table::Align;
  const Model& model_;
  output::Table table_{
      {{"", Align::left}, {"largest"}, {"unit", Align::left}, {"at", Align::left}, {"reference x"}, {"y"}, {"z"}}};
};

void add_displacement(Rows& rows, const observe::Observer& observer) {
  for (const observe::NodalField& field : observer.fields()) {
    if (field.named.name != "displacement") continue;
    Largest found;
    for (std::size_t node = 0; 3 * node < field.rows.size(); ++node)
      found.take(Eigen::Map<const Vec3>(&field.rows[3 * node]).norm(), node);
    if (found.row >= 0) rows.add_node("displacement", found.value, field.named, static_cast<int>(found.row) + 1);
  }
}

/// At the points of the cells.
void add_stress(Rows& rows, const Model& model, const observe::Observer& observer) {
  const std::vector<observe::ElementField>& fields = observer.element_fields();
  const auto field = std::find_if(fields.begin(), fields.end(), [](const auto& one) { return one.named.name == equivalent; });
  if (field == fields.end()) return;
  const bool by_points = field->place_count > 0;
  const Largest found = largest_of(by_points ? field->places : field->rows);
  if (found.row < 0) return;
  const auto row = static_cast<std::size_t>(found.row);
  std::size_t part = row;
  std::string point;
  if (by_points) {
    const std::vector<int> parts = observer.place_parts(static_cast<std::size_t>(field - fields.begin()));
    part = static_cast<std::size_t>(parts[row]);
    const auto first = std::lower_bound(parts.begin(), parts.end(), parts[row]) - parts.begin();
    point = fmt::format(", point {}", found.row - first + 1);
  }
  const Model::Part& cell = model.parts[part];
  Vec3 middle = Vec3::Zero();
  for (const int node : cell.nodes) middle += model.node(node).x / static_cast<double>(cell.nodes.size());
  rows.add("von Mises, in cells", found.value, field->named,
           fmt::format("{} {}{}, about", cell.is_cell() ? "cell" : cell.type, cell.element->id(), point), middle);
}

void add_average(Rows& rows, const Model& model, const observe::Observer& observer) {
  for (const observe::AveragedField& field : observer.averages()) {
    if (field.named.name != equivalent) continue;
    const Largest found = largest_of(field.rows);
    if (found.row < 0) continue;
    const auto point = static_cast<std::size_t>(found.row), nodes = model.nodes.size() - 1;
    const int node = point < nodes ? static_cast<int>(point) + 1 : observer.points().copies()[point - nodes];
    rows.add_node("von Mises, averaged", found.value, field.named, node);
  }
}

}  // namespace

std::string describe_largest(const Model& model, const observe::Observer& observer) {
  if (!has_cells(model)) return {};
  Rows rows(model);
  add_displacement(rows, observer);
  add_stress(rows, model, observer);
  add_average(rows, model, observer);
  return rows.text();
}

}  // namespace engrane::app
