// SPDX-License-Identifier: BSD-3-Clause
#include "elements/beams/beam.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "deck/cards/profile_card.hpp"
#include "elements/beams/beam_piece.hpp"
#include "elements/common/building.hpp"
#include "elements/structural/deck_model.hpp"
#include "elements/suite.hpp"
#include "math/chain.hpp"
#include "math/matrix6.hpp"
#include "math/rotation.hpp"
#include "math/rotation_series.hpp"

namespace engrane::elements::beams {
namespace {

using namespace suite;

const NodeMap bow = {{1, {0, 0, 0}}, {2, {0.9, 0.3, -0.2}}, {3, {1.6, 0.9, 0.1}}};

/// The sections of a deck: 1, and 20, which is 1.5 times that.
std::vector<deck::Record> sections(const deck::ProfileCard& profile) {
  std::vector<deck::Record> records(2);
  deck::ProfileCard other = profile;
  for (auto* value : {&other.stretching, &other.twisting, &other.mass})
    if (*value) **value *= 1.5;
  for (auto* pair : {&other.shearing, &other.bending})
    if (*pair)
      for (double& value : **pair) value *= 1.5;
  for (auto* list : {&other.stiffness, &other.inertia})
    for (double& value : *list) value *= 1.5;
  records[0].id = 1;
  records[0].data = profile;
  records[1].id = 20;
  records[1].data = other;
  return records;
}

deck::ProfileCard round_section() {
  deck::ProfileCard p;
  p.stretching = 50;
  p.shearing = {{20, 20}};
  p.twisting = 8;
  p.bending = {{10, 10}};
  p.mass = 3;
  p.inertia = {0.4, 0.2, 0.2};
  return p;
}

/// Every strain makes every force, and the mass is beside the line of the nodes.
deck::ProfileCard coupled_section() {
  Mat6 L = Mat6::Zero();
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = 0; j <= i; ++j)
      L(i, j) = i == j ? 3 + 0.2 * static_cast<double>(i) : std::sin(1.0 + static_cast<double>(3 * i + j));
  const Mat6 m = L * L.transpose();
  deck::ProfileCard p;
  for (Eigen::Index i = 0; i < 6; ++i)
    for (Eigen::Index j = i; j < 6; ++j) p.stiffness.push_back(m(i, j));
  p.mass = 2;
  p.inertia = {0.4, 0.3, 0.1};
  p.center = {{0.1, -0.2}};
  return p;
}

std::array<double, 3> list(const Vec3& v) { return {v[0], v[1], v[2]}; }

Subject subject(
    std::vector<int> nodes, const deck::ProfileCard& profile, double damping = 0,
    const std::function<void(BeamData&)>& more = [](BeamData&) {}) {
  Subject s;
  s.name = std::to_string(nodes.size()) + " nodes, " + (profile.stiffness.empty() ? "round" : "coupled") +
           (damping > 0 ? ", damped" : "");
  for (const int id : nodes) s.nodes[id] = bow.at(id);
  const auto data = [=](const Mat3& Q) {
    BeamData beam;
    beam.nodes = nodes;
    beam.profile = 1;
    beam.axis_2 = list(Q * Vec3(-0.2, 0.3, 1));
    beam.damping = damping;
    more(beam);
    if (beam.axis_2_end) beam.axis_2_end = list(Q * to_vector(*beam.axis_2_end));
    return beam;
  };
  const auto made = [=](const BeamData& beam, const Mat3& Q) {
    const std::vector<deck::Record> records = sections(profile);
    return build(beam_type(), beam, turned(bow, Q), {.records = &records});
  };
  s.build = [=](const Mat3& Q) { return made(data(Q), Q); };
  if (profile.stiffness.empty())
    s.build_swapped = [=] {
      BeamData beam = data(Mat3::Identity());
      std::reverse(beam.nodes.begin(), beam.nodes.end());
      return made(beam, Mat3::Identity());
    };
  s.turn = 0.6;  // of each node, so that the relative rotation stays below 2
  s.step = 1e-4;
  s.tolerance = 1e-7;
  if (damping > 0) s.skip[Check::lagrange] = "a damper has no potential";
  if (profile.mass) {
    s.skip[Check::rigid] = "inertia resists a rigid motion";
    s.skip[Check::equilibrium] = "inertia pushes against space";
  }
  return s;
}

deck::ProfileCard massless(deck::ProfileCard profile) {
  profile.mass.reset();
  profile.inertia.clear();
  profile.center.reset();
  return profile;
}

TEST(Beam, Suite) {
  for (const std::vector<int>& nodes : {std::vector{1, 2, 3}, std::vector{1, 3}})
    for (const deck::ProfileCard& profile : {round_section(), coupled_section()})
      for (const double damping : {0.0, 0.3})
        for (const bool heavy : {true, false}) {
          Subject s = subject(nodes, heavy ? profile : massless(profile), damping);
          // an arc through three points, by three points of Gauss
          if (heavy && nodes.size() == 2) s.mass = *profile.mass * (bow.at(3) - bow.at(1)).norm();
          run_suite(s);
        }
}

/// The tangent in closed form is that of dual numbers, whatever the turns between nodes and the parameters of rotations.
template <int Nodes>
void expect_closed_form(const std::vector<int>& ids, const deck::ProfileCard& profile, double damping, double turn) {
  const Subject s = subject(ids, profile, damping);
  const auto element = s.build(Mat3::Identity());
  StateBuffer state(*element, s.nodes);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const auto n = static_cast<double>(i);
    NodeState& node = state.nodes[i];
    node.x += turn * Vec3(0.1 * n, -0.2, 0.3 * n * n);
    node.R = rotation_exp(Vec3(2.0, -1.0, 0.5)) * rotation_exp(turn * Vec3(0.2, 0.8, -0.5) * (n - 1));
    node.T = rotation_tangent(Vec3(0.3, -0.2, 0.1 * n));
    node.v = Vec3(n, 2, -1);
    node.W = Vec3(1, -n, 0.5);
    node.a = Vec3(-3, n, 1);
    node.A = Vec3(n, 2, -n);
  }
  const auto& member = dynamic_cast<const BlockMember&>(*element);
  const auto& block = dynamic_cast<const Beams<Nodes, false>&>(member.block());
  constexpr std::size_t n = 6 * Nodes;
  const State view = state.view();
  std::vector<double> r(n), k(n * n), dual_r(n), dual_k(n * n);
  const Weights weights{0.7, 3.0, 11.0, 1.0};
  block.tangent(member.index(), {&view, 1}, weights, r, k);
  block.BeamSweep<Nodes>::tangent(member.index(), {&view, 1}, weights, dual_r, dual_k);
  const auto largest = [](const std::vector<double>& of) {
    return std::abs(*std::max_element(of.begin(), of.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  };
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(r[i], dual_r[i], 1e-14 * largest(dual_r)) << i;
  for (std::size_t i = 0; i < n * n; ++i) EXPECT_NEAR(k[i], dual_k[i], 2e-14 * largest(dual_k)) << i / n << ' ' << i % n;
}

TEST(Beam, ClosedForm) {
  for (const double turn : {0.0, 1e-9, 1e-4, 0.1, 0.25, 0.7, 1.8})
    for (const double damping : {0.0, 0.3})
      for (const deck::ProfileCard& profile : {round_section(), coupled_section()}) {
        SCOPED_TRACE(fmt::format("turn {}, damping {}", turn, damping));
        expect_closed_form<3>({1, 2, 3}, profile, damping, turn);
        expect_closed_form<2>({1, 3}, profile, damping, turn);
      }
}

/// A bar off the line of the nodes, of a material that expands.
std::vector<deck::Record> warm_records() {
  deck::ProfileCard profile;
  profile.shape = {"RECTANGLE", {0.3, 0.2}};
  profile.offset = {{0.05, 0.1}};
  std::vector<deck::Record> records = sections(profile);
  deck::MaterialCard material;
  material.young = {900};
  material.poisson = {0.25};
  material.density = 30;
  material.expansion = {0.01};
  records.emplace_back();
  records.back().id = 1;
  records.back().data = material;
  return records;
}

std::unique_ptr<Element> warm_beam(const std::vector<int>& nodes, double damping, bool unshearable, const NodeMap& places,
                                   const Vec3& side, const Temperatures& temperatures) {
  static const std::vector<deck::Record> records = warm_records();
  BeamData beam;
  beam.nodes = nodes;
  beam.profile = beam.material = 1;
  beam.axis_2 = list(side);
  beam.damping = damping;
  beam.unshearable = unshearable;
  return build(beam_type(), beam, places, {.records = &records, .temperatures = &temperatures});
}

/// With temperatures that differ from node to node and change with time.
TEST(Beam, Warm) {
  static const Wave wave(0.3, 0.7, 1.9, 0.4);
  static const Temperatures temperatures = {{1, {9, &wave}}, {3, {14, nullptr}}};
  for (const std::vector<int>& nodes : {std::vector{1, 2, 3}, std::vector{1, 3}})
    for (const double damping : {0.0, 0.3})
      for (const bool unshearable : {false, true}) {
        Subject s;
        s.name = fmt::format("{} nodes, warm, damping {}, unshearable {}", nodes.size(), damping, unshearable);
        for (const int id : nodes) s.nodes[id] = bow.at(id);
        s.build = [=](const Mat3& Q) {
          return warm_beam(nodes, damping, unshearable, turned(bow, Q), Q * Vec3(-0.2, 0.3, 1), temperatures);
        };
        s.turn = 0.6;
        s.step = 1e-4;
        s.tolerance = 1e-7;
        for (const Check check : {Check::rigid, Check::zero}) s.skip[check] = "warmth has forces at rest";
        s.skip[Check::equilibrium] = "inertia pushes against space";
        if (damping > 0) s.skip[Check::lagrange] = "a damper has no potential";
        run_suite(s);
      }
}

/// A curved beam of even temperature grows in all directions, freely, and turned as well.
TEST(Beam, WarmAndFree) {
  const Temperatures temperatures = {{1, {14}}, {2, {14}}, {3, {14}}};
  const auto beam = warm_beam({1, 2, 3}, 0, false, bow, {-0.2, 0.3, 1}, temperatures);
  StateBuffer state(*beam, bow);
  const auto largest = [&] {
    double most = 0;
    for (const double r : residual_of(*beam, state)) most = std::max(most, std::abs(r));
    return most;
  };
  EXPECT_GT(largest(), 1);
  const Mat3 turn = rotation_exp(Vec3(0.7, -1.1, 2));
  for (NodeState& node : state.nodes) {
    node.x = Vec3(1, 2, 3) + 1.14 * (turn * node.x);
    node.R = turn;
  }
  EXPECT_LT(largest(), 1e-13);
}

/// Strains that are held, each alone and together, also of a section that couples them.
TEST(Beam, Held) {
  for (const std::vector<int>& nodes : {std::vector{1, 2, 3}, std::vector{1, 3}})
    for (const deck::ProfileCard& profile : {massless(round_section()), massless(coupled_section())})
      for (const double damping : {0.0, 0.3})
        for (const int which : {1, 2, 3}) {
          Subject s = subject(nodes, profile, damping, [which](BeamData& beam) {
            beam.inextensible = (which & 1) != 0;
            beam.unshearable = (which & 2) != 0;
          });
          s.name += ", held " + std::to_string(which);
          s.skip[Check::swap] = "multipliers stand in the order of the points, and in their axes";
          run_suite(s);
        }
}

/// Beams among cells, with small displacements: as a frame that turns far shows, forces and moments in space are linear.
TEST(Beam, Small) {
  for (const std::string line : {"1 -2 3", "1 3"}) {
    Subject s;
    s.name = "small, " + line;
    const bool three = line.size() > 3;
    for (const auto& [id, place] : bow)
      if (three || id != 2) s.nodes[id] = place;
    s.build = [=, nodes = s.nodes](const Mat3& Q) {
      std::string text = ".NOE\n";
      for (const auto& [id, place] : turned(nodes, Q))
        text += fmt::format(" I {} X {} {} {}\n", id, place[0], place[1], place[2]);
      const Vec3 side = Q * Vec3(-0.2, 0.3, 1);
      text +=
          fmt::format(".BPR\n I 1 EA 50 GA 20 30 GJ 8 EI 10 12\n.MAI\n I 1 N {}\n.HYP BEAM\n.AEL\n I 1 BPR 1 AXIS2 {} {} {}\n",
                      line, side[0], side[1], side[2]);
      DeckModel deck(text + ".SAM TYPE STATIC DISPLACEMENTS SMALL\n.FIN 1\n");
      return std::move(deck.model.parts.at(0).element);
    };
    s.turn = 0.6;
    for (const Check check : {Check::lagrange, Check::power, Check::rigid, Check::objectivity, Check::equilibrium})
      s.skip[check] = "rotations and displacements are small";
    run_suite(s);
    const auto element = s.build(Mat3::Identity());
    EXPECT_TRUE(element->is_linear());
    StateBuffer state(*element, s.nodes);
    const std::size_t last = s.nodes.size() - 1;
    const Vec3 shift(0.1, -0.2, 0.15), turn(0.3, 0.4, -0.2);
    std::vector<std::vector<double>> forces;
    for (const double size : {1.0, 2.0}) {
      state.nodes[last].x = bow.at(3) + size * shift;
      state.turn(last, rotation_exp(size * turn), Vec3::Zero());
      forces.push_back(residual_of(*element, state));
      Vec3 moment(&forces.back()[6 * last + 3]);
      moment = state.nodes[last].R * moment;
      std::copy(moment.data(), moment.data() + 3, &forces.back()[6 * last + 3]);
    }
    for (std::size_t i = 0; i < forces[0].size(); ++i) EXPECT_NEAR(2 * forces[0][i], forces[1][i], 1e-12) << i;
  }
}

TEST(Beam, SectionsThatChange) {
  for (const std::vector<int>& nodes : {std::vector{1, 2, 3}, std::vector{1, 3}})
    for (const bool heavy : {true, false}) {
      const deck::ProfileCard profile = heavy ? coupled_section() : massless(coupled_section());
      Subject s = subject(nodes, profile, 0, [](BeamData& beam) {
        beam.profile_end = 20;
        beam.axis_2_end = list(Vec3(1, 0.4, 0.3));
      });
      if (heavy) s.skip[Check::mass] = "told by tests of shafts";
      run_suite(s);
    }
}

/// Half a beam of two pieces with sections and axes that change is that of a beam of one.
TEST(Beam, ChangeAlongTheLine) {
  const NodeMap straight = {{1, {0, 0, 0}}, {2, {0.5, 0, 0}}, {3, {1, 0, 0}}, {4, {1.5, 0, 0}}, {5, {2, 0, 0}}};
  const std::vector<deck::Record> records = sections(massless(coupled_section()));
  BeamData data;
  data.nodes = {1, 2, 3, 4, 5};
  data.profile = 1;
  data.profile_end = 20;
  data.axis_2 = {{0, 1, 0}};
  data.axis_2_end = {{0, 0, 2}};
  const auto first = build(beam_type(), data, straight, {.records = &records});
  std::vector<deck::Record> half = records;
  deck::ProfileCard middle = *records[1].get<deck::ProfileCard>();
  for (double& value : middle.stiffness) value *= 1.25 / 1.5;
  half[1].data = middle;
  data.nodes = {1, 2, 3};
  data.axis_2_end = {{0, 3, 3}};
  const auto alone = build(beam_type(), data, straight, {.records = &half});
  StateBuffer state(*first, {{1, {0, 0, 0}}, {2, {0.5, 0.1, 0}}, {3, {1, 0, 0.1}}});
  const std::vector<double> a = residual_of(*first, state), b = residual_of(*alone, state);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-13);
}

TEST(Beam, SoftAndStiff) {
  for (const double size : {1e-6, 1e12}) {
    deck::ProfileCard profile = massless(coupled_section());
    for (double& value : profile.stiffness) value *= size;
    run_suite(subject({1, 2, 3}, profile));
  }
}

/// exp(ψ), T(ψ) and its slope, from the functions φ_n and from other formulas.
TEST(Beam, RotationSeries) {
  for (const double a : {0.0, 1e-9, 1e-4, 0.1, 0.9, 1.7, 2.5, 3.1}) {
    const RotationSeries<double> f(a * a);
    const long double x = a;
    if (a > 0.05) {
      EXPECT_NEAR(f.f1, static_cast<double>(std::sin(x) / x), 1e-15);
      EXPECT_NEAR(f.f2, static_cast<double>((1 - std::cos(x)) / (x * x)), 1e-15);
      EXPECT_NEAR(f.f3, static_cast<double>((x - std::sin(x)) / (x * x * x)), 1e-15);
    }
    const Vec3 psi = a * Vec3(2, -3, 6) / 7;
    Mat3 hat;
    hat << 0, -psi[2], psi[1], psi[2], 0, -psi[0], -psi[1], psi[0], 0;
    EXPECT_LE((Mat3::Identity() + f.f1 * hat + f.f2 * hat * hat - rotation_exp(psi)).norm(), 2e-15) << a;
    EXPECT_LE((Mat3::Identity() - f.f2 * hat + f.f3 * hat * hat - rotation_tangent(psi)).norm(), 2e-15) << a;
    const double u = a * a + 0.3, h = 1e-3;
    const auto slope = [&](double RotationSeries<double>::*of) {
      const auto at = [&](int k) { return RotationSeries<double>(u + k * h).*of; };
      return (45 * (at(1) - at(-1)) - 9 * (at(2) - at(-2)) + at(3) - at(-3)) / (60 * h);
    };
    const RotationSeries<double> here(u);
    EXPECT_NEAR(here.f2_slope, slope(&RotationSeries<double>::f2), 1e-13);
    EXPECT_NEAR(here.f3_slope, slope(&RotationSeries<double>::f3), 1e-13);
    const RotationSeries<Dual<1>> dual([u] {
      Dual<1> d(u);
      d.d[0] = 1;
      return d;
    }());
    EXPECT_NEAR(dual.f2.d[0], here.f2_slope, 1e-16);
    EXPECT_NEAR(dual.f2_slope.d[0], slope(&RotationSeries<double>::f2_slope), 1e-13);
    EXPECT_NEAR(dual.f3_slope.d[0], slope(&RotationSeries<double>::f3_slope), 1e-13);
  }
}

/// A beam that is bent, twisted, sheared and pulled evenly is a helix: section moments are exact; forces are those of a parabola
/// through its nodes, which at the points of Gauss has the slope of the helix up to the third power of the length.
TEST(Beam, EvenStrain) {
  const std::vector<deck::Record> records = sections(round_section());
  BeamData data;
  data.nodes = {1, 2, 3};
  data.profile = 1;
  data.axis_2 = {{0, 1, 0}};
  const Vec3 k(0.3, -0.4, 0.5), gamma(1.02, 0.01, -0.03);
  const Vec3 force(50 * (gamma[0] - 1), 20 * gamma[1], 20 * gamma[2]), moment(8 * k[0], 10 * k[1], 10 * k[2]);
  std::vector<double> errors;
  for (const double length : {1.0, 0.5}) {
    const NodeMap straight = {{1, {0, 0, 0}}, {2, {length / 2, 0, 0}}, {3, {length, 0, 0}}};
    const auto beam = build(beam_type(), data, straight, {.records = &records});
    StateBuffer state(*beam, straight);
    std::size_t i = 0;
    for (const auto& [id, place] : straight) {
      const double s = place[0];
      state.turn(i, rotation_exp(k * s), Vec3::Zero());
      state.nodes[i++].x = s * rotation_tangent(-k * s) * gamma;  // ∫ exp(k s) ds γ
    }
    std::vector<double> fields(16);
    beam->evaluate_fields(state.view(), fields);
    errors.push_back(0);
    for (std::size_t p = 0; p < 2; ++p) {
      errors.back() = std::max(errors.back(), (Vec3(&fields[3 * p]) - force).norm());
      EXPECT_LE((Vec3(&fields[6 + 3 * p]) - moment).norm(), 1e-14 * moment.norm());
    }
  }
  EXPECT_GT(errors[0], 1e-6);
  EXPECT_GT(errors[0] / errors[1], 7.5);
}

/// A bent and twisted piece that is turned 10^4 times in 6·10^4 parts about an axis across space keeps its forces.
TEST(Beam, TenThousandTurns) {
  const std::vector<deck::Record> records = sections(coupled_section());
  BeamData data;
  data.nodes = {1, 2, 3};
  data.profile = 1;
  data.axis_2 = {{0, 0, 1}};
  const auto beam = build(beam_type(), data, bow, {.records = &records});
  StateBuffer state(*beam, bow);
  const std::array<Vec3, 3> bend = {Vec3(0.2, -0.5, 0.1), Vec3(0.3, 0.2, 0.6), Vec3(-0.4, 0.9, 0.2)};
  std::array<Mat3, 3> turns;
  for (std::size_t i = 0; i < 3; ++i) turns[i] = rotation_exp(bend[i]);
  const auto fields = [&] {
    for (std::size_t i = 0; i < 3; ++i) state.turn(i, turns[i], Vec3::Zero());
    std::vector<double> values(16);
    beam->evaluate_fields(state.view(), values);
    return values;
  };
  const std::vector<double> first = fields();
  constexpr int parts = 60000;
  const Mat3 part = rotation_exp(2 * std::acos(-1.0) * 1e4 / parts * Vec3(1, 2, -2) / 3);
  for (int k = 0; k < parts; ++k)
    for (std::size_t i = 0; i < 3; ++i) {
      turns[i] = part * turns[i];
      state.nodes[i].x = part * state.nodes[i].x;
    }
  const std::vector<double> last = fields();
  for (std::size_t i = 0; i < 12; ++i) EXPECT_NEAR(last[i], first[i], 1e-10 * std::abs(first[i])) << i;
}

TEST(Beam, FaultsOfTheCard) {
  const std::vector<deck::Record> records = sections(coupled_section());
  const auto message = [&](const BeamData& data) {
    Diagnostics diagnostics;
    EXPECT_EQ(build(beam_type(), data, {{1, {0, 0, 0}}, {2, {0.5, 0, 0}}, {3, {1, 0, 0}}, {4, {2, 0, 0}}},
                    {.diagnostics = &diagnostics, .records = &records}),
              nullptr);
    return diagnostics.all().empty() ? std::string() : diagnostics.all().front().message;
  };
  BeamData data;
  data.nodes = {1, 2, 3, 4};
  data.profile = 1;
  EXPECT_EQ(message(data), "4 nodes: pieces have three, and share their ends");
  data.nodes = {1, 2, 2};
  EXPECT_EQ(message(data), "node 2 stands twice in turn");
  data.nodes = {1, 2, 3};
  EXPECT_EQ(message(data), "beam 1 has a section that is not round, and no AXIS2");
  data.axis_2 = {{3, 0, 0}};
  EXPECT_EQ(message(data), "AXIS2 is along beam 1");
  data.axis_2 = {{0, 1, 0}};
  data.nodes = {1, 4, 2};
  EXPECT_EQ(message(data), "the line is folded, or has no length, at node 4");
  data.nodes = {1, 2, 3};
  data.material = 3;
  EXPECT_EQ(message(data), "section 1 has a stiffness of its own: MAT means nothing");
  data.profile = 7;
  EXPECT_EQ(message(data), "section 7 does not exist");
  data.profile = 1;
  data.material = 0;
  data.profile_end = 7;
  EXPECT_EQ(message(data), "section 7 does not exist");
  data.profile_end = 20;
  data.axis_2_end = {{1, 0, 0}};
  EXPECT_EQ(message(data), "AXIS2_END is along beam 1");
}

std::string deck_of_beam(const std::string& keywords) {
  return R"(.NOE
 I 1 X 0 0 0
 I 5 X 0.3 0.4 0
 I 7 X 0.6 0.8 0
.BPR
 I 1 EA 1D3 GA 1D3 1D3 GJ 1 EI 1 1
.MCE
 I 4 BEAM N 1 5 7 BPR 1 )" +
         keywords + "\n.FIN 1\n";
}

