// SPDX-License-Identifier: BSD-3-Clause
#include "elements/bodies/rigid_body.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/bodies/carried_body.hpp"
#include "elements/bodies/rigid_link.hpp"
#include "elements/common/building.hpp"

namespace engrane::elements::bodies {

namespace {

/// A CarriedBody on the master, if there is inertia, and a RigidLink from the master to every slave.
class RigidBody final : public Element {
 public:
  RigidBody(int id, const std::vector<int>& nodes, const std::vector<Vec3>& offsets, std::unique_ptr<CarriedBody> body)
      : Element(id), body_(std::move(body)) {
    layout_.nodes = nodes;
    layout_.needs.assign(nodes.size(), NodeNeed::both);
    if (body_) {
      layout_.needs[0] = nodes.size() > 1 ? NodeNeed::both : body_->layout().needs[0];
      channels_ = body_->channels();
    }
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      links_.push_back(std::make_unique<RigidLink>(id, nodes[0], nodes[i], offsets[i]));
      for (Multiplier multiplier : links_.back()->layout().multipliers) {
        multiplier.name += fmt::format("_{}", nodes[i]);
        layout_.multipliers.push_back(std::move(multiplier));
      }
      name_channels(nodes[i]);
    }
  }

  const Layout& layout() const override { return layout_; }

  void residual(const State& state, std::span<double> r) const override {
    std::fill(r.begin(), r.end(), 0.0);
    std::array<double, largest> part{};
    if (body_) {
      const std::size_t count = body_slots();
      body_->residual(of_master(state), std::span(part).first(count));
      for (std::size_t i = 0; i < count; ++i) r[body_slot(i)] = part[i];
    }
    for (std::size_t link = 0; link < links_.size(); ++link) {
      links_[link]->residual(OfLink(state, link).state, part);
      for (std::size_t i = 0; i < largest; ++i) r[slot(link, i)] += part[i];
    }
  }

  void tangent(const State& state, Weights weights, std::span<double> r, std::span<double> k) const override {
    std::fill(r.begin(), r.end(), 0.0);
    std::fill(k.begin(), k.end(), 0.0);
    const auto n = static_cast<std::size_t>(layout_.slots());
    std::array<double, largest> part{};
    std::array<double, largest * largest> square{};
    const auto scatter = [&](std::size_t count, const auto& place) {
      for (std::size_t i = 0; i < count; ++i) {
        r[place(i)] += part[i];
        for (std::size_t j = 0; j < count; ++j) k[place(i) * n + place(j)] += square[i * count + j];
      }
    };
    if (body_) {
      const std::size_t count = body_slots();
      body_->tangent(of_master(state), weights, std::span(part).first(count), std::span(square).first(count * count));
      scatter(count, [this](std::size_t i) { return body_slot(i); });
    }
    for (std::size_t link = 0; link < links_.size(); ++link) {
      links_[link]->tangent(OfLink(state, link).state, weights, part, square);
      scatter(largest, [&](std::size_t i) { return slot(link, i); });
    }
  }

  void constraint_rates(const State& state, std::span<double> phi, std::span<double> rate,
                        std::span<double> second) const override {
    for (std::size_t link = 0; link < links_.size(); ++link)
      links_[link]->constraint_rates(OfLink(state, link).state, phi.subspan(6 * link, 6), rate.subspan(6 * link, 6),
                                     second.subspan(6 * link, 6));
  }

  Energies energies(const State& state) const override { return body_ ? body_->energies(of_master(state)) : Energies{}; }
  bool is_body() const override { return true; }
  Mat3 inertia_at(int node) const override { return body_ ? body_->inertia_at(node) : Mat3(Mat3::Zero()); }
  const std::vector<Channel>& channels() const override { return channels_; }

  void observe(const State& state, std::span<double> values) const override {
    std::size_t next = 0;
    if (body_) {
      next = body_->channels().size();
      body_->observe(of_master(state), values.first(next));
    }
    for (std::size_t link = 0; link < links_.size(); ++link) {
      std::array<double, largest> r{};
      links_[link]->residual(OfLink(state, link).state, r);
      const Vec3 moment = state.nodes[link + 1].R * Vec3(r[9], r[10], r[11]);
      for (std::size_t c = 0; c < 3; ++c) values[next++] = -r[6 + c];
      for (Eigen::Index c = 0; c < 3; ++c) values[next++] = -moment[c];
    }
  }

  Drawing drawing() const override {
    Drawing shapes = {fmt::format(R"("shape": "body", "nodes": {})", json(layout_.nodes))};
    if (body_) shapes.push_back(body_->drawing().front());
    return shapes;
  }

 private:
  static constexpr std::size_t largest = 18;  ///< slots of a link: two nodes and six multipliers

  static State of_master(const State& whole) {
    State state = whole;
    state.nodes = whole.nodes.first(1);
    state.multipliers = {};
    return state;
  }

  /// The part of the state that one link sees.
  struct OfLink {
    OfLink(const State& whole, std::size_t link) : nodes{whole.nodes[0], whole.nodes[link + 1]}, state(whole) {
      state.nodes = nodes;
      state.multipliers = whole.multipliers.subspan(6 * link, 6);
    }
    OfLink(const OfLink&) = delete;  // the state views this object's nodes
    OfLink& operator=(const OfLink&) = delete;

    std::array<NodeState, 2> nodes;
    State state;
  };

  std::size_t body_slots() const { return static_cast<std::size_t>(body_->layout().slots()); }
  /// Slot of the whole element for slot i of the inertia, which may lack the master's translations.
  std::size_t body_slot(std::size_t i) const {
    const auto of = [](const Layout& layout) { return layout.node_slot(0, NodeNeed::translation); };
    return of(layout_) >= 0 && of(body_->layout()) < 0 ? i + 3 : i;
  }

