// SPDX-License-Identifier: BSD-3-Clause
#include "elements/cams/cam_profile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "elements/cams/profiles.hpp"
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

}  // namespace
}  // namespace engrane::elements::cams
