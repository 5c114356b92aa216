// SPDX-License-Identifier: BSD-3-Clause
#include "elements/springs/spring.hpp"

#include <fmt/format.h>

#include "elements/common/along_motion.hpp"
#include "elements/common/line.hpp"
#include "model/templated_block.hpp"

namespace engrane::elements::springs {

namespace {

/// Spring along the line of its ends, exact for any motion. `Law` has the interface of SpringLaw.
template <class Law>
struct SpringOnLine {
  LineEnds ends;
  Law law;
  double natural;

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const {
    const auto reach = ends.reach<T>(motion.node);
    const T tension = law.force(T(reach.length - natural), reach.rate, state.time, balance.contact_homotopy());
    ends.pull(Vec3T<T>(reach.direction * tension), balance);
  }

  Energies energies(const State& state) const {
    const auto reach = ends.reach<double>(state.nodes);
    return law.energies(reach.length - natural, reach.rate, state.time);
  }

  static const std::vector<Channel>& channels() {
    static const std::vector<Channel> all = {{"LENGTH", dimension::length, "distance of the ends"},
                                             {"ELONGATION", dimension::length, "length less natural length"},
                                             {"SPEED", dimension::velocity, "rate of the length"},
                                             {"FORCE", dimension::force, "force of spring and damper, positive in tension"},
                                             {"SPRING_ENERGY", dimension::energy, "energy stored"},
                                             {"DAMPER_POWER", dimension::power, "power lost in the damper"}};
    return all;
  }

  void observe(const State& state, std::span<double> values) const {
    const auto reach = ends.reach<double>(state.nodes);
    const Energies e = energies(state);
    values[0] = reach.length;
    values[1] = reach.length - natural;
    values[2] = reach.rate;
    values[3] = law.force(values[1], reach.rate, state.time, 0);
    values[4] = e.potential;
    values[5] = e.dissipated;
  }

  std::vector<Derived> derived() const { return {{"natural length", natural, dimension::length}}; }
  Drawing drawing() const {
    return {fmt::format(R"("shape": "coil", "points": {})", json(std::vector(ends.nodes.begin(), ends.nodes.end())))};
  }
};

/// Spring along a line with a nonlinear law.
class LineSpring final : public TemplatedElement<LineSpring, 2, 6> {
 public:
  LineSpring(int id, const SpringOnLine<SpringLaw>& spring) : TemplatedElement(id), spring_(spring) {
    Layout layout;
    layout.nodes.assign(spring.ends.nodes.begin(), spring.ends.nodes.end());
    layout.needs = spring.ends.needs();
    spring.law.name_switches(layout.switches, "");
    set_layout(std::move(layout));
  }

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const {
    spring_.evaluate(motion, state, balance);
  }
  void switches(const State& state, std::span<Switch> values) const override {
    if (values.empty()) return;
    const Taylor length = spring_.ends.reach<Taylor>(along_motion(state)).length;
    spring_.law.switches(length - spring_.natural, state.time, length.value + spring_.natural, values);
  }
  Energies energies(const State& state) const override { return spring_.energies(state); }
  const std::vector<Channel>& channels() const override { return spring_.channels(); }
  void observe(const State& state, std::span<double> values) const override { spring_.observe(state, values); }
  std::vector<Derived> derived() const override { return spring_.derived(); }
  Drawing drawing() const override { return spring_.drawing(); }

 private:
  SpringOnLine<SpringLaw> spring_;
};

/// Force linear in elongation and rate. Such springs share a block, as there may be thousands of them.
struct LinearLaw {
  double stiffness, damping;

  template <class T>
  T force(const T& stretch, const T& rate, double, double) const {
    return stiffness * stretch + damping * rate;
  }
  Energies energies(double stretch, double rate, double) const {
    Energies e;
    e.potential = stretch * stretch * (stiffness / 2);
    e.dissipated = damping * rate * rate;
    return e;
  }
};

class LinearSprings final : public TemplatedBlock<SpringOnLine<LinearLaw>, 2, 6> {
 public:
  using TemplatedBlock::TemplatedBlock;

