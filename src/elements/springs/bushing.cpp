// SPDX-License-Identifier: BSD-3-Clause
#include "elements/springs/bushing.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "elements/common/held_point.hpp"
#include "elements/common/rotation_vector.hpp"
#include "math/matrix6.hpp"
#include "model/templated_element.hpp"

namespace engrane::elements::springs {

namespace {

/// Linear in the displacement u of B's point relative to A's and in the rotation vector θ of B relative to A, both in axes
/// fixed to A. The history is θ at the end of the last step: where it changes sign, at half a turn, a stiff bush has no forces.
class Bushing final : public TemplatedElement<Bushing, 2, 12> {
 public:
  Bushing(int id, const HeldPoint& place, const Mat6& stiffness, const Mat6& damping)
      : TemplatedElement(id), place_(place), stiffness_(stiffness), damping_(damping) {
    Layout layout;
    layout.nodes.assign(place.nodes.begin(), place.nodes.end());
    layout.needs = {NodeNeed::both, NodeNeed::both};
    layout.history = 3;
    set_layout(std::move(layout));
  }

  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const {
    const Strain<T> strain = this->strain(motion);
    const T start(passes_half_a_turn(strain, state) ? std::numeric_limits<double>::quiet_NaN() : 0.0);
    const auto load = [&](int row) {
      T sum = start;
      for (int c = 0; c < 6; ++c) {
        const T &q = c < 3 ? strain.shift.value[c] : strain.turn.theta[c - 3],
                &rate = c < 3 ? strain.shift.rate[c] : strain.turn_rate[c - 3];
        sum += stiffness_(row, c) * q + damping_(row, c) * rate;
      }
      return sum;
    };
    HeldPoint::resist(strain.shift, Vec3T<T>(load(0), load(1), load(2)), strain.turn.moment(Vec3T<T>(load(3), load(4), load(5))),
                      motion, balance);
  }

  void count_turns(const State& state, std::span<double>, std::span<double> history) const override {
    Eigen::Map<Vec3>(history.data()) = strain(motion<double>(state)).turn.theta;
  }
  const char* why_not_finite() const override {
    return "passes half a turn, where its moment would change sign: BUSHING is for smaller rotations, TSPRING counts turns";
  }

  Energies energies(const State& state) const override {
    const auto [q, rate] = coordinates(state);
    Energies e;
    e.potential = 0.5 * q.dot(stiffness_ * q);
    e.dissipated = rate.dot(damping_ * rate);
    return e;
  }

  const std::vector<Channel>& channels() const override {
    static const std::vector<Channel> all = [] {
      std::vector<Channel> list;
      const auto three = [&](const std::string& name, Dimension dimension, const std::string& help) {
        for (const char* axis : {"_1", "_2", "_3"}) list.push_back({name + axis, dimension, help});
      };
      three("DISPLACEMENT", dimension::length, "displacement of B's point from A's, in the bush's axes");
      three("ROTATION", dimension::angle, "rotation vector of B from A, in the bush's axes");
      three("FORCE", dimension::force, "force of the bush on B, in its axes");
      three("MOMENT", dimension::moment, "moment of the bush on B, at its point, in its axes");
      list.push_back({"SPRING_ENERGY", dimension::energy, "energy stored"});
      list.push_back({"DAMPER_POWER", dimension::power, "power lost"});
      return list;
    }();
    return all;
  }

  void observe(const State& state, std::span<double> values) const override {
    const auto [q, rate] = coordinates(state);
    const Vec6 load = stiffness_ * q + damping_ * rate;
    const Vec3 moment = strain(motion<double>(state)).turn.moment(Vec3(load.tail<3>()));
    for (Eigen::Index c = 0; c < 6; ++c) {
      values[static_cast<std::size_t>(c)] = q[c];
      values[static_cast<std::size_t>(c + 6)] = c < 3 ? -load[c] : -moment[c - 3];
    }
    const Energies e = energies(state);
    values[12] = e.potential;
    values[13] = e.dissipated;
  }

  Drawing drawing() const override {
    Drawing shapes = place_.drawing();
    if (place_.nodes[0] != 0 && place_.nodes[1] != 0)
      shapes.push_back(fmt::format(R"("shape": "coil", "points": {})", json(layout().nodes)));
    return shapes;
  }

 private:
  template <class T>
  struct Strain {
    HeldPoint::Shift<T> shift;
    RotationVector<T> turn;  ///< of B relative to A, in the bush's axes
    Vec3T<T> turn_rate;
  };

  template <class T>
  Strain<T> strain(const Motion<T, 2>& motion) const {
    Strain<T> s{place_.shift(motion), {}, {}};
    Mat3T<T> relative;  // axes fixed to B, in those fixed to A
    for (int c = 0; c < 3; ++c)
      relative.col(c) = rotate_back(s.shift.axes, Vec3T<T>(rotate(motion.node[1].R, Vec3(place_.axes.col(c)))));
    s.turn = RotationVector<T>::of(relative);
    s.turn_rate = s.turn.change(rotate_back(s.shift.axes, s.shift.spin));
    return s;
  }

