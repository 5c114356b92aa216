// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>

#include "user/routine.hpp"

namespace engrane::user {
namespace {

std::shared_ptr<const Source> source(const std::string& library, const std::string& name, std::vector<double> parameters = {}) {
  Fault fault;
  auto s = std::make_shared<Source>();
  s->library = Library::open(library, ENGRANE_USER_LIBRARIES, fault);
  EXPECT_TRUE(s->library) << fault.message;
  s->name = name;
  s->address = s->library->routine(name, fault);
  EXPECT_TRUE(s->address) << fault.message;
  s->parameters = std::move(parameters);
  return s;
}

Routine routine(const std::string& library, const std::string& name, Kind kind, std::vector<double> parameters = {},
                Arguments scale = {1, 1, 1}) {
  return {source(library, name, std::move(parameters)), kind, scale};
}

TEST(UserLibrary, IsFoundInEverySpelling) {
  for (const char* name : {"laws_c", "laws_c.so", "liblaws_c", "liblaws_c.so"}) {
    Fault fault;
    EXPECT_TRUE(Library::open(name, ENGRANE_USER_LIBRARIES, fault)) << fault.message;
  }
  Fault fault;
  EXPECT_TRUE(Library::open(std::string(ENGRANE_USER_LIBRARIES) + "/liblaws_c.so", "elsewhere", fault)) << fault.message;
  EXPECT_FALSE(Library::open("laws_d", ENGRANE_USER_LIBRARIES, fault));
  EXPECT_NE(fault.message.find("there is no library \"laws_d\""), std::string::npos);
  EXPECT_FALSE(Library::open("", ENGRANE_USER_LIBRARIES, fault));
  EXPECT_FALSE(Library::open("libm.so.6", ENGRANE_USER_LIBRARIES, fault)) << "the linker's folders are not searched";
}

TEST(UserLibrary, RoutinesAreFoundAsFortranSpellsThem) {
  Fault fault;
  const auto library = Library::open("laws_fixed", ENGRANE_USER_LIBRARIES, fault);
  ASSERT_TRUE(library);
  EXPECT_EQ(library->functions(), (std::vector<std::string>{"stribk", "swing"}));
  const auto swing = library->routine("swing", fault);
  EXPECT_TRUE(swing);
  EXPECT_EQ(library->routine("SWING", fault), swing);
  EXPECT_EQ(library->routine("swing_", fault), swing);
  EXPECT_FALSE(library->routine("swings", fault));
  EXPECT_EQ(fault.message, "liblaws_fixed.so has no routine \"swings\"");
  EXPECT_EQ(fault.hint, "did you mean \"swing\"? It has stribk and swing");
  EXPECT_FALSE(library->routine("sin", fault)) << "functions of other libraries are not the user's";
}

TEST(UserRoutine, GivesWhatItComputes) {
  const double A = 2, w = 3, t = 0.7;
  const Results y = routine("laws_fixed", "swing", Kind::function, {A, w}).at({t, 0, 0});
  EXPECT_NEAR(y[0], A * std::pow(std::sin(w * t), 2), 1e-15);
  EXPECT_NEAR(y[1], A * w * std::sin(2 * w * t), 1e-14);
  EXPECT_NEAR(y[2], 2 * A * w * w * std::cos(2 * w * t), 1e-14);
  EXPECT_NEAR(y[3], -4 * A * w * w * w * std::sin(2 * w * t), 1e-13);
}

TEST(UserRoutine, DifferencesTakeThePlaceOfMissingDerivatives) {
  const double x = 0.7;
  const Results f = routine("wrong_laws", "only_value", Kind::function).at({x, 0, 0});
  EXPECT_NEAR(f[1], std::cos(x), 1e-11);
  EXPECT_NEAR(f[2], -std::sin(x), 1e-9);
  EXPECT_NEAR(f[3], -std::cos(x), 1e-5);
  const Results force = routine("laws_c", "hardening_plain", Kind::force, {50, 400, 3}, {0.1, 0.1, 1}).at({0.2, 0.5, 0});
  EXPECT_NEAR(force[1], 50 + 3 * 400 * 0.04, 1e-7);
  EXPECT_NEAR(force[2], 3, 1e-8);
}

TEST(UserRoutine, DifferencesStayWhereTheRoutineIsGood) {
  forget_failures();
  const double pi = std::acos(-1.0);
  const auto expect = [&](Kind kind, const Arguments& x, const Results& y) {
    const double load = 0.2 * (1 + 0.1 * x[1]), phase = pi * x[0];
    EXPECT_NEAR(y[1], pi * load * std::cos(phase), kind == Kind::friction ? 1e-8 : 1e-9);
    if (kind == Kind::friction) {
      EXPECT_NEAR(y[2], 0.02 * std::sin(phase), 1e-8);
      return;
    }
    EXPECT_NEAR(y[2], -pi * pi * load * std::sin(phase), 1e-6);
    const bool mesh = kind == Kind::mesh;
    EXPECT_NEAR(y[3], mesh ? 0.02 * std::sin(phase) : -pi * pi * pi * load * std::cos(phase), mesh ? 1e-8 : 1e-3);
  };
  for (const Kind kind : {Kind::function, Kind::mesh, Kind::friction}) {
    const Routine bounded = routine("wrong_laws", "bounded", kind, {1});
    for (const double place : {0.0, 0.0015, 0.4, 0.9995, 1.0}) {
      for (const double second : {0.0, 1e-6, 2.0}) {
        const Arguments x{place, kind == Kind::function ? 0 : second, 0};
        expect(kind, x, bounded.at(x));
      }
    }
    EXPECT_EQ(bounded.check({{0, 0, 0}, {1, 0, 0}}).message, "");
  }
  EXPECT_EQ(last_failure(), "");
}

TEST(UserRoutine, DifferencesSayWhatTheRoutineSays) {
  forget_failures();
  EXPECT_TRUE(std::isnan(routine("wrong_laws", "bounded", Kind::function, {0.001}).at({0.0005, 0, 0})[1]));
  EXPECT_EQ(last_failure(),
            "bounded of libwrong_laws.so says that this is outside what it is good for (at variable -0.0015, for a derivative "
            "that it does not give at variable 0.0005)");
  forget_failures();
}

TEST(UserRoutine, ChecksPassWhatIsRight) {
  const std::vector<Arguments> around{{0, 0, 0}, {0.3, 0.1, 0}, {-0.2, -0.4, 0}};
  EXPECT_EQ(routine("laws_fortran", "hardening", Kind::force, {50, 400, 3}).check(around).message, "");
  EXPECT_EQ(routine("laws_fortran", "hardening", Kind::force, {1e12, 1e-9, 1e-6}, {1e-3, 1e-3, 1}).check(around).message, "");
  EXPECT_EQ(routine("laws_c", "hardening_plain", Kind::force, {50, 400, 3}).check(around).message, "");
  EXPECT_EQ(routine("wrong_laws", "one_sided", Kind::force).check(around).message, "") << "a corner at the first sample";
  EXPECT_EQ(routine("laws_fixed", "swing", Kind::function, {2, 300}).check(around).message, "") << "much faster than the scale";
  EXPECT_EQ(routine("laws_c", "fourier_mesh", Kind::mesh, {0.2, 0, 0, 0.1}).check(around).message, "");
}

TEST(UserRoutine, ChecksNameWhatIsWrong) {
  const std::vector<Arguments> around{{0.3, 0.1, 0}};
  const auto says = [&](const char* name, Kind kind, const std::string& words) {
    const Fault fault = routine("wrong_laws", name, kind).check(around);
    EXPECT_NE(fault.message.find(words), std::string::npos) << name << ": " << fault.message;
  };
  says("wrong_slope", Kind::force, "derivative of the force by the elongation is given as 50.27");
  says("wrong_slope", Kind::force, "make it 100.27");
  says("wrong_rate", Kind::force, "derivative of the force by the rate is given as -3");
  says("wrong_energy", Kind::force, "the energy stored changes by 60 per elongation, and the force at rest is 30");
  says("wrong_second", Kind::function, "the second derivative is given as 0.29552");
  says("no_value", Kind::friction, "gives no value");
  says("own_error", Kind::force, "reports its error 7");
  says("counts_calls", Kind::force, "answers 1 and then 2");
}

TEST(UserRoutine, FailuresAreNumbersThatAreNoneAndWordsThatSayWhy) {
  forget_failures();
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Routine ends = routine("wrong_laws", "ends", Kind::force, {0.5});
  EXPECT_EQ(ends.at({0.4, 0, 0})[0], 0.4);
  EXPECT_EQ(last_failure(), "");
  EXPECT_TRUE(std::isnan(ends.at({0.6, 0, 0})[1]));
  EXPECT_EQ(last_failure(),
            "ends of libwrong_laws.so says that this is outside what it is good for (at elongation 0.6, rate 0 and time 0)");
  forget_failures();
  EXPECT_TRUE(std::isnan(routine("wrong_laws", "breaks", Kind::force, {0.5}).at({0.6, 0, 0})[0]));
  EXPECT_NE(last_failure().find("gives a result that is not a finite number"), std::string::npos);
  EXPECT_TRUE(std::isnan(routine("laws_fixed", "swing", Kind::function, {1, 1}).at({none, 0, 0})[0]));
  forget_failures();
}

TEST(UserRoutine, CrashesAreCalledByName) {
  const Routine crashes = routine("wrong_laws", "crashes", Kind::force, {0.5});
  EXPECT_EQ(crashes.at({0.4, 0, 0})[0], 0.4);
  EXPECT_DEATH(crashes.at({0.6, 0, 0}), "the user routine crashes of libwrong_laws.so crashed");
}

TEST(UserRoutine, SeveralThreadsAskAtOnce) {
  const Routine swing = routine("laws_fixed", "swing", Kind::function, {2, 3});
  std::vector<double> sums(4);
  std::vector<std::thread> threads;
  for (double& sum : sums)
    threads.emplace_back([&] {
      for (int i = 0; i < 1000; ++i) sum += swing.at({0.001 * i, 0, 0})[0];
    });
  for (std::thread& t : threads) t.join();
  for (const double sum : sums) EXPECT_EQ(sum, sums[0]);
}

}  // namespace
}  // namespace engrane::user
