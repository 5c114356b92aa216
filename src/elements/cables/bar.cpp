// SPDX-License-Identifier: BSD-3-Clause
#include "elements/cables/bar.hpp"

#include <fmt/format.h>

#include <cmath>

#include "elements/common/building.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements::cables {

namespace {

/// A bar's law: energy EA L φ(s) of the strain s, which includes the prestrain.
struct BarLaw {
  double length = 0;     ///< L
  double stiffness = 0;  ///< EA
  double prestrain = 0;  ///< tension over EA at length L
  double width = 0;      ///< w: φ' is s when taut and 0 when slack, with a transition over strains of w; 0: φ' = s
  double damping = 0;    ///< a time constant
  bool logarithmic = false;

  /// Strain as a function of the squared length, and its derivative with respect to half of it: Green–Lagrange (l² − L²)/2L² or
  /// ln(l/L).
  template <class T>
  std::pair<T, T> strain(const T& square) const {
    const double over = 1 / (length * length);
    if (!logarithmic) return {(square * over - T(1)) * T(0.5) + T(prestrain), T(over)};
    const double value = value_of(square), inverse = 1 / value;
    return {compose(square, 0.5 * std::log(value * over), 0.5 * inverse, -0.5 * inverse * inverse) + T(prestrain), T(1) / square};
  }

  /// φ' and φ'': φ' = (s + √(s² + w²))/2 if the bar can become slack.
  template <class T>
  std::pair<T, T> slope(const T& s) const {
    using std::sqrt;
    if (width == 0) return {s, T(1)};
    const T root = sqrt(s * s + T(width * width));
    // remaining tension in compression, w²/(√ − s)/2, without cancellation
    const T first = value_of(s) < 0 ? T(0.5 * width * width) / (root - s) : (s + root) * T(0.5);
    return {first, first / root};
  }

  /// φ, with φ(0) = 0.
  double energy(double s) const {
    if (width == 0) return 0.5 * s * s;
    const double first = slope(s).first;
    return 0.5 * (s * first + 0.5 * width * width * std::asinh(s / width));
  }
};

class Bar final : public TemplatedElement<Bar, 2, 6> {
 public:
  Bar(int id, const std::array<int, 2>& nodes, const BarLaw& law, double mass)
      : TemplatedElement(id), law_(law), mass_(mass * law.length) {
    Layout layout;
    layout.nodes.assign(nodes.begin(), nodes.end());
    layout.needs = {NodeNeed::translation, NodeNeed::translation};
    set_layout(std::move(layout));
  }

  bool turns_with_nodes() const override { return true; }

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const {
    const auto& a = motion.node[0];
    const auto& b = motion.node[1];
    const Vec3T<T> pull = this->pull(a, b).force;
    balance.force(0, Vec3T<T>(-pull));
    balance.force(1, pull);
    if (mass_ == 0) return;
    // linear interpolation of accelerations: m/6 [2 1; 1 2]
    const T sixth(mass_ / 6);
    const Vec3T<T> weight = state.gravity.template cast<T>() * T(mass_ / 2);
    balance.force(0, Vec3T<T>((a.a * T(2) + b.a) * sixth - weight));
    balance.force(1, Vec3T<T>((b.a * T(2) + a.a) * sixth - weight));
  }

  Energies energies(const State& state) const override {
    const NodeState &a = state.nodes[0], &b = state.nodes[1];
    const Pull<double> p = pull(a, b);
    Energies e;
    e.potential = law_.stiffness * law_.length * law_.energy(p.strain);
    e.add_weight(state, mass_ / 2, a.x + b.x, a.v + b.v);
    e.kinetic = mass_ / 6 * (a.v.dot(a.v) + a.v.dot(b.v) + b.v.dot(b.v));
    e.dissipated = p.lost;
    return e;
  }

  const std::vector<Channel>& channels() const override {
    static const std::vector<Channel> all = {{"FORCE", dimension::force, "tension"},
                                             {"STRAIN", dimension::none, "with that of the prestress"},
                                             {"LENGTH", dimension::length, "distance of the nodes"},
                                             {"SPRING_ENERGY", dimension::energy, "energy stored"},
                                             {"DAMPER_POWER", dimension::power, "power lost"}};
    return all;
  }

  void observe(const State& state, std::span<double> values) const override {
    const NodeState &a = state.nodes[0], &b = state.nodes[1];
    const Vec3 arrow = b.x - a.x;
    const Pull<double> p = pull(a, b);
    values[0] = p.force.dot(arrow) / arrow.norm();
    values[1] = p.strain;
    values[2] = arrow.norm();
    values[3] = law_.stiffness * law_.length * law_.energy(p.strain);
    values[4] = p.lost;
  }

