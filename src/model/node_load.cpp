// SPDX-License-Identifier: BSD-3-Clause
#include "model/node_load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "math/linear_rotation.hpp"
#include "model/determined_channels.hpp"
#include "model/templated_element.hpp"

namespace engrane {

namespace {

/// Channels of a kind of load, shared because there may be very many loads.
const std::vector<Channel>& named(bool force, bool moment) {
  static const auto list = [](bool pushes, bool turns) {
    std::vector<Channel> all;
    for (const char* axis : {"X", "Y", "Z"})
      if (pushes) all.push_back({fmt::format("FORCE_{}", axis), dimension::force, "on the node, global"});
    for (const char* axis : {"X", "Y", "Z"})
      if (turns) all.push_back({fmt::format("MOMENT_{}", axis), dimension::moment, "on the node, global"});
    return all;
  };
  static const std::array<std::vector<Channel>, 4> lists{list(false, false), list(true, false), list(false, true),
                                                         list(true, true)};
  return lists[(force ? 1U : 0U) + (moment ? 2U : 0U)];
}

/// Force and moment of given directions, fixed in space. `Base` is the base of the element, which is constructed from its number.
template <class Base>
class FixedLoad : public Base, public DeterminedChannels {
 public:
  FixedLoad(int id, const Vec3& at, const Vec3& force, const Vec3& moment, const Function* function)
      : Base(id), at_(at), force_(force), moment_(moment), function_(function) {}

  bool is_load() const override { return true; }
  Energies energies(const State& state) const override {
    const NodeState& node = state.nodes[0];
    Energies e;
    e.external = factor(state.time) * (force_.dot(node.v) + moment_.dot(node.R * node.W));
    return e;
  }

  const std::vector<Channel>& channels() const override { return named(pushes(), turns()); }
  void observe(const State& state, std::span<double> values) const override {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = determine(static_cast<int>(i), state.time, {});
  }
  std::vector<Determined> determined() const override {
    std::vector<Determined> all;
    for (std::size_t i = 0; function_ && i < channels().size(); ++i) all.push_back({static_cast<int>(i)});
    return all;
  }
  double determine(int channel, double time, std::span<const double>) const override {
    return factor(time) * (channel < 3 && pushes() ? force_ : moment_)[channel % 3];
  }

  Drawing drawing() const override {
    Drawing shapes;
    for (const Vec3* load : {&force_, &moment_}) {
      if (load->isZero(0)) continue;
      const Vec3 axis = load->normalized();
      shapes.push_back(fmt::format(R"("shape": "arrow", {}"node": {}, "center": [{}, {}, {}], "axis": [{}, {}, {}], "holder": 0)",
                                   load == &moment_ ? R"("couple": true, )" : "", this->layout().nodes[0], at_[0], at_[1], at_[2],
                                   axis[0], axis[1], axis[2]));
    }
    return shapes;
  }

 protected:
  bool pushes() const { return !force_.isZero(0); }
  bool turns() const { return !moment_.isZero(0); }
  /// In the units of a load whose function is 1.
  const Vec3& force() const { return force_; }
  const Vec3& moment() const { return moment_; }
  double factor(double time) const { return function_ ? function_->at(time).f : 1.0; }
  /// The factor with its derivatives, for evaluate().
  template <class T>
  T factor_at(const T& time) const {
    return function_ ? engrane::evaluate(*function_, time) : T(1);
  }

 private:
  Vec3 at_, force_, moment_;
  const Function* function_;
};

class NodeLoad final : public FixedLoad<TemplatedElement<NodeLoad, 1, 6>> {
 public:
  NodeLoad(int id, int node, const Vec3& at, const Vec3& force, const Vec3& moment, const Function* function, bool linear)
      : FixedLoad(id, at, force, moment, function), linear_(linear) {
    Layout layout;
    layout.nodes = {node};
    layout.needs = {pushes() && turns() ? NodeNeed::both : turns() ? NodeNeed::rotation : NodeNeed::translation};
    set_layout(std::move(layout));
  }

  template <class T>
  void evaluate(const Motion<T, 1>& motion, const State& state, Balance<T, 1>& balance) const {
    const T size = factor_at(motion.time);
    balance.force(0, Vec3T<T>(force().template cast<T>() * (-size)));
    // a moment fixed in space, in components of the rotating node: its tangent is not symmetric, and the dual numbers provide
    // it; in a linear model it does not depend on the rotation
    const Vec3T<T> resisting = moment().template cast<T>() * (-size);
    balance.moment(0, linear_ ? moment_on_node(state.nodes[0].R, resisting) : Vec3T<T>(rotate_back(motion.node[0].R, resisting)));
  }
  bool is_linear() const override { return linear_; }

  bool applied(const State& state, std::span<double> forces) const override {
    const double size = factor(state.time);
    // what R takes back into space, also in a linear model
    const Mat3& R = state.nodes[0].R;
    const Vec3 push = size * force(),
               turn = size * ((is_linear_rotation(R) ? Mat3(R.inverse()) : Mat3(R.transpose())) * moment());
    double* out = forces.data();
    if (layout().needs_any(0, NodeNeed::translation)) out = std::copy_n(push.data(), 3, out);
    std::copy_n(turn.data(), 3, out);
    return true;
  }

 private:
  bool linear_;  ///< nodes do not turn under the moment
};

/// A force without a moment, which depends on time only.
class NodeForce final : public FixedLoad<Element> {
 public:
  NodeForce(int id, int node, const Vec3& at, const Vec3& force, const Function* function)
      : FixedLoad(id, at, force, Vec3::Zero(), function) {
    layout_.nodes = {node};
    // a force in the plane XY needs no z translation, which nodes of plane cells do not have
    layout_.needs = {force[2] == 0 ? NodeNeed::in_plane : NodeNeed::translation};
  }

  const Layout& layout() const override { return layout_; }
  bool is_linear() const override { return true; }
  void residual(const State& state, std::span<double> r) const override {
    for (std::size_t i = 0; i < r.size(); ++i) r[i] = -factor(state.time) * force()[static_cast<Eigen::Index>(i)];
  }
  void tangent(const State& state, Weights, std::span<double> r, std::span<double> k) const override {
    residual(state, r);
    std::fill(k.begin(), k.end(), 0.0);
  }
  void constraint_rates(const State&, std::span<double>, std::span<double>, std::span<double>) const override {}
  bool applied(const State& state, std::span<double> forces) const override {
    residual(state, forces);
    for (double& slot : forces) slot = -slot;
    return true;
  }

 private:
  Layout layout_;
};

}  // namespace

std::unique_ptr<Element> make_node_load(int id, int node, const Vec3& at, const Vec3& force, const Vec3& moment,
                                        const Function* function, bool linear) {
  if (moment.isZero(0) && !force.isZero(0)) return std::make_unique<NodeForce>(id, node, at, force, function);
  return std::make_unique<NodeLoad>(id, node, at, force, moment, function, linear);
}

}  // namespace engrane
