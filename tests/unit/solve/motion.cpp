// SPDX-License-Identifier: BSD-3-Clause
// Moves from a whole configuration and from what is kept of it.
#include "solve/constraints/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "math/rotation.hpp"

namespace engrane::solve {
namespace {

TEST(Motion, AnOriginServesForItsConfiguration) {
  Model model;
  model.nodes.resize(5);
  const Numbering numbering(model);
  const MotionSlots motion(model, numbering);
  Configuration from = numbering.reference_configuration(3);
  for (std::size_t i = 1; i < from.nodes.size(); ++i) from.nodes[i].x = Vec3(0.1, 7, 1e-3) * static_cast<double>(i);
  from.nodes[2].R = rotation_exp(Vec3(0.3, -0.2, 1.1));
  from.nodes[4].R = rotation_exp(Vec3(-2, 0.1, 0));
  for (std::size_t i = 0; i < from.remainders.size(); ++i) from.remainders[i] = 1e-18 * std::sin(static_cast<double>(i));
  const MotionSlots::Origin origin(from);
  Configuration whole = from, kept = from;
  // moves follow one another and all start anew; nodes 1 and 2 turn in the first only
  for (const double turn : {0.4, 0.0}) {
    std::vector<double> y(motion.size());
    for (std::size_t i = 0; i < y.size(); ++i) {
      const bool turns = i % 6 >= 3, is_early = i / 6 < 3;
      y[i] = std::cos(static_cast<double>(i)) * (turns ? (is_early ? turn : 0.2) : 1e-3);
    }
    motion.move(from, y, whole);
    motion.move(origin, y, kept);
    for (std::size_t i = 0; i < from.nodes.size(); ++i) {
      EXPECT_EQ(kept.nodes[i].x, whole.nodes[i].x);
      EXPECT_EQ(kept.nodes[i].R, whole.nodes[i].R) << "node " << i;
      EXPECT_EQ(kept.nodes[i].T, whole.nodes[i].T);
    }
    EXPECT_EQ(kept.remainders, whole.remainders);
  }
}

}  // namespace
}  // namespace engrane::solve
