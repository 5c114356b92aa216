// SPDX-License-Identifier: BSD-3-Clause
#include "elements/beams/line_load.hpp"

#include "elements/beams/line_shape.hpp"
#include "elements/common/building.hpp"
#include "model/determined_channels.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements::beams {

namespace {

/// Load on one piece: nodal forces Σ_j ∫ N_i N_j ds q_j, with q_j the load per unit length at rest at node j.
template <int Nodes>
class LineLoad final : public TemplatedElement<LineLoad<Nodes>, Nodes, 6 * Nodes>, public DeterminedChannels {
 public:
  using Matrix = Eigen::Matrix<double, Nodes, Nodes>;

  LineLoad(int id, const std::array<int, Nodes>& nodes, const Matrix& lengths, const Vec3& load, bool follow,
           const Function* function)
      : TemplatedElement<LineLoad<Nodes>, Nodes, 6 * Nodes>(id),
        lengths_(lengths),
        load_(load),
        follow_(follow),
        function_(function) {
    Layout layout;
    layout.nodes.assign(nodes.begin(), nodes.end());
    layout.needs.assign(Nodes, follow ? NodeNeed::both : NodeNeed::translation);
    this->set_layout(std::move(layout));
  }

  template <class T>
  void evaluate(const Motion<T, Nodes>& motion, const State&, Balance<T, Nodes>& balance) const {
    const auto forces = forces_at(motion);
    for (int i = 0; i < Nodes; ++i) balance.force(i, Vec3T<T>(-forces[static_cast<std::size_t>(i)]));
  }

  bool is_load() const override { return true; }
  bool is_linear() const override { return !follow_; }
  Energies energies(const State& state) const override {
    Energies e;
    e.external = power(state);
    return e;
  }

  bool applied(const State& state, std::span<double> slots) const override {
    this->residual(state, slots);
    for (double& slot : slots) slot = -slot;
    return true;
  }

  const std::vector<Channel>& channels() const override {
    static const std::vector<Channel> all = {{"FORCE_X", dimension::force, "resultant, global axes"},
                                             {"FORCE_Y", dimension::force, "resultant, global axes"},
                                             {"FORCE_Z", dimension::force, "resultant, global axes"},
                                             {"POWER", dimension::power, "power given to the mechanism"}};
    return all;
  }

  void observe(const State& state, std::span<double> values) const override {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& force : forces_at(Motion<double, Nodes>(state))) sum += force;
    for (Eigen::Index c = 0; c < 3; ++c) values[static_cast<std::size_t>(c)] = sum[c];
    values[3] = power(state);
  }

  std::vector<Determined> determined() const override {
    return function_ && !follow_ ? std::vector<Determined>{{0}, {1}, {2}} : std::vector<Determined>();
  }
  double determine(int channel, double time, std::span<const double>) const override {
    return function_->at(time).f * lengths_.sum() * load_[channel];
  }

  std::vector<Derived> derived() const override { return {{"length", lengths_.sum(), dimension::length}}; }
  Drawing drawing() const override { return {}; }

 private:
  template <class T>
  std::array<Vec3T<T>, Nodes> forces_at(const Motion<T, Nodes>& motion) const {
    const T size = function_ ? engrane::evaluate(*function_, motion.time) : T(1);
    std::array<Vec3T<T>, Nodes> forces;
    forces.fill(Vec3T<T>(T(0), T(0), T(0)));
    for (int j = 0; j < Nodes; ++j) {
      const auto& R = motion.node[static_cast<std::size_t>(j)].R;
      const Vec3T<T> load = (follow_ ? rotate(R, load_) : Vec3T<T>(load_.template cast<T>())) * size;
      for (int i = 0; i < Nodes; ++i) forces[static_cast<std::size_t>(i)] += load * T(lengths_(i, j));
    }
    return forces;
  }

  double power(const State& state) const {
    const Motion<double, Nodes> motion(state);
    const auto forces = forces_at(motion);
    double sum = 0;
    for (std::size_t i = 0; i < Nodes; ++i) sum += forces[i].dot(motion.node[i].v);
    return sum;
  }

  Matrix lengths_;  ///< ∫ N_i N_j ds
  Vec3 load_;
  bool follow_;
  const Function* function_;
};

template <int Nodes>
std::unique_ptr<Element> make_loads(const LineLoadData& data, const LineNodes& line, const Function* function,
                                    BuildContext& context) {
  std::unique_ptr<Element> first;
  for (std::size_t p = 0; p < line.pieces(); ++p) {
    const auto nodes = line.piece<Nodes>(p);
    const auto places = line_places<Nodes>(nodes, context);
    if (!places) return nullptr;
    auto element = std::make_unique<LineLoad<Nodes>>(context.record.id + static_cast<int>(p), nodes, line_masses<Nodes>(*places),
                                                     to_vector(data.load), data.follow, function);
    if (!first)
      first = std::move(element);
    else if (context.more)
      context.more->push_back(std::move(element));
  }
  return first;
}

std::unique_ptr<Element> build(const LineLoadData& data, BuildContext& context) {
  const Function* function = nullptr;
  if (data.function != 0 && !(function = context.function(data.function, "NF"))) return nullptr;
  const LineNodes line{data.nodes, data.linear};
  if (!line.check(context)) return nullptr;
  return line.of_two() ? make_loads<2>(data, line, function, context) : make_loads<3>(data, line, function, context);
}

}  // namespace

ElementType line_load_type() {
  deck::Card<LineLoadData> card("LINE_LOAD", {"CHARGE_LINEIQUE"}, "Force per length along a line of nodes");
  card.numbered()
      .chapter("Beams")
      .describe(
          "For beams, whose N it takes: pieces of three nodes, or with LINEAR of two, whose numbers count on from that of the "
          "record. The length is that of the reference configuration, so that the resultant does not change when the line "
          "stretches. The load keeps its direction in space, or with FOLLOW turns with the nodes.")
      .example("I 40 LINE_LOAD N 1 2 3 4 5  V 0 0 -250")
      .example("I 50 LINE_LOAD N 1 2 3 4 5  V 0 100 0  FOLLOW  NF 2");
  card.add("N", &LineLoadData::nodes, "the nodes along the line: 2, 3, 5, 7 …, or with LINEAR any number")
      .synonyms({"NODES", "NOEUDS"})
      .refers(deck::Reference::node)
      .at_least(1)
      .values(2, deck::any_number)
      .required();
  card.add("V", &LineLoadData::load, "force per length, global axes; with FOLLOW as in the reference configuration")
      .synonyms({"VAL"})
      .unit({0, 1, -2, 0})
      .required();
  card.add("NF", &LineLoadData::function, "function of time that multiplies V").refers(deck::Reference::function).at_least(0);
  card.add("FOLLOW", &LineLoadData::follow, "the load turns with the nodes").synonyms({"SUIVEUR"});
  card.add("LINEAR", &LineLoadData::linear, "pieces of two nodes");
  return element_type(card, build);
}

}  // namespace engrane::elements::beams
