// SPDX-License-Identifier: BSD-3-Clause
// Events: a tooth that bounces on its flank, against flight and contact in closed form (damping ALWAYS) or contact by a fine
// Runge–Kutta rule (CONTACT); and the locator by itself, on an element whose switch is a known function of time.
#include "solve/run/events.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "run_deck.hpp"

namespace engrane::test {

using namespace solve;

namespace {

constexpr double stiffness = 100, torque = 1, released = -0.53, ending = 6;

/// c_m. With CONTACT so large that the rounding of its limit, which takes 0.2 c/k, is longer than the steps.
double damping_of(bool always) { return always ? 0.4 : 4; }

/// Wheel A of inertia 1 and radius 1 turns under a torque 1 towards the front flank of a wheel held fast: u_m is its angle and
/// u'' + force(u, u') = 1. The back flank is too far away to matter.
std::string bouncing(double h, const std::string& law, const std::string& events) {
  return fmt::format(R"(
.NOE
 I 1 X 2 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1
 I 2 GEAR N 1 0 AXIS 0 0 1 Z 20 20 MN 0.1 KM {} CM {} JEU 10 SMOOTH 0 DAMP {}
 I 3 INERTIA N 1 J 1
.CLM
 CHA NOEUD 1 C 6 V {}
.INI
 DEP NOEUD 1 C 6 V ({}*180/PI) IMPOSED
.SAM TYPE DYNAMIC SCHEME CHUNG RHO 0.8 PREC 1e-12 EVENTS {}
.SUB TF {} H {}
)",
                     stiffness, damping_of(law == "ALWAYS"), law, torque, released, events, ending, h);
}

struct Motion {
  double u, v;
};

/// u'' + c u' + k u = 1 from the state at the beginning, t later.
Motion free_motion(Motion s, double k, double t) {
  const double c = damping_of(true);
  if (k == 0) {
    const double limit = torque / c, e = std::exp(-c * t);
    return {s.u + limit * t + (s.v - limit) * (1 - e) / c, limit + (s.v - limit) * e};
  }
  const double w = std::sqrt(k - c * c / 4), e = std::exp(-c * t / 2), y = s.u - torque / k, cs = std::cos(w * t),
               sn = std::sin(w * t);
  const double a = (s.v + c / 2 * y) / w;
  return {torque / k + e * (y * cs + a * sn), e * (-c / 2 * (y * cs + a * sn) + w * (a * cs - y * sn))};
}

/// The law CONTACT with a sharp corner: the damper takes away no more than the elastic force, rounded between 90 and 110 %.
double contact_force(Motion s) {
  const double elastic = stiffness * s.u, damper = damping_of(false) * s.v;
  if (elastic <= 0) return damper > 0 ? damper : 0;
  const double t = (1 + damper / elastic) / 0.2 + 0.5;
  if (t >= 1) return elastic + damper;
  return t <= 0 ? 0 : elastic * 0.2 * t * t * t * (1 - 0.5 * t);
}

Motion runge_kutta(Motion s, double h) {
  const auto slope = [](Motion m) { return Motion{m.v, torque - contact_force(m)}; };
  const auto moved = [](Motion m, Motion d, double t) { return Motion{m.u + t * d.u, m.v + t * d.v}; };
  const Motion a = slope(s), b = slope(moved(s, a, h / 2)), c = slope(moved(s, b, h / 2)), d = slope(moved(s, c, h));
  return moved(s, {(a.u + 2 * b.u + 2 * c.u + d.u) / 6, (a.v + 2 * b.v + 2 * c.v + d.v) / 6}, h);
}

/// One phase forward by t, in contact or in flight.
Motion phase(Motion s, bool touching, bool always, double t) {
  if (always) return free_motion(s, touching ? stiffness : 0, t);
  if (!touching) return {s.u + s.v * t + 0.5 * torque * t * t, s.v + torque * t};
  const int steps = static_cast<int>(std::ceil(t / 1e-5));
  for (int i = 0; i < steps; ++i) s = runge_kutta(s, t / steps);
  return s;
}

struct Bounces {
  Motion end;
  std::vector<double> times;
};

/// Each phase ends where u passes zero, found by stepping and halving.
Bounces exact(bool always) {
  Bounces out;
  Motion s{released, 0};
  bool touching = false;
  for (double t = 0; t < ending;) {
    const double stride = 1e-3;
    const Motion next = phase(s, touching, always, std::min(stride, ending - t));
    if ((next.u >= 0) == touching) {
      s = next;
      t += stride;
      continue;
    }
    double lo = 0, hi = std::min(stride, ending - t);
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (lo + hi);
      ((phase(s, touching, always, middle).u >= 0) == touching ? lo : hi) = middle;
    }
    s = phase(s, touching, always, hi);
    s.u = 0;
    t += hi;
    touching = !touching;
    out.times.push_back(t);
  }
  out.end = s;
  return out;
}

