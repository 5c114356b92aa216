// SPDX-License-Identifier: BSD-3-Clause
// Profile shift: published pairs to their digits, closed forms, and every closing combination of Z, X, module, helix and
// distance.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "elements/gears/profile_shift.hpp"
#include "gear_deck.hpp"

namespace engrane {

using namespace elements::gears;
using gear_deck::Deck;

namespace {

constexpr double pi = std::numbers::pi, deg = pi / 180;

/// What `engrane check` says of a pair under a name.
double said(const GearPair& pair, const std::string& name) {
  for (const Derived& d : pair.derived())
    if (d.name == name) return d.value;
  ADD_FAILURE() << "nothing is said of " << name;
  return 0;
}

struct Book {
  std::string name;
  double value, digit;  ///< one unit of the last digit printed
};

/// Lengths of a book are diameters, those of the report radii; angles in degrees.
void compare(const GearPair& pair, const std::vector<Book>& book) {
  for (const Book& b : book) {
    double value = said(pair, b.name);
    if (b.name.find("radius") != std::string::npos) value *= 2;
    if (b.name.find("angle") != std::string::npos) value /= deg;
    EXPECT_NEAR(value, b.value, 0.51 * b.digit) << b.name;
  }
}

TEST(ProfileShift, InverseInvolute) {
  for (const double angle : {1e-6, 1e-3, 0.1, 20 * deg, 0.5, 1.0, 1.4, 1.55})
    EXPECT_NEAR(inverse_involute(involute(angle)) / angle, 1, angle < 1e-2 ? 1e-4 * 1e-2 / angle : 1e-13) << angle;
  EXPECT_NEAR(inverse_involute(0.0149043838673368), 20 * deg, 1e-14);  // the tables' inv 20°
}

// KHK, Gear Technical Reference, "Profile shifted spur gear": m 3, z 12/24, x 0.6/0.36; contact ratio after the same table's
// pair (bolsover.com, profile-shifted external spur gears: 1.202).
TEST(ProfileShift, SpurPairOfKhk) {
  Deck deck(" I 1\n I 2\n", " I 1 GEAR N 1 2 KIND SPUR Z 12 24 MN 3 X 0.6 0.36 AXIS 0 0 1 PLACE 1 0 0");
  compare(deck.pair(1), {{"working transverse pressure angle", 26.0886, 1e-4},
                         {"distance of the axles", 56.4999, 1e-4},
                         {"centre distance without shift", 54.000, 1e-3},
                         {"reference radius of wheel A", 36.000, 1e-3},
                         {"reference radius of wheel B", 72.000, 1e-3},
                         {"base radius of wheel A", 33.8289, 1e-4},
                         {"base radius of wheel B", 67.6579, 1e-4},
                         {"working pitch radius of wheel A", 37.667, 1e-3},
                         {"working pitch radius of wheel B", 75.333, 1e-3},
                         {"tip radius of wheel A", 44.840, 1e-3},
                         {"tip radius of wheel B", 79.400, 1e-3},
                         {"root radius of wheel A", 32.100, 1e-3},
                         {"root radius of wheel B", 66.660, 1e-3},
                         {"transverse contact ratio", 1.202, 1e-3}});
  EXPECT_NEAR(deck.node(2)[0], 56.4999, 5e-5);
}

// The same reference, "Profile shifted helical gear", normal system: m_n 3, β 30°, z 12/60, x 0.09809/0.
TEST(ProfileShift, HelicalPairOfKhk) {
  Deck deck(" I 1\n I 2\n", " I 1 GEAR N 1 2 Z 12 60 MN 3 HELIX 30 X 0.09809 0 AXIS 0 0 1 PLACE 1 0 0 WIDTH 30");
  compare(deck.pair(1), {{"transverse pressure angle", 22.79588, 1e-5},
                         {"working transverse pressure angle", 23.1126, 1e-4},
                         {"distance of the axles", 125.000, 1e-3},
                         {"reference radius of wheel A", 41.569, 1e-3},
                         {"reference radius of wheel B", 207.846, 1e-3},
                         {"base radius of wheel A", 38.322, 1e-3},
                         {"base radius of wheel B", 191.611, 1e-3},
                         {"working pitch radius of wheel A", 41.667, 1e-3},
                         {"working pitch radius of wheel B", 208.333, 1e-3},
                         {"tip radius of wheel A", 48.154, 1e-3},  // printed 48.153: h_a 3.292 rounded before it is doubled
                         {"tip radius of wheel B", 213.842, 1e-3},
                         {"root radius of wheel A", 34.658, 1e-3},  // printed 34.657, from the same h_a and h 6.748
                         {"root radius of wheel B", 200.346, 1e-3},
                         {"overlap ratio", 30 * std::sin(30 * deg) / (3 * pi), 1e-9}});
}

// ISO 21771:2007 eq. 62, as worked for m_n 3.5, β 21°, z 31/30, a 116.5 (scribd 376176518): the centre distance decides Σx.
TEST(ProfileShift, SumOfShiftsOfACentreDistance) {
  Deck deck(" I 1\n I 2 X 116.5\n", " I 1 GEAR N 1 2 KIND HELICAL Z 31 30 MN 3.5 HELIX 21 X 0.291 AXIS 0 0 1");
  compare(deck.pair(1), {{"centre distance without shift", 114.3447280708, 1e-9},
                         {"working transverse pressure angle", 23.8707609654, 1e-9},
                         {"transverse pressure angle", 21.2990642859, 1e-9},
                         {"sum of profile shifts", 0.651877131252, 1e-11},
                         {"profile shift of wheel A", 0.291, 1e-12}});
}

// SDP/SI, Elements of Metric Gear Technology, table 5-1 (m 3, z 16/24, x 0/0.5), and m 14, z 17/96, x 0.2/0.5 (scribd
// 92821234). Both count a ring's shift in the other sense: their 0.5 is −0.5 in ISO 21771.
TEST(ProfileShift, InternalPairs) {
  Deck deck(" I 1\n I 2\n I 3\n I 4\n",
            " I 1 GEAR N 1 2 KIND INTERNAL Z 16 24 MN 3 X 0 -0.5 AXIS 0 0 1 PLACE 1 0 0\n"
            " I 2 GEAR N 3 4 KIND INTERNAL Z 96 17 MN 14 X -0.5 0.2 AXIS 0 0 1 PLACE 1 0 0");
  compare(deck.pair(1), {{"working transverse pressure angle", 31.0936, 1e-4},
                         {"distance of the axles", 13.1683, 1e-4},
                         {"base radius of wheel A", 45.105, 1e-3},
                         {"base radius of wheel B", 67.658, 1e-3},
                         {"working pitch radius of wheel A", 52.673, 1e-3},
                         {"working pitch radius of wheel B", 79.010, 1e-3},
                         {"tip radius of wheel A", 54.000, 1e-3},
                         {"tip radius of wheel B", 69.000, 1e-3},
                         {"root radius of wheel A", 40.500, 1e-3},
                         {"root radius of wheel B", 82.500, 1e-3}});
  compare(deck.pair(2), {{"working transverse pressure angle", 21.1251, 1e-4}, {"distance of the axles", 557.0887, 1e-4}});
}

// LECAD, Analysis of Planetary Transmissions (lecad.uni-lj.si/~leon/FS/PlanetryTransmissions, test run): m 1.75, z 21/43/108,
// a 56.8, x 0.4380, 0.0426, 0.0000, with base tangent lengths. The printed tips of planet and sun keep the tip clearance.
TEST(ProfileShift, PlanetarySetOfLecad) {
  Deck deck(" I 1\n I 2 X 56.8\n",
            " I 1 GEAR N 1 2 KIND SPUR Z 21 43 MN 1.75 X 0.4380 AXIS 0 0 1\n"
            " I 2 GEAR N 2 1 KIND INTERNAL Z 43 108 MN 1.75 X 0.0426 TIP 78.8170 185.4992 AXIS 0 0 1");
  const GearPair &sun = deck.pair(1), &ring = deck.pair(2);
  compare(sun, {{"profile shift of wheel B", 0.0426, 1e-4},
                {"reference radius of wheel A", 36.7500, 1e-4},
                {"reference radius of wheel B", 75.2500, 1e-4},
                {"tip radius of wheel A", 41.7008, 1.5e-4},  // x is printed to 5e-5, of 2 m
                {"tip radius of wheel B", 78.8170, 1.5e-4}});
  EXPECT_NEAR(said(ring, "profile shift of wheel B"), 0, 3e-4);  // 0.0000 printed: x of the planet to 5e-5, a to 0.05
  EXPECT_NEAR(2 * said(ring, "reference radius of wheel B"), 189, 1e-9);
  // base tangent over k teeth: k − 1 base pitches and the thickness at the base circle
  const auto span = [](const CutTeeth& cut, std::size_t wheel, int k) {
    const double r_b = cut.base_radius(wheel);
    return (k - 1) * 2 * pi * r_b / cut.teeth[wheel] + cut.thickness_at(wheel, r_b);
  };
  EXPECT_NEAR(span(*sun.design().cut, 0, 3), 13.9546, 1e-4);
  EXPECT_NEAR(span(*sun.design().cut, 1, 5), 24.3530, 1e-4);
}

// Equal shifts on sun and planet; the ring takes −(x + x) of the sun pair's play back when z_s + z_p = z_r − z_p, so that both
// meshes have the same centre distance and, by closed form, the same working pressure angle.
TEST(ProfileShift, PlanetarySetWithEqualShifts) {
  const double x = 0.3;
  Deck deck(" I 1\n I 2\n I 3\n", fmt::format(" I 1 GEAR N 1 2 KIND SPUR Z 24 30 MN 2 X {0} {0} AXIS 0 0 1 PLACE 1 0 0\n"
                                              " I 2 GEAR N 2 1 KIND INTERNAL Z 30 84 MN 2 X {0} AXIS 0 0 1",
                                              x));
  const GearPair &sun = deck.pair(1), &ring = deck.pair(2);
  // z_p − z_r = −54 = −(z_s + z_p): Σx of the ring mesh is the negative of the sun mesh's
  EXPECT_NEAR(said(ring, "profile shift of wheel B"), -2 * x - x, 1e-12);
  EXPECT_NEAR(said(ring, "working transverse pressure angle"), said(sun, "working transverse pressure angle"), 1e-14);
  EXPECT_NEAR(said(sun, "distance of the axles"),
              54 * std::cos(20 * deg) / std::cos(said(sun, "working transverse pressure angle")), 1e-12);
  EXPECT_EQ(said(sun, "working pitch radius of wheel B"), said(ring, "working pitch radius of wheel A"));
}

struct Case {
  std::array<int, 2> teeth;
  bool internal;
  double module, helix;
  std::array<double, 2> shift;
};

std::vector<Case> cases() {
  return {{{12, 24}, false, 3, 0, {0.6, 0.36}},      {{17, 103}, false, 8, 15.8, {0.145, 0}},
          {{30, 20}, false, 2, -25, {-0.2, 0.5}},    {{25, 25}, false, 0.5, 0, {-0.3, -0.2}},
          {{20, 70}, true, 4, 12, {0.3, -0.2}},      {{60, 20}, true, 2, 0, {0.2, 0.4}},
          {{40, 41}, false, 1.5, 30, {0.25, -0.25}}, {{18, 90}, true, 3, 0, {0.4, -0.9}}};
}

// The other way to the working pressure angle: on the working pitch circles the two teeth fill the pitch (no play), whatever the
// formula for inv α_wt; and the contact ratio is z (tanα_a − tanα_wt) summed over 2π (ISO 21771, eq. 86).
TEST(ProfileShift, TeethFillThePitchWithoutPlay) {
  for (const Case& c : cases()) {
    const std::string text = fmt::format(" I 1 GEAR N 1 2 Z {} {} MN {} HELIX {} X {} {} AXIS 0 0 1 PLACE 1 0.3 0 {}", c.teeth[0],
                                         c.teeth[1], c.module, c.helix, c.shift[0], c.shift[1], c.internal ? "INTERNAL" : "");
    Deck deck(" I 1\n I 2\n", text);
    const GearDesign& d = deck.pair(1).design();
    ASSERT_TRUE(d.cut) << text;
    const CutTeeth& cut = *d.cut;
    const double pitch = 2 * pi * d.radius(0) / c.teeth[0];
    EXPECT_NEAR(cut.thickness_at(0, d.radius(0)) + cut.thickness_at(1, d.radius(1)), pitch, 1e-13 * pitch) << text;
    EXPECT_NEAR(std::abs((cut.ring[0] ? -1 : 1) * d.radius(0) + (cut.ring[1] ? -1 : 1) * d.radius(1)), cut.distance(),
                1e-13 * cut.distance());
    // base circles, base helix and base pitch belong to the teeth, not to the pair
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
      EXPECT_NEAR(d.radius(i) * std::cos(d.transverse_pressure_angle(i)), cut.base_radius(i), 1e-13 * cut.base_radius(i));
      EXPECT_NEAR(std::sin(d.helix[i]) * std::cos(d.pressure_angle), std::sin(cut.helix[i]) * std::cos(20 * deg), 1e-14);
    }
    double epsilon = 0;
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
      const double tip = std::tan(std::acos(cut.base_radius(i) / cut.tip[i]));
      epsilon += (cut.ring[i] ? -1 : 1) * c.teeth[i] * (tip - std::tan(cut.working_pressure_angle)) / (2 * pi);
    }
    EXPECT_NEAR(*contact_ratio(d), epsilon, 1e-12) << text;
  }
}