/// The elements of a beam with these keywords: their types, numbers and nodes.
std::vector<std::string> released(const std::string& keywords, std::optional<Vec3>* made = nullptr) {
  const DeckModel deck(deck_of_beam(keywords));
  std::vector<std::string> parts;
  for (const Model::Part& part : deck.model.parts) {
    parts.push_back(part.type + " " + std::to_string(part.element->id()));
    for (const int node : part.element->node_ids()) parts.back() += " " + std::to_string(node);
  }
  if (made) *made = deck.nodes().at(8);
  return parts;
}

TEST(Beam, Releases) {
  using Parts = std::vector<std::string>;
  std::optional<Vec3> made;
  EXPECT_EQ(released("AXIS2 0 0 1 RELEASE_B 6", &made), (Parts{"BEAM 4 1 5 8", "HINGE 5 8 7"}));
  EXPECT_EQ(*made, Vec3(0.6, 0.8, 0));
  EXPECT_EQ(released("AXIS2 0 0 1 RELEASE_A 6 RELEASE_B 5 6"), (Parts{"BEAM 4 8 5 9", "HINGE 5 8 1", "UNIVERSAL 6 9 7"}));
  for (const auto& [components, joint] : std::vector<std::pair<std::string, std::string>>{{"4", "HINGE"},
                                                                                          {"5", "HINGE"},
                                                                                          {"4 6", "UNIVERSAL"},
                                                                                          {"4 5", "UNIVERSAL"},
                                                                                          {"4 5 6", "SPHERICAL"},
                                                                                          {"1", "PRISMATIC"},
                                                                                          {"3", "PRISMATIC"},
                                                                                          {"2 5", "CYLINDRICAL"},
                                                                                          {"1 4 5 6", "POINT_LINE"},
                                                                                          {"2 3 4", "PLANAR"},
                                                                                          {"1 3 5", "PLANAR"},
                                                                                          {"1 2 4 5 6", "POINT_PLANE"}})
    EXPECT_EQ(released("AXIS2 0 0 1 RELEASE_A " + components).back(), joint + " 5 8 1") << components;
  EXPECT_EQ(released("RELEASE_A 5 6").back(), "UNIVERSAL 5 8 1") << "a round beam needs no AXIS2 for both";
}

