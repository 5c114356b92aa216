// SPDX-License-Identifier: BSD-3-Clause
#include "model/function.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/function_integral.hpp"
#include "model/model.hpp"

namespace engrane {
namespace {

const deck::Schema& function_schema() {
  const auto& cards = deck::general_commands();
  return *std::find_if(cards.begin(), cards.end(), [](const deck::Schema& card) { return card.name == ".FCT"; });
}

deck::Record record(deck::FunctionCard card) {
  deck::Record r;
  r.id = 7;
  r.location = {0, 1, 1, 1};
  r.data = std::move(card);
  return r;
}

std::unique_ptr<Function> make(deck::FunctionCard card) {
  Diagnostics diagnostics;
  auto function = make_function(record(std::move(card)), diagnostics);
  for (const Diagnostic& d : diagnostics.all()) ADD_FAILURE() << d.message;
  return function;
}

std::string fault_of(deck::FunctionCard card) {
  Diagnostics diagnostics;
  EXPECT_EQ(make_function(record(std::move(card)), diagnostics), nullptr);
  EXPECT_EQ(diagnostics.errors(), 1);
  return diagnostics.errors() == 1 ? diagnostics.all()[0].message : "";
}

deck::FunctionCard formula_card(std::string text) {
  deck::FunctionCard card;
  card.expression = std::move(text);
  return card;
}
deck::FunctionCard table(std::vector<double> values, bool spline = false, std::optional<double> period = {}) {
  deck::FunctionCard card;
  card.table = std::move(values);
  card.spline = spline;
  card.period = period;
  return card;
}

/// The slope of f is d1, of d1 is d2, of d2 is d3; the slope of the integral is f. By central differences.
void expect_consistent(const Function& function, double x) {
  const double h = 1e-4;
  const Function::Jet a = function.at(x - h), j = function.at(x), b = function.at(x + h);
  const double scale = 1 + std::abs(j.d1) + std::abs(j.d2) + std::abs(j.d3);
  EXPECT_NEAR((b.f - a.f) / (2 * h), j.d1, 1e-5 * scale) << x;
  EXPECT_NEAR((b.d1 - a.d1) / (2 * h), j.d2, 1e-5 * scale) << x;
  EXPECT_NEAR((b.d2 - a.d2) / (2 * h), j.d3, 1e-5 * scale) << x;
  EXPECT_NEAR((function.integral(x + h) - function.integral(x - h)) / (2 * h), j.f, 1e-5 * scale) << x;
}

TEST(Function, Tables) {
  const auto lines = make(table({0, 0, 1, 1}));
  EXPECT_EQ(lines->at(0.5).f, 0.5);
  EXPECT_EQ(lines->at(7).f, 1);
  EXPECT_EQ(lines->integral(2), 1.5);
  const auto spline = make(table({0, 0, 1, 2, 2, 0, 3, 1}, true));
  for (const double x : {-0.5, 0.4, 1.7, 2.2, 3.5}) expect_consistent(*spline, x);
  const auto periodic = make(table({0, 0, 1, 2, 2, 0}, true, 2));
  for (const double x : {-5.5, 0.4, 1.7, 100.2}) expect_consistent(*periodic, x);
}

TEST(Function, Sinus) {
  deck::FunctionCard card;
  card.sinus = {2, 3, 90, 0.5};
  const auto f = make(card);
  EXPECT_NEAR(f->at(0).f, 2.5, 1e-15);
  EXPECT_NEAR(f->at(1.0 / 12).f, 0.5, 1e-14);
  EXPECT_NEAR(f->integral(1.0 / 12), 0.5 / 12 + 2 / (6 * std::numbers::pi), 1e-15);
  EXPECT_NEAR(f->integral(1e-9) / 1e-9, 2.5, 1e-12);
  for (const double x : {-0.4, 0.0, 0.3, 2.0}) expect_consistent(*f, x);
  card.sinus = {2, 0, 30};
  EXPECT_NEAR(make(card)->integral(3), 3, 1e-14);
}

TEST(Function, RampAndStep) {
  deck::FunctionCard ramp;
  ramp.ramp = {1, 2, 3, 6};
  const auto r = make(ramp);
  EXPECT_EQ(r->at(0).f, 2);
  EXPECT_EQ(r->at(2).f, 4);
  EXPECT_EQ(r->at(2).d1, 2);
  EXPECT_EQ(r->at(9).f, 6);
  EXPECT_EQ(r->integral(4), 2 + 8 + 6);

  deck::FunctionCard step;
  step.step = {1, 2, 3, 6};
  const auto s = make(step);
  EXPECT_EQ(s->at(1).f, 2);
  EXPECT_EQ(s->at(1).d2, 0);
  EXPECT_EQ(s->at(2).f, 4);
  EXPECT_EQ(s->at(3).f, 6);
  EXPECT_NEAR(s->at(std::nextafter(3.0, 0)).d1, 0, 1e-15);
  EXPECT_NEAR(s->at(std::nextafter(3.0, 0)).d2, 0, 1e-13);
  EXPECT_NEAR(s->integral(4), 2 + 8 + 6, 1e-14);
  EXPECT_EQ(s->integral(-1), -2);
  for (const double x : {0.5, 1.3, 2.0, 2.9, 3.5}) expect_consistent(*s, x);
}

TEST(Function, FormulaIntegralIsExactToRounding) {
  const double pi = std::numbers::pi;
  const auto expect = [](const std::string& text, double x, double value, double tolerance) {
    EXPECT_NEAR(make(formula_card(text))->integral(x), value, tolerance) << text << " to " << x;
  };
  expect("T", 3, 4.5, 1e-14);
  expect("exp(-T)", 10, 1 - std::exp(-10.0), 1e-14);
  expect("exp(T)", -3, std::exp(-3.0) - 1, 1e-14);
  expect("sin(2*PI*1000*T)", 0.3, 0, 1e-13);
  expect("sin(2*PI*1000*T)", 0.30025, 1 / (2 * pi * 1000), 1e-13);
  expect("sin(2*PI*1000*T)", 10.00025, 1 / (2 * pi * 1000), 1e-12);
  expect("sin(T)**2", 1e4, 5e3 - std::sin(2e4) / 4, 1e-9);
  expect("abs(T-1)", 2, 1, 1e-13);
  expect("max(0, T-0.123)", 5, 4.877 * 4.877 / 2, 1e-12);
  expect("sqrt(T)", 4, 16.0 / 3, 1e-12);
  expect("T/(T*T+1E-6)", 1, 0.5 * std::log((1 + 1e-6) / 1e-6), 1e-12);
  expect("exp(-((T-5)*20)**2)", 10, std::sqrt(pi) / 20, 1e-14);
  expect("3", 1e6, 3e6, 1e-6);
  // values that are differences are rounding near zero
  expect("75*(1-cos(PI*min(T/0.02, 1)))", 0.01, 75 * (0.01 - 0.02 / pi), 1e-14);
  expect("sqrt(1+T*T)-1", 1e-3, 1e-9 / 6 - 1e-15 / 40, 1e-18);
  expect("exp(T)-1-T", 1e-4, std::pow(1e-4, 3) / 6 + std::pow(1e-4, 4) / 24, 1e-19);
  // a corner may be as near to zero, or as far away, as units make it
  for (const double unit : {1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6}) {
    const std::string at = std::to_string(1 / unit), text = "min(1, " + at + "*T)";
    for (const double x : {0.5, 1.001, 1.2, 20.0}) {
      const double exact = x < 1 ? 0.5 * x * x : x - 0.5;
      expect(text, x * unit, exact * unit, 1e-14 * x * unit);
      expect(text, -x * unit, 0.5 * x * x * unit, 1e-14 * x * x * unit);
    }
  }
  EXPECT_TRUE(std::isnan(make(formula_card("sqrt(1-T)"))->integral(2)));
  EXPECT_NEAR(make(formula_card("if(T < 0.37, 0, 1)"))->integral(1), 0.63, 1e-9);
  EXPECT_NEAR(make(formula_card("sign(T - 1) + 3*(T > 2)"))->integral(3), 4, 1e-9);
  for (const double x : {-2.0, 0.3, 1.0, 5.0}) expect_consistent(*make(formula_card("cos(T)*exp(-T/3)")), x);
}

TEST(Function, IntegralOfWhatIsKnownByValuesOnly) {
  for (const double unit : {1e-9, 1.0, 1e6}) {
    const PanelIntegral area([unit](double x) { return std::min(1.0, x / unit); }, 0.01 * unit);
    for (const double x : {0.5, 1.001, 20.0})
      EXPECT_NEAR(area(x * unit), (x < 1 ? 0.5 * x * x : x - 0.5) * unit, 1e-13 * x * unit);
  }
}

TEST(Function, IntegralDoesNotDependOnTheOrderOfQuestions) {
  const auto once = make(formula_card("sin(50*T)+T**2")), often = make(formula_card("sin(50*T)+T**2"));
  const double late = once->integral(7.3);
  for (int i = 0; i < 730; ++i) often->integral(0.01 * i);
  EXPECT_EQ(often->integral(7.3), late);
  EXPECT_EQ(once->integral(1.1), often->integral(1.1));
}

TEST(Function, Faults) {
  EXPECT_NE(fault_of({}).find("gives no values"), std::string::npos);
  deck::FunctionCard two = table({0, 0, 1, 1});
  two.expression = "T";
  EXPECT_NE(fault_of(two).find("TABLE and EXPR"), std::string::npos);
  EXPECT_NE(fault_of(table({0, 0, 1})).find("lacks its ordinate"), std::string::npos);
  EXPECT_NE(fault_of(table({0, 0, 1, 1, 1, 2})).find("point 3 at 1"), std::string::npos);
  EXPECT_NE(fault_of(table({0, 0, 1, 1}, false, 0.5)).find("shorter"), std::string::npos);
  EXPECT_NE(fault_of(table({0, 0, 1, 1}, false, -1)).find("positive"), std::string::npos);
  EXPECT_NE(fault_of(table({0, 0, 1, 1}, true, 1)).find("end where it began"), std::string::npos);
  deck::FunctionCard card = formula_card("T");
  card.spline = true;
  EXPECT_NE(fault_of(card).find("SPLINE"), std::string::npos);
  card = {};
  card.sinus = {1};
  EXPECT_NE(fault_of(card).find("two to four"), std::string::npos);
  card = {};
  card.step = {1, 0, 1, 2};
  EXPECT_NE(fault_of(card).find("end after it starts"), std::string::npos);
  EXPECT_NE(fault_of(formula_card("2*U")).find("column 3"), std::string::npos);
}

TEST(Function, FaultsPointIntoTheText) {
  deck::Record r = record(formula_card("2*U"));
  r.field_locations = {{function_schema().find("EXPR"), {0, 4, 20, 5}}};
  Diagnostics diagnostics;
  make_function(r, diagnostics);
  ASSERT_EQ(diagnostics.errors(), 1);
  EXPECT_EQ(diagnostics.all()[0].location.column, 23);
  r = record(table({0, 0, 0, 1}));
  r.field_locations = {{function_schema().find("TABLE"), {0, 5, 9, 1}}};
  make_function(r, diagnostics);
  EXPECT_EQ(diagnostics.all()[1].location.line, 5);
}

TEST(Function, ThroughDifferentiatedNumbers) {
  const auto f = make(formula_card("T**3"));
  Dual<2> x(2.0);
  x.d = {1, 3};
  const Dual<2> y = evaluate(*f, x), dy = evaluate(*f, x, 1), area = evaluate_integral(*f, x);
  EXPECT_EQ(y.d[1], 36);
  EXPECT_EQ(dy.value, 12);
  EXPECT_EQ(dy.d[0], 12);
  EXPECT_NEAR(area.value, 4, 1e-14);
  EXPECT_EQ(area.d[1], 24);
  const Taylor t = evaluate(*f, Taylor(2, 1, 0));
  EXPECT_EQ(t.d1, 12);
  EXPECT_EQ(t.d2, 12);
}

TEST(Function, StepsEndAtThePointsOfASplineOrAtItsEnds) {
  std::vector<double> short_one{1, 0, 2, 3, 4, 1, 5, 0}, long_one;
  for (int k = 0; k <= 150; ++k) long_one.insert(long_one.end(), {1 + 0.01 * k, std::sin(0.3 * k)});
  for (const bool many : {false, true}) {
    const auto spline = make(table(many ? long_one : short_one, true));
    Model model;
    model.of_time = {spline.get()};
    const std::vector<double> joints = model.joints(0, 10);
    EXPECT_EQ(joints.size(), many ? 2u : 4u);
    ASSERT_FALSE(joints.empty());
    EXPECT_EQ(joints.front(), 1);
    EXPECT_NEAR(joints.back(), many ? 2.5 : 5, 1e-12);
  }
}

}  // namespace
}  // namespace engrane