TEST(ProfileShift, EveryClosingCombinationGivesTheSamePair) {
  for (const Case& c : cases()) {
    const std::string z = fmt::format("N 1 2 Z {} {} AXIS 0 0 1", c.teeth[0], c.teeth[1]);
    const std::string helix = c.helix == 0 ? "" : fmt::format(" HELIX {}", c.helix), hand = c.helix < 0 ? " HAND LEFT" : "";
    const std::string kind = c.internal ? " KIND INTERNAL" : c.helix == 0 ? " KIND SPUR" : " KIND HELICAL";
    const std::string x = fmt::format(" X {} {}", c.shift[0], c.shift[1]), one = fmt::format(" X {}", c.shift[0]);
    const std::string m = fmt::format(" MN {}", c.module);
    Deck first(" I 1\n I 2\n", " I 1 GEAR " + z + kind + helix + m + x + " PLACE 1 0 0");
    const GearDesign& wanted = first.pair(1).design();
    const double a = wanted.cut->distance(), m_t = c.module / std::cos(c.helix * deg);
    const std::string distance = fmt::format(" DISTANCE {:.17g}", a), at = fmt::format(" I 1\n I 2 X {:.17g}\n", a);
    const std::string free = " I 1\n I 2\n", place = " PLACE 1 0 0", mt = fmt::format(" MT {:.17g}", m_t);
    std::vector<std::pair<std::string, std::string>> ways{{at, kind + helix + m + one},
                                                          {at, (c.internal ? " INTERNAL" : "") + helix + m + one},
                                                          {at, kind + helix + m + x},
                                                          {at, kind + helix + mt + one},
                                                          {free, kind + helix + mt + x + place},
                                                          {free, kind + helix + m + one + distance + place},
                                                          {at, kind + helix + m + one + distance}};
    ways.push_back({free, kind + helix + distance + x + place});  // the module follows
    ways.push_back({at, kind + helix + distance + x});
    if (c.helix != 0) {
      ways.push_back({free, kind + hand + m + distance + x + place});  // the helix follows
      ways.push_back({free, kind + hand + m + mt + x + place});
      if (!c.internal) ways.push_back({at, kind + hand + m + x});
    }
    for (const auto& [nodes, words] : ways) {
      Deck deck(nodes, " I 1 GEAR " + z + words);
      const GearDesign& d = deck.pair(1).design();
      ASSERT_TRUE(d.cut) << words;
      for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
        EXPECT_NEAR(d.cut->shift[i], wanted.cut->shift[i], 1e-10) << words;
        EXPECT_NEAR(d.cut->helix[i], wanted.cut->helix[i], 1e-9) << words;
        EXPECT_NEAR(d.cut->tip[i], wanted.cut->tip[i], 1e-9 * a) << words;
        EXPECT_NEAR(d.radius(i), wanted.radius(i), 1e-10 * a) << words;
      }
      EXPECT_NEAR(d.cut->normal_module, c.module, 1e-9 * c.module) << words;
    }
  }
}

