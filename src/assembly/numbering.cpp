// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/numbering.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace engrane {

namespace {

/// Measure of a constraint, or of the force conjugate to a scalar, from the dimension of the multiplier or scalar.
Measure measure_of(const Named& named, bool multiplier) {
  const bool angular = named.dimension.length == 0;
  if (multiplier) return angular ? Measure::angle : Measure::length;
  return angular ? Measure::moment : Measure::force;
}

}  // namespace

Numbering::Numbering(const Model& model, Partition partition) : model_(model), partition_(std::move(partition)) {
  const auto node_slots = 6 * model.nodes.size();
  std::vector<bool> used(node_slots, false);
  for (const Model::Part& part : model.parts) {
    const Layout& layout = part.element->layout();
    for (std::size_t i = 0; i < part.nodes.size(); ++i) {
      const auto node = static_cast<std::size_t>(part.nodes[i]);
      if (node == 0) continue;
      for (int c = 0; c < 6; ++c)
        if (layout.has(i, c)) used[6 * node + static_cast<std::size_t>(c)] = true;
    }
    scalars_ += static_cast<int>(layout.scalars.size());
    multipliers_ += static_cast<int>(layout.own_multipliers());
  }
  for (const Support& s : model.supports) used[static_cast<std::size_t>(6 * s.node + s.component)] = false;

  for (std::size_t slot = 0; model.plane.active() && slot < node_slots; ++slot)
    if (model.plane.leaves_out(static_cast<int>(slot % 6))) used[slot] = false;

  motion_slots_ = static_cast<int>(node_slots) + scalars_;
  equation_.assign(static_cast<std::size_t>(motion_slots_ + multipliers_), -1);
  const auto add = [this](Unknown u) {
    equation_[static_cast<std::size_t>(u.slot)] = equations();
    unknowns_.push_back(u);
  };
  // nodes first, then each element's own unknowns, so that an equation number roughly tells where the equation belongs
  for (std::size_t slot = 0; slot < node_slots; ++slot)
    if (used[slot]) {
      const int c = static_cast<int>(slot % 6);
      add({static_cast<int>(slot), -1, static_cast<int>(slot / 6), c, false, false, c < 3 ? Measure::force : Measure::moment});
    }
  int scalar = 0, multiplier = 0;
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const Layout& layout = model.parts[p].element->layout();
    // shared multipliers are those of the last element that has its own
    const int shared = static_cast<int>(layout.multipliers.size() - layout.own_multipliers());
    parts_.push_back({part_slots_.size(), scalar, multiplier - shared, history_});
    for (std::size_t i = 0; i < layout.needs.size(); ++i)
      for (int c = 0; c < 6; ++c)
        if (layout.has(i, c)) part_slots_.push_back(6 * model.parts[p].nodes[i] + c);
    for (std::size_t i = 0; i < layout.scalars.size(); ++i) {
      const int slot = static_cast<int>(node_slots) + scalar++;
      part_slots_.push_back(slot);
      add({slot, static_cast<int>(p), -1, static_cast<int>(i), false, layout.scalars[i].signal,
           measure_of(layout.scalars[i], false)});
    }
    for (int m = multiplier - shared; m < multiplier; ++m) part_slots_.push_back(motion_slots_ + m);
    for (std::size_t i = 0; i < layout.own_multipliers(); ++i) {
      const int slot = motion_slots_ + multiplier;
      part_slots_.push_back(slot);
      const Unknown unknown{
          slot, static_cast<int>(p), -1, static_cast<int>(i), true, false, measure_of(layout.multipliers[i], true)};
      if (model.plane.leaves_out_multiplier(multiplier++))
        left_out_.push_back(unknown);
      else
        add(unknown);
    }
    history_ += layout.history;
  }
  parts_.push_back({part_slots_.size(), scalar, multiplier, history_});
  evaluated_ = partition_.own();
  end_row_ = equations();
  if (partition_.ranks() == 1) return;
  order_by_ranks();
}

