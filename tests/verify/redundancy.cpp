// SPDX-License-Identifier: BSD-3-Clause
// Redundant constraints: found as an independent computation finds them, and without effect on motion and sums of forces.
#include <Eigen/Dense>
#include <cmath>
#include <fstream>

#include "run_deck.hpp"
#include "solve/constraints/mobility.hpp"

namespace engrane::test {

using namespace solve;

namespace {

/// A door with its mass away from the axis, pushed and turned; `second` is a line for what holds it besides HINGE 2.
std::string door(const std::string& second, const std::string& analysis) {
  return std::string(R"(
.NOE
 I 1 X 0.4 0.1 1
.MCE
 I 1 INERTIA N 1 M 20 J 8 4 5
 I 2 HINGE N 0 1 AXIS 0 0 1 AT 0 0 0.2 )") +
         (analysis == "KINEMATIC" ? "DRIVE ANGLE NF 1\n" : "K 30\n") + second +
         R"(
 I 4 TORQUE N 1 AXIS 0 0 1 V 8 NF 1
 I 5 FORCE N 1 DIR 1 2 -3 V 25 NF 1
.CLM
 STRU ACC VAL 0 1 -9.81
.FCT
 I 1 EXPR "T"
.SAM TYPE )" +
         analysis + " PREC 1e-12\n.SUB TF 0.5 H 0.01\n";
}

const char* const second_hinge = " I 3 HINGE N 0 1 AXIS 0 0 1 AT 0 0 1.8";

struct Wrench {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();  ///< about the origin
};

Wrench of_hinge(DeckRun& deck, const Configuration& c, int id, const Vec3& point) {
  Wrench w;
  for (int i = 0; i < 3; ++i) {
    w.force[i] = deck.channel(c, id, std::string("FORCE_") + "XYZ"[i]);
    w.moment[i] = deck.channel(c, id, std::string("MOMENT_") + "XYZ"[i]);
  }
  w.moment += point.cross(w.force);
  return w;
}

class SameAsOneHinge : public ::testing::TestWithParam<std::string> {};

TEST_P(SameAsOneHinge, MotionAndSumsOfForces) {
  const Vec3 lower(0, 0, 0.2), upper(0, 0, 1.8);
  DeckRun one(door("", GetParam())), two(door(second_hinge, GetParam()));
  std::vector<Configuration> expected;
  one.run([&](const Configuration& c, const StepReport&) {
    expected.push_back(c);
    return true;
  });
  EXPECT_FALSE(one.context().redundancy.active());
  std::size_t step = 0;
  two.run([&](const Configuration& c, const StepReport&) {
    const Configuration& e = expected.at(step++);
    const NodeState &a = one.node(e, 1), &b = two.node(c, 1);
    EXPECT_LT((a.x - b.x).norm(), 1e-12) << "t = " << c.time;
    EXPECT_LT((a.R - b.R).norm(), 1e-12);
    EXPECT_LT((a.v - b.v).norm(), 1e-11);
    const Wrench single = of_hinge(one, e, 2, lower), first = of_hinge(two, c, 2, lower), second = of_hinge(two, c, 3, upper);
    const double size = 300;  // newtons, and newton metres at a metre
    EXPECT_LT((single.force - first.force - second.force).norm(), 1e-9 * size) << "t = " << c.time;
    EXPECT_LT((single.moment - first.moment - second.moment).norm(), 1e-9 * size) << "t = " << c.time;
    return true;
  });
  EXPECT_EQ(step, expected.size());
  EXPECT_GT((one.node(expected.back(), 1).x - one.node(expected.front(), 1).x).norm(), 0.01);
  EXPECT_EQ(two.context().redundancy.mobility().redundant(), 5);
  EXPECT_EQ(two.context().redundancy.mobility().freedom(), GetParam() == "KINEMATIC" ? 0 : 1);
}

INSTANTIATE_TEST_SUITE_P(Redundancy, SameAsOneHinge, ::testing::Values("STATIC", "DYNAMIC", "KINEMATIC"),
                         [](const auto& instance) { return instance.param; });

/// The least multipliers of the door by hand: with F and M about the lower hinge known, minimise |F1|² + |F2|² + (|M1|² +
/// |M2|²)/L² under F1 + F2 = F and M1 + M2 + d × F2 = M, by its Lagrange equations.
TEST(Redundancy, SharesAreTheLeast) {
  DeckRun one(door("", "STATIC")), two(door(second_hinge, "STATIC"));
  const Configuration c1 = one.run(), c2 = two.run();
  const Vec3 lower(0, 0, 0.2), upper(0, 0, 1.8);
  const Wrench all = of_hinge(one, c1, 2, lower);
  const Vec3 about_lower = all.moment - lower.cross(all.force);
  const double extent = two.model().extent();
  // unknowns F1 F2 M1 M2 with the moments over L; M about z is free in both
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(5, 10);
  Eigen::VectorXd b(5);
  const double d = 1.6;
  for (int i = 0; i < 3; ++i) a(i, i) = a(i, 3 + i) = 1;
  a(3, 6) = a(3, 8) = a(4, 7) = a(4, 9) = extent;
  a(3, 4) = -d;  // (d e_z × F2)_x
  a(4, 3) = d;
  b << all.force, about_lower[0], about_lower[1];
  const Eigen::VectorXd least = a.completeOrthogonalDecomposition().solve(b);
  for (int i = 0; i < 3; ++i) {
    const std::string name = std::string("FORCE_") + "XYZ"[i];
    EXPECT_NEAR(two.channel(c2, 2, name), least[i], 1e-8);
    EXPECT_NEAR(two.channel(c2, 3, name), least[3 + i], 1e-8);
  }
  EXPECT_NEAR(two.channel(c2, 2, "MOMENT_X"), extent * least[6], 1e-8);
  EXPECT_NEAR(two.channel(c2, 3, "MOMENT_Y"), extent * least[9], 1e-8);
}

/// Rank of the constraints' gradient from differences of Φ and a singular value decomposition: nothing in common with the
/// sparse QR of the elements' tangents.
int rank_by_differences(DeckRun& deck, Configuration c) {
  SolverContext& context = deck.context();
  const Numbering& numbering = context.numbering;
  for (NodeState& node : c.nodes) node.T.setIdentity();
  std::vector<int> slots;
  for (const Unknown& u : numbering.unknowns())
    if (!u.multiplier) slots.push_back(u.slot);
  std::vector<double> plus, minus, rate, second;
  Eigen::MatrixXd gradient(numbering.slots() - numbering.motion_slots(), static_cast<Eigen::Index>(slots.size()));
  const double extent = deck.model().extent(), h = 1e-5;
  for (std::size_t j = 0; j < slots.size(); ++j) {
    const Unknown& u = numbering.unknown(numbering.equation(slots[j]));
    const double size = u.measure == Measure::force || u.measure == Measure::length ? extent : 1.0;
    for (const double sign : {1.0, -1.0}) {
      std::vector<double> y(context.motion.size(), 0.0);
      y[static_cast<std::size_t>(slots[j])] = sign * h * size;
      Configuration moved = c;
      context.motion.move(c, y, moved);
      context.assembler.constraint_rates(moved, sign > 0 ? plus : minus, rate, second);
    }
    for (std::size_t m = 0; m < plus.size(); ++m)
      gradient(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(j)) = (plus[m] - minus[m]) / (2 * h);
  }
  for (Eigen::Index m = 0; m < gradient.rows(); ++m) gradient.row(m).normalize();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(gradient);
  return static_cast<int>((svd.singularValues().array() > 1e-6 * svd.singularValues()[0]).count());
}

std::string deck_text(const std::string& name) {
  std::ifstream file(std::string(ENGRANE_SOURCE_DIR) + "/decks/" + name);
  if (!file) throw std::runtime_error("no deck " + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

class Rank : public ::testing::TestWithParam<const char*> {};

TEST_P(Rank, AgreesWithSingularValuesOfDifferences) {
  DeckRun deck(deck_text(GetParam()));
  Configuration c = deck.context().numbering.reference_configuration(0);
  StartReport report;
  deck.context().start.assemble(c, report);
  const Mobility& mobility = deck.context().redundancy.mobility();
  ASSERT_TRUE(mobility.analysed);
  EXPECT_EQ(mobility.lost_here, 0);
  EXPECT_EQ(mobility.rank, rank_by_differences(deck, c));
  EXPECT_EQ(mobility.dependent.size(), static_cast<std::size_t>(mobility.redundant()));
}

INSTANTIATE_TEST_SUITE_P(Redundancy, Rank,
                         ::testing::Values("mechanisms/door.dat", "mechanisms/bricard.dat", "mechanisms/four_bars_in_line.dat",
                                           "trains/planetary_rigid_teeth.dat", "trains/two_stage_reducer.dat", "gears/bevel.dat"),
                         [](const auto& instance) {
                           std::string name = instance.param;
                           name = name.substr(name.find('/') + 1);
                           return name.substr(0, name.find('.'));
                         });

/// Four bars in one line: the constraints lose a rank there alone, and none of them is to be given up for that.
TEST(Redundancy, DeadPointIsToldFromRedundancy) {
  const auto linkage = [](double degrees) {
    const double x = std::cos(degrees * M_PI / 180), y = std::sin(degrees * M_PI / 180);
    std::ostringstream text;
    text.precision(17);
    text << ".NOE\n I 1 X 0 0 0\n I 2 X " << x << " " << y << " 0\n I 3 X 1 0 0\n.MCE\n"
         << " I 1 INERTIA N 1 M 1 J 1\n I 2 INERTIA N 2 M 1 J 1\n I 3 INERTIA N 3 M 1 J 1\n"
         << " I 11 HINGE N 0 1 AXIS 0 0 1\n I 12 HINGE N 1 2 AXIS 0 0 1 AT " << x << " " << y << " 0\n"
         << " I 13 HINGE N 0 3 AXIS 0 0 1\n I 14 HINGE N 2 3 AXIS 0 0 1 AT " << 1 + x << " " << y << " 0\n"
         << ".SAM TYPE KINEMATIC\n.SUB TF 1 H 0.1\n";
    return text.str();
  };
  for (const double degrees : {90.0, 0.0}) {
    DeckRun deck(linkage(degrees));
    const Configuration c = deck.context().numbering.reference_configuration(0);
    const Mobility mobility = analyse_mobility(deck.context().assembler, deck.context().motion, c, rank_tolerance);
    EXPECT_EQ(mobility.lost_here, degrees == 0 ? 1 : 0);
    EXPECT_EQ(mobility.redundant(), 3) << "a flat loop repeats one force and two moments";
    EXPECT_EQ(mobility.freedom(), 1);
    EXPECT_EQ(rank_by_differences(deck, c), mobility.rank - mobility.lost_here);
  }
}

}  // namespace
}  // namespace engrane::test
