// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/linear_relation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "elements/common/axis_angle.hpp"
#include "elements/common/building.hpp"
#include "math/linear_rotation.hpp"
#include "model/outside_force.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements::joints {

namespace {

constexpr int most_nodes = 6;

/// Φ = Σ aᵢ uᵢ − V f(t). A displacement is a global component measured from the node's reference position; a rotation is the
/// node's angle about a global axis (axis_angle), with turns counted; in linear statics it is a component of the rotation vector
/// (linear_rotation).
class LinearRelation final : public TemplatedElement<LinearRelation, most_nodes, 6 * most_nodes + 1>, public OutsideForce {
 public:
  struct Term {
    std::size_t node = 0;  ///< index into the layout
    int component = 0;     ///< 0 to 2 translations, 3 to 5 rotations
    double coefficient = 0;
    double origin = 0;  ///< translation: reference coordinate
    int history = -1;   ///< rotation: index of its turn count
    bool turns() const { return component >= 3; }
  };

  LinearRelation(int id, Layout layout, std::vector<Term> terms, double value, const Function* function)
      : TemplatedElement(id), terms_(std::move(terms)), value_(value), function_(function) {
    const bool angles = std::all_of(terms_.begin(), terms_.end(), [](const Term& t) { return t.turns(); });
    layout.multipliers = {{"REACTION", angles ? dimension::angle : dimension::length, "force per unit of a coefficient",
                           function ? Role::drive : Role::other}};
    set_layout(std::move(layout));
    channels_ = {{"VALUE", angles ? dimension::angle : dimension::length, "sum of coefficients times displacements"},
                 {"REACTION", angles ? dimension::moment : dimension::force,
                  "a node receives it times its coefficient, along its component"},
                 {"POWER", dimension::power, "power given to the mechanism by the imposed value"}};
  }

  template <class T>
  void evaluate(const Motion<T, most_nodes>& motion, const State& state, Balance<T, most_nodes>& balance) const {
    std::array<AxisAngle<T>, 6 * most_nodes> turned;
    T sum = function_ ? T(-value_) * engrane::evaluate(*function_, motion.time) : T(-value_);
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      const Term& t = terms_[i];
      const auto& node = motion.node[t.node];
      if (t.turns()) {
        turned[i] = angle<T>(t, node.R);
        sum += t.coefficient * total(t, turned[i].angle, state);
      } else {
        sum += t.coefficient * (node.x[t.component] - t.origin);
      }
    }
    const T effort = balance.constraint(0, sum);
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      const Term& t = terms_[i];
      const T pull = t.coefficient * effort;
      if (t.turns()) {
        const auto& R = motion.node[t.node].R;
        balance.moment(static_cast<int>(t.node), moment_on_node(R, Vec3T<T>(turned[i].gradient * T(-pull))));
      } else {
        Vec3T<T> force(T(0), T(0), T(0));
        force[t.component] = -pull;
        balance.force(static_cast<int>(t.node), force);
      }
    }
  }

  void count_turns(const State& state, std::span<double>, std::span<double> history) const override {
    for (const Term& t : terms_)
      if (t.turns() && !is_linear_rotation(state.nodes[t.node].R))
        turn_count::commit(angle<double>(t, state.nodes[t.node].R).angle, committed(t, state),
                           history.subspan(static_cast<std::size_t>(t.history), turn_count::history));
  }

  Energies energies(const State& state) const override {
    Energies e;
    e.external = power(state);
    return e;
  }

  std::vector<Release> releases() const override { return {}; }  // a drive is all there is of it

  bool is_linear() const override { return true; }

  const std::vector<Channel>& channels() const override { return channels_; }

  void observe(const State& state, std::span<double> values) const override {
    values[0] = sum(state);
    values[1] = reaction(state);
    values[2] = power(state);
  }

 private:
  std::span<const double> committed(const Term& t, const State& state) const {
    return state.history.subspan(static_cast<std::size_t>(t.history), turn_count::history);
  }

  template <class T>
  T total(const Term& t, const T& angle, const State& state) const {
    return is_linear_rotation(state.nodes[t.node].R) ? angle : turn_count::total(angle, committed(t, state));
  }

  template <class T>
  AxisAngle<T> angle(const Term& t, const Mat3T<T>& R) const {
    if (is_linear_rotation(R))
      return {linear_rotation_vector<T>(R)[t.component - 3], Vec3(Vec3::Unit(t.component - 3)).template cast<T>()};
    std::array<Vec3T<T>, 3> fixed, carried;
    for (int k = 0; k < 3; ++k) {
      const Vec3 e = Vec3::Unit((t.component + k) % 3);
      fixed[static_cast<std::size_t>(k)] = e.template cast<T>();
      carried[static_cast<std::size_t>(k)] = rotate(R, e);
    }
    return axis_angle(fixed, carried);
  }

  double sum(const State& state) const {
    double sum = 0;
    for (const Term& t : terms_) {
      const NodeState& node = state.nodes[t.node];
      sum += t.coefficient * (t.turns() ? total(t, angle<double>(t, node.R).angle, state) : node.x[t.component] - t.origin);
    }
    return sum;
  }
  double reaction(const State& state) const {
    if (state.penalty == 0) return state.multipliers[0];
    return state.multipliers[0] - state.penalty * (sum(state) - value_ * (function_ ? function_->at(state.time).f : 1));
  }
  double power(const State& state) const { return function_ ? reaction(state) * value_ * function_->at(state.time).d1 : 0; }

  std::vector<Term> terms_;
  double value_;
  const Function* function_;
  std::vector<Channel> channels_;
};

