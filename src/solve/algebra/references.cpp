// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/references.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace engrane::solve {

namespace {

/// Share of the largest load so far that a residual is at least compared with: a load that passes through zero could never be
/// balanced by itself.
constexpr double remembered = 1e-3;
/// Forces of a node make moments of its rotations by rounding of lengths, and moments forces.
constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
bool is_rotational(Measure m) { return m == Measure::moment || m == Measure::angle; }

}  // namespace

References::References(const Assembler& assembler, double precision)
    : assembler_(assembler),
      rounding_share_(rounding / precision),
      at_node_(assembler.model().nodes.size()),
      at_part_(assembler.model().parts.size()),
      largest_of_slot_(static_cast<std::size_t>(assembler.numbering().motion_slots()), 0.0) {
  find_lengths();
}

void References::find_lengths() {
  const Model& model = assembler_.model();
  span_.assign(model.nodes.size(), 0.0);
  place_.assign(model.nodes.size(), 0.0);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) place_[i] = model.nodes[i].x.norm();
  for (const Model::Part& part : model.parts)
    for (const int a : part.nodes)
      for (const int b : part.nodes) {
        // the ground is no place but what holds others
        if (a <= 0 || b <= 0) continue;
        double& span = span_[static_cast<std::size_t>(a)];
        span = std::max(span, (model.nodes[static_cast<std::size_t>(a)].x - model.nodes[static_cast<std::size_t>(b)].x).norm());
      }
  // where nothing tells a length, that of the model
  for (std::size_t i = 0; i < span_.size(); ++i)
    if (span_[i] == 0 && place_[i] == 0) span_[i] = model.extent();
}

void References::take(const Configuration& c, const std::vector<double>& carried) {
  const Model& model = assembler_.model();
  const Numbering& numbering = assembler_.numbering();
  for (std::size_t slot = 0; slot < carried.size(); ++slot)
    largest_of_slot_[slot] = std::max(largest_of_slot_[slot], carried[slot]);
  everywhere_ = {};
  const auto reference = [&](std::size_t slot) { return std::max(carried[slot], remembered * largest_of_slot_[slot]); };
  for (std::size_t i = 1; i < model.nodes.size(); ++i) {
    Pair& at = at_node_[i];
    at = {};
    for (std::size_t k = 0; k < 3; ++k) {
      at.force = std::max(at.force, reference(6 * i + k));
      at.moment = std::max(at.moment, reference(6 * i + 3 + k));
    }
    place_[i] = c.nodes[i].x.norm();
    const double length = std::max(span_[i], place_[i]);
    const Pair own = at;
    at.moment = std::max(own.moment, rounding_share_ * own.force * length);
    at.force = std::max(own.force, rounding_share_ * own.moment / length);
    everywhere_[Measure::force] = std::max(everywhere_[Measure::force], own.force);
    everywhere_[Measure::moment] = std::max(everywhere_[Measure::moment], own.moment);
  }
  // loads of an element's own unknowns cancel inside it: those of its nodes and multipliers tell their size
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    Pair& at = at_part_[p];
    at = {};
    const Layout& layout = model.parts[p].element->layout();
    if (layout.multipliers.empty() && layout.scalars.empty()) continue;
    const auto first = static_cast<std::size_t>(numbering.multiplier_begin(static_cast<int>(p)));
    for (std::size_t m = 0; m < layout.multipliers.size(); ++m) {
      const bool turns = layout.multipliers[m].dimension.length == 0;
      double& load = turns ? at.moment : at.force;
      load = std::max(load, std::abs(c.multipliers[first + m]));
    }
    for (const int node : model.parts[p].nodes) {
      at.force = std::max(at.force, at_node_[static_cast<std::size_t>(node)].force);
      at.moment = std::max(at.moment, at_node_[static_cast<std::size_t>(node)].moment);
    }
  }
  find_largest();
}

void References::find_largest() {
  largest_ = {};
  const std::size_t nodes = at_node_.size();
  for (std::size_t slot = 6; slot < 6 * nodes; ++slot) {
    double& largest = largest_[slot % 6 < 3 ? Measure::force : Measure::moment];
    largest = std::max(largest, largest_of_slot_[slot]);
  }
}

double References::load(const Unknown& u) const {
  const bool turns = is_rotational(u.measure);
  const double all = std::max(everywhere_[turns ? Measure::moment : Measure::force],
                              remembered * largest_[turns ? Measure::moment : Measure::force]);
  double own = 0;
  if (u.part < 0)
    own = at_node_[static_cast<std::size_t>(u.node)].of(turns);
  else if (u.first_order || assembler_.model().parts[static_cast<std::size_t>(u.part)].nodes.empty())
    own = std::max(all, everywhere_[turns ? Measure::force : Measure::moment]);  // a signal is of no unit
  else
    own = at_part_[static_cast<std::size_t>(u.part)].of(turns);
  return std::max(own, std::numeric_limits<double>::min());
}

double References::length(const Unknown& u) const {
  if (is_rotational(u.measure)) return 1;
  double length = 0;
  if (u.part < 0)
    length = std::max(span_[static_cast<std::size_t>(u.node)], place_[static_cast<std::size_t>(u.node)]);
  else
    for (const int node : assembler_.model().parts[static_cast<std::size_t>(u.part)].nodes)
      if (node > 0) length = std::max({length, span_[static_cast<std::size_t>(node)], place_[static_cast<std::size_t>(node)]});
  return length > 0 ? length : assembler_.model().extent();
}

void References::restore(std::vector<double> memory) { largest_of_slot_ = std::move(memory); }

void References::save(Snapshot& snapshot) const { snapshot.put("newton/largest", largest_of_slot_); }

void References::load_memory(const Snapshot& snapshot) {
  const std::vector<double>& saved = snapshot.array("newton/largest");
  if (saved.size() == largest_of_slot_.size()) largest_of_slot_ = saved;
}

}  // namespace engrane::solve