  Energies energies(std::size_t e, const State& state) const override { return data(e).energies(state); }
  const std::vector<Channel>& channels() const override { return SpringOnLine<LinearLaw>::channels(); }
  void observe(std::size_t e, const State& state, std::span<double> values) const override { data(e).observe(state, values); }
  std::vector<Derived> derived(std::size_t e) const override { return data(e).derived(); }
  Drawing drawing(std::size_t e) const override { return data(e).drawing(); }
};

std::unique_ptr<Element> linear_spring(BuildContext& context, const SpringOnLine<LinearLaw>& spring) {
  Layout layout;
  layout.needs = spring.ends.needs();
  std::string options;
  for (std::size_t i = 0; i < 2; ++i) {
    layout.nodes.push_back(spring.ends.nodes[i] == 0 ? 0 : -1);
    options += fmt::format("{} {} ", layout.nodes[i], static_cast<int>(layout.needs[i]));
  }
  BlockStore alone;
  const auto block = (context.blocks ? *context.blocks : alone).block<LinearSprings>(options, layout);
  return LinearSprings::add(block, context.record.id, spring.ends.nodes, spring);
}

/// Three springs on the relative displacement in the global directions, such as a support or the compliance of a joint.
class DirectionalSpring final : public TemplatedElement<DirectionalSpring, 2, 6> {
 public:
  DirectionalSpring(int id, const std::array<int, 2>& nodes, const Vec3& apart, const Vec3& stiffness, const Vec3& damping)
      : TemplatedElement(id), apart_(apart), stiffness_(stiffness), damping_(damping) {
    Layout layout;
    layout.nodes.assign(nodes.begin(), nodes.end());
    for (const int node : nodes) layout.needs.push_back(node == 0 ? NodeNeed::both : NodeNeed::translation);
    set_layout(std::move(layout));
  }

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State&, Balance<T, 2>& balance) const {
    const auto& a = motion.node[0];
    const auto& b = motion.node[1];
    Vec3T<T> force;
    for (int c = 0; c < 3; ++c) force[c] = stiffness_[c] * (b.x[c] - a.x[c] - apart_[c]) + damping_[c] * (b.v[c] - a.v[c]);
    balance.force(0, Vec3T<T>(-force));
    balance.force(1, force);
    // the ground is held where the other node is
    if (layout().nodes[0] == 0) balance.moment(0, cross(force, b.x));
    if (layout().nodes[1] == 0) balance.moment(1, cross(a.x, force));
  }

  Energies energies(const State& state) const override {
    const Vec3 stretch = elongation(state), rate = state.nodes[1].v - state.nodes[0].v;
    Energies e;
    e.potential = 0.5 * stretch.dot(stiffness_.cwiseProduct(stretch));
    e.dissipated = rate.dot(damping_.cwiseProduct(rate));
    return e;
  }

  const std::vector<Channel>& channels() const override {
    static const std::vector<Channel> all = {
        {"ELONGATION_X", dimension::length, "displacement of b relative to a, global"},
        {"ELONGATION_Y", dimension::length, "displacement of b relative to a, global"},
        {"ELONGATION_Z", dimension::length, "displacement of b relative to a, global"},
        {"FORCE_X", dimension::force, "force of spring and damper, positive in tension, global"},
        {"FORCE_Y", dimension::force, "force of spring and damper, positive in tension, global"},
        {"FORCE_Z", dimension::force, "force of spring and damper, positive in tension, global"},
        {"SPRING_ENERGY", dimension::energy, "energy stored"},
        {"DAMPER_POWER", dimension::power, "power lost in the damper"}};
    return all;
  }

  void observe(const State& state, std::span<double> values) const override {
    const Vec3 stretch = elongation(state), rate = state.nodes[1].v - state.nodes[0].v;
    const Energies e = energies(state);
    for (Eigen::Index c = 0; c < 3; ++c) {
      values[static_cast<std::size_t>(c)] = stretch[c];
      values[static_cast<std::size_t>(c + 3)] = stiffness_[c] * stretch[c] + damping_[c] * rate[c];
    }
    values[6] = e.potential;
    values[7] = e.dissipated;
  }

  Drawing drawing() const override { return {fmt::format(R"("shape": "coil", "points": {})", json(layout().nodes))}; }

 private:
  Vec3 elongation(const State& state) const { return state.nodes[1].x - state.nodes[0].x - apart_; }

