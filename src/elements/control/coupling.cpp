// SPDX-License-Identifier: BSD-3-Clause
#include "elements/control/coupling.hpp"

#include <fmt/format.h>

#include "elements/common/building.hpp"
#include "elements/control/joint_coordinate.hpp"

namespace engrane::elements::control {

namespace {

/// Φ = q₂ − r q₁ − o, enforced by a multiplier or by a spring and damper. The effort on q₂ is that of the element along the
/// second coordinate; −r times it acts along the first.
class Coupling final : public TemplatedElement<Coupling, 4, 25> {
 public:
  struct Law {
    double ratio = 1, offset = 0;
    std::optional<double> stiffness, damping;
    bool elastic() const { return stiffness || damping; }
    double k() const { return stiffness.value_or(0); }
    double c() const { return damping.value_or(0); }
  };

  Coupling(int id, const Coordinate& first, const Coordinate& second, const Law& law)
      : Coupling(id, first, second, law, Layout{}) {}

  template <class T>
  void evaluate(const Motion<T, 4>& motion, const State& state, Balance<T, 4>& balance) const {
    const auto first = first_.read<T>(motion.node, state), second = second_.read<T>(motion.node, state);
    const T apart = second.measured.value - law_.ratio * first.measured.value - law_.offset;
    const T effort =
        law_.elastic() ? T(-law_.k() * apart - law_.c() * (second.rate - law_.ratio * first.rate)) : balance.constraint(0, apart);
    second_.act(second, effort, motion.node, balance);
    first_.act(first, T(-law_.ratio * effort), motion.node, balance);
  }

  void count_turns(const State& state, std::span<double>, std::span<double> history) const override {
    first_.commit(state, history);
    second_.commit(state, history);
  }

  Energies energies(const State& state) const override {
    const Apart now = apart(state);
    Energies e;
    e.potential = 0.5 * law_.k() * now.value * now.value;
    e.dissipated = law_.c() * now.rate * now.rate;
    return e;
  }

  const std::vector<Channel>& channels() const override { return channels_; }

  void observe(const State& state, std::span<double> values) const override {
    const Apart now = apart(state);
    const double effort =
        law_.elastic() ? -law_.k() * now.value - law_.c() * now.rate : state.multipliers[0] - state.penalty * now.value;
    values[0] = now.first;
    values[1] = now.second;
    values[2] = now.value;
    values[3] = -law_.ratio * effort;
    values[4] = effort;
  }

 private:
  // the coordinates append their nodes to the layout in turn, before it is passed to the base
  Coupling(int id, const Coordinate& first, const Coordinate& second, const Law& law, Layout layout)
      : TemplatedElement(id), law_(law), first_(first, layout), second_(second, layout) {
    if (!law.elastic())
      layout.multipliers = {{"EFFORT_2", second.dimension(),
                             second.is_angle() ? "moment along the second coordinate" : "force along the second coordinate"}};
    set_layout(std::move(layout));
    channels_ = {{"COORDINATE_1", first.dimension(), "the first coordinate"},
                 {"COORDINATE_2", second.dimension(), "the second coordinate"},
                 {"DIFFERENCE", second.dimension(), "second less what the relation wants it to be"},
                 {"EFFORT_1", first.effort_dimension(), "force or moment of the coupling along the first coordinate"},
                 {"EFFORT_2", second.effort_dimension(), "force or moment of the coupling along the second coordinate"}};
  }

  struct Apart {
    double first, second, value, rate;
  };
  Apart apart(const State& state) const {
    const auto first = first_.read<double>(state.nodes, state), second = second_.read<double>(state.nodes, state);
    return {first.measured.value, second.measured.value, second.measured.value - law_.ratio * first.measured.value - law_.offset,
            second.rate - law_.ratio * first.rate};
  }

  Law law_;
  PlacedCoordinate first_, second_;
  std::vector<Channel> channels_;
};

std::unique_ptr<Element> build(const CouplingData& data, BuildContext& context) {
  const auto first = find_coordinate(context, "JOINTS", data.joints[0], "FIRST", data.first);
  const auto second = find_coordinate(context, "JOINTS", data.joints[1], "SECOND", data.second);
  if (!first || !second) return nullptr;
  if (data.joints[0] == data.joints[1] && first->name == second->name) {
    context.error("JOINTS", fmt::format("{} of element {} is coupled to itself", first->name, data.joints[0]),
                  "name two joints, or two coordinates of one by FIRST and SECOND");
    return nullptr;
  }
  return std::make_unique<Coupling>(
      context.record.id, *first, *second,
      Coupling::Law{data.ratio, second->is_angle() ? data.offset * degree : data.offset, data.stiffness, data.damping});
}

}  // namespace

ElementType coupling_type() {
  deck::Card<CouplingData> card("COUPLING", {"COUPLAGE"}, "Relation with a ratio between the coordinates of two joints");
  card.numbered()
      .chapter("Special boundary conditions and multi-point constraints")
      .describe(
          "q2 = RATIO q1 + OFFSET, where q1 and q2 are coordinates of the joints named by JOINTS: angles in radians, slides in "
          "the deck's length. So the RATIO of a slide to an angle is the advance per radian. The relation is exact; with K or C "
          "it is elastic. A joint with several coordinates takes its first unless FIRST or SECOND names another.")
      .example("I 7 COUPLING JOINTS 3 5  RATIO -2.5")
      .example("I 8 COUPLING JOINTS 3 6  RATIO (0.005/(2*PI))  SECOND SLIDE  K 1D7  C 200");
  card.add("JOINTS", &CouplingData::joints, "numbers of the two joints (or sensors)")
      .synonyms({"LIAISONS"})
      .refers(deck::Reference::element)
      .required();
  card.add("RATIO", &CouplingData::ratio, "of the second coordinate to the first").synonyms({"RAPPORT"}).required();
  card.add("OFFSET", &CouplingData::offset, "second coordinate where the first is 0; degrees for an angle")
      .synonyms({"DECALAGE"});
  card.add("FIRST", &CouplingData::first, "coordinate of the first joint, as its channel is named").synonyms({"PREMIER"});
  card.add("SECOND", &CouplingData::second, "coordinate of the second joint").synonyms({"DEUXIEME"});
  card.add("K", &CouplingData::stiffness, "stiffness on the second coordinate: per length, or per radian").at_least(0);
  card.add("C", &CouplingData::damping, "damping on the second coordinate").at_least(0);
  return element_type(card, build, 1);
}

}  // namespace engrane::elements::control
