// SPDX-License-Identifier: BSD-3-Clause
// The motion within a step, against motions that it has without error.
#include "solve/schemes/interpolation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "math/rotation.hpp"

namespace engrane::solve {
namespace {

/// A node whose place is a polynomial of degree five and that turns at a constant speed about an axis, `time` after 2.
Configuration moving(const Numbering& numbering, double time) {
  const Vec3 spin(0.3, -1.1, 0.7);
  Configuration c = numbering.reference_configuration(2 + time);
  NodeState& node = c.nodes[1];
  const double t = time;
  node.x = Vec3(1 + t, 2 * t * t - t * t * t, 5 * t * t * t * t * t);
  node.v = Vec3(1, 4 * t - 3 * t * t, 25 * t * t * t * t);
  node.a = Vec3(0, 4 - 6 * t, 100 * t * t * t);
  node.R = rotation_exp(spin * t);
  node.W = spin;
  return c;
}

TEST(Interpolation, HasPolynomialsOfDegreeFiveAndSteadySpinsExactly) {
  Model model;
  model.nodes.resize(2);
  model.nodes[1].id = 1;
  const Numbering numbering(model);
  const MotionSlots motion(model, numbering);
  const Configuration from = moving(numbering, 0.2), to = moving(numbering, 1.4);
  const Interpolation between(motion, from, to, to.scalars);
  Interpolation::Motion m;
  for (const double t : {0.2, 0.5, 1.1, 1.4}) {
    Configuration c;
    between.at(2 + t, m);
    between.place(2 + t, m, c);
    const Configuration exact = moving(numbering, t);
    EXPECT_DOUBLE_EQ(c.time, 2 + t);
    EXPECT_LT((c.nodes[1].x - exact.nodes[1].x).norm(), 1e-13);
    EXPECT_LT((c.nodes[1].v - exact.nodes[1].v).norm(), 1e-12);
    EXPECT_LT((c.nodes[1].R - exact.nodes[1].R).norm(), 1e-14);
    EXPECT_LT((c.nodes[1].W - exact.nodes[1].W).norm(), 1e-13);
    EXPECT_LT((c.nodes[1].a - exact.nodes[1].a).norm(), 1e-11);
    EXPECT_LT((c.nodes[1].A - exact.nodes[1].A).norm(), 1e-12);
  }
}

/// A turn about an axis that itself turns: all terms of the angular acceleration count.
TEST(Interpolation, TurnsOfOrderSix) {
  const auto turning = [](const Numbering& numbering, double t) {
    Configuration c = numbering.reference_configuration(t);
    const Vec3 y(std::sin(t), 0.4 * std::cos(2 * t), t), rate(std::cos(t), -0.8 * std::sin(2 * t), 1),
        second(-std::sin(t), -1.6 * std::cos(2 * t), 0);
    NodeState& node = c.nodes[1];
    node.R = rotation_exp(y);
    node.W = rotation_tangent(y) * rate;
    node.A = rotation_tangent(y) * second + rotation_tangent_rate(y, rate, rate);
    return c;
  };
  Model model;
  model.nodes.resize(2);
  model.nodes[1].id = 1;
  const Numbering numbering(model);
  const MotionSlots motion(model, numbering);
  double before = 0, before_second = 0;
  for (const double h : {0.4, 0.2, 0.1}) {
    const Configuration from = turning(numbering, 0.7), to = turning(numbering, 0.7 + h);
    const Interpolation between(motion, from, to, to.scalars);
    Interpolation::Motion m;
    Configuration c;
    between.at(0.7 + 0.4 * h, m);
    between.place(0.7 + 0.4 * h, m, c);
    const Configuration exact = turning(numbering, 0.7 + 0.4 * h);
    const double off = (c.nodes[1].R - exact.nodes[1].R).norm(), off_second = (c.nodes[1].A - exact.nodes[1].A).norm();
    if (before > 0) {
      EXPECT_GT(std::log2(before / off), 5.7);
      EXPECT_GT(std::log2(before_second / off_second), 3.7);
    }
    before = off;
    before_second = off_second;
  }
  EXPECT_LT(before, 1e-9);
}

}  // namespace
}  // namespace engrane::solve
