// SPDX-License-Identifier: BSD-3-Clause
// A few plain elements whose energies and forces are known in closed form, and models of them without a deck.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "assembly/assembler.hpp"
#include "model/model.hpp"

namespace engrane::test {

/// What the elements below have in common: no tangent is asked for.
class PlainElement : public Element {
 public:
  PlainElement(int id, Layout layout) : Element(id), layout_(std::move(layout)) {}
  const Layout& layout() const override { return layout_; }
  void tangent(const State& state, Weights, std::span<double> r, std::span<double> k) const override {
    residual(state, r);
    std::fill(k.begin(), k.end(), 0.0);
  }
  void constraint_rates(const State&, std::span<double>, std::span<double>, std::span<double>) const override {}

 private:
  Layout layout_;
};

inline Layout translations_of(std::vector<int> nodes) {
  Layout layout;
  layout.needs.assign(nodes.size(), NodeNeed::translation);
  layout.nodes = std::move(nodes);
  return layout;
}

/// A point mass; its weight is a load.
class PointMass final : public PlainElement {
 public:
  PointMass(int id, int node, double mass) : PlainElement(id, translations_of({node})), mass_(mass) {}
  void residual(const State& s, std::span<double> r) const override {
    for (Eigen::Index i = 0; i < 3; ++i) r[static_cast<std::size_t>(i)] = mass_ * (s.nodes[0].a[i] - s.gravity[i]);
  }
  Energies energies(const State& s) const override {
    return {0.5 * mass_ * s.nodes[0].v.squaredNorm(), 0, 0, mass_ * s.gravity.dot(s.nodes[0].v)};
  }

 private:
  double mass_;
};

/// A spring of no natural length between two nodes.
class LineSpring final : public PlainElement {
 public:
  LineSpring(int id, int a, int b, double stiffness) : PlainElement(id, translations_of({a, b})), stiffness_(stiffness) {}
  void residual(const State& s, std::span<double> r) const override {
    const Vec3 force = stiffness_ * along(s);
    for (Eigen::Index i = 0; i < 3; ++i) {
      r[static_cast<std::size_t>(i)] = -force[i];
      r[static_cast<std::size_t>(3 + i)] = force[i];
    }
  }
  Energies energies(const State& s) const override { return {0, 0.5 * stiffness_ * along(s).squaredNorm(), 0, 0}; }
  const std::vector<Channel>& channels() const override {
    static const std::vector<Channel> names{{"LENGTH", dimension::length, "length"}, {"FORCE", dimension::force, "force"}};
    return names;
  }
  void observe(const State& s, std::span<double> values) const override {
    values[0] = along(s).norm();
    values[1] = stiffness_ * values[0];
  }

 private:
  static Vec3 along(const State& s) { return s.nodes[1].x - s.nodes[0].x; }
  double stiffness_;
};

/// A spring that declares fields: its force as a vector, and a number at two points.
class TellingSpring final : public PlainElement {
 public:
  TellingSpring(int id, int a, int b) : PlainElement(id, translations_of({a, b})) {}
  void residual(const State&, std::span<double> r) const override { std::fill(r.begin(), r.end(), 0.0); }
  const std::vector<Field>& fields() const override {
    static const std::vector<Field> fields{{{"TRACTION", dimension::force, "force"}, Field::Place::element, {"X", "Y", "Z"}, 1},
                                           {{"PLACE", dimension::length, "x of the points"}, Field::Place::point, {}, 2}};
    return fields;
  }
  void evaluate_fields(const State& s, std::span<double> values) const override {
    const Vec3 apart = s.nodes[1].x - s.nodes[0].x;
    std::copy_n(apart.data(), 3, values.begin());
    values[3] = s.nodes[0].x[0];
    values[4] = s.nodes[1].x[0];
  }
};

/// Holds the x of a node by a multiplier, which is its channel.
class Stay final : public PlainElement {
 public:
  Stay(int id, int node) : PlainElement(id, layout_of(node)) {}
  void residual(const State& s, std::span<double> r) const override {
    std::fill(r.begin(), r.end(), 0.0);
    r[0] = -s.multipliers[0];
  }
  const std::vector<Channel>& channels() const override {
    static const std::vector<Channel> names{{"FORCE", dimension::force, "force of the stay"},
                                            {"ONE", dimension::none, "always one"}};
    return names;
  }
  void observe(const State& s, std::span<double> values) const override {
    values[0] = s.multipliers[0];
    values[1] = 1;
  }

 private:
  static Layout layout_of(int node) {
    Layout layout = translations_of({node});
    layout.multipliers.push_back({"HOLD", dimension::length, "holds x"});
    return layout;
  }
};

/// A model that grows part by part. Node 0 is the ground.
struct Bench {
  Model model;

  explicit Bench(const std::vector<Vec3>& nodes) {
    model.nodes.push_back({0, Vec3::Zero()});
    for (const Vec3& x : nodes) model.nodes.push_back({10 * static_cast<int>(model.nodes.size()), x});
  }
  template <class Part, class... Values>
  Bench& add(const std::string& type, Values... values) {
    auto element = std::make_unique<Part>(static_cast<int>(model.parts.size()) + 1, values...);
    Model::Part part;
    for (const int id : element->node_ids()) part.nodes.push_back(model.node_index(id));
    part.element = std::move(element);
    part.type = type;
    model.parts.push_back(std::move(part));
    return *this;
  }
  Bench& support(int index) {
    for (int c = 0; c < 3; ++c) model.supports.push_back({index, c, 0.0, nullptr});
    return *this;
  }
};

/// A bench with all that looks at it.
struct Set {
  explicit Set(Bench made) : bench(std::move(made)), numbering(bench.model), assembler(bench.model, numbering, PETSC_COMM_SELF) {}

  Configuration at(double time) const { return numbering.reference_configuration(time); }

  Bench bench;
  Numbering numbering;
  Assembler assembler;
};

}  // namespace engrane::test