// Z of one value: the teeth of B follow from module, shifts and centre distance, of DISTANCE or of the nodes.
TEST(ProfileShift, TeethOfACentreDistance) {
  for (const Case& c : cases()) {
    if (c.internal && c.teeth[0] > c.teeth[1]) continue;  // the one value is the pinion's
    for (const bool shifted : {true, false}) {
      const std::string helix = c.helix == 0 ? "" : fmt::format(" HELIX {}", c.helix);
      const std::string kind = c.internal ? " KIND INTERNAL" : c.helix == 0 ? " KIND SPUR" : " KIND HELICAL";
      const std::string x = shifted ? fmt::format(" X {} {}", c.shift[0], c.shift[1]) : "", m = fmt::format(" MN {}", c.module);
      Deck first(" I 1\n I 2\n",
                 fmt::format(" I 1 GEAR N 1 2 AXIS 0 0 1 Z {} {} PLACE 1 0 0", c.teeth[0], c.teeth[1]) + kind + helix + m + x);
      const double a = first.node(2)[0] < 0 ? -first.node(2)[0] : first.node(2)[0];
      const std::string head = fmt::format(" I 1 GEAR N 1 2 AXIS 0 0 1 Z {}", c.teeth[0]),
                        at = fmt::format(" I 1\n I 2 X {:.12g}\n", a);
      Deck nodes(at, head + kind + helix + m + x), long_form(at, head + (c.internal ? " INTERNAL" : "") + helix + m + x);
      Deck distance(" I 1\n I 2\n", head + kind + helix + m + x + fmt::format(" DISTANCE {:.12g} PLACE 1 0 0", a));
      for (const Deck* deck : {&nodes, &long_form, &distance}) EXPECT_EQ(deck->pair(1).design().teeth, c.teeth);
    }
  }
}