  template <class T>
  bool passes_half_a_turn(const Strain<T>& strain, const State& state) const {
    const Vec3 before = Eigen::Map<const Vec3>(state.history.data());
    double moved = 0;
    for (int c = 0; c < 3; ++c) moved += std::pow(value_of(strain.turn.theta[c]) - before[c], 2);
    return moved > std::numbers::pi * std::numbers::pi && !stiffness_.rightCols<3>().isZero(0);
  }

  std::pair<Vec6, Vec6> coordinates(const State& state) const {
    const Strain<double> s = strain(motion<double>(state));
    Vec6 q, rate;
    q << s.shift.value, s.turn.theta;
    rate << s.shift.rate, s.turn_rate;
    return {q, rate};
  }

  HeldPoint place_;
  Mat6 stiffness_, damping_;
};

/// Matrix from 6 or 21 values; zero if there are none. Reports an error and returns nothing if the number of values is wrong or
/// the matrix is not positive semidefinite.
std::optional<Mat6> matrix(const BuildContext& context, const char* keyword, const std::vector<double>& values) {
  if (values.empty()) return Mat6(Mat6::Zero());
  const auto m = symmetric_6(values);
  if (!m) {
    context.error(keyword, fmt::format("{} has {} values", keyword, values.size()),
                  "give 6 (the diagonal: three of displacement, three of rotation) or 21 (the upper triangle, row by row)");
    return {};
  }
  constexpr double rounding = 1e-9;
  if (definiteness(*m) >= -rounding || m->isZero(0)) return m;
  context.error(keyword, fmt::format("the matrix of {} is not positive: some motion would gain energy from it", keyword),
                fmt::format("none of its eigenvalues may be negative: the least is {:.6g} times the largest in size, with rows "
                            "scaled to a unit diagonal",
                            definiteness(*m)));
  return {};
}

/// The bush's axes as columns, right-handed.
std::optional<Mat3> find_axes(const BushingData& data, const BuildContext& context) {
  if (!data.axis) {
    if (!data.axis_2) return Mat3(Mat3::Identity());
    context.error("AXIS2", "AXIS2 without AXIS", "give the first axis: AXIS x y z");
    return {};
  }
  return axes_of(context, *data.axis, data.axis_2);
}

std::unique_ptr<Element> build(const BushingData& data, BuildContext& context) {
  const auto stiffness = matrix(context, "K", data.stiffness), damping = matrix(context, "C", data.damping);
  const auto axes = find_axes(data, context);
  if (!check_nodes(context, {data.nodes[0], data.nodes[1]}) || !stiffness || !damping || !axes) return nullptr;
  if (stiffness->isZero(0) && damping->isZero(0)) {
    context.error("K", "a bush with neither stiffness nor damping does nothing", "K k1 .. k6 and C c1 .. c6");
    return nullptr;
  }
  const HeldPoint place = HeldPoint::of(context, data.nodes, data.at, *axes);
  return std::make_unique<Bushing>(context.record.id, place, *stiffness, *damping);
}

}  // namespace

ElementType bushing_type() {
  deck::Card<BushingData> card("BUSHING", {"SILENTBLOC", "BUSH"}, "Bush: stiffness and damping in all six directions");
  card.numbered()
      .chapter("Stiffeners, dampers, transfer functions")
      .describe(
          "Linear in the displacement of b relative to a and in their relative rotation vector, both in axes that node a "
          "holds: exact under any motion of both nodes, for relative rotations below half a turn. It is relaxed in the "
          "reference configuration. K and C are diagonals (6 values: displacement along, rotation about the axes 1, 2, 3) "
          "or full symmetric matrices (21 values: the upper triangle, row by row).")
      .example("I 8 BUSHING N 4 5  K 2D6 5D5 5D5 80 300 300  C 200 50 50 0 0 0  AXIS 0 0 1");
  card.add("N", &BushingData::nodes, "the two nodes, a and b; 0 is the ground")
      .synonyms({"NODES", "NOEUDS"})
      .refers(deck::Reference::node)
      .required();
  card.add("K", &BushingData::stiffness, "stiffness: 6 values of the diagonal, or 21 of the upper triangle").values(6, 21);
  card.add("C", &BushingData::damping, "damping: 6 values of the diagonal, or 21 of the upper triangle").values(6, 21);
  card.add("AT", &BushingData::at, "where the bush is, in the reference configuration; default: at b").unit(dimension::length);
  card.add("AXIS", &BushingData::axis, "first axis, in the reference configuration; default: global x, y, z").synonyms({"AXE"});
  card.add("AXIS2", &BushingData::axis_2, "across AXIS, towards the second axis; default: any perpendicular").synonyms({"AXE2"});
  return element_type(card, build);
}

}  // namespace engrane::elements::springs