  Vec3 apart_;  ///< from a to b in the reference configuration
  Vec3 stiffness_, damping_;
};

/// Reports an error and returns false if there are two values.
bool check_values(const BuildContext& context, std::string_view keyword, const std::vector<double>& values) {
  if (values.size() == 2) {
    context.error(keyword, fmt::format("{} has 2 values", keyword), "give 1 (along the line) or 3 (along x, y and z)");
    return false;
  }
  return true;
}

std::unique_ptr<Element> build(const SpringData& data, BuildContext& context) {
  const auto& nodes = data.nodes;
  const auto &k = data.stiffness, &c = data.damping;
  const auto& length = data.length;
  const auto& at = data.at;
  const bool good = check_values(context, "K", k) && check_values(context, "C", c);
  if (!check_nodes(context, {nodes[0], nodes[1]}) || !good) return nullptr;
  const auto zero = [](double v) { return v == 0; };
  const bool lawful = data.law.given() || data.damping_law != 0;
  if (std::all_of(k.begin(), k.end(), zero) && std::all_of(c.begin(), c.end(), zero) && !lawful) {
    context.error("K", "a spring with neither stiffness nor damping does nothing", "K k and C c, or three values of each");
    return nullptr;
  }
  const int id = context.record.id;
  if (k.size() != 3 && c.size() != 3) {
    const auto ends = LineEnds::of(context, nodes, at, "K kx ky kz acts in the three global directions and needs no line");
    if (!ends) return nullptr;
    const double start = ends->reference_length(context), natural = length.value_or(start);
    const auto law = SpringLaw::of(context, data, k.empty() ? 0 : k[0], c.empty() ? 0 : c[0], start - natural,
                                   0.01 * std::max(start, natural));
    if (!law) return nullptr;
    if (!lawful) return linear_spring(context, {*ends, {law->k1, law->damping}, natural});
    return std::make_unique<LineSpring>(id, SpringOnLine<SpringLaw>{*ends, *law, natural});
  }
  if (lawful) {
    context.error(data.law.given() ? "LAW" : "CLAW",
                  "a law of the elongation has no meaning for a spring in the global directions",
                  "give one value of K or C, or none, for a spring along the line");
    return nullptr;
  }
  if (k.size() == 1 || c.size() == 1) {
    context.error(k.size() == 1 ? "K" : "C", "one value beside three", "give K and C the same number of values, 1 or 3");
    return nullptr;
  }
  for (const char* keyword : {"L0", "AT"})
    if (std::string_view(keyword) == "L0" ? length.has_value() : at.has_value()) {
      context.error(keyword, fmt::format("{} has no meaning for a spring in the global directions", keyword),
                    "give one value of K and C for a spring along the line");
      return nullptr;
    }
  const auto three = [](const std::vector<double>& v) { return v.empty() ? Vec3(Vec3::Zero()) : Vec3(v[0], v[1], v[2]); };
  const Vec3 apart = context.nodes.at(nodes[1]) - context.nodes.at(nodes[0]);
  return std::make_unique<DirectionalSpring>(id, nodes, apart, three(k), three(c));
}

}  // namespace

ElementType spring_type() {
  deck::Card<SpringData> card("SPRING", {"RESSORT"}, "Spring and damper between two nodes");
  card.numbered()
      .chapter("Stiffeners, dampers, transfer functions")
      .describe(
          "With one value of K or C, or with LAW or CLAW, it acts along the line of the two nodes, exactly for any motion; its "
          "natural length is "
          "that of the reference configuration unless L0 says otherwise, and an end on the ground (node 0) is at the "
          "origin unless AT says otherwise. With three values it acts in the global directions on the displacement of b "
          "relative to a, as the flexible support of a bearing does.")
      .example("I 9 SPRING N 4 5  K 2.0D4  C 10  L0 0.25")
      .example("I 9 SPRING N 4 5  LAW POLY 2.0D4 0 3.0D8  CLAW 2")
      .example("I 9 SPRING N 4 5  LAW USER 3")
      .example("I 10 SPRING N 0 2  K 1D6 1D6 0");
  card.add("N", &SpringData::nodes, "the two nodes, a and b; 0 is the ground")
      .synonyms({"NODES", "NOEUDS"})
      .refers(deck::Reference::node)
      .required();
  card.add("K", &SpringData::stiffness, "stiffness: 1 value along the line, 3 along x, y, z")
      .values(1, 3)
      .unit(dimension::stiffness)
      .at_least(0);
  card.add("C", &SpringData::damping, "damping: 1 value along the line, 3 along x, y, z")
      .values(1, 3)
      .unit(dimension::damping)
      .at_least(0);
  add_spring_law(card, "elongation", "tension");
  card.add("L0", &SpringData::length, "natural length; default: the distance of the nodes").unit(dimension::length).at_least(0);
  card.add("AT", &SpringData::at, "end on the ground; default: the origin").unit(dimension::length);
  return element_type(card, build);
}

}  // namespace engrane::elements::springs
