// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/references.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace engrane::solve {

namespace {

/// Least reference of a residual, as a fraction of the largest load so far: a load that passes through zero could never be
/// balanced by itself.
constexpr double remembered = 1e-3;
/// Lever at which a node's forces count as moments, as a fraction of the distance to the nodes joined with it: a small moment
/// beside large forces need not balance better than they do.
constexpr double part_of_lever = 0.1;
/// Through the rounding of its position a node's forces make moments, and moments forces.
constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();

}  // namespace

References::References(const Assembler& assembler, double precision)
    : assembler_(assembler),
      precision_(precision),
      rounding_share_(rounding / precision),
      spans_(assembler.model().nodes.size(), 0.0),
      reach_(spans_.size(), 0.0),
      pairs_(spans_.size() + assembler.model().parts.size() + 1),
      largest_of_slot_(static_cast<std::size_t>(assembler.numbering().motion_slots()), 0.0) {
  find_spans();
  find_inner();
  find_sources();
  find_lengths();
}

void References::find_spans() {
  const Model& model = assembler_.model();
  const auto place = [&](int node) -> const Vec3& { return model.nodes[static_cast<std::size_t>(node)].x; };
  for (const Model::Part& part : model.parts)
    for (const int a : part.nodes)
      for (const int b : part.nodes) {
        // the ground has no position of its own
        if (a <= 0 || b <= 0) continue;
        double& span = spans_[static_cast<std::size_t>(a)];
        span = std::max(span, (place(a) - place(b)).norm());
      }
}

void References::find_inner() {
  const Model& model = assembler_.model();
  constexpr int none = -1, several = -2;
  std::vector<int> only(model.nodes.size(), none);
  for (std::size_t p = 0; p < model.parts.size(); ++p)
    for (const int node : model.parts[p].nodes) {
      int& found = only[static_cast<std::size_t>(node)];
      found = found == none || found == static_cast<int>(p) ? static_cast<int>(p) : several;
    }
  for (std::size_t i = 1; i < only.size(); ++i)
    if (only[i] >= 0) inner_.push_back({i, static_cast<std::size_t>(only[i])});
}

void References::find_sources() {
  const Model& model = assembler_.model();
  for (const Unknown& u : assembler_.numbering().unknowns()) {
    std::size_t pair = static_cast<std::size_t>(u.node);
    if (u.part >= 0) {
      // signals are of the size of some load, and parts without nodes of none
      const bool signal = u.signal || model.parts[static_cast<std::size_t>(u.part)].nodes.empty();
      pair = signal ? pairs_.size() - 1 : spans_.size() + static_cast<std::size_t>(u.part);
      if (signal && !u.multiplier) signals_.push_back(sources_.size());
    }
    sources_.push_back({pair, u.rotational()});
  }
  lengths_.assign(sources_.size(), 1.0);
  for (const std::size_t e : signals_) lengths_[e] = least_load;
  influence_.resize(signals_.size());
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const Layout& layout = model.parts[p].element->layout();
    if (layout.own_multipliers() == 0 && layout.scalars.empty()) continue;
    for (const Multiplier& m : layout.multipliers) turns_.push_back(m.dimension.length == 0);
    owners_.push_back({p, turns_.size()});
  }
}

void References::begin(const Configuration& c) {
  solved_force_ = std::max(solved_force_, last_force_);
  find_influence(c);
  // reference lengths need not follow every step
  const auto reach = [&](std::size_t i) { return std::max(spans_[i], c.nodes[i].x.norm()); };
  for (std::size_t i = 0; i < spans_.size(); ++i) {
    const double now = reach(i);
    if (now <= 1.5 * reach_[i] && now >= 0.5 * reach_[i]) continue;
    for (std::size_t k = 0; k < spans_.size(); ++k) reach_[k] = reach(k);
    find_lengths();
    return;
  }
}