  const char* why_not_finite() const override { return "its nodes are in one place"; }

  std::vector<Derived> derived() const override {
    return {{"REFERENCE_LENGTH", law_.length, dimension::length}, {"MASS", mass_, dimension::mass}};
  }

  Drawing drawing() const override { return {fmt::format(R"("shape": "line", "points": {})", json(layout().nodes))}; }

 private:
  template <class T>
  struct Pull {
    Vec3T<T> force;  ///< on a towards b
    T strain, lost;
  };

  template <class Node, class T = typename std::decay_t<decltype(Node::x)>::Scalar>
  Pull<T> pull(const Node& a, const Node& b) const {
    const Vec3T<T> arrow = b.x - a.x;
    const auto [strain, slope] = law_.strain(T(dot(arrow, arrow)));
    auto [tension, stiffness] = law_.slope(strain);
    T lost(0);
    if (law_.damping > 0) {
      const T rate = slope * dot(arrow, Vec3T<T>(b.v - a.v)), damped = stiffness * rate * T(law_.damping);
      tension += damped;
      lost = damped * rate * T(law_.stiffness * law_.length);
    }
    return {arrow * T(tension * slope * T(law_.stiffness * law_.length)), strain, lost};
  }

  BarLaw law_;
  double mass_;
};

std::unique_ptr<Element> build(const BarData& data, BuildContext& context) {
  if (!check_nodes(context, {data.nodes[0], data.nodes[1]})) return nullptr;
  const double distance = (context.nodes.at(data.nodes[1]) - context.nodes.at(data.nodes[0])).norm();
  if (distance == 0) {
    context.error("N", "both ends of the bar are in one place", "give two places: a bar needs a direction");
    return nullptr;
  }
  if (data.length && data.tension) {
    context.error("TENSION", "TENSION beside LENGTH", "give one of them: each follows from the other");
    return nullptr;
  }
  BarLaw law;
  law.length = data.length.value_or(distance);
  law.stiffness = data.stiffness;
  law.prestrain = data.tension.value_or(0) / data.stiffness;
  law.width = data.width.value_or(0);
  law.damping = data.damping;
  law.logarithmic = data.logarithmic;
  return std::make_unique<Bar>(context.record.id, data.nodes, law, data.mass);
}

}  // namespace

ElementType bar_type() {
  deck::Card<BarData> card("BAR", {"BARRE"}, "Bar: resists changes of its length, at any strain, with mass and prestress");
  card.numbered()
      .chapter("Stiffeners, dampers, transfer functions")
      .describe(
          "A straight line between two nodes that hinge on it. The tension over EA is that of Green and Lagrange's strain, or of "
          "the logarithmic one with LOG. Its mass is spread over its length. With ONLY_TENSION it becomes slack instead of "
          "resisting pressure, smoothly over a strain of w; for the sag of a cable under its weight take several, or a CABLE.")
      .example("I 5 BAR N 1 2  EA 2.1D6  M 0.08  TENSION 400.")
      .example("I 6 BAR N 1 3  EA 2.1D6  LENGTH 2.5  ONLY_TENSION 1D-5  DAMPING 1D-3");
  card.add("N", &BarData::nodes, "the two nodes, a and b; 0 is the ground, at the origin")
      .synonyms({"NODES", "NOEUDS"})
      .refers(deck::Reference::node)
      .required();
  card.add("EA", &BarData::stiffness, "Young's modulus times area").unit(dimension::force).positive().required();
  card.add("M", &BarData::mass, "mass per length, of the bar without force or, with TENSION, as the nodes are given").at_least(0);
  card.add("LENGTH", &BarData::length, "unstretched length; default: the distance of the nodes")
      .unit(dimension::length)
      .positive();
  card.add("TENSION", &BarData::tension, "tension in the reference configuration; default: that of LENGTH")
      .unit(dimension::force);
  card.add("LOG", &BarData::logarithmic, "logarithmic strain instead of Green and Lagrange's");
  card.add("ONLY_TENSION", &BarData::width, "it resists tension only; the strain w over which it becomes slack").positive();
  card.add("DAMPING", &BarData::damping, "a time: the strain's rate times it adds to the strain")
      .unit(dimension::time)
      .at_least(0);
  return element_type(card, build);
}

}  // namespace engrane::elements::cables
