// SPDX-License-Identifier: BSD-3-Clause
// The suite on elements whose law is a routine of the user's.
#include <gtest/gtest.h>

#include "elements/gears/gear_pair_cases.hpp"
#include "elements/springs/spring.hpp"
#include "elements/springs/torsion_spring.hpp"
#include "elements/suite.hpp"

namespace engrane {

using namespace elements::springs;

namespace {

using namespace suite;
using namespace gear_cases;

std::unique_ptr<Function> routine(std::string library, std::string name, std::vector<double> parameters = {},
                                  std::vector<double> scale = {}) {
  deck::FunctionCard card;
  card.user = {std::move(library), std::move(name)};
  card.parameters = std::move(parameters);
  card.scale = std::move(scale);
  deck::Record record;
  record.data = std::move(card);
  Diagnostics diagnostics;
  auto function = make_function(record, diagnostics, {ENGRANE_USER_LIBRARIES});
  for (const Diagnostic& d : diagnostics.all()) ADD_FAILURE() << d.message << "; " << d.hint;
  return function;
}

const FunctionMap& functions() {
  static const FunctionMap map = [] {
    FunctionMap m;
    m[1] = routine("laws_fortran", "hardening", {40, 90, 3});
    m[2] = routine("laws_fortran", "hardening", {40, 90, 0});
    m[3] = routine("laws_c", "hardening_plain", {40, 90, 3});
    m[4] = routine("laws_c", "fourier_mesh", {0.2, -0.1, 0, 0.05});
    m[5] = routine("laws_c", "stiffening_mesh", {0.8, 0.7, 0.2});
    m[6] = routine("laws_fixed", "stribk", {0.3, 0.1, 0.7});
    m[7] = routine("wrong_laws", "loaded_friction");
    m[8] = routine("wrong_laws", "only_value", {}, {1, 1, 1});
    return m;
  }();
  return map;
}

TEST(UserLaws, SuiteOfSprings) {
  for (const int f : {1, 2, 3, 8}) {
    Subject s;
    s.name = "LAW USER " + std::to_string(f);
    s.nodes = {{0, Vec3::Zero()}, {1, {1, 0.2, -0.3}}, {2, {-0.5, 0.4, 0.8}}};
    const auto make = [f, nodes = s.nodes](std::array<int, 2> ends, const Mat3& Q) {
      SpringData data;
      data.nodes = ends;
      data.law = {"USER", {static_cast<double>(f)}};
      data.damping = {0.5};
      return build(spring_type(), data, turned(nodes, Q), {.functions = &functions()});
    };
    s.build = [=](const Mat3& Q) { return make({1, 2}, Q); };
    s.build_swapped = [=] { return make({2, 1}, Mat3::Identity()); };
    s.step = 1e-4;
    s.tolerance = 1e-7;
    s.skip[Check::lagrange] = "a damper has no potential";
    run_suite(s);
  }
}

TEST(UserLaws, SpringStoresWhatTheRoutineSays) {
  Subject s;
  s.name = "LAW USER with energy";
  s.nodes = {{1, {1, 0.2, -0.3}}, {2, {-0.5, 0.4, 0.8}}};
  s.build = [nodes = s.nodes](const Mat3& Q) {
    SpringData data;
    data.nodes = {1, 2};
    data.law = {"USER", {2}};
    return build(spring_type(), data, turned(nodes, Q), {.functions = &functions()});
  };
  s.step = 1e-4;
  s.tolerance = 1e-7;
  run_suite(s);  // Lagrange's equations too: with energies from the routine it is a spring like any other
}

TEST(UserLaws, SuiteOfTorsionSpring) {
  Subject s;
  s.name = "TSPRING LAW USER";
  s.nodes = {{1, {1, 0.2, -0.3}}, {2, {-0.5, 0.4, 0.8}}};
  s.build = [nodes = s.nodes](const Mat3& Q) {
    TorsionSpringData data;
    data.nodes = {1, 2};
    data.axis = components(Q * Vec3(0.3, -0.5, 0.8));
    data.law = {"USER", {1}};
    return build(torsion_spring_type(), data, turned(nodes, Q), {.functions = &functions()});
  };
  s.skip[Check::lagrange] = "a damper has no potential";
  s.turn = 0.8;  // away from where the axes oppose each other
  s.step = 1e-4;
  s.tolerance = 1e-7;
  run_suite(s);
}

Subject gear(const Case& c, double x) {
  Subject s = subject(c);
  s.build = [c](const Mat3& Q) { return c.build(Q, {.functions = &functions()}); };
  s.build_swapped = {};
  s.tolerance = 1e-7;
  s.step = 2e-4;
  s.skip[Check::zero] = s.skip[Check::rigid] = "the error is not zero at rest";
  s.adjust = [x, c](StateBuffer& state, Random&) {
    const auto element = c.build(Mat3::Identity(), {.functions = &functions()});
    approach(dynamic_cast<const GearPair&>(*element), state, x);
  };
  return s;
}

Case teeth(int course) {
  Case c = helical();
  c.name += " STIFF USER " + std::to_string(course);
  c.data.stiffness = 30;
  c.data.backlash = 0.5;
  c.data.onset = 0.2;
  c.data.course = {"USER", {static_cast<double>(course)}};
  c.data.error = {"COS", {0.01}};
  return c;
}

TEST(UserLaws, SuiteOfMeshStiffness) {
  for (const int course : {4, 5})
    for (const double x : {0.3, -0.9, 0.03, -0.52}) {
      const Case c = teeth(course);
      Subject s = gear(c, x);
      s.name += " x " + std::to_string(x);
      run_suite(s);
    }
}

TEST(UserLaws, MeshOfRoutineIsTheFourierSeries) {
  const Case user = teeth(4);
  Case fourier = user;
  fourier.data.course = {"FOURIER", {0.2, -0.1, 0, 0.05}};
  const auto a = user.build(Mat3::Identity(), {.functions = &functions()}), b = fourier.build(Mat3::Identity());
  const Subject s = gear(user, 0.3);
  Random random(7);
  for (int i = 0; i < 4; ++i) {
    StateBuffer state = random_state(s, *a, random);
    const auto one = residual_of(*a, state), other = residual_of(*b, state);
    const auto tangent_one = tangent_of(*a, state, {1, 0.3, 0.1}), tangent_other = tangent_of(*b, state, {1, 0.3, 0.1});
    double size = 0, tangent_size = 0;
    for (const double v : other) size = std::max(size, std::abs(v));
    for (const double v : tangent_other) tangent_size = std::max(tangent_size, std::abs(v));
    for (std::size_t k = 0; k < one.size(); ++k) EXPECT_NEAR(one[k], other[k], 1e-12 * size);
    for (std::size_t k = 0; k < tangent_one.size(); ++k) EXPECT_NEAR(tangent_one[k], tangent_other[k], 1e-12 * tangent_size);
  }
}

TEST(UserLaws, SuiteOfFriction) {
  for (const int law : {6, 7}) {
    Case c = worm();
    c.name += " FRICTION USER " + std::to_string(law);
    c.data.friction = {"USER", {static_cast<double>(law)}};
    c.data.friction_width = 0.4;
    Subject s = subject(c);
    s.build = [c](const Mat3& Q) { return c.build(Q, {.functions = &functions()}); };
    s.build_swapped = {};
    s.tolerance = 1e-7;
    s.step = 2e-4;
    s.skip[Check::ideal] = "friction and the separating force are not gradients of constraints";
    run_suite(s);
  }
}

}  // namespace
}  // namespace engrane