void References::find_lengths() {
  const Model& model = assembler_.model();
  // a node that no element joins with another has no length of its own: that of the model is used
  const auto length_at = [&](int node) {
    const auto i = static_cast<std::size_t>(node);
    return spans_[i] > 0 ? reach_[i] : std::max(reach_[i], model.extent());
  };
  for (std::size_t e = 0; e < lengths_.size(); ++e) {
    const Unknown& u = assembler_.numbering().unknown(static_cast<int>(e));
    if (sources_[e].turns || std::binary_search(signals_.begin(), signals_.end(), e)) continue;
    double length = 0;
    if (u.part < 0)
      length = length_at(u.node);
    else
      for (const int node : model.parts[static_cast<std::size_t>(u.part)].nodes)
        if (node > 0) length = std::max(length, length_at(node));
    lengths_[e] = length > 0 ? length : model.extent();
  }
}

void References::find_influence(const Configuration& c) {
  const Numbering& numbering = assembler_.numbering();
  int evaluated = -1;
  std::span<const double> k;
  for (std::size_t s = 0; s < signals_.size(); ++s) {
    const Unknown& signal = numbering.unknown(static_cast<int>(signals_[s]));
    if (signal.part != evaluated) k = assembler_.element_tangent(signal.part, c, {1, 0, 0, 0}).k;
    evaluated = signal.part;
    influence_[s].clear();
    const auto slots = numbering.part_slots(signal.part);
    const auto column = static_cast<std::size_t>(std::find(slots.begin(), slots.end(), signal.slot) - slots.begin());
    for (std::size_t row = 0; row < slots.size(); ++row) {
      const int equation = numbering.equation(slots[row]);
      const double by = std::abs(k[row * slots.size() + column]);
      if (equation >= 0 && by > 0 && numbering.unknown(equation).node >= 0) influence_[s].emplace_back(equation, by);
    }
  }
}

void References::find_signals(const Configuration& c) {
  const Numbering& numbering = assembler_.numbering();
  const auto first = static_cast<int>(6 * assembler_.model().nodes.size());
  for (const std::size_t e : signals_) {
    const int scalar = numbering.unknown(static_cast<int>(e)).slot - first;
    lengths_[e] = std::max(lengths_[e], std::abs(c.scalars[static_cast<std::size_t>(scalar)]));
  }
}

double References::relative_change(int equation, double change) const {
  const Numbering& numbering = assembler_.numbering();
  const Unknown& u = numbering.unknown(equation);
  const double size = std::abs(change), displacement = size / length(equation);
  if (u.multiplier) {
    const double k = assembler_.scale()[static_cast<std::size_t>(u.slot - numbering.motion_slots())];
    return std::min(displacement, k * size / load(equation));
  }
  const auto signal = std::lower_bound(signals_.begin(), signals_.end(), static_cast<std::size_t>(equation));
  if (signal == signals_.end() || *signal != static_cast<std::size_t>(equation)) return displacement;
  double effect = 0;
  const auto& forces = influence_[static_cast<std::size_t>(signal - signals_.begin())];
  for (const auto& [force, by] : forces) effect = std::max(effect, by * size / load(force));
  return forces.empty() || effect > precision_ ? displacement : 0;
}
double References::peak(int equation) const {
  const Unknown& u = assembler_.numbering().unknown(equation);
  return std::max(peak_on(static_cast<std::size_t>(u.part), sources_[static_cast<std::size_t>(equation)].turns), load(equation));
}

double References::peak_on(std::size_t part, bool turns) const {
  double largest = 0;
  for (const int node : assembler_.model().parts[part].nodes)
    for (std::size_t k = turns ? 3 : 0, end = k + 3; k < end; ++k)
      largest = std::max(largest, largest_of_slot_[6 * static_cast<std::size_t>(node) + k]);
  return largest;
}

double References::leverage_on(std::size_t part) const {
  double largest = 0;
  for (const int node : assembler_.model().parts[part].nodes) {
    const auto i = static_cast<std::size_t>(node);
    for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, part_of_lever * spans_[i] * largest_of_slot_[6 * i + k]);
  }
  return largest;
}