TEST(ProfileShift, NoShiftIsThePairWithoutX) {
  for (const char* rest : {" Z 20 40 MN 2", " Z 20 40 MN 2 HELIX 15", " Z 20 60 MN 2 INTERNAL"}) {
    Deck with(" I 1\n I 2\n", std::string(" I 1 GEAR N 1 2 AXIS 0 0 1 PLACE 1 0 0 X 0 0") + rest);
    Deck without(" I 1\n I 2\n", std::string(" I 1 GEAR N 1 2 AXIS 0 0 1 PLACE 1 0 0") + rest);
    const GearDesign &d = with.pair(1).design(), &e = without.pair(1).design();
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
      EXPECT_NEAR(d.radius(i), e.radius(i), 1e-13);
      EXPECT_NEAR(tip_radius(d, i), tip_radius(e, i), 1e-13);
    }
    EXPECT_NEAR(d.pressure_angle, e.pressure_angle, 1e-15);
    EXPECT_NEAR(*contact_ratio(d), *contact_ratio(e), 1e-13);
    EXPECT_NEAR(contact_geometry(d, 1).flank, 0.25, 1e-14);
  }
}

// The plateau of STIFF SQUARE with one pair more, against flanks counted along the path of contact.
TEST(ProfileShift, SquareCourseFollowsTheFlanks) {
  for (const Case& c : cases()) {
    Deck deck(" I 1\n I 2\n",
              fmt::format(" I 1 GEAR N 1 2 Z {} {} MN {} HELIX {} X {} {} AXIS 0 0 1 PLACE 1 0 0 {} KM 1E8 STIFF SQUARE",
                          c.teeth[0], c.teeth[1], c.module, c.helix, c.shift[0], c.shift[1], c.internal ? "INTERNAL" : ""));
    const GearPair& pair = deck.pair(1);
    const ContactGeometry g = contact_geometry(pair.design(), 1);
    const double ratio = (g.approach + g.recess) / g.base_pitch;
    int compared = 0;
    for (int i = 0; i < 400; ++i) {
      const double cycle = (i + 0.37) / 400;
      int count = 0;
      double nearest = 1;
      for (int j = -6; j <= 6; ++j) {
        const double place = cycle + g.flank + j;
        nearest = std::min({nearest, std::abs(place + g.approach / g.base_pitch), std::abs(place - g.recess / g.base_pitch)});
        if (place > -g.approach / g.base_pitch && place < g.recess / g.base_pitch) ++count;
      }
      if (nearest < 0.5 * pair.teeth().course.edge) continue;
      EXPECT_NEAR(pair.teeth().course.at(2 * pi * cycle).f, count / ratio, 1e-9);
      ++compared;
    }
    EXPECT_GT(compared, 300);
  }
}

