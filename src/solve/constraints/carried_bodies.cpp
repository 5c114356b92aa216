// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/carried_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include "solve/constraints/start.hpp"

namespace engrane::solve {

namespace {

/// Of a body that moves as one few nodes, near to its axis, move by less than the first part of the fastest one.
constexpr double left_behind = 0.03, most_behind = 0.25;

std::vector<Body> bodies_of(const Model& model) {
  std::vector<int> first(model.nodes.size());  // for each node one of its body, and in the end the first one
  std::iota(first.begin(), first.end(), 0);
  const auto root = [&first](int node) {
    const auto above = [&first](int of) -> int& { return first[static_cast<std::size_t>(of)]; };
    while (above(node) != node) node = above(node) = above(above(node));
    return node;
  };
  const auto for_each_piece = [&model](auto&& use) {
    for (std::size_t p = 0; p < model.parts.size(); ++p)
      if (const Element& element = *model.parts[p].element; element.keeps_shape() || element.cell_shape() != CellShape::none)
        use(static_cast<int>(p), model.parts[p].nodes);
  };
  for_each_piece([&](int, const std::vector<int>& nodes) {
    for (const int node : nodes) {
      const int one = root(nodes.front()), other = root(node);
      first[static_cast<std::size_t>(std::max(one, other))] = std::min(one, other);
    }
  });
  std::map<int, Body> bodies;
  for_each_piece([&](int part, const std::vector<int>& nodes) {
    Body& body = bodies[root(nodes.front())];
    body.parts.push_back(part);
    body.keeps_shape = body.keeps_shape && model.part(part).element->keeps_shape();
  });
  for (std::size_t n = 1; n < first.size(); ++n)
    if (const auto body = bodies.find(root(static_cast<int>(n))); body != bodies.end())
      body->second.nodes.push_back(static_cast<int>(n));
  std::vector<Body> all;
  for (auto& [_, body] : bodies) all.push_back(std::move(body));
  return all;
}

}  // namespace

CarriedBodies::CarriedBodies(const Assembler& assembler, Assembler::Metric metric, bool velocity, std::span<const double> moved,
                             double least)
    : assembler_(assembler) {
  if (std::all_of(moved.begin(), moved.end(), [least](double move) { return move <= least; })) return;
  const Model& model = assembler.model();
  std::vector<bool> given(model.nodes.size(), false);
  for (const InitialValue& value : model.initial)
    if (value.velocity == velocity) given[static_cast<std::size_t>(value.node)] = true;
  const auto move = [&](int node) { return moved[static_cast<std::size_t>(node)]; };
  for (Body& body : bodies_of(model)) {
    const int farthest = *std::max_element(body.nodes.begin(), body.nodes.end(), [&](int a, int b) { return move(a) < move(b); });
    if (move(farthest) <= least) continue;
    const bool has_own =
        std::any_of(body.nodes.begin(), body.nodes.end(), [&](int node) { return given[static_cast<std::size_t>(node)]; });
    if (body.keeps_shape && !has_own) {
      const double weight = this->weight(body, metric);
      if (weight == 0) continue;
      give_.resize(model.parts.size(), 0.0);
      for (const int part : body.parts) give_[static_cast<std::size_t>(part)] = weight;
      bodies_.push_back(std::move(body));
      continue;
    }
    const auto behind =
        std::count_if(body.nodes.begin(), body.nodes.end(), [&](int node) { return move(node) < left_behind * move(farthest); });
    if (static_cast<double>(behind) > most_behind * static_cast<double>(body.nodes.size()))
      torn_.push_back({farthest, static_cast<int>(body.nodes.size()), static_cast<int>(behind)});
  }
}

double CarriedBodies::weight(const Body& body, Assembler::Metric metric) const {
  constexpr double much = 1e8;
  const Numbering& numbering = assembler_.numbering();
  const Configuration c = numbering.reference_configuration(0);
  const double square = assembler_.model().extent() * assembler_.model().extent();
  const auto rotations = static_cast<int>(6 * c.nodes.size());
  double stiffness = 0, inertia = 0;
  for (const int part : body.parts) {
    const auto slots = numbering.part_slots(part);
    const std::size_t n = slots.size();
    const auto trace = [&](std::span<const double> k) {  // of translations, and of rotations as if at the ends of the model
      double sum = 0;
      for (std::size_t i = 0; i < n; ++i)
        if (slots[i] < rotations) sum += k[i * n + i] / (slots[i] % 6 < 3 ? 1.0 : square);
      return sum;
    };
    stiffness += trace(assembler_.element_tangent(part, c, {1, 0, 0, 0}).k);
    inertia += metric == Assembler::Metric::geometric ? static_cast<double>(n) / square
                                                      : trace(assembler_.element_tangent(part, c, {0, 0, 1, 0}).k);
  }
  return stiffness > 0 ? much * inertia / stiffness : 0;
}

bool CarriedBodies::stiffen() {
  constexpr double more = 100, most = 1e4;
  if (stiffened_ >= most) return false;
  stiffened_ *= more;
  for (double& weight : give_) weight *= more;
  return true;
}

template <class Forces>
std::vector<double> CarriedBodies::sum(Forces&& forces) const {
  std::vector<double> by_slot(static_cast<std::size_t>(assembler_.numbering().motion_slots()), 0.0);
  const int motion = assembler_.numbering().motion_slots();
  for (const Body& body : bodies_)
    for (const int part : body.parts) {
      const auto slots = assembler_.numbering().part_slots(part);
      const std::span<const double> of_part = forces(part, slots);
      for (std::size_t i = 0; i < slots.size() && slots[i] < motion; ++i)  // those of multipliers are last
        by_slot[static_cast<std::size_t>(slots[i])] -= give_[static_cast<std::size_t>(part)] * of_part[i];
    }
  return by_slot;
}

std::vector<double> CarriedBodies::resistance(const Configuration& c, std::span<const double> rates) const {
  const int motion = assembler_.numbering().motion_slots();
  std::vector<double> product;
  return sum([&](int part, std::span<const int> slots) {
    const std::span<const double> k = assembler_.element_tangent(part, c, {1, 0, 0, 0}).k;
    product.assign(slots.size(), 0.0);
    for (std::size_t i = 0; i < slots.size(); ++i)
      for (std::size_t j = 0; j < slots.size() && slots[j] < motion; ++j)
        product[i] += k[i * slots.size() + j] * rates[static_cast<std::size_t>(slots[j])];
    return std::span<const double>(product);
  });
}

double CarriedBodies::fastest(std::span<const double> rates) const {
  double most = 0;
  for (const Body& body : bodies_)
    for (const int node : body.nodes)
      for (std::size_t k = 0; k < 3; ++k) most = std::max(most, std::abs(rates[6 * static_cast<std::size_t>(node) + k]));
  return most;
}

std::vector<double> CarriedBodies::pull(const Configuration& c) const {
  Configuration still = c;
  for (NodeState& node : still.nodes) node.v = node.W = node.a = node.A = Vec3::Zero();
  std::vector<double> force;
  return sum([&](int part, std::span<const int> slots) {
    State state = assembler_.view(part, still);
    state.gravity = Vec3::Zero();
    state.varying = nullptr;
    force.resize(slots.size());
    assembler_.model().part(part).element->residual(state, force);
    return std::span<const double>(force);
  });
}

void Start::carry(Configuration& c, Assembler::Metric metric, std::span<const int> held,
                  const std::vector<StartCoordinates::Wanted>& free, CarriedBodies& bodies) {
  constexpr int most_iterations = 40;
  constexpr double at_rest = 1e-13, falls = 0.5;  // corrections over the largest speed, and over the correction before
  if (bodies.none()) return;
  std::vector<double> right(static_cast<std::size_t>(assembler_.numbering().equations())), change, delta(motion_.size());
  double before = std::numeric_limits<double>::infinity();
  bool assembled = false;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    std::vector<double> v = motion_.velocities(c);
    std::fill(right.begin(), right.end(), 0.0);
    motion_.gather(bodies.resistance(c, v), right);
    if (!assembled) assembler_.projection(at_start_of_step(c), metric, held, assembler_.matrix(), bodies.give());
    assembled = true;
    if (!solve(right, change) || !add_coordinates(c, free, change)) return;
    std::fill(delta.begin(), delta.end(), 0.0);
    motion_.scatter(change, delta);
    for (std::size_t i = 0; i < v.size(); ++i) v[i] += delta[i];
    motion_.set_velocities(v, c);
    const double correction = bodies.fastest(delta), speed = bodies.fastest(v);
    if (!(correction > at_rest * speed)) return;
    if (correction > falls * before) {  // softer than the weight overcomes, or at rest but for rounding
      if (!bodies.stiffen()) return;
      assembled = false;
    }
    before = assembled ? correction : std::numeric_limits<double>::infinity();
  }
}

void Start::note_bodies(const CarriedBodies& bodies, const std::string& what, const std::string& remedy,
                        StartReport& report) const {
  const Model& model = assembler_.model();
  const auto id = [&model](int node) { return model.nodes[static_cast<std::size_t>(node)].id; };
  for (const Body& body : bodies.bodies()) {
    std::string name = fmt::format("that of node {} ({} nodes)", id(body.nodes.front()), body.nodes.size());
    if (std::find(report.carried.begin(), report.carried.end(), name) == report.carried.end())
      report.carried.push_back(std::move(name));
  }
  for (const CarriedBodies::Torn& torn : bodies.torn()) {
    const auto holds = [&](const Model::Part& part) {
      return part.element->cell_shape() == CellShape::none &&
             std::find(part.nodes.begin(), part.nodes.end(), torn.node) != part.nodes.end();
    };
    const auto link = std::find_if(model.parts.begin(), model.parts.end(), holds);
    report.remarks.push_back(fmt::format("{} node {}{} and leaves {} of the {} nodes of its body behind: {}", what, id(torn.node),
                                         link == model.parts.end() ? "" : " of " + link->name(), torn.behind, torn.nodes,
                                         remedy));
  }
}

}  // namespace engrane::solve