/// Of small motions of the end of the beam, along and about the axes of its section, the joint holds all but the released ones.
TEST(Beam, ReleasesAreAboutTheAxesOfTheSection) {
  for (const std::string components : {"1", "2", "3", "4", "5", "6", "5 6", "4 6", "1 2 6", "2 4 5 6", "1 3 4 5 6"}) {
    const DeckModel deck(deck_of_beam("AXIS2 0 0 1 AXIS2_END -0.8 0.6 0 RELEASE_B " + components));
    const Element& joint = *deck.model.parts.back().element;
    // of the section at the last node: the beam is twisted by a right angle
    Mat3 axes;
    axes << Vec3(0.6, 0.8, 0), Vec3(-0.8, 0.6, 0), Vec3(0, 0, 1);
    for (int k = 0; k < 6; ++k) {
      StateBuffer state(joint, {{8, {0.6, 0.8, 0}}, {7, {0.6, 0.8, 0}}});
      const Vec3 e = 1e-6 * axes.col(k % 3);
      if (k < 3)
        state.nodes[0].x += e;
      else
        state.turn(0, rotation_exp(e), Vec3::Zero());
      const auto r = residual_of(joint, state);
      double gap = 0;
      for (std::size_t i = r.size() - joint.layout().multipliers.size(); i < r.size(); ++i) gap = std::max(gap, std::abs(r[i]));
      const bool is_free = components.find(std::to_string(k + 1)) != std::string::npos;
      EXPECT_EQ(gap < 1e-9, is_free) << components << " moved along " << k + 1;
    }
  }
}

}  // namespace
}  // namespace engrane::elements::beams
