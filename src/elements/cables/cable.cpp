// SPDX-License-Identifier: BSD-3-Clause
#include "elements/cables/cable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "elements/cables/catenary.hpp"
#include "elements/common/building.hpp"
#include "model/filled.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements::cables {

namespace {

/// At each instant the shape is the static equilibrium under weight and end positions; for inertia its mass is lumped at the
/// ends.
class Cable final : public TemplatedElement<Cable, 2, 6>, public Filled {
 public:
  struct Data {
    std::array<int, 2> nodes;
    double length, stiffness, mass;  ///< L, EA, mass per unstretched length
    const Function* reel = nullptr;  ///< factor of the length; nullptr: 1
  };

  Cable(int id, const Data& data) : TemplatedElement(id), data_(data) {
    Layout layout;
    layout.nodes.assign(data.nodes.begin(), data.nodes.end());
    layout.needs = {NodeNeed::translation, NodeNeed::translation};
    layout.switches = {{"the string is taut", "the string is slack"}};
    set_layout(std::move(layout));
  }

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const {
    const Catenary cable = catenary(state);
    const Vec3T<T> span = motion.node[1].x - motion.node[0].x;
    const Vec3T<T> tension = hangs(cable) ? cable.start_tension(span, cable.start_tension(value(span)))
                                          : cable.string_tension(span, balance.contact_homotopy());
    balance.force(0, Vec3T<T>(-tension));
    balance.force(1, Vec3T<T>(tension - Vec3(cable.weight * cable.length).cast<T>()));
    if (data_.mass == 0) return;
    const T half(data_.mass * cable.length / 2);
    for (int i = 0; i < 2; ++i) balance.force(i, Vec3T<T>(motion.node[static_cast<std::size_t>(i)].a * half));
  }

  Energies energies(const State& state) const override {
    const Catenary cable = catenary(state);
    const Vec3 start = start_tension(cable, state);
    Energies e;
    e.kinetic = data_.mass * cable.length / 4 * (state.nodes[0].v.squaredNorm() + state.nodes[1].v.squaredNorm());
    if (start.isZero(0)) return e;
    const Catenary::Shape<double> at = cable.shape(start);
    e.potential = potential(cable, start, state);
    if (state.varying) e.external = power_of_weight(cable, data_.mass * state.varying->rate, state);
    if (data_.reel) e.external = power_of_reeling(at.end.norm(), state);
    return e;
  }

  bool is_filled() const override { return data_.reel != nullptr; }
  /// The content is the unstretched length, the size the tension. What is reeled has no weight.
  Filling filling(const State& state) const override {
    const Catenary cable = catenary(state);
    const double tension = start_tension(cable, state).norm();
    return {cable.length, tension, power_of_reeling(tension, state)};
  }
  double work_of_filling(double from, double to, double tension) const override { return reeling_force(tension) * (to - from); }
  double slope_beside(const Filling& at, double tension) const override {
    return reeling_force(at.size) - reeling_force(tension);
  }

  /// A weightless string starts to pull at its unstretched length; one with weight always pulls.
  void switches(const State& state, std::span<Switch> values) const override {
    const Catenary cable = catenary(state);
    const Vec3 span = state.nodes[1].x - state.nodes[0].x, rate = state.nodes[1].v - state.nodes[0].v;
    const double distance = span.norm(), reeled = data_.reel ? data_.length * data_.reel->at(state.time).d1 : 0;
    values[0] = {distance - cable.length, distance > 0 ? span.dot(rate) / distance - reeled : std::nan(""),
                 hangs(cable) ? 0 : cable.length};
  }

  const std::vector<Channel>& channels() const override {
    static const std::vector<Channel> all = [] {
      std::vector<Channel> list = {{"TENSION_A", dimension::force, "at A"},
                                   {"TENSION_B", dimension::force, "at B"},
                                   {"LENGTH", dimension::length, "of the stretched cable"},
                                   {"SAG", dimension::length, "largest distance from the line of the ends, along the weight"},
                                   {"SPRING_ENERGY", dimension::energy, "energy stored"}};
      for (const char* end : {"A", "B"})
        for (const char* axis : {"X", "Y", "Z"})
          list.push_back(
              {fmt::format("FORCE_{}{}", end, axis), dimension::force, fmt::format("of the cable on {}, global", end)});
      return list;
    }();
    return all;
  }

  void observe(const State& state, std::span<double> values) const override {
    const Catenary cable = catenary(state);
    const Vec3 start = start_tension(cable, state), span = state.nodes[1].x - state.nodes[0].x;
    const bool slack = start.isZero(0);
    const Catenary::Shape<double> at = slack ? Catenary::Shape<double>{start, span, 0, 0} : cable.shape(start);
    values[0] = start.norm();
    values[1] = at.end.norm();
    values[2] = cable.length * (1 + at.mean / data_.stiffness);
    values[3] = hangs(cable) ? sag(cable, start, span) : 0;
    values[4] = cable.length * at.square / (2 * data_.stiffness);
    for (std::size_t c = 0; c < 3; ++c) {
      values[5 + c] = start[static_cast<Eigen::Index>(c)];
      values[8 + c] = -at.end[static_cast<Eigen::Index>(c)];
    }
  }

  std::vector<Derived> derived() const override {
    return {{"UNSTRETCHED_LENGTH", data_.length, dimension::length}, {"MASS", data_.mass * data_.length, dimension::mass}};
  }

  Drawing drawing() const override { return {fmt::format(R"("shape": "line", "points": {})", json(layout().nodes))}; }

