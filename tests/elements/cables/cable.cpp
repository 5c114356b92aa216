// SPDX-License-Identifier: BSD-3-Clause
#include "elements/cables/cable.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "elements/cables/catenary.hpp"
#include "elements/suite.hpp"

namespace engrane::elements::cables {
namespace {

using namespace suite;

const NodeMap places = {{0, Vec3::Zero()}, {1, {1, 0.2, -0.3}}, {2, {-0.5, 0.4, 0.8}}};

Subject subject(const std::string& name, std::array<int, 2> ends, const std::function<void(CableData&)>& fill = {}) {
  Subject s;
  s.name = name;
  s.nodes = places;
  s.length = 0.3;
  s.build = [=](const Mat3& Q) {
    CableData data;
    data.nodes = ends;
    data.stiffness = 40;
    if (fill) fill(data);
    return build(cable_type(), data, turned(places, Q));
  };
  return s;
}

TEST(Cable, Suite) {
  Subject s = subject("slack under its weight", {1, 2}, [](CableData& d) {
    d.mass = 3;
    d.length = 3;
  });
  s.mass = 9;
  s.skip[Check::equilibrium] = "it has weight";
  run_suite(s);
  s = subject("taut under its weight", {2, 0}, [](CableData& d) {
    d.mass = 0.3;
    d.length = 0.3;
  });
  s.skip[Check::zero] = "it is stretched in the reference configuration";
  s.skip[Check::equilibrium] = "it has weight";
  run_suite(s);
  s = subject("a string", {1, 2}, [](CableData& d) { d.tension = 30; });
  s.skip[Check::zero] = s.skip[Check::rigid] = "it is stretched in the reference configuration";
  run_suite(s);
  run_suite(subject("a slack string", {1, 2}, [](CableData& d) { d.length = 9; }));
}

TEST(Cable, Reel) {
  FunctionMap functions;
  functions[1] = std::make_unique<Wave>(0.4, 0.2, 3, 0.5);
  Subject s = subject("a winch", {1, 2});
  s.build = [&](const Mat3& Q) {
    CableData data;
    data.nodes = {1, 2};
    data.stiffness = 40;
    data.function = 1;
    return build(cable_type(), data, turned(places, Q), {.functions = &functions});
  };
  s.skip[Check::zero] = s.skip[Check::rigid] = "it is stretched in the reference configuration";
  run_suite(s);
}

/// The span of a cable by Simpson's rule over its tension.
Vec3 by_quadrature(const Catenary& cable, const Vec3& start) {
  constexpr int pieces = 20000;
  const auto rate = [&](double s) {
    const Vec3 t = start - s * cable.weight;
    return Vec3(t / t.norm() + t / cable.stiffness);
  };
  Vec3 sum = Vec3::Zero();
  const double h = cable.length / pieces;
  for (int i = 0; i < pieces; ++i) sum += h / 6 * (rate(i * h) + 4 * rate((i + 0.5) * h) + rate((i + 1) * h));
  return sum;
}

TEST(Catenary, IsTheIntegralOfItsTension) {
  Catenary cable{10, 1e3, {2, -1, 9}};
  for (const double size : {1.0, 1e-3, 1e-7}) {
    cable.weight = size * Vec3(2, -1, 9);
    for (const Vec3& start : {Vec3(5, 3, 60), Vec3(-30, 2, -40), Vec3(200, 900, 3)})
      EXPECT_LE((cable.shape(start).span - by_quadrature(cable, start)).norm(), 1e-11) << size;
  }
}

/// Spans of every kind: slack and taut, short and long, stiff and soft, above and beside each other.
TEST(Catenary, FindsTheTensionOfAnySpan) {
  Random random(5);
  int cases = 0;
  double worst = 0;
  for (const double EA : {1e1, 1e4, 1e9})
    for (const double q : {1e-9, 1e-3, 1.0, 30.0})
      for (const double distance : {1e-3, 0.3, 0.999, 1.0, 1.001, 1.5})
        for (int i = 0; i < 6; ++i, ++cases) {
          const Catenary cable{10, EA, q * uniform_vector(random).normalized()};
          const Vec3 span = 10 * distance * uniform_vector(random).normalized();
          const Vec3 start = cable.start_tension(span);
          worst = std::max(worst, (cable.shape(start).span - span).norm() / 10);
        }
  EXPECT_LE(worst, 1e-13) << cases << " spans";
}

/// EA = 1e4, 10 N/m, 10 m from the origin to a place.
struct Hanging {
  explicit Hanging(const Vec3& end) : Hanging(NodeMap{{1, Vec3::Zero()}, {2, end}}) {}
  explicit Hanging(const NodeMap& nodes) : cable(build(cable_type(), data(), nodes)), state(*cable, nodes) {
    state.gravity = {0, 0, -5};
  }
  static CableData data() {
    CableData data;
    data.nodes = {1, 2};
    data.stiffness = 1e4;
    data.mass = 2;
    data.length = 10;
    return data;
  }
  double channel(const std::string& name) const { return channel_of(*cable, state, name); }

  std::unique_ptr<Element> cable;
  StateBuffer state;
};

/// On a span of 8 m: horizontal tension and sag.
TEST(Cable, HangsAsACatenary) {
  const Hanging cable({8, 0, 0});
  EXPECT_NEAR(cable.channel("FORCE_AX"), 33.354808620, 5e-10);
  EXPECT_NEAR(cable.channel("FORCE_BX"), -33.354808620, 5e-10);
  EXPECT_NEAR(cable.channel("FORCE_AZ"), -50, 1e-12);
  EXPECT_NEAR(cable.channel("FORCE_BZ"), -50, 1e-12);
  EXPECT_NEAR(cable.channel("SAG"), 2.687462764, 5e-10);
  EXPECT_NEAR(cable.channel("TENSION_A"), std::hypot(33.354808620, 50), 1e-9);
}

/// From one place both halves hang side by side: 5 m and what 25 N per metre stretch them.
TEST(Cable, HangsFromOnePlace) {
  const Hanging cable(Vec3::Zero());
  EXPECT_NEAR(cable.channel("FORCE_AZ"), -50, 1e-4);
  EXPECT_NEAR(cable.channel("SAG"), 5 + 50.0 * 5 / 2 / 1e4, 1e-4);
}

TEST(Cable, FaultsOfTheCard) {
  const NodeMap nodes = {{1, {1, 2, 3}}, {2, {1, 2, 3}}, {3, {1, 2, 4}}};
  FunctionMap functions;
  functions[1] = std::make_unique<Wave>(0.4, 0.2, 3, 0.5);
  const auto message = [&](const CableData& data) {
    Diagnostics diagnostics;
    EXPECT_EQ(build(cable_type(), data, nodes, {.functions = &functions, .diagnostics = &diagnostics}), nullptr);
    return diagnostics.all().empty() ? std::string() : diagnostics.all().front().message;
  };
  CableData data;
  data.stiffness = 1;
  data.nodes = {1, 2};
  EXPECT_EQ(message(data), "both ends of the cable are in one place, and it has no LENGTH");
  data.length = data.tension = 1;
  EXPECT_EQ(message(data), "TENSION beside LENGTH");
  data.tension.reset();
  data.mass = 1;
  data.function = 1;
  EXPECT_EQ(message(data), "a cable whose length changes has no mass: what is reeled in would have to go somewhere");
}

}  // namespace
}  // namespace engrane::elements::cables
