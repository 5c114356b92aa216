// SPDX-License-Identifier: BSD-3-Clause
#include "elements/bodies/inertia.hpp"

#include <gtest/gtest.h>

#include "elements/suite.hpp"
#include "math/rotation.hpp"

namespace engrane::elements::bodies {
namespace {

using namespace suite;

/// An inertia whose tensor and offset are turned with the frame.
Subject subject(std::string name, double mass, const Mat3& J, const Vec3& offset) {
  Subject s;
  s.name = std::move(name);
  s.nodes = {{3, {1, 0.2, -0.3}}};
  s.mass = mass;
  s.build = [=](const Mat3& Q) {
    InertiaData data;
    data.node = 3;
    data.mass = mass;
    const Mat3 t = Q * J * Q.transpose();
    if (!J.isZero(0)) data.tensor = {t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(2, 0)};
    const Vec3 o = Q * offset;
    data.offset = {o[0], o[1], o[2]};
    return build(inertia_type(), data, turned(s.nodes, Q));
  };
  s.skip[Check::rigid] = "inertia resists a rigid motion";
  s.skip[Check::equilibrium] = "inertia pushes against space";
  return s;
}

Mat3 tensor() {
  Mat3 J;
  J << 2.1, 0.2, -0.3, 0.2, 1.7, 0.4, -0.3, 0.4, 2.6;
  return J;
}

TEST(Inertia, Suite) {
  run_suite(subject("point mass", 2.5, Mat3::Zero(), Vec3::Zero()));
  run_suite(subject("body", 2.5, tensor(), Vec3::Zero()));
  run_suite(subject("body with offset", 2.5, tensor(), {0.4, -0.3, 0.5}));
  run_suite(subject("mass with offset", 2.5, Mat3::Zero(), {0.4, -0.3, 0.5}));
  run_suite(subject("inertia without mass", 0, tensor(), Vec3::Zero()));
}

TEST(Inertia, Extremes) {
  for (const double mass : {1e-12, 1e15})
    for (const double length : {1e-9, 1e6}) {
      Subject s = subject("extreme", mass, Mat3(mass * length * length * tensor()), Vec3(length, -length, length));
      s.length = s.velocity = length;
      run_extreme(s);
    }
}

TEST(Inertia, AsksOnlyForWhatItNeeds) {
  const auto need = [](const Subject& s) { return s.build(Mat3::Identity())->layout().needs[0]; };
  EXPECT_EQ(need(subject("", 1, Mat3::Zero(), Vec3::Zero())), NodeNeed::translation);
  EXPECT_EQ(need(subject("", 0, tensor(), Vec3::Zero())), NodeNeed::rotation);
  EXPECT_EQ(need(subject("", 1, tensor(), Vec3::Zero())), NodeNeed::both);
  EXPECT_EQ(need(subject("", 1, Mat3::Zero(), Vec3::UnitX())), NodeNeed::both);
}

TEST(Inertia, AboutItsNode) {
  const auto element = subject("", 2, tensor(), {0, 3, 0}).build(Mat3::Identity());
  Mat3 expected = tensor();
  expected(0, 0) += 2 * 9;
  expected(2, 2) += 2 * 9;
  EXPECT_LT((element->inertia_at(3) - expected).norm(), 1e-14);
  EXPECT_TRUE(element->inertia_at(4).isZero(0));
}

TEST(Inertia, EulerEquations) {
  // J dW/dt + W × JW of a body with principal axes, written out
  const auto element = subject("", 1, Mat3(Vec3(1, 2, 3).asDiagonal()), Vec3::Zero()).build(Mat3::Identity());
  StateBuffer state(*element, {{3, Vec3::Zero()}});
  state.turn(0, rotation_exp({1, 2, 3}), Vec3::Zero());
  state.nodes[0].W = {0.5, 0.7, 1.1};
  state.nodes[0].A = {0.1, 0.2, 0.3};
  const auto r = residual_of(*element, state);
  EXPECT_NEAR(r[3], 1 * 0.1 + (3 - 2) * 0.7 * 1.1, 1e-15);
  EXPECT_NEAR(r[4], 2 * 0.2 + (1 - 3) * 1.1 * 0.5, 1e-15);
  EXPECT_NEAR(r[5], 3 * 0.3 + (2 - 1) * 0.5 * 0.7, 1e-15);
}

TEST(Inertia, DrawnAsADisc) {
  InertiaData data;
  data.node = 3;
  data.mass = 1;
  data.tensor = {3, 2, 2};
  data.axes = {0, 0, 2, 1, 0, 0};
  data.offset = {1, 0, 0};
  const auto drawing = [&] { return build(inertia_type(), data, {{3, {1, 0.5, 0}}})->drawing(); };
  EXPECT_EQ(drawing(), Drawing{R"("shape": "mass", "node": 3)"});
  data.outer = 0.5;
  data.width = 0.125;
  EXPECT_EQ(
      drawing(),
      Drawing{
          R"("shape": "disc", "node": 3, "center": [2, 0.5, 0], "axis": [0, 0, 1], "outer": 0.5, "inner": 0, "width": 0.125)"});
  data.axis = {0, 2, 0};
  EXPECT_NE(drawing().front().find(R"("axis": [0, 1, 0])"), std::string::npos);
}

TEST(Inertia, FaultsOfTheCard) {
  const NodeMap nodes = {{3, Vec3::Zero()}};
  const auto faults = [&](const InertiaData& data) {
    Diagnostics diagnostics;
    build(inertia_type(), data, nodes, {.diagnostics = &diagnostics});
    return std::pair(diagnostics.errors(), diagnostics.warnings());
  };
  using Count = std::pair<int, int>;
  InertiaData data;
  data.node = 3;
  EXPECT_EQ(faults(data), Count(1, 0)) << "nothing given";
  data.mass = 1;
  EXPECT_EQ(faults(data), Count(0, 0));
  data.tensor = {1, 2};
  EXPECT_EQ(faults(data), Count(1, 0)) << "two values";
  data.tensor = {1, 2, 4};
  EXPECT_EQ(faults(data), Count(0, 1)) << "triangle inequality";
  data.tensor = {1, 2, 3};
  EXPECT_EQ(faults(data), Count(0, 0)) << "a flat body";
  data.tensor = {0, 0, 3};
  EXPECT_EQ(faults(data), Count(0, 0)) << "a rotor given by its polar moment";
  data.tensor = {1, 1, 1, 2, 0, 0};
  EXPECT_EQ(faults(data), Count(1, 0)) << "negative principal moment";
  data.tensor = {1, 2, 2};
  data.offset = {2, 0, 0};
  data.about = {0, 0, 0};
  EXPECT_EQ(faults(data), Count(1, 0)) << "less than m a2 about the node";
  data.tensor = {1, 5, 5};
  EXPECT_EQ(faults(data), Count(0, 0));
}

}  // namespace
}  // namespace engrane::elements::bodies
