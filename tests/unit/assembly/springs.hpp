// SPDX-License-Identifier: BSD-3-Clause
// Masses in a row, on springs that stand alone or in a block, and a model of them without a deck.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "assembly/assembler.hpp"
#include "model/model.hpp"
#include "model/templated_block.hpp"
#include "model/templated_element.hpp"

namespace engrane::test {

/// A spring and damper along the line of two nodes, of no natural length but stiffening.
struct SpringData {
  double stiffness, damping;

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State&, Balance<T, 2>& balance) const {
    const Vec3T<T> apart = motion.node[1].x - motion.node[0].x, rate = motion.node[1].v - motion.node[0].v;
    const Vec3T<T> force = apart * T(stiffness * (T(1) + dot(apart, apart))) + rate * T(damping);
    balance.force(0, Vec3T<T>(-force));
    balance.force(1, force);
  }
};

inline Layout spring_layout(int a, int b) {
  Layout layout;
  layout.nodes = {a, b};
  layout.needs = {NodeNeed::translation, NodeNeed::translation};
  return layout;
}

class LoneSpring final : public TemplatedElement<LoneSpring, 2, 6> {
 public:
  LoneSpring(int id, int a, int b, SpringData data) : TemplatedElement(id), data_(data) { set_layout(spring_layout(a, b)); }
  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const {
    data_.evaluate(motion, state, balance);
  }

 private:
  SpringData data_;
};

using Springs = TemplatedBlock<SpringData, 2, 6>;

/// A point mass whose turn, if it has one, is held to the turn of an own unknown by a constraint.
class Mass final : public TemplatedElement<Mass, 1, 8> {
 public:
  Mass(int id, int node, double mass, bool turns) : TemplatedElement(id), mass_(mass), turns_(turns) {
    Layout layout;
    layout.nodes = {node};
    layout.needs = {turns ? NodeNeed::both : NodeNeed::translation};
    if (turns) {
      layout.scalars = {{"SHIFT", dimension::length, "follows x"}};
      layout.multipliers = {{"HOLD", dimension::length, "holds SHIFT to x"}};
      layout.history = 1;
    }
    set_layout(std::move(layout));
  }
  template <class T>
  void evaluate(const Motion<T, 1>& motion, const State& state, Balance<T, 1>& balance) const {
    const auto& node = motion.node[0];
    balance.force(0, Vec3T<T>(node.a * T(mass_) - state.gravity.template cast<T>() * T(mass_)));
    if (!turns_) return;
    const T hold = balance.constraint(0, T(motion.scalar[0] - node.x[0]));
    Vec3T<T> along(T(0), T(0), T(0));
    along[0] = hold;
    balance.force(0, along);
    balance.scalar(0, T(-hold));
    balance.moment(0, Vec3T<T>(node.A * T(0.1 * mass_) + node.W * T(state.h)));
  }
  void count_turns(const State& state, std::span<double>, std::span<double> history) const override {
    if (turns_) history[0] = state.history[0] + 1;
  }
  void commit(const State& state, std::span<double> scalars, std::span<double> history) const override {
    count_turns(state, scalars, history);
    if (turns_) history[0] += 100;
  }

 private:
  double mass_;
  bool turns_;
};

inline void add_part(Model& model, std::unique_ptr<Element> element, const std::string& type) {
  Model::Part part;
  for (const int id : element->node_ids()) part.nodes.push_back(model.node_index(id));
  part.element = std::move(element);
  part.type = type;
  model.parts.push_back(std::move(part));
}

/// n masses, each on a spring from the one before and the first on the ground; every third mass turns. Masses and springs in
/// turn, or all springs last.
inline Model row_of_masses(int n, bool in_block, bool in_turn) {
  Model model;
  model.nodes.push_back({0, Vec3::Zero()});
  for (int i = 1; i <= n; ++i) model.nodes.push_back({i, Vec3(i, 0.1 * i, -0.05 * i)});
  const auto first = std::make_shared<Springs>(spring_layout(0, -1)), others = std::make_shared<Springs>(spring_layout(-1, -1));
  const auto add_spring = [&](int i) {
    const SpringData data{10.0 + i, 0.3 / i};
    if (in_block)
      add_part(model, Springs::add(i == 1 ? first : others, n + i, {i - 1, i}, data), "SPRING");
    else
      add_part(model, std::make_unique<LoneSpring>(n + i, i - 1, i, data), "SPRING");
  };
  for (int i = 1; i <= n; ++i) {
    add_part(model, std::make_unique<Mass>(i, i, 1 + 0.01 * i, i % 3 == 0), "INERTIA");
    if (in_turn) add_spring(i);
  }
  for (int i = 1; i <= n && !in_turn; ++i) add_spring(i);
  return model;
}

/// Everything in motion, reproducibly.
inline Configuration shaken(const Numbering& numbering) {
  Configuration c = numbering.reference_configuration(0.5);
  int k = 0;
  const auto next = [&k] { return std::sin(1.7 * ++k); };
  const auto vector = [&] { return Vec3(next(), next(), next()); };
  for (std::size_t i = 1; i < c.nodes.size(); ++i) {
    NodeState& node = c.nodes[i];
    node.x += 0.1 * vector();
    node.v = vector();
    node.a = vector();
    node.W = vector();
    node.A = vector();
  }
  for (auto* values : {&c.scalars, &c.scalar_rates, &c.scalar_accelerations, &c.multipliers})
    for (double& value : *values) value = next();
  c.h = 0.25;
  return c;
}

}  // namespace engrane::test
