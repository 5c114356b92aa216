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

/// Steps of an oscillator that is displaced and let go, in the first slot of a node, beside a slow motion that steps follow.
class Released {
 public:
  Released(double omega, double kappa) : exponent_(-kappa, omega) {}

  /// A slow swing of this amplitude.
  void swing(double amplitude, double rate) {
    swing_ = amplitude;
    swing_rate_ = rate;
  }
  /// Leaves the oscillator undamped by the scheme, as a force does that keeps it going.
  void keep_going() { kept_ = true; }

  void step(double h) {
    const Complex z = exponent_ * h;
    const Eigen::Matrix3cd a = collocation_.a.cast<Complex>();
    const Eigen::Vector3cd left = (Eigen::Matrix3cd::Identity() - z * a).partialPivLu().solve(Eigen::Vector3cd::Ones());
    std::vector<std::vector<double>> y(3, std::vector<double>(6)), v = y, acceleration = y;
    std::vector<double> v0(6), a0(6), end(6);
    // in the order of derivatives
    const auto value = [&](double time, Complex phasor, int order) {
      const Complex slow(0, swing_rate_);
      return (std::pow(exponent_, order) * phasor).real() + (std::pow(slow, order) * swing_ * std::exp(slow * time)).real();
    };
    v0[0] = value(time_, phasor_, 1);
    a0[0] = value(time_, phasor_, 2);
    for (Eigen::Index i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double time = time_ + h * collocation_.c[i];
      y[k][0] = value(time, phasor_ * left[i], 0) - value(time_, phasor_, 0);
      v[k][0] = value(time, phasor_ * left[i], 1);
      acceleration[k][0] = value(time, phasor_ * left[i], 2);
    }
    lost_.look(v0, a0, y, v, acceleration);
    time_ += h;
    phasor_ *= kept_ ? std::exp(z) : left[2];
    end[0] = value(time_, phasor_, 2);
    std::vector<double> inertia(lost_.differences().begin(), lost_.differences().end());
    for (double& force : inertia) force *= mass;
    lost_.take(h, steps_++ == 0, end, inertia);
    const double missing = std::norm(exponent_) * (std::exp(-std::abs(exponent_.real()) * time_) - std::abs(phasor_));
    square_ += 0.5 * missing * missing * h;
  }

  static constexpr double mass = 2;
  double time() const { return time_; }
  double missing() const { return std::sqrt(square_ / time_); }
  const LostVibrations& lost() const { return lost_; }

 private:
  const Collocation collocation_ = Collocation::radau();
  LostVibrations lost_{collocation_, 6};
  Complex exponent_, phasor_ = 1;
  double swing_ = 0, swing_rate_ = 0, time_ = 0, square_ = 0;
  bool kept_ = false;
  int steps_ = 0;
};

TEST(LostVibrations, AreWhatTheSchemeTakesFromAnOscillator) {
  for (const double kappa : {0.0, 1.0}) {
    Released oscillator(300, kappa);
    oscillator.swing(1, 3);
    // steps that follow it at first, and then grow
    for (double h = 0.002; oscillator.time() < 4; h = std::min(1.05 * h, 0.08)) oscillator.step(h);
    EXPECT_GT(oscillator.missing(), 0.1 * 300 * 300);
    EXPECT_NEAR(oscillator.lost().missing(0), oscillator.missing(), 0.15 * oscillator.missing()) << "kappa " << kappa;
    EXPECT_NEAR(oscillator.lost().period(0), 2 * std::numbers::pi / 300, 7e-4);
    EXPECT_EQ(oscillator.lost().missing(1), 0);
    EXPECT_NEAR(oscillator.lost().missing_force(0), Released::mass * oscillator.lost().missing(0), 1e-9 * oscillator.missing());
  }
}

TEST(LostVibrations, AreNoneWhereStepsFollow) {
  Released oscillator(300, 0.5);
  oscillator.swing(1, 3);
  while (oscillator.time() < 4) oscillator.step(0.003);
  EXPECT_EQ(oscillator.lost().missing(0), 0);
}

TEST(LostVibrations, AreNoneWhereSomethingKeepsThemGoing) {
  Released oscillator(300, 0);
  oscillator.keep_going();
  while (oscillator.time() < 4) oscillator.step(0.008);
  EXPECT_EQ(oscillator.lost().missing(0), 0);
}

}  // namespace
}  // namespace engrane::test