  /// Slot of the whole element for slot i of a link; all nodes joined by links have six.
  std::size_t slot(std::size_t link, std::size_t i) const {
    if (i < 6) return i;
    if (i < 12) return 6 * (link + 1) + i - 6;
    return 6 * layout_.nodes.size() + 6 * link + i - 12;
  }

  void name_channels(int slave) {
    const auto add = [&](const char* quantity, Dimension dimension) {
      for (const char* c : {"X", "Y", "Z"})
        channels_.push_back({fmt::format("{}_{}_{}", quantity, c, slave), dimension,
                             fmt::format("of the body on node {}, at the node, global", slave)});
    };
    add("FORCE", dimension::force);
    add("MOMENT", dimension::moment);
  }

  Layout layout_;
  std::unique_ptr<CarriedBody> body_;
  std::vector<std::unique_ptr<RigidLink>> links_;
  std::vector<Channel> channels_;
};

/// The centre of mass of each part: CG, or the master node.
std::optional<std::vector<Vec3>> centers(const RigidBodyData& data, std::size_t parts, const BuildContext& context,
                                         const Vec3& origin) {
  std::vector<Vec3> all(parts, origin);
  if (data.centers.empty()) return all;
  if (data.centers.size() != 3 * parts) {
    context.error("CG", fmt::format("CG has {} values, M has {}", data.centers.size(), data.mass.size()),
                  "three coordinates for each mass");
    return {};
  }
  for (std::size_t i = 0; i < parts; ++i) all[i] = Eigen::Map<const Vec3>(data.centers.data() + 3 * i);
  return all;
}

std::unique_ptr<Element> build(const RigidBodyData& data, BuildContext& context) {
  if (!check_nodes(context, data.nodes)) return nullptr;
  const int master = data.nodes[0];
  const Vec3 origin = context.nodes.at(master);
  const std::vector<double> masses = data.mass.empty() ? std::vector<double>{0} : data.mass;
  if (!data.centers.empty() && std::all_of(masses.begin(), masses.end(), [](double m) { return m == 0; })) {
    context.error("CG", "CG without mass", "give M, or leave CG out");
    return nullptr;
  }
  const auto places = centers(data, masses.size(), context, origin);
  if (!places) return nullptr;
  const auto inertia = one_body(context, {masses, *places, data.tensor, data.axes, data.about}, origin);
  if (!inertia) return nullptr;
  const bool heavy = inertia->mass > 0 || !inertia->tensor.isZero(0);
  if (heavy && master == 0) {
    context.error("N", "the first node carries the inertia, and the ground cannot", "name a node of the model first");
    return nullptr;
  }
  if (!heavy && data.nodes.size() == 1) {
    context.error("N", "a rigid body of one node without inertia does nothing", "name its other nodes, or give M and J");
    return nullptr;
  }
  std::vector<Vec3> offsets;
  for (const int node : data.nodes) offsets.push_back(context.nodes.at(node) - origin);
  std::unique_ptr<CarriedBody> body;
  if (heavy) body = std::make_unique<CarriedBody>(context.record.id, master, *inertia);
  return std::make_unique<RigidBody>(context.record.id, data.nodes, offsets, std::move(body));
}

}  // namespace

ElementType rigid_body_type() {
  deck::Card<RigidBodyData> card("RIGID", {"RIGIDE"}, "Rigid body: nodes that move as one, with mass and inertia");
  card.numbered()
      .chapter("Special boundary conditions and multi-point constraints")
      .describe(
          "The first node is the master; every other node is held to it, in position and orientation, where it is in the "
          "reference configuration. M, J and CG give the body inertia: J about the centre of mass, in axes that are the "
          "global ones in the reference configuration (1, 3 or 6 values as for INERTIA); the centre of mass is at the "
          "master unless CG says otherwise; AXES gives J other axes, ABOUT another point. Several masses behind M are parts "
          "of the body, and the other keywords have then as many values for each; it moves as their sum. `engrane inertia "
          "part.stl` finds mass, centre and tensor from a mesh. The ground (0) among the nodes welds the body to it.")
      .example("I 2 RIGID N 4 3")
      .example("I 3 RIGID N 10 11 12 13  M 2.5  J 0.1 0.2 0.25  CG 0.5 0 0")
      .example("I 4 RIGID N 20 21  M 2.5 0.4  CG 0 0 0  0.5 0 0  J 0.1 0.2 0.25  0.01 0.01 0.02")
      .example("I 5 RIGID N 20 21  M 2.5  CG 0.5 0 0  J 0.1 0.8 0.9  AXES 0 1 0 0 0 1  ABOUT 0 0 0");
  card.add("N", &RigidBodyData::nodes, "the nodes, the master first")
      .synonyms({"NODES", "NOEUDS"})
      .refers(deck::Reference::node)
      .required();
  card.add("M", &RigidBodyData::mass, "mass; several values: of the parts of the body")
      .synonyms({"MASS", "MASSE"})
      .unit(dimension::mass)
      .at_least(0);
  card.add("J", &RigidBodyData::tensor, "moments of inertia about the centre of mass: 1, 3 or 6 values, of each part")
      .unit(dimension::inertia);
  card.add("CG", &RigidBodyData::centers, "centre of mass, in the reference configuration, of each part").unit(dimension::length);
  card.add("AXES", &RigidBodyData::axes,
           "first axis of J, and a direction on the side of its second; of each part or of all; default: global x and y");
  card.add("ABOUT", &RigidBodyData::about,
           "the point about which J is, in the reference configuration; of each part or of all; default: its centre of mass")
      .unit(dimension::length);
  return element_type(card, build);
}

}  // namespace engrane::elements::bodies