// ISO 6336-1:2006, eqs. 82 to 91, term by term, for the helical pair of KHK and for a ring.
TEST(ProfileShift, StiffnessOfIso6336) {
  const auto terms = [](double n_1, double n_2, double x_1, double x_2) {
    const std::vector<double> C{0.04723, 0.15551, 0.25791, -0.00635, -0.11654, -0.00193, -0.24188, 0.00529, 0.00182};
    const std::vector<double> t{1, 1 / n_1, 1 / n_2, x_1, x_1 / n_1, x_2, x_2 / n_2, x_1 * x_1, x_2 * x_2};
    double q = 0;
    for (std::size_t i = 0; i < C.size(); ++i) q += C[i] * t[i];
    return q;
  };
  Deck deck(" I 1\n I 2\n I 3\n",
            " I 1 GEAR N 1 2 Z 12 60 MN 3 HELIX 30 X 0.4 -0.1 AXIS 0 0 1 PLACE 1 0 0 WIDTH 30 E 206000 STIFF ISO DEDENDUM 1.4\n"
            " I 2 GEAR N 1 3 Z 60 20 MN 3 INTERNAL X 0.3 0.2 AXIS 0 0 1 PLACE 1 0 0 WIDTH 30 E 206000 STIFF ISO");
  const double cos3 = std::pow(std::cos(30 * deg), 3);
  const double single = 0.8 * (1 + 0.5 * (1.2 - 1.4)) * std::cos(30 * deg) / terms(12 / cos3, 60 / cos3, 0.4, -0.1);
  const GearPair& pair = deck.pair(1);
  EXPECT_NEAR(said(pair, "stiffness of one pair of teeth per face width, c'"), 1000 * single, 1e-6);
  const double c_gamma = 1000 * single * (0.75 * said(pair, "transverse contact ratio") + 0.25);
  EXPECT_NEAR(said(pair, "mesh stiffness per face width, c_gamma"), c_gamma, 1e-6);
  // a unit of u_m turns A by 1/(r_w cosβ_w), which moves r_b/(r_w cosβ_w) along the transverse line of action
  const GearDesign& d = pair.design();
  EXPECT_NEAR(pair.teeth().stiffness, c_gamma * 30 * std::pow(d.cut->base_radius(0) / d.lever(0), 2),
              1e-9 * pair.teeth().stiffness);
  EXPECT_NEAR(said(deck.pair(2), "stiffness of one pair of teeth per face width, c'"),
              1000 * 0.8 * 0.975 / terms(20, 1e300, 0.2, 0), 1e-6);
}