void Numbering::order_by_ranks() {
  std::vector<int> of_nodes(model_.nodes.size(), -1);
  for (std::size_t p = 0; p < model_.parts.size(); ++p)
    for (const int node : model_.parts[p].nodes)
      if (node >= 0 && of_nodes[static_cast<std::size_t>(node)] < 0)
        of_nodes[static_cast<std::size_t>(node)] = partition_.owner(static_cast<int>(p));
  const auto owner = [&](const Unknown& u) {
    return u.part < 0 ? of_nodes[static_cast<std::size_t>(u.node)] : partition_.owner(u.part);
  };
  std::stable_sort(unknowns_.begin(), unknowns_.end(),
                   [&](const Unknown& one, const Unknown& other) { return owner(one) < owner(other); });
  for (std::size_t e = 0; e < unknowns_.size(); ++e) equation_[static_cast<std::size_t>(unknowns_[e].slot)] = static_cast<int>(e);
  std::vector<int> row_end(static_cast<std::size_t>(partition_.ranks()), 0);
  for (std::size_t e = 0; e < unknowns_.size(); ++e)
    row_end[static_cast<std::size_t>(owner(unknowns_[e]))] = static_cast<int>(e) + 1;
  for (std::size_t r = 1; r < row_end.size(); ++r) row_end[r] = std::max(row_end[r], row_end[r - 1]);
  const auto rank = static_cast<std::size_t>(partition_.rank());
  first_row_ = rank > 0 ? row_end[rank - 1] : 0;
  end_row_ = row_end[rank];
  find_ghosts(row_end);
}

void Numbering::find_ghosts(const std::vector<int>& row_end) {
  for (int p = 0; p < parts(); ++p) {
    const auto rank = static_cast<std::size_t>(partition_.owner(p));
    const int first = rank > 0 ? row_end[rank - 1] : 0, end = row_end[rank];
    bool shared = false, ours = false;
    for (const int slot : part_slots(p)) {
      const int e = equation(slot);
      if (e < 0 || (e >= first && e < end)) continue;
      shared = true;
      ours = ours || is_own(e);
    }
    if (shared) ++shared_parts_;
    if (ours) evaluated_.push_back(p);
  }
}

const Unknown& Numbering::multiplier(int index) const {
  const int slot = motion_slots_ + index, of = equation(slot);
  if (of >= 0) return unknown(of);
  return *std::lower_bound(left_out_.begin(), left_out_.end(), slot, [](const Unknown& u, int s) { return u.slot < s; });
}

Configuration Numbering::reference_configuration(double time) const {
  Configuration c;
  c.time = time;
  c.nodes.resize(model_.nodes.size());
  for (std::size_t i = 0; i < model_.nodes.size(); ++i) c.nodes[i].x = model_.nodes[i].x;
  c.scalars.assign(static_cast<std::size_t>(scalars_), 0);
  c.scalar_rates = c.scalar_accelerations = c.scalars;
  c.remainders.assign(static_cast<std::size_t>(motion_slots()), 0);
  c.multipliers.assign(static_cast<std::size_t>(multipliers_), 0);
  c.history.assign(static_cast<std::size_t>(history_), 0);
  for (std::size_t p = 0; p < model_.parts.size(); ++p) {
    const Layout& layout = model_.parts[p].element->layout();
    model_.parts[p].element->start(
        std::span(c.scalars).subspan(static_cast<std::size_t>(parts_[p].scalar), layout.scalars.size()),
        std::span(c.history).subspan(static_cast<std::size_t>(parts_[p].history), static_cast<std::size_t>(layout.history)));
  }
  return c;
}

const char* component_name(int component) {
  static constexpr const char* names[] = {"x", "y", "z", "rx", "ry", "rz"};
  return names[component];
}

std::string Numbering::describe(int equation) const {
  const Unknown& u = unknown(equation);
  if (u.part < 0) return fmt::format("node {} ({})", model_.node(u.node).id, component_name(u.item));
  const Model::Part& part = model_.part(u.part);
  const Layout& layout = part.element->layout();
  const auto item = static_cast<std::size_t>(u.item);
  const Named& named =
      u.multiplier ? static_cast<const Named&>(layout.multipliers[item]) : static_cast<const Named&>(layout.scalars[item]);
  return fmt::format("{} ({})", part.name(), named.name);
}

}  // namespace engrane