void References::take(const Configuration& c, const std::vector<double>& carried) {
  const Model& model = assembler_.model();
  find_signals(c);
  Pair all;
  last_force_ = 0;
  for (std::size_t i = 1; i < model.nodes.size(); ++i) {
    Pair own;
    for (std::size_t k = 0; k < 6; ++k) {
      const std::size_t slot = 6 * i + k;
      const int equation = assembler_.numbering().equation(static_cast<int>(slot));
      if (equation < 0) continue;
      const double now = carried[static_cast<std::size_t>(equation)];
      double& largest = largest_of_slot_[slot];
      largest = std::max(largest, now);
      double& load = k < 3 ? own.force : own.moment;
      load = std::max({load, now, remembered * largest});
      if (k < 3) last_force_ = std::max(last_force_, now);
    }
    // forces have levers; moments make forces by rounding alone
    const double lever = std::max(part_of_lever * spans_[i], rounding_share_ * reach_[i]);
    const double by_moment = spans_[i] > 0 ? rounding_share_ * own.moment / spans_[i] : 0;
    at_node(static_cast<int>(i)) = {std::max(own.force, by_moment), std::max(own.moment, own.force * lever)};
    all = {std::max(all.force, own.force), std::max(all.moment, own.moment)};
  }
  all.force = all.moment = std::max(all.force, all.moment);
  everywhere() = all;
  // a node inside an element transmits no load: the element's other nodes give the reference
  for (const Inner& inner : inner_) {
    Pair& own = at_node(static_cast<int>(inner.node));
    for (const int node : model.parts[inner.part].nodes) {
      const Pair& other = at_node(node);
      own = {std::max(own.force, other.force), std::max(own.moment, other.moment)};
    }
  }
  // loads on an element's own unknowns cancel inside it: those of its nodes and multipliers are the reference
  std::size_t m = 0;
  for (const Owner& owner : owners_) {
    Pair of;
    for (; m < owner.end; ++m) {
      double& load = turns_[m] ? of.moment : of.force;
      load = std::max(load, std::abs(c.multipliers[m]));
    }
    for (const int node : model.parts[owner.part].nodes)
      of = {std::max(of.force, at_node(node).force), std::max(of.moment, at_node(node).moment)};
    at_part(owner.part) = of;
  }
}

bool References::remembers() const {
  return std::any_of(largest_of_slot_.begin(), largest_of_slot_.end(), [](double load) { return load != 0; });
}

void References::restore(std::vector<double> memory) {
  largest_of_slot_ = std::move(memory);
  last_force_ = 0;
}

void References::save(Snapshot& snapshot) const {
  snapshot.put("newton/largest", largest_of_slot_);
  snapshot.put("newton/reach", reach_);
  std::vector<double> loads;
  for (const Pair& pair : pairs_) loads.insert(loads.end(), {pair.force, pair.moment});
  snapshot.put("newton/loads", loads);
  std::vector<double> sizes;
  for (const std::size_t e : signals_) sizes.push_back(lengths_[e]);
  snapshot.put("newton/signals", sizes);
}

void References::load_memory(const Snapshot& snapshot) {
  const std::vector<double>&largest = snapshot.array("newton/largest"), &reach = snapshot.array("newton/reach");
  const std::vector<double>& loads = snapshot.array("newton/loads");
  if (largest.size() != largest_of_slot_.size() || reach.size() != reach_.size() || loads.size() < 2 * (spans_.size() + 1))
    throw std::out_of_range("the restart point has another number of nodes");
  largest_of_slot_ = largest;
  reach_ = reach;
  // Loads on nodes are the last parts (.CLM CHA), and the run that is continued may have had others. What a new one carries is
  // taken with the first residual.
  const std::size_t before = loads.size() / 2;
  for (std::size_t i = 0; i + 1 < std::min(before, pairs_.size()); ++i) pairs_[i] = {loads[2 * i], loads[2 * i + 1]};
  everywhere() = {loads[2 * before - 2], loads[2 * before - 1]};
  find_lengths();
  const std::vector<double>& sizes = snapshot.array("newton/signals");
  for (std::size_t i = 0; i < std::min(sizes.size(), signals_.size()); ++i) lengths_[signals_[i]] = sizes[i];
}

}  // namespace engrane::solve
