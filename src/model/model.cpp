// SPDX-License-Identifier: BSD-3-Clause
#include "model/model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "model/jump.hpp"
#include "model/masses.hpp"
#include "model/user_function.hpp"

namespace engrane {

int Model::node_index(int id) const {
  const auto it = std::lower_bound(nodes.begin(), nodes.end(), id, [](const Node& n, int i) { return n.id < i; });
  return it != nodes.end() && it->id == id ? static_cast<int>(it - nodes.begin()) : -1;
}

Vec3 Model::gravity_at(double time) const {
  Vec3 g = Vec3::Zero();
  for (const Gravity& part : gravity) g += part.acceleration * (part.function ? part.function->at(time).f : 1.0);
  return g;
}

std::optional<VaryingGravity> Model::varying_gravity_at(double time) const {
  std::optional<VaryingGravity> sum;
  for (const Gravity& part : gravity) {
    if (!part.function) continue;
    if (!sum) sum.emplace();
    const auto factor = part.function->at(time);
    sum->acceleration += part.acceleration * factor.f;
    sum->rate += part.acceleration * factor.d1;
  }
  return sum;
}

namespace {

/// A table or a spline with more of them is a measured curve, not smoother between them. Formulas and periodic functions, such as
/// those that switch a motor on and off, mean each of theirs.
constexpr std::size_t most_joints = 100, most_meant = 10'000;

std::size_t most_joints_of(const Function& function) {
  return function.formula() || function.period() > 0 ? most_meant : most_joints;
}

/// Nodes closer than this fraction of their distance from the origin coincide: computed coordinates differ in their last
/// digits.
constexpr double rounding = 1e-12;

/// Twice the largest distance of a node that elements use from the mean of them all, excluding the ground; 0 if it is only
/// rounding. It does not depend on the direction of the axes.
double size_of_nodes(const Model& model) {
  const auto of_each = [&model](auto&& with) {
    for (const Model::Part& part : model.parts)
      for (const int node : part.nodes)
        if (node > 0) with(model.node(node).x);
  };
  // The mean is taken from one of the nodes, so that a model far from the origin loses no digits in the sum.
  double count = 0, away = 0, farthest = 0;
  Vec3 one = Vec3::Zero(), sum = Vec3::Zero();
  of_each([&](const Vec3& x) {
    if (count == 0) one = x;
    ++count;
    sum += x - one;
    away = std::max(away, x.norm());
  });
  const Vec3 mean = sum / std::max(count, 1.0);
  of_each([&](const Vec3& x) { farthest = std::max(farthest, (x - one - mean).norm()); });
  return 2 * farthest > rounding * away ? 2 * farthest : 0;
}

/// The lengths known to elements.
struct KnownLengths {
  double largest = 0;                                      ///< of sizes; 0 if there is none
  double bound = std::numeric_limits<double>::infinity();  ///< the least bound that is not zero
};

KnownLengths known_lengths(const Model& model) {
  KnownLengths known;
  for (const Model::Part& part : model.parts) {
    known.largest = std::max(known.largest, radius_of_gyration(model, part));
    for (const Derived& d : part.element->derived()) {
      const double length = std::abs(d.value);
      if (d.dimension != dimension::length || !std::isfinite(length)) continue;
      if (!d.bound)
        known.largest = std::max(known.largest, length);
      else if (length > 0)
        known.bound = std::min(known.bound, length);
    }
  }
  return known;
}

}  // namespace

std::vector<double> Model::joints(double from, double to) const {
  std::set<double> all;
  for (const Function* function : of_time) {
    std::vector<double> found = function->joints(from, to, most_joints_of(*function));
    // a long spline still has the corners at its ends
    if (found.empty()) found = function->corners(from, to, most_joints_of(*function));
    all.insert(found.begin(), found.end());
  }
  return {all.begin(), all.end()};
}

std::vector<double> Model::corners(double from, double to) const {
  std::set<double> all;
  for (const Function* function : of_time) {
    const std::vector<double> found = function->corners(from, to, most_joints_of(*function));
    all.insert(found.begin(), found.end());
  }
  return {all.begin(), all.end()};
}

bool Model::jumps_at(double time) const {
  const double just_before = number_before(time);
  return std::any_of(of_time.begin(), of_time.end(), [&](const Function* function) {
    const Function::Jet before = function->at(just_before), after = function->at(time);
    return jumps({before.f, before.d1}, {after.f, after.d1}, time - just_before);
  });
}

void Model::measure() {
  extent_ = size_of_nodes(*this);
  if (extent_ > 0) return;
  const KnownLengths known = known_lengths(*this);
  // A bound can only tell that motions are small. An unreachable one thus has no effect.
  extent_ = known.largest > 0 ? known.largest : std::min(1.0, known.bound);
}

bool has_cells(const Model& model) {
  return std::any_of(model.parts.begin(), model.parts.end(),
                     [](const Model::Part& part) { return part.element->cell_shape() != CellShape::none || part.is_cell(); });
}

std::string parameters_json(const Model::Part& part) {
  const auto* load = part.record->get<deck::LoadCard>();
  if (!load || load->nodes.size() + load->groups.size() < 2) return deck::record_json(*part.record);
  deck::LoadCard here;
  here.nodes = part.element->layout().nodes;
  here.components = load->components;
  here.values = load->values;
  here.function = load->function;
  deck::Record record;
  record.schema = part.record->schema;
  record.id = part.record->id;
  record.data = std::move(here);
  return deck::record_json(record);
}

deck::Catalogue catalogue(const std::vector<ElementType>& types) {
  deck::Catalogue all;
  for (const deck::Schema& command : deck::general_commands()) all.commands.push_back(&command);
  // an element whose name is a command has its own records, outside .MCE
  for (const ElementType& type : types) (type.schema.name.front() == '.' ? all.commands : all.elements).push_back(&type.schema);
  return all;
}

const Function* BuildContext::function(int id, std::string_view keyword) const {
  const auto it = functions.find(id);
  if (it != functions.end())
    return is_function_of_one_variable(it->second.get(), record.where(keyword), diagnostics) ? it->second.get() : nullptr;
  diagnostics.missing(".FCT", record.where(keyword), "function " + std::to_string(id) + " does not exist",
                      "declare it with .FCT I " + std::to_string(id));
  return nullptr;
}

const Function* BuildContext::function_of_time(int id, std::string_view keyword) const {
  const Function* found = function(id, keyword);
  if (found && of_time) of_time->insert(found);
  return found;
}

}  // namespace engrane