 private:
  Catenary catenary(const State& state) const {
    const double length = data_.length * (data_.reel ? data_.reel->at(state.time).f : 1);
    return {length, data_.stiffness, data_.mass * state.gravity};
  }
  /// Elastic energy and weight of a cable that pulls: work of the tension less the complementary energy, and the weight as if it
  /// were all at B.
  static double potential(const Catenary& cable, const Vec3& start, const State& state) {
    const Vec3 span = state.nodes[1].x - state.nodes[0].x;
    const Catenary::Shape<double> at = cable.shape(start);
    return start.dot(span) - cable.length * (at.mean + at.square / (2 * cable.stiffness)) -
           cable.length * cable.weight.dot(state.nodes[1].x);
  }
  /// Power of a change `rate` of the weight. What the weight does on the way of the cable's points is not known, but the
  /// potential changes by this.
  static double power_of_weight(const Catenary& cable, const Vec3& rate, const State& state) {
    const double size = rate.norm();
    if (size == 0) return 0;
    if (!hangs(cable)) return -cable.length / 2 * rate.dot(state.nodes[0].x + state.nodes[1].x);  // straight
    constexpr double part = 1e-5;  // central differences are off by its square
    const double change = part * cable.weight.norm();
    const auto with = [&](double added) {
      Catenary other = cable;
      other.weight += added / size * rate;
      return potential(other, start_tension(other, state), state);
    };
    return size * (with(change) - with(-change)) / (2 * change);
  }
  /// Derivative of the energy by the unstretched length at constant distance of the ends.
  double reeling_force(double tension) const { return -tension * (1 + tension / (2 * data_.stiffness)); }
  double power_of_reeling(double tension, const State& state) const {
    return reeling_force(tension) * data_.length * data_.reel->at(state.time).d1;
  }
  static bool hangs(const Catenary& cable) { return !cable.weight.isZero(0); }
  static Vec3 start_tension(const Catenary& cable, const State& state) {
    const Vec3 span = state.nodes[1].x - state.nodes[0].x;
    return hangs(cable) ? cable.start_tension(span) : cable.string_tension(span, 0);
  }
  template <class T>
  static Vec3 value(const Vec3T<T>& v) {
    return {value_of(v[0]), value_of(v[1]), value_of(v[2])};
  }

  /// The cable is farthest from the chord where it is parallel to it.
  static double sag(const Catenary& cable, const Vec3& start, const Vec3& span) {
    const double q = cable.weight.norm();
    const Vec3 n = cable.weight / q, across = span - n.dot(span) * n, flat = start - n.dot(start) * n;
    const double l = across.norm(), slope = l > 1e-9 * cable.length ? n.dot(span) / l : 0;
    Catenary part = cable;
    part.length = std::clamp((n.dot(start) - slope * flat.norm()) / q, 0.0, cable.length);
    if (part.length == 0) return 0;
    const Vec3 place = part.shape(start).span;
    const double along = l > 0 ? across.dot(place) / l : 0;
    return n.dot(place) - slope * along;
  }

  Data data_;
};

std::unique_ptr<Element> build(const CableData& data, BuildContext& context) {
  const Function* reel = nullptr;
  const bool found = find_function(context, data.function, reel);
  if (!check_nodes(context, {data.nodes[0], data.nodes[1]}) || !found) return nullptr;
  const double distance = (context.nodes.at(data.nodes[1]) - context.nodes.at(data.nodes[0])).norm();
  if (data.length && data.tension) {
    context.error("TENSION", "TENSION beside LENGTH", "give one of them: each follows from the other");
    return nullptr;
  }
  if (!data.length && distance == 0) {
    context.error("N", "both ends of the cable are in one place, and it has no LENGTH", "give its unstretched length");
    return nullptr;
  }
  if (reel && data.mass > 0) {
    context.error("NF", "a cable whose length changes has no mass: what is reeled in would have to go somewhere",
                  "leave M out, or NF");
    return nullptr;
  }
  const double length = data.length.value_or(distance / (1 + data.tension.value_or(0) / data.stiffness));
  return std::make_unique<Cable>(context.record.id, Cable::Data{data.nodes, length, data.stiffness, data.mass, reel});
}

}  // namespace

ElementType cable_type() {
  deck::Card<CableData> card("CABLE", {}, "Cable: hangs between two nodes, and resists tension only");
  card.numbered()
      .chapter("Stiffeners, dampers, transfer functions")
      .describe(
          "One element is a whole span: its shape under its weight is that of the elastic catenary, exactly, taut or slack. "
          "Where the nodes accelerate half of its mass is at each of them; for waves along a cable take several. Without mass "
          "or gravity it is a straight string that becomes slack. With NF its length is reeled in and out: a winch.")
      .example("I 5 CABLE N 1 2  EA 1D4  M 1.02  LENGTH 10.")
      .example("I 6 CABLE N 3 4  EA 2D5  LENGTH 2.5  NF 3");
  card.add("N", &CableData::nodes, "the two nodes, a and b; 0 is the ground, at the origin")
      .synonyms({"NODES", "NOEUDS"})
      .refers(deck::Reference::node)
      .required();
  card.add("EA", &CableData::stiffness, "Young's modulus times area").unit(dimension::force).positive().required();
  card.add("M", &CableData::mass, "mass per unstretched length").at_least(0);
  card.add("LENGTH", &CableData::length, "unstretched length; default: the distance of the nodes")
      .unit(dimension::length)
      .positive();
  card.add("TENSION", &CableData::tension, "tension in the reference configuration if it had no weight; default: that of LENGTH")
      .unit(dimension::force)
      .at_least(0);
  card.add("NF", &CableData::function, "function of time that LENGTH is multiplied by; default: none")
      .refers(deck::Reference::function);
  return element_type(card, build);
}

}  // namespace engrane::elements::cables
