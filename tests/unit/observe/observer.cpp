// SPDX-License-Identifier: BSD-3-Clause
#include "observe/observer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>

#include "assembly/configuration_snapshot.hpp"
#include "bench.hpp"

namespace engrane::test {
namespace {

using namespace observe;

const Vec3 down(0, 0, -9.81);

/// A stone of 2 kg that falls.
struct Fall : Set {
  Fall() : Set(make()) {}
  static Bench make() {
    Bench bench({Vec3(1, 0, 100)});
    bench.add<PointMass>("INERTIA", 10, 2.0);
    bench.model.gravity.push_back({down, nullptr});
    return bench;
  }
  Configuration falling(double t) const {
    Configuration c = at(t);
    c.nodes[1].v = Vec3(3, 0, 1) + down * t;
    c.nodes[1].x += Vec3(3, 0, 1) * t + 0.5 * down * t * t;
    c.nodes[1].a = down;
    return c;
  }
};

TEST(Energies, OfAFallingStoneAreThoseOfThePencil) {
  Fall fall;
  Observer observer(fall.assembler, true, {});
  for (int i = 0; i <= 4; ++i) observer.observe(fall.falling(0.25 * i), {0.25, 1, 0}, true, false);
  const EnergyBalance& e = observer.energies();
  const double vz = 1 - 9.81;
  EXPECT_NEAR(e.kinetic, 9 + vz * vz, 1e-12);
  EXPECT_NEAR(e.initial, 10, 1e-12);
  EXPECT_NEAR(e.external_work, -2 * 9.81 * (1 - 0.5 * 9.81), 1e-12);  // the power is linear: the rule is exact
  EXPECT_EQ(e.potential, 0);
  EXPECT_LE(e.largest_error, 1e-12);
  EXPECT_EQ(observer.values()[static_cast<std::size_t>(observer.channel("run", "EXTERNAL_WORK"))], e.external_work);
}

TEST(Energies, GoOnAfterARestart) {
  Fall fall;
  Observer whole(fall.assembler, true, {}), first(fall.assembler, true, {}), second(fall.assembler, true, {});
  Snapshot snapshot;
  for (int i = 0; i <= 6; ++i) {
    const Configuration c = fall.falling(0.3 * i * i);
    whole.observe(c, {0.3, 1, 2}, true, false);
    if (i <= 3) first.observe(c, {0.3, 1, 2}, true, false);
    if (i == 3) {
      first.save(snapshot);
      save_configuration(c, snapshot);
      second.load(snapshot);
    }
    if (i > 3) second.observe(c, {0.3, 1, 2}, true, false);
  }
  EXPECT_EQ(whole.values(), second.values());
}

/// A stone with a velocity of t⁵, which is no motion: the power of its weight has degree five.
Configuration with_power(const Fall& fall, double t) {
  Configuration c = fall.at(t);
  c.nodes[1].v = Vec3(0, 0, std::pow(t, 5));
  return c;
}

TEST(Energies, AreIntegratedExactlyToDegreeFiveWithPointsInsideTheStep) {
  const auto work = [](double t) { return -2 * 9.81 * std::pow(t, 6) / 6; };
  Fall fall;
  Observer observer(fall.assembler, true, {}), alone(fall.assembler, true, {}), half(fall.assembler, true, {});
  for (Observer* o : {&observer, &alone, &half}) {
    o->keep_ends();
    o->observe(with_power(fall, 0), {}, true, false);
  }
  double begin = 0;
  for (const double end : {0.7, 1.2, 2.0}) {
    for (const double part : lobatto_points) {
      const Configuration c = with_power(fall, begin + part * (end - begin));
      observer.observe_inside(c);
      alone.integrate_inside(c);
      if (part < 0.5) half.observe_inside(c);  // no balance was found at the second point
    }
    for (Observer* o : {&observer, &alone, &half}) o->observe(with_power(fall, end), {end - begin, 1, 0}, true, false);
    EXPECT_NEAR(observer.energies().external_work, work(end), 1e-13 * std::abs(work(end)));
    EXPECT_EQ(alone.energies().external_work, observer.energies().external_work);
    EXPECT_NEAR(observer.energies().passed, -work(end), 1e-13 * std::abs(work(end)));
    begin = end;
  }
  EXPECT_NEAR(half.energies().external_work, work(2), 0.05 * std::abs(work(2)));
  EXPECT_GT(std::abs(half.energies().external_work - work(2)), 1e-4 * std::abs(work(2)));
  // between the points the work is that of a cubic of the power
  observer.between(with_power(fall, 1.5));
  const auto column = static_cast<std::size_t>(observer.channel("run", "EXTERNAL_WORK"));
  EXPECT_NEAR(observer.values()[column], work(1.5), 2e-3 * std::abs(work(2)));
}

TEST(Energies, OfAStepWithAnEventAreNotIntegratedAcrossIt) {
  Fall fall;
  Observer observer(fall.assembler, true, {});
  observer.keep_ends();
  observer.observe(with_power(fall, 0), {}, true, false);
  for (const double part : lobatto_points) observer.observe_inside(with_power(fall, part));
  observer.observe(with_power(fall, 3), {1, 1, 1}, true, false);  // the power has jumped
  const double last = lobatto_points[1], rest = 3 - last;
  const double before = -2 * 9.81 * std::pow(last, 6) / 6;
  EXPECT_NEAR(observer.energies().external_work, before - 9.81 * rest * (std::pow(last, 5) + std::pow(3, 5)), 0.3);
}

TEST(Energies, InsideStepsGoOnAfterARestart) {
  Fall fall;
  Observer whole(fall.assembler, true, {}), first(fall.assembler, true, {}), second(fall.assembler, true, {});
  for (Observer* o : {&whole, &first, &second}) o->keep_ends();
  Snapshot snapshot;
  for (int i = 0; i <= 6; ++i) {
    const std::vector<Observer*> on = {&whole, i <= 3 ? &first : &second};
    for (Observer* o : on) {
      if (i > 0 && i != 5)
        for (const double part : lobatto_points) o->observe_inside(with_power(fall, 0.3 * (i - 1 + part)));
      o->observe(with_power(fall, 0.3 * i), {0.3, 1, 0}, true, false);
    }
    if (i != 3) continue;
    first.save(snapshot);
    save_configuration(with_power(fall, 0.9), snapshot);
    second.load(snapshot);
  }
  EXPECT_EQ(whole.values(), second.values());
}

/// A lamp of 3 kg on two springs from supports at (±1, 0, 0).
struct Lamp : Set {
  static constexpr double stiffness = 50;
  Lamp() : Set(make()) {}
  static Bench make() {
    Bench bench({Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0.2, 0, 0)});
    bench.add<LineSpring>("SPRING", 10, 30, stiffness).add<LineSpring>("SPRING", 30, 20, stiffness);
    bench.add<PointMass>("INERTIA", 30, 3.0).support(1).support(2);
    bench.model.gravity.push_back({down, nullptr});
    return bench;
  }
  /// Springs without natural length: 2 k x = m g, whatever the supports.
  Configuration hanging(double time) const {
    Configuration c = at(time);
    c.nodes[3].x = 3 * down / (2 * stiffness);
    return c;
  }
};

TEST(Reactions, CarryTheWeight) {
  Lamp lamp;
  Reactions supports(lamp.assembler);
  EXPECT_EQ(supports.nodes(), (std::vector<int>{1, 2}));
  const std::vector<Reaction> reactions = supports.at(lamp.hanging(0));
  ASSERT_EQ(reactions.size(), 2u);
  const Vec3 sum = reactions[0].force + reactions[1].force;
  EXPECT_LE((sum + 3 * down).norm(), 1e-12);
  EXPECT_NEAR(reactions[0].force[0], -Lamp::stiffness, 1e-12);  // each pulls outwards with k times its span
  EXPECT_NEAR(reactions[1].force[0], Lamp::stiffness, 1e-12);
  EXPECT_LE(reactions[0].torque.norm() + reactions[1].torque.norm(), 1e-12);
}

TEST(StaticWork, OfAMovedSupportIsTheSpringsEnergy) {
  Bench bench({Vec3(0, 0, 0), Vec3(1, 0, 0)});
  bench.add<LineSpring>("SPRING", 10, 20, 7.0).support(1).support(2);
  Set set(std::move(bench));
  Reactions supports(set.assembler);
  const auto pulled = [&](double t) {
    Configuration c = set.at(t);
    c.nodes[2].x = Vec3(1 + t, 2 * t, 0);
    return c;
  };
  const auto energy = [](double t) { return 3.5 * ((1 + t) * (1 + t) + 4 * t * t); };
  EXPECT_NEAR(static_work(set.assembler, supports, pulled(0.5), pulled(2)).mean(), energy(2) - energy(0.5), 1e-10);
  Observer observer(set.assembler, false, {});
  for (const double t : {0.0, 0.5, 2.0}) observer.observe(pulled(t), {0.5, 1, 0}, true, false);
  EXPECT_NEAR(observer.energies().external_work, energy(2) - energy(0), 1e-10);
  EXPECT_LE(observer.energies().largest_error, 1e-10);
}

TEST(Histories, HoldChannelsOfElementsAndNodes) {
  Lamp lamp;
  Observer observer(lamp.assembler, true, {});
  ASSERT_EQ(observer.tables().size(), 3u);
  const Table& springs = observer.tables()[0];
  EXPECT_EQ(springs.path, "element/SPRING");
  EXPECT_EQ(springs.ids, (std::vector<int>{1, 2}));
  EXPECT_EQ(springs.columns(), 4u);
  Configuration c = lamp.hanging(0);
  c.nodes[3].v = Vec3(0, 5, 0);
  observer.observe(c, {0.1, 3, 2}, true, false);
  const auto value = [&](const std::string& owner, const std::string& name) {
    const int column = observer.channel(owner, name);
    return column < 0 ? std::nan("") : observer.values()[static_cast<std::size_t>(column)];
  };
  const double length = std::hypot(1.0, 3 * 9.81 / (2 * Lamp::stiffness));
  EXPECT_DOUBLE_EQ(value("element/1", "LENGTH"), length);
  EXPECT_DOUBLE_EQ(value("element/2", "FORCE"), Lamp::stiffness * length);
  EXPECT_DOUBLE_EQ(value("node/30", "UX"), -0.2);
  EXPECT_DOUBLE_EQ(value("node/30", "VY"), 5);
  EXPECT_DOUBLE_EQ(value("node/10", "FX"), -Lamp::stiffness);
  EXPECT_DOUBLE_EQ(value("run", "ITERATIONS"), 3);
  EXPECT_DOUBLE_EQ(value("run", "EVENTS"), 2);
  EXPECT_EQ(observer.channel("node/30", "FX"), -1);  // nothing holds it
  EXPECT_EQ(observer.channel("element/3", "LENGTH"), -1);
}

TEST(Histories, AreThoseThatAreSelected) {
  Lamp lamp;
  Selection selection;
  selection.all_parts = selection.all_nodes = false;
  selection.parts = {1};
  selection.nodes = {3};
  selection.channels = {"FORCE", "UZ"};
  selection.singles = {{true, 0, "LENGTH"}, {false, 3, "VX"}};
  Observer observer(lamp.assembler, true, selection);
  observer.observe(lamp.hanging(0), {}, true, false);
  EXPECT_GE(observer.channel("element/2", "FORCE"), 0);
  EXPECT_GE(observer.channel("node/30", "UZ"), 0);
  EXPECT_GE(observer.channel("node/30", "VX"), 0);
  const int single = observer.channel("element/1", "LENGTH");
  ASSERT_GE(single, 0);
  EXPECT_GT(observer.values()[static_cast<std::size_t>(single)], 1);
  EXPECT_EQ(observer.channel("element/1", "FORCE"), -1);
  EXPECT_EQ(observer.channel("node/10", "UZ"), -1);
  EXPECT_EQ(observer.values().size(), 4 + run_channels(lamp.assembler.model(), true).size());
}

TEST(Fields, AreGlobalComponents) {
  Lamp lamp;
  Observer observer(lamp.assembler, false, {});
  observer.observe(lamp.hanging(0), {}, false, true);
  std::map<std::string, std::vector<double>> f;
  for (const NodalField& field : observer.fields()) f[field.named.name] = field.rows;
  ASSERT_EQ(f["displacement"].size(), 9u);
  EXPECT_DOUBLE_EQ(f["displacement"][6], -0.2);
  EXPECT_DOUBLE_EQ(f["displacement"][8], -3 * 9.81 / (2 * Lamp::stiffness));
  EXPECT_DOUBLE_EQ(f["reaction_force"][3], Lamp::stiffness);
  EXPECT_EQ(f["reaction_force"][6], 0);
  EXPECT_EQ(f.count("velocity"), 0u);
  EXPECT_EQ(nodal_field_names(true).size(), f.size() + 2);
}

TEST(Fields, OfElementsAreRowsOfTheParts) {
  Bench bench({Vec3(0, 0, 0), Vec3(4, 0, 3)});
  bench.add<PointMass>("INERTIA", 10, 1.0).add<TellingSpring>("SPRING", 10, 20);
  Set set(std::move(bench));
  Observer observer(set.assembler, false, {});
  observer.observe(set.at(0), {}, false, true);
  ASSERT_EQ(observer.element_fields().size(), 2u);
  const ElementField &traction = observer.element_fields()[0], &place = observer.element_fields()[1];
  EXPECT_EQ(traction.named.name, "TRACTION");
  ASSERT_EQ(traction.rows.size(), 6u);
  EXPECT_TRUE(std::isnan(traction.rows[0]));
  EXPECT_EQ(std::vector<double>(traction.rows.begin() + 3, traction.rows.end()), (std::vector<double>{4, 0, 3}));
  EXPECT_EQ(place.rows[1], 2);  // the mean over its points
  EXPECT_EQ(traction.place_count, 0u);
  EXPECT_TRUE(observer.place_parts(0).empty());
  EXPECT_EQ(place.place_count, place.places.size());
  EXPECT_EQ(observer.place_parts(1), (std::vector<int>(place.places.size(), 1)));
  ASSERT_GT(place.places.size(), 1u);
  EXPECT_EQ(std::accumulate(place.places.begin(), place.places.end(), 0.0) / static_cast<double>(place.places.size()), 2);
  EXPECT_NE(place.places[0], place.places[1]);
}

TEST(NotUnique, AreTheForcesOfTwoStaysInOnePlace) {
  Bench bench({Vec3(0, 0, 0)});
  bench.add<PointMass>("INERTIA", 10, 1.0).add<Stay>("STAY", 10).add<Stay>("STAY", 10);
  Set set(std::move(bench));
  Observer observer(set.assembler, false, {});
  Configuration c = set.at(0);
  c.multipliers = {4, 4};
  observer.find_not_unique(c, {});
  EXPECT_TRUE(observer.not_unique().empty());
  observer.find_not_unique(c, {Eigen::Vector2d(1, -1)});
  EXPECT_EQ(observer.not_unique(),
            (std::vector<int>{observer.channel("element/2", "FORCE"), observer.channel("element/3", "FORCE")}));
  Snapshot snapshot;
  observer.observe(c, {}, true, false);
  observer.save(snapshot);
  save_configuration(c, snapshot);
  Observer next(set.assembler, false, {});
  next.load(snapshot);
  EXPECT_EQ(next.not_unique(), observer.not_unique());
}

}  // namespace
}  // namespace engrane::test
