// SPDX-License-Identifier: BSD-3-Clause
// The motion within a step, against motions that it has without error.
#include "solve/schemes/interpolation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "math/rotation.hpp"

namespace engrane::solve {
namespace {

/// A node whose place is a polynomial of degree four and that turns at a constant speed about an axis, `time` after 2.
Configuration moving(const Numbering& numbering, double time) {
  const Vec3 spin(0.3, -1.1, 0.7);
  Configuration c = numbering.reference_configuration(2 + time);
  NodeState& node = c.nodes[1];
  const double t = time;
  node.x = Vec3(1 + t, 2 * t * t - t * t * t, 5 * t * t * t * t);
  node.v = Vec3(1, 4 * t - 3 * t * t, 20 * t * t * t);
  node.a = Vec3(0, 4 - 6 * t, 60 * t * t);
  node.R = rotation_exp(spin * t);
  node.W = spin;
  return c;
}

TEST(Interpolation, HasPolynomialsOfDegreeFourAndSteadySpinsExactly) {
  Model model;
  model.nodes.resize(2);
  model.nodes[1].id = 1;
  const Numbering numbering(model);
  const MotionSlots motion(model, numbering);
  const Configuration from = moving(numbering, 0.2), to = moving(numbering, 1.4);
  const Interpolation between(motion, from, to);
  for (const double t : {0.2, 0.5, 1.1, 1.4}) {
    Configuration c;
    between.at(2 + t, c);
    const Configuration exact = moving(numbering, t);
    EXPECT_DOUBLE_EQ(c.time, 2 + t);
    EXPECT_LT((c.nodes[1].x - exact.nodes[1].x).norm(), 1e-13);
    EXPECT_LT((c.nodes[1].v - exact.nodes[1].v).norm(), 1e-12);
    EXPECT_LT((c.nodes[1].R - exact.nodes[1].R).norm(), 1e-14);
    EXPECT_LT((c.nodes[1].W - exact.nodes[1].W).norm(), 1e-13);
  }
}

}  // namespace
}  // namespace engrane::solve