// Outside the range of the formula the result is an estimate, and the deck says so.
TEST(ProfileShift, RangeOfIso6336) {
  const auto pair = [](const std::string& data) {
    return Deck(" I 1\n I 2\n", " I 1 GEAR N 1 2 AXIS 0 0 1 PLACE 1 0 0 WIDTH 30 E 206000 STIFF ISO MN 2 " + data);
  };
  EXPECT_TRUE(pair("Z 24 25 ADDENDUM 0.7").warned("contact ratio 1.181: the formula of STIFF ISO is given for 1.2 or more"));
  EXPECT_TRUE(pair("Z 50 60 X 1.2 1.1").warned("a sum of profile shifts of 2.3: the formula of STIFF ISO"));
  EXPECT_TRUE(pair("Z 50 60 X -0.3 -0.4").warned("a sum of profile shifts of -0.7: the formula of STIFF ISO"));
  for (const char* inside : {"Z 24 25", "Z 50 60 X 1 1", "Z 50 60 X -0.3 -0.2", "Z 20 60 INTERNAL X 0.2 -1"})
    EXPECT_FALSE(pair(inside).warned("STIFF ISO")) << inside;
}

// The conversions of backlash can be checked: j_bn = j cosα_nw, whichever of them the card gives.
TEST(ProfileShift, BacklashIsListed) {
  for (const char* given : {"JEU 0.05", "JEUN 0.05", "JEUA 0.05", "ASN -0.03 -0.02"}) {
    Deck deck(" I 1\n I 2\n",
              std::string(" I 1 GEAR N 1 2 Z 17 40 MN 3 HELIX 20 X 0.4 0.3 AXIS 0 0 1 PLACE 1 0 0 KM 1E8 ") + given);
    const GearPair& pair = deck.pair(1);
    EXPECT_EQ(said(pair, "backlash along the circumference"), pair.teeth().backlash);
    EXPECT_NEAR(said(pair, "backlash normal to the flanks"), pair.teeth().backlash * std::cos(pair.design().pressure_angle),
                1e-15);
  }
  Deck none(" I 1\n I 2\n", " I 1 GEAR N 1 2 Z 17 40 MN 3 AXIS 0 0 1 PLACE 1 0 0 KM 1E8");
  for (const Derived& d : none.pair(1).derived()) EXPECT_EQ(d.name.find("backlash"), std::string::npos);
}

