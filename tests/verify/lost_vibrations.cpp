// SPDX-License-Identifier: BSD-3-Clause
// What is found of vibrations that Radau IIA loses, against one oscillator whose loss is known.
#include "solve/schemes/lost_vibrations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace engrane::test {
namespace {

using solve::Collocation;
using solve::LostVibrations;
using Complex = std::complex<double>;

/// Steps of an oscillator that is displaced and let go, in the first slot of node 1, beside a slow motion that steps follow.
/// Node 2 has the slow motion alone.
class Released {
 public:
  Released(double omega, double kappa) : exponent_(-kappa, omega) {}

  static constexpr std::size_t slot = 6, other = 12;

  /// A slow swing of this amplitude.
  void swing(double amplitude, double rate) {
    swing_ = amplitude;
    swing_rate_ = rate;
  }
  /// Leaves the oscillator undamped by the scheme, as a force does that keeps it going.
  void keep_going() { kept_ = true; }
  /// Lets it go once more.
  void again() { phasor_ = 1; }

  void step(double h) {
    const Complex z = exponent_ * h;
    const Eigen::Matrix3cd a = collocation_.a.cast<Complex>();
    const Eigen::Vector3cd left = (Eigen::Matrix3cd::Identity() - z * a).partialPivLu().solve(Eigen::Vector3cd::Ones());
    std::vector<std::vector<double>> y(3, std::vector<double>(18)), v = y, acceleration = y;
    std::vector<double> v0(18), a0(18), end_v(18), end(18);
    // in the order of derivatives
    const auto value = [&](double time, Complex phasor, int order) {
      const Complex slow(0, swing_rate_);
      return (std::pow(exponent_, order) * phasor).real() + (std::pow(slow, order) * swing_ * std::exp(slow * time)).real();
    };
    const auto set = [](std::vector<double>& of, double both, double slow) {
      of[slot] = both;
      of[other] = slow;
    };
    set(v0, value(time_, phasor_, 1), value(time_, 0, 1));
    set(a0, value(time_, phasor_, 2), value(time_, 0, 2));
    for (Eigen::Index i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double time = time_ + h * collocation_.c[i];
      set(y[k], value(time, phasor_ * left[i], 0) - value(time_, phasor_, 0), value(time, 0, 0) - value(time_, 0, 0));
      set(v[k], value(time, phasor_ * left[i], 1), value(time, 0, 1));
      set(acceleration[k], value(time, phasor_ * left[i], 2), value(time, 0, 2));
    }
    lost_.look(v0, a0, y, v, acceleration);
    time_ += h;
    phasor_ *= kept_ ? std::exp(z) : left[2];
    set(end_v, value(time_, phasor_, 1), value(time_, 0, 1));
    set(end, value(time_, phasor_, 2), value(time_, 0, 2));
    std::vector<double> inertia(lost_.differences().begin(), lost_.differences().end());
    for (double& force : inertia) force *= mass;
    lost_.take(h, steps_++ == 0, end_v, end, inertia);
    const double missing = std::norm(exponent_) * (std::exp(-std::abs(exponent_.real()) * time_) - std::abs(phasor_));
    square_ += 0.5 * missing * missing * h;
  }

  static constexpr double mass = 2;
  double time() const { return time_; }
  double missing() const { return std::sqrt(square_ / time_); }
  const LostVibrations& lost() const { return lost_; }

 private:
  const Collocation collocation_ = Collocation::radau();
  LostVibrations lost_{collocation_, 1e-12, 1, 18, {{1, 2}}};
  Complex exponent_, phasor_ = 1;
  double swing_ = 0, swing_rate_ = 0, time_ = 0, square_ = 0;
  bool kept_ = false;
  int steps_ = 0;
};

/// Steps that follow it at first, and then grow.
void lose(Released& oscillator) {
  for (double h = 0.002; oscillator.time() < 4; h = std::min(1.05 * h, 0.08)) oscillator.step(h);
}

TEST(LostVibrations, AreWhatTheSchemeTakesFromAnOscillator) {
  for (const double kappa : {0.0, 1.0}) {
    Released oscillator(300, kappa);
    oscillator.swing(1, 3);
    lose(oscillator);
    const LostVibrations& lost = oscillator.lost();
    EXPECT_GT(oscillator.missing(), 0.1 * 300 * 300);
    EXPECT_NEAR(lost.missing(Released::slot), oscillator.missing(), 0.15 * oscillator.missing()) << "kappa " << kappa;
    EXPECT_NEAR(lost.period(Released::slot), 2 * std::numbers::pi / 300, 7e-4);
    EXPECT_EQ(lost.missing(Released::slot + 1), 0);
    const double force = Released::mass * lost.missing(Released::slot);
    EXPECT_NEAR(lost.missing_force(Released::slot), force, 1e-9 * force);
  }
}

TEST(LostVibrations, AreFoundBesideALargeSlowMotion) {
  // its third derivative is that of the vibration at most: of displacements, it hides what is left of it in long steps
  for (const double swing : {1e4, 1e6}) {
    Released oscillator(300, 0.2);
    oscillator.swing(swing, 3);
    lose(oscillator);
    const double found = oscillator.lost().missing(Released::slot) / oscillator.missing();
    EXPECT_GT(found, 1.0 / 3) << swing;
    EXPECT_LT(found, 3) << swing;
    EXPECT_EQ(oscillator.lost().missing(Released::other), 0);
  }
}

TEST(LostVibrations, AreFoundInTheMotionOfTwoNodesRelativeToEachOther) {
  Released oscillator(300, 0);
  oscillator.swing(1e7, 3);
  lose(oscillator);
  const LostVibrations& lost = oscillator.lost();
  const std::size_t between = lost.relative(2, 1);
  EXPECT_EQ(between, lost.relative(1, 2));
  EXPECT_EQ(lost.relative(0, 2), Released::other);
  EXPECT_NEAR(lost.missing(between), oscillator.missing(), 0.15 * oscillator.missing());
  EXPECT_NEAR(lost.missing_speed(between), oscillator.missing() / 300, 0.15 * oscillator.missing() / 300);
  EXPECT_NEAR(lost.range_of_speed(between), 600, 6);
}

TEST(LostVibrations, AreNoneWhereStepsFollow) {
  Released oscillator(300, 0.5);
  oscillator.swing(1, 3);
  while (oscillator.time() < 4) oscillator.step(0.003);
  EXPECT_EQ(oscillator.lost().missing(Released::slot), 0);
}

TEST(LostVibrations, AreNoneWhereSomethingKeepsThemGoing) {
  Released oscillator(300, 0);
  oscillator.keep_going();
  while (oscillator.time() < 4) oscillator.step(0.008);
  EXPECT_EQ(oscillator.lost().missing(Released::slot), 0);
}

TEST(LostVibrations, AreNoneWhereSomethingStartsThemAgain) {
  Released oscillator(300, 0);
  oscillator.swing(1, 3);
  for (int step = 0; oscillator.time() < 4; ++step) {
    if (step % 3 == 0) oscillator.again();
    oscillator.step(0.012);
  }
  EXPECT_EQ(oscillator.lost().missing(Released::slot), 0);
}

}  // namespace
}  // namespace engrane::test
