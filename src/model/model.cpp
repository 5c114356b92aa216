// SPDX-License-Identifier: BSD-3-Clause
#include "model/model.hpp"

#include <algorithm>

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

double Model::extent() const {
  if (nodes.size() < 2) return 1;
  Vec3 low = nodes[1].x, high = nodes[1].x;
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    low = low.cwiseMin(nodes[i].x);
    high = high.cwiseMax(nodes[i].x);
  }
  const double size = (high - low).norm();
  return size > 0 ? size : 1;
}

deck::Catalogue catalogue(const std::vector<ElementType>& types) {
  deck::Catalogue all;
  for (const deck::Schema& command : deck::general_commands()) all.commands.push_back(&command);
  // an element whose name is a command has records of its own, outside .MCE
  for (const ElementType& type : types) (type.schema.name.front() == '.' ? all.commands : all.elements).push_back(&type.schema);
  return all;
}

const Function* BuildContext::function(int id, std::string_view keyword) const {
  const auto it = functions.find(id);
  if (it != functions.end())
    return is_function_of_one_variable(it->second.get(), record.where(keyword), diagnostics) ? it->second.get() : nullptr;
  error(keyword, "function " + std::to_string(id) + " does not exist", "declare it with .FCT I " + std::to_string(id));
  return nullptr;
}

}  // namespace engrane
