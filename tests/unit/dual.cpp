// SPDX-License-Identifier: BSD-3-Clause
#include "math/dual.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "math/taylor.hpp"
#include "math/vector.hpp"

namespace engrane {
namespace {

/// Uses every operation of the scalars once.
template <class T>
T everything(const T& x, const T& y) {
  using std::abs, std::atan2, std::cos, std::sin, std::sqrt;
  T r = sqrt(x * x + y * y + 1.0) / (2.0 + sin(x));
  r += cos(y) * 3.0 - 1.0 / (x + 4.0);
  r -= abs(x - y) * atan2(y, x);
  r *= 0.5 - y / 7.0;
  r /= 1.0 + x * x;
  return -r + (1.0 - x) - (y - 2.0);
}

TEST(Dual, GradientAgreesWithDifferences) {
  for (const double x : {-1.2, 0.4, 2.0}) {
    for (const double y : {-0.7, 1.1}) {
      Dual<2> a(x), b(y);
      a.d[0] = b.d[1] = 1;
      const Dual<2> r = everything(a, b);
      EXPECT_NEAR(r.value, everything(x, y), 1e-15);
      const double h = 1e-6;
      EXPECT_NEAR(r.d[0], (everything(x + h, y) - everything(x - h, y)) / (2 * h), 1e-8);
      EXPECT_NEAR(r.d[1], (everything(x, y + h) - everything(x, y - h)) / (2 * h), 1e-8);
    }
  }
}

TEST(Dual, ComparesByValue) {
  Dual<1> a(1.0), b(1.0);
  a.d[0] = 5;
  EXPECT_TRUE(a == b && a <= b && a >= b);
  EXPECT_FALSE(a < b || a > b);
  EXPECT_EQ(value_of(a), 1);
}

TEST(Dual, InEigenAndVectors) {
  Vec3T<Dual<1>> v(Dual<1>(1.0), Dual<1>(2.0), Dual<1>(3.0));
  v[0].d[0] = 1;
  EXPECT_EQ(v.dot(v).d[0], 2);
  const Vec3 w(0, 0, 1);
  const auto c = cross(v, w);
  EXPECT_EQ(c[1].value, -1);
  EXPECT_EQ(c[1].d[0], -1);
  EXPECT_EQ(dot(v, w).value, 3);
  EXPECT_EQ(rotate(Mat3(skew(w)), v)[1].d[0], 1);
  EXPECT_EQ(rotate_back(Mat3(skew(w)), v)[1].d[0], -1);
}

TEST(Taylor, RatesAgreeWithDifferences) {
  const auto x = [](double t) { return 0.4 + 0.3 * t - 0.2 * t * t; };
  const auto y = [](double t) { return -0.8 + 0.5 * t + 0.1 * t * t; };
  const Taylor r = everything(Taylor(x(0), 0.3, -0.4), Taylor(y(0), 0.5, 0.2));
  const double h = 1e-4;
  const double minus = everything(x(-h), y(-h)), here = everything(x(0), y(0)), plus = everything(x(h), y(h));
  EXPECT_NEAR(r.value, here, 1e-15);
  EXPECT_NEAR(r.d1, (plus - minus) / (2 * h), 1e-7);
  EXPECT_NEAR(r.d2, (plus - 2 * here + minus) / (h * h), 1e-6);
}

TEST(Taylor, Compose) {
  const Taylor c = compose(Taylor(2, 3, 5), 8, 12, 12);  // x³ at 2
  EXPECT_EQ(c.d1, 36);
  EXPECT_EQ(c.d2, 12 * 5 + 12 * 9);
  EXPECT_EQ(compose(2.0, 8, 12, 12), 8);
}

}  // namespace
}  // namespace engrane