// The reach of the tips on the line of centres, and teeth without cut data, which are those of X 0 0.
TEST(ProfileShift, TipsThatReachEachOther) {
  const std::string pair = " I 1 GEAR N 1 2 AXIS 0 0 1 PLACE 1 0 0 MN 3 ";
  const auto overlap = [&](const std::string& data) {
    return Deck(" I 1\n I 2\n", pair + data).pair(1).design().cut->tip_overlap();
  };
  EXPECT_NEAR(overlap("Z 20 60 X 0 0"), 6, 1e-12);
  EXPECT_NEAR(overlap("Z 20 60 X 0 0 INTERNAL"), 6, 1e-12);
  EXPECT_NEAR(overlap("Z 60 20 X 0 0 INTERNAL"), 6, 1e-12);
  EXPECT_NEAR(overlap("Z 20 60 TIP 60.4 180.2"), 0.3, 1e-12);
  for (const char* apart : {"Z 20 60 TIP 54 174", "Z 20 60 INTERNAL TIP 56 178"}) {
    Deck deck(" I 1\n I 2\n", pair + apart);
    EXPECT_THROW(deck.pair(1), std::runtime_error) << apart;
  }
  Deck within(" I 1\n I 2\n", pair + "Z 20 60 TIP 56.2 186");
  EXPECT_TRUE(within.warned("wheel A: its tip diameter 56.2 is within its base circle, 56.38155725"));
  EXPECT_TRUE(within.pair(1).design().cut->without_involute(0));
  for (const char* shift : {"", " X 0 0"}) {
    Deck pointed(" I 1\n I 2\n", pair + "Z 20 60 ALPHA 40" + shift);
    EXPECT_THROW(pointed.pair(1), std::runtime_error) << shift;
    Deck thin(" I 1\n I 2\n", pair + "Z 23 25 ALPHA 33" + shift);
    EXPECT_TRUE(thin.warned("the tips of wheel A are 0.1")) << shift;
  }
  EXPECT_FALSE(Deck(" I 1\n I 2\n", pair + "Z 23 25 ALPHA 33").pair(1).design().cut) << "the check makes no cut pair of it";
}