Bounces computed(double h, const std::string& law, const std::string& events) {
  DeckRun deck(bouncing(h, law, events));
  Bounces out;
  double before = released, time = 0;
  const Configuration end = deck.run([&](const Configuration& c, const StepReport& step) {
    const double u = deck.channel(c, 2, "U_M");
    for (const Event& e : step.events) {
      const auto& names = deck.model().parts[static_cast<std::size_t>(e.part)].element->layout().switches;
      const std::string& name =
          e.rises ? names[static_cast<std::size_t>(e.index)].rises : names[static_cast<std::size_t>(e.index)].falls;
      if (name == "front flank touches" || name == "front flank parts") out.times.push_back(c.time);
    }
    // what a user would read off the histories
    if (events == "NO" && (u >= 0) != (before >= 0)) out.times.push_back(c.time - (c.time - time) * u / (u - before));
    before = u;
    time = c.time;
  });
  out.end = {deck.channel(end, 2, "U_M"), deck.node(end, 1).v.norm()};
  out.end.v = deck.node(end, 1).W[2];
  return out;
}

/// Largest error of the position at the end, the velocity there, and the times of events.
std::array<double, 3> errors(const Bounces& mine, const Bounces& right) {
  double worst = mine.times.size() == right.times.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(mine.times.size(), right.times.size()); ++i)
    worst = std::max(worst, std::abs(mine.times[i] - right.times[i]));
  return {std::abs(mine.end.u - right.end.u), std::abs(mine.end.v - right.end.v), worst};
}

TEST(Events, KeepSecondOrderAcrossContact) {
  for (const std::string law : {"ALWAYS", "CONTACT"}) {
    const Bounces right = exact(law == "ALWAYS");
    ASSERT_GE(right.times.size(), 4u);
    for (const std::string events : {"YES 1e-8", "NO"}) {
      if (law == "CONTACT" && events == "NO") continue;  // a step that ends where the force jumps has no solution
      std::vector<std::array<double, 3>> found;
      for (const double h : {0.01, 0.005, 0.0025, 0.00125}) found.push_back(errors(computed(h, law, events), right));
      for (std::size_t what = 0; what < 3; ++what) {
        std::string line = fmt::format("{:8} EVENTS {:9} {:9}", law, events,
                                       what == 0   ? "position"
                                       : what == 1 ? "velocity"
                                                   : "times");
        for (std::size_t i = 0; i < found.size(); ++i) line += fmt::format("  {:.3e}", found[i][what]);
        for (std::size_t i = 1; i < found.size(); ++i)
          line += fmt::format("  {:.2f}", std::log2(found[i - 1][what] / found[i][what]));
        fmt::print("{}\n", line);
        if (events == "NO") continue;
        for (std::size_t i = 2; i < found.size(); ++i)
          EXPECT_NEAR(std::log2(found[i - 1][what] / found[i][what]), 2, 0.15) << line;
      }
    }
  }
}

}  // namespace
}  // namespace engrane::test
