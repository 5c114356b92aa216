// SPDX-License-Identifier: BSD-3-Clause
#include "elements/cams/cam_profile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "elements/cams/cam_motion.hpp"
#include "elements/cams/profiles.hpp"
#include "elements/jets.hpp"
#include "elements/suite.hpp"

namespace engrane::elements::cams {
namespace {

using namespace suite;

using std::numbers::pi;

CamProfile star_profile() {
  const std::vector<double> polar = star();
  std::vector<double> angle, radius;
  for (std::size_t k = 0; k < polar.size(); k += 2) {
    angle.push_back(polar[k] * pi / 180);
    radius.push_back(polar[k + 1]);
  }
  return {polar_curve(angle, radius), 0, false};
}

TEST(CamProfile, NearestAndFarthestOfAll) {
  const CamProfile profile = star_profile();
  Random random(3);
  for (int trial = 0; trial < 60; ++trial) {
    const Vec2 q(uniform(random), uniform(random)), m = Vec2(uniform(random), uniform(random)).normalized();
    double least = 1e9, most = -1e9;
    for (int k = 0; k < 40000; ++k) {
      const Vec2 p = profile.at(2 * pi * k / 40000).p;
      least = std::min(least, (p - q).norm());
      most = std::max(most, p.dot(m));
    }
    const CamFoot near = profile.nearest(q), far = profile.farthest(m);
    EXPECT_NEAR((near.p - q).norm(), least, 1e-7);
    EXPECT_LE((near.p - q).norm(), least + 1e-14);
    EXPECT_NEAR((near.p - q).normalized().dot(near.t), 0, 1e-12);
    EXPECT_NEAR(far.p.dot(m), most, 1e-7);
    EXPECT_GE(far.p.dot(m), most - 1e-14);
    EXPECT_NEAR(far.n.dot(m), 1, 1e-12);
  }
}

TEST(CamProfile, EveryPlaceThatIsTouched) {
  const CamProfile profile = star_profile();
  constexpr int n = 40000;
  std::vector<CamFoot> feet;
  for (int k = 0; k < n; ++k) feet.push_back(profile.at(2 * pi * k / n));
  // all hills of a function of the places; two that have not parted yet are one
  const auto hills = [&](auto value, auto counts) {
    std::vector<double> found;
    std::vector<Vec2> places;
    for (int k = 0; k < n; ++k) {
      const double here = value(feet[k]);
      if (!(here > value(feet[(k + n - 1) % n]) && here >= value(feet[(k + 1) % n]) && here > 0 && counts(feet[k]))) continue;
      const Vec2 p = feet[k].p;
      if (std::any_of(places.begin(), places.end(), [&](const Vec2& other) { return (other - p).norm() < 0.033; })) continue;
      places.push_back(p);
      found.push_back(here);
    }
    std::sort(found.rbegin(), found.rend());
    return found;
  };
  double greatest = 0;
  for (const CamFoot& f : feet) greatest = std::max(greatest, f.p.norm());
  Random random(7);
  std::size_t several = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const double a = pi * uniform(random), out = 0.75 + 0.1 * uniform(random);
    const Vec2 q(out * std::cos(a), out * std::sin(a)), m = Vec2(uniform(random), uniform(random)).normalized();
    const auto depth = [&](const CamFoot& f) { return 1.1 * 0.33 - (f.p - q).norm(); };
    bool vanishing = false;  // a hill so flat that samples may miss it
    const auto under_roller = hills(depth, [&](const CamFoot& f) {
      vanishing = vanishing || std::abs(1 + f.curvature * (q - f.p).dot(f.n)) < 0.15;
      return (q - f.p).dot(f.n) > 0;
    });
    if (vanishing) continue;
    const CamFeet rolled = profile.under_roller(q, 0.33);
    ASSERT_EQ(rolled.count, std::clamp<std::size_t>(under_roller.size(), 1, CamFeet::most));
    for (std::size_t k = 0; k < std::min(rolled.count, under_roller.size()); ++k) {
      EXPECT_NEAR(depth(rolled.feet[k]), under_roller[k], 1e-7);
      EXPECT_NEAR((q - rolled.feet[k].p).dot(rolled.feet[k].t), 0, 1e-13);
    }
    const double distance = 0.5 + 0.1 * uniform(random);
    const auto height = [&](const CamFoot& f) { return f.p.dot(m) - (distance - 0.02 * greatest); };
    const auto under_face = hills(height, [&](const CamFoot& f) { return f.n.dot(m) > 0; });
    const CamFeet faced = profile.under_face(m, distance);
    ASSERT_EQ(faced.count, std::clamp<std::size_t>(under_face.size(), 1, CamFeet::most));
    for (std::size_t k = 0; k < std::min(faced.count, under_face.size()); ++k) {
      EXPECT_NEAR(height(faced.feet[k]), under_face[k], 1e-7);
      EXPECT_NEAR(faced.feet[k].n.dot(m), 1, 1e-12);
    }
    several += (rolled.count > 1) + (faced.count > 1);
  }
  EXPECT_GT(several, 100u);
}

TEST(CamMotion, LawsRiseFromZeroToOne) {
  // greatest speed and acceleration of a unit rise: Norton, Cam Design and Manufacturing Handbook, table 3-2, and in closed form
  const double two = 1.0 / std::sqrt(3.0), three = (5 - std::sqrt(5.0)) / 10;
  struct Case {
    CamLaw law;
    double speed, acceleration, at;
    bool soft;  ///< acceleration zero at the ends
  };
  for (const Case& c : {Case{CamLaw::cycloidal, 2, 2 * pi, 0.25, true},
                        Case{CamLaw::modified_sine, 4 * pi / (4 + pi), 4 * pi * pi / (4 + pi), 0.125, true},
                        Case{CamLaw::poly_345, 1.875, 10 * two, (1 - two) / 2, true},
                        Case{CamLaw::poly_4567, 2.1875, 84 * std::sqrt(5.0) / 25, three, true},
                        Case{CamLaw::harmonic, pi / 2, pi * pi / 2, 0, false}}) {
    const Jet first = unit_rise(c.law, 0), last = unit_rise(c.law, 1);
    EXPECT_NEAR(first.f, 0, 1e-15);
    EXPECT_NEAR(last.f, 1, 1e-14);
    EXPECT_NEAR(first.d1, 0, 1e-14);
    EXPECT_NEAR(last.d1, 0, 1e-13);
    if (c.soft) {
      EXPECT_NEAR(first.d2, 0, 1e-13);
      EXPECT_NEAR(last.d2, 0, 1e-12);
    }
    EXPECT_NEAR(unit_rise(c.law, 0.5).d1, c.speed, 1e-13);
    EXPECT_NEAR(unit_rise(c.law, c.at).d2, c.acceleration, 1e-12);
    for (const double tau : {0.04, 0.3, 0.61, 0.83, 0.97})
      test::expect_jet([&](double x) { return unit_rise(c.law, x); }, tau, 1e-3, 1e-9);
    for (const double border : {0.125, 0.875}) {
      const Jet before = unit_rise(c.law, border - 1e-13), after = unit_rise(c.law, border + 1e-13);
      EXPECT_NEAR(before.f, after.f, 1e-12);
      EXPECT_NEAR(before.d1, after.d1, 1e-11);
      EXPECT_NEAR(before.d2, after.d2, 1e-10);
    }
  }
}

TEST(CamMotion, JointsAreWhereItIsNotSmooth) {
  const double half = pi, third = pi * 2 / 3;
  const auto joints = [](const std::vector<CamMotion::Segment>& segments) { return CamMotion(segments, 0.5).joints(); };
  // one cosine over the whole turn, no lift at all
  EXPECT_TRUE(joints({{half, 0, 1, CamLaw::harmonic}, {half, 1, 0, CamLaw::harmonic}}).empty());
  EXPECT_TRUE(joints({{2 * pi, 0, 0}}).empty());
  EXPECT_EQ(joints({{third, 0, 1, CamLaw::poly_4567}, {third, 1, 0, CamLaw::poly_345}, {third, 0, 0}}).size(), 3u);
  const std::vector<double> found = joints({{third, 0, 1, CamLaw::harmonic}, {third, 1, 0, CamLaw::harmonic}, {third, 0, 0}});
  ASSERT_EQ(found.size(), 2u);  // not between the rise and the fall
  EXPECT_NEAR(found[0], 0.5, 1e-15);
  EXPECT_NEAR(found[1], 0.5 + 2 * third, 1e-14);
}

}  // namespace
}  // namespace engrane::elements::cams