/// The need of two terms of one node.
NodeNeed both_of(NodeNeed a, NodeNeed b) {
  if (a == b) return a;
  return a == NodeNeed::rotation || b == NodeNeed::rotation || a == NodeNeed::both ? NodeNeed::both : NodeNeed::translation;
}

std::unique_ptr<Element> build_linear_relation(const LinearRelationData& data, BuildContext& context) {
  const Function* function = nullptr;
  if (!find_function(context, data.function, function)) return nullptr;
  const std::size_t count = data.nodes.size();
  const auto fits = [&](std::string_view keyword, std::size_t given) {
    if (given == count) return true;
    context.error(keyword, fmt::format("NOEUD names {} terms, {} gives {}", count, keyword, given),
                  "give each term its node, component and coefficient; a node may be named again");
    return false;
  };
  if (!fits("C", data.components.size()) || !fits("A", data.coefficients.size())) return nullptr;
  Layout layout;
  std::vector<LinearRelation::Term> terms;
  for (std::size_t i = 0; i < count; ++i) {
    const int node = data.nodes[i], component = data.components[i] - 1;
    if (data.coefficients[i] == 0) {
      context.error("A", fmt::format("the coefficient of node {} is 0", node), "leave the term out");
      return nullptr;
    }
    for (std::size_t k = 0; k < i; ++k)
      if (data.nodes[k] == node && data.components[k] == data.components[i]) {
        context.error("C", fmt::format("component {} of node {} is named twice", component + 1, node),
                      "add its coefficients to one term");
        return nullptr;
      }
    const auto found = std::find(layout.nodes.begin(), layout.nodes.end(), node);
    const auto at = static_cast<std::size_t>(found - layout.nodes.begin());
    // nodes of plane cells have no z translation
    const NodeNeed need = component < 2 ? NodeNeed::in_plane : component < 3 ? NodeNeed::translation : NodeNeed::rotation;
    if (found == layout.nodes.end()) {
      layout.nodes.push_back(node);
      layout.needs.push_back(need);
    } else {
      layout.needs[at] = both_of(layout.needs[at], need);
    }
    LinearRelation::Term term{at, component, data.coefficients[i]};
    if (term.turns()) {
      term.history = layout.history;
      layout.history += turn_count::history;
    } else {
      term.origin = context.nodes.at(node)[component];
    }
    terms.push_back(term);
  }
  if (layout.nodes.size() > most_nodes) {
    context.error("NOEUD", fmt::format("{} nodes in one relation", layout.nodes.size()),
                  fmt::format("at most {}; a node between may carry a part of the sum", most_nodes));
    return nullptr;
  }
  return std::make_unique<LinearRelation>(context.record.id, std::move(layout), std::move(terms), data.value, function);
}

}  // namespace

ElementType linear_relation_type() {
  deck::Card<LinearRelationData> card(".LIA", {".LIAISON", ".LIAISONS"}, "Linear relation between displacements of nodes");
  card.numbered()
      .chapter("Boundary conditions, loads and functions")
      .describe(
          "The sum of A times the displacements (C 1 to 3) or rotations (C 4 to 6) is V, times the function NF of time: `NOEUD 3 "
          "C 1 A 2. NOEUD 4 C 1 A -1.`, or shorter `NOEUD 3 4 C 1 1 A 2. -1.`, means 2 u3 - u4 = 0. A rotation is the turn about "
          "a global axis, in radians, whole turns counted; it is what one expects of nodes that turn about that axis, as in a "
          "HINGE. In linear statics it is a component of the rotation vector. The number must differ from those of the elements "
          "of `.MCE`: results name it by it.")
      .example(".LIA\n I 1 NOEUD 3 C 1 A 2. NOEUD 4 C 1 A -1.\n I 2 NOEUD 5 6 C 6 6 A 1. 3.  V 0.1 NF 2");
  card.add("NOEUD", &LinearRelationData::nodes, "the node of each term")
      .synonyms({"NOEUDS", "NODES"})
      .refers(deck::Reference::node)
      .at_least(1)
      .leads()
      .required();
  card.add("C", &LinearRelationData::components, "the component of each term: 1 to 3 translations, 4 to 6 rotations")
      .synonyms({"COMPONENTS", "COMPOSANTES"})
      .at_least(1)
      .at_most(6)
      .required();
  card.add("A", &LinearRelationData::coefficients, "the coefficient of each term").synonyms({"COEFFICIENTS"}).required();
  card.add("V", &LinearRelationData::value, "value of the sum; rotations in radians").synonyms({"VAL"});
  card.add("NF", &LinearRelationData::function, "function of time that multiplies V")
      .refers(deck::Reference::function)
      .at_least(0);
  return element_type(card, build_linear_relation);
}

}  // namespace engrane::elements::joints