// A_sn of ISO 21771: j_bn = −ΣA_sn cosα_n, against the thinner teeth on the base circles.
TEST(ProfileShift, ThicknessAllowancesMakeBacklash) {
  Deck deck(" I 1\n I 2\n", " I 1 GEAR N 1 2 Z 17 40 MN 3 HELIX 20 X 0.4 0.3 AXIS 0 0 1 PLACE 1 0 0 KM 1E8 ASN -0.05 -0.08");
  const GearPair& pair = deck.pair(1);
  const GearDesign& d = pair.design();
  // thinner by A_sn/cosβ at the reference circle, by cosα_t of that at the base circle; u_m turns A by u_m/lever
  const double base = 0.13 / std::cos(20 * deg) * std::cos(d.cut->transverse_pressure_angle());
  EXPECT_NEAR(pair.teeth().backlash * d.cut->base_radius(0) / d.lever(0), base, 1e-14);
}

// One wheel has one shift and one tip circle, in whichever pairs it stands.
TEST(ProfileShift, OneWheelOneCut) {
  const std::string sun =
      " I 1 GEAR N 1 2 Z 24 30 MN 2 X 0.3 0.3 AXIS 0 0 1 PLACE 1 0 0\n I 2 GEAR N 2 1 KIND INTERNAL Z 30 84 MN 2 ";
  Deck same(" I 1\n I 2\n", sun + "X 0.3 AXIS 0 0 1 TIPALTER -0.0408582 0");
  EXPECT_FALSE(same.warned("wheel at node 2"));
  Deck tip(" I 1\n I 2\n", sun + "X 0.3 AXIS 0 0 1");
  EXPECT_TRUE(tip.warned("the wheel at node 2 has the tip diameter 65.03656"));
  Deck shift(" I 1\n I 2\n", sun + "X 0.2 AXIS 0 0 1");
  EXPECT_TRUE(shift.warned("the wheel at node 2 has the profile shift 0.3 in GEAR 1 and 0.2 here: they are taken as two wheels"));
}

TEST(ProfileShift, LimitsOfTheTooth) {
  // x for 12 teeth: 1 − 12 sin²20°/2 (ISO 21771, 7.7); a tooth of 10 teeth is pointed at x = 0.8 below its tip
  Deck full(" I 1\n I 2\n", " I 1 GEAR N 1 2 Z 12 40 MN 2 X 0.299 0 AXIS 0 0 1 PLACE 1 0 0");
  EXPECT_FALSE(full.warned("undercut"));
  EXPECT_NEAR(full.pair(1).design().cut->least_shift(0), 1 - 6 * std::pow(std::sin(20 * deg), 2), 1e-15);
  Deck undercut(" I 1\n I 2\n", " I 1 GEAR N 1 2 Z 12 40 MN 2 X 0.29 0 AXIS 0 0 1 PLACE 1 0 0");
  EXPECT_TRUE(
      undercut.warned("wheel A of 12 teeth is undercut: its teeth are full from a profile shift of 0.298 on, 0.29 given"));
  Deck thin(" I 1\n I 2\n", " I 1 GEAR N 1 2 Z 12 40 MN 2 X 0.65 0 AXIS 0 0 1 PLACE 1 0 0 TIPALTER 0");
  EXPECT_TRUE(thin.warned("the tips of wheel A are"));
  EXPECT_LT(thin.pair(1).design().cut->tip_thickness(0), 0.4);
  // tips without alteration come near the mate's roots by k m_n
  const CutTeeth& cut = *thin.pair(1).design().cut;
  EXPECT_NEAR(cut.tip_clearance(0), 0.5 + 2 * cut.clearance_alteration(), 1e-12);
  Deck deep(" I 1\n I 2\n", " I 1 GEAR N 1 2 Z 20 40 MN 2 AXIS 0 0 1 PLACE 1 0 0 TIP 45.2 84");
  EXPECT_TRUE(deep.warned("the tips of wheel A run into the roots of wheel B by 0.1"));
}

}  // namespace

}  // namespace engrane
