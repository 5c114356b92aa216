// SPDX-License-Identifier: BSD-3-Clause
#include "math/expression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace engrane {
namespace {

double constant(std::string_view text) {
  const Expression::Parsed parsed = Expression::parse(text, false);
  EXPECT_TRUE(parsed.good()) << text << ": " << parsed.fault.message;
  EXPECT_TRUE(parsed.expression.constant());
  return parsed.expression.value(0);
}

Expression formula(std::string_view text) {
  Expression::Parsed parsed = Expression::parse(text);
  EXPECT_TRUE(parsed.good()) << text << ": " << parsed.fault.message;
  return std::move(parsed.expression);
}

Expression::Fault fault(std::string_view text, bool variable = true) {
  const Expression::Parsed parsed = Expression::parse(text, variable);
  EXPECT_FALSE(parsed.good()) << text;
  return parsed.fault;
}

TEST(Expression, ArithmeticOfFortran) {
  EXPECT_EQ(constant("1+2*3"), 7);
  EXPECT_EQ(constant("(1+2)*3"), 9);
  EXPECT_EQ(constant("2**3**2"), 512);
  EXPECT_EQ(constant("-2**2"), -4);
  EXPECT_EQ(constant("(-2)**3"), -8);
  EXPECT_EQ(constant("2**-1"), 0.5);
  EXPECT_EQ(constant("2*-3"), -6);
  EXPECT_EQ(constant("8/4/2"), 1);
  EXPECT_EQ(constant("1-2-3"), -4);
  EXPECT_EQ(constant("--1"), 1);
  EXPECT_EQ(constant("1.5D3 + .5d0 + 2.E-1"), 1500.7);
  EXPECT_EQ(constant("1.5+3"), 4.5);
  EXPECT_EQ(constant("  Max( 1 , 3,2 ) - MIN(4)"), -1);
  EXPECT_EQ(constant("atan2(1,-1)"), std::atan2(1, -1));
  EXPECT_EQ(constant("1000/cos(20*PI/180)"), 1000 / std::cos(20 * std::numbers::pi / 180));
  EXPECT_EQ(constant("-atan(5)*180/pi"), -std::atan(5.0) * 180 / std::numbers::pi);
  EXPECT_EQ(constant("abs(log(exp(-2)))"), 2);
}

TEST(Expression, FaultsNameTheirPlace) {
  const auto expect = [](std::string_view text, std::size_t at, std::string_view words, bool variable = true) {
    const Expression::Fault f = fault(text, variable);
    EXPECT_EQ(f.at, at) << text << ": " << f.message;
    EXPECT_NE(f.message.find(words), std::string::npos) << text << ": " << f.message;
  };
  expect("", 0, "missing here");
  expect("1+", 1, "missing here");
  expect("1+*2", 2, "not `*`");
  expect("2 T", 2, "operator is missing");
  expect("(1+2", 0, "never closed");
  expect("sin(1", 3, "never closed");
  expect("1+2)", 3, "closes nothing");
  expect("sin 1", 0, "parentheses");
  expect("sine(1)", 0, "not known");
  expect("T*2", 0, "not known", false);
  expect("T+X", 2, "one variable");
  expect("sin(1,2)", 0, "takes 1 argument");
  expect("atan2(1)", 0, "takes 2 arguments");
  expect("(1,2)", 2, "comma");
  expect("3+1/0", 3, "not a finite");
  expect("sqrt(-1)", 0, "not a finite");
  expect("1e999", 0, "range");
  expect("1 $ 2", 2, "operator is missing");
  expect(std::string(200, '('), 99, "deep");
  EXPECT_EQ(fault("sine(1)").hint, "did you mean sin?");
}

TEST(Expression, SurvivesDepthAndLength) {
  fault(std::string(100000, '('));
  std::string tower = "1";
  for (int i = 0; i < 100000; ++i) tower += "**1";
  fault(tower);
  std::string chain = "T";
  for (int i = 0; i < 10000; ++i) chain += "+T*1";
  EXPECT_EQ(formula(chain).value(1), 10001);
  EXPECT_EQ(formula(std::string(9999, '-') + "T").value(3), -3);
  std::string nested = "T";
  for (int i = 0; i < 40; ++i) nested = "(1+" + nested + ")";
  EXPECT_EQ(formula(nested).value(2), 42);
}

/// Third-order Taylor agreement: f(t+h) minus the series shrinks as h⁴.
void expect_series(std::string_view text, double t) {
  const Expression f = formula(text);
  const Jet j = f.at(t);
  EXPECT_EQ(j.f, f.value(t)) << text;
  const auto gap = [&](double h) { return std::abs(f.value(t + h) - (j.f + h * (j.d1 + h / 2 * (j.d2 + h / 3 * j.d3)))); };
  const double large = gap(2e-2), small = gap(1e-2);
  EXPECT_LE(small, std::max(large / 12, 1e-13 * (1 + std::abs(j.f)))) << text << " at " << t << ": " << large << " " << small;
}

TEST(Expression, DerivativesAreThoseOfTheFunction) {
  for (const double t : {0.3, 0.71}) {
    for (const std::string_view text : {"sin(3*T)",
                                        "cos(T**2)",
                                        "tan(T)",
                                        "asin(T/2)",
                                        "acos(T/3)",
                                        "atan(4*T)",
                                        "atan2(T, 1-T)",
                                        "sqrt(1+T**3)",
                                        "exp(-T)*T",
                                        "log(2+sin(T))",
                                        "abs(T-2)",
                                        "min(T, T**2)",
                                        "max(T, 1/T)",
                                        "T**2.5",
                                        "T**T",
                                        "2**T",
                                        "T**-2",
                                        "tanh(2*T)",
                                        "if(T < 0.5, T**3, exp(T))",
                                        "sign(T**3, 1-T)",
                                        "1/(1+T)",
                                        "(1+T)/(2-T*T)",
                                        "X*(1-X)",
                                        "3"})
      expect_series(text, t);
  }
}

TEST(Expression, ExactValuesOfDerivatives) {
  const Jet cubic = formula("T**3 - 2*T").at(0);
  EXPECT_EQ(cubic.f, 0);
  EXPECT_EQ(cubic.d1, -2);
  EXPECT_EQ(cubic.d2, 0);
  EXPECT_EQ(cubic.d3, 6);
  const Jet e = formula("exp(2*T)").at(0);
  EXPECT_EQ(e.d3, 8);
  const Jet constant_power = formula("(0*T)**0.5").at(1);
  EXPECT_EQ(constant_power.d1, 0);
}

TEST(Expression, CornersTakeTheRight) {
  EXPECT_EQ(formula("abs(T)").at(0).d1, 1);
  EXPECT_EQ(formula("abs(1-T)").at(1).d1, 1);
  EXPECT_EQ(formula("max(0, T-1)").at(1).d1, 1);
  EXPECT_EQ(formula("max(T-1, 0)").at(1).d1, 1);
  EXPECT_EQ(formula("min(0, T-1)").at(1).d1, 0);
  EXPECT_EQ(formula("min(T-1, 0)").at(1).d1, 0);
  EXPECT_EQ(formula("max(0, T**3)").at(0).d3, 6);
}

TEST(Expression, ComparisonsAndLogicGiveOneAndNought) {
  EXPECT_EQ(constant("1 < 2"), 1);
  EXPECT_EQ(constant("2 <= 2"), 1);
  EXPECT_EQ(constant("1 > 2"), 0);
  EXPECT_EQ(constant("2 >= 3"), 0);
  EXPECT_EQ(constant("2 == 2"), 1);
  EXPECT_EQ(constant("2 /= 2"), 0);
  EXPECT_EQ(constant("1.LT.2"), 1);
  EXPECT_EQ(constant("1.5.ge.1.d0"), 1);
  EXPECT_EQ(constant("1.E1 .eq. 10."), 1);
  EXPECT_EQ(constant("3.NE.3.OR.2.GT.1"), 1);
  EXPECT_EQ(constant(".NOT. 1 > 2"), 1);
  EXPECT_EQ(constant("1 < 2 .AND. .NOT. 2 < 3"), 0);
  EXPECT_EQ(constant("1 > 2 .AND. 0 < 1 .OR. 1 < 2"), 1) << ".AND. binds before .OR.";
  EXPECT_EQ(constant("1 + 2 < 2*2"), 1);
  EXPECT_EQ(constant("(1 < 2)*5 - 6/3/2"), 4);
  EXPECT_EQ(constant("6/(2)/3"), 1);
}

TEST(Expression, Choices) {
  EXPECT_EQ(constant("if(1 < 2, 3, 4)"), 3);
  EXPECT_EQ(constant("IF(0, 3, 4)"), 4);
  EXPECT_EQ(constant("sign(-3)"), -1);
  EXPECT_EQ(constant("sign(0)"), 0);
  EXPECT_EQ(constant("sign(-3, 2)"), 3) << "as in Fortran";
  EXPECT_EQ(constant("sign(3, -2)"), -3);
  EXPECT_EQ(constant("sign(3, 0)"), 3);
  EXPECT_EQ(constant("tanh(0.5)"), std::tanh(0.5));
  const Expression ramp = formula("if(T < 1, 0, if(T < 2, (T-1)**2, 1))");
  EXPECT_EQ(ramp.value(0.5), 0);
  EXPECT_EQ(ramp.value(1.5), 0.25);
  EXPECT_EQ(ramp.value(3), 1);
  EXPECT_EQ(ramp.at(1.5).d1, 1);
  EXPECT_EQ(ramp.at(1.5).d2, 2);
  EXPECT_EQ(formula("if(T < 1, 0, sqrt(T-1))").at(0.5).f, 0) << "what is not chosen may be undefined";
  EXPECT_TRUE(std::isnan(formula("if(sqrt(T) < 1, 0, 1)").at(-1).f));
  EXPECT_TRUE(std::isnan(formula("max(0, sqrt(T))").value(-1)));
  EXPECT_TRUE(std::isnan(formula("max(0, sqrt(T))").at(-1).f));
  EXPECT_TRUE(std::isnan(formula("min(sqrt(T), 0)").at(-1).f));
  EXPECT_TRUE(std::isnan(formula("sign(sqrt(T))").at(-1).f));
  EXPECT_TRUE(std::isnan(formula("1 .OR. sqrt(T)").at(-1).f));
}

TEST(Expression, JumpsTakeTheRight) {
  for (const auto& [text, right] : {std::pair{"if(T > 1, 5, 0)", 5.0},
                                    {"if(T <= 1, 0, 5)", 5.0},
                                    {"if(T < 1, 0, 5)", 5.0},
                                    {"5*(T > 1)", 5.0},
                                    {"if(T == 1, 0, 5)", 5.0},
                                    {"sign(T-1)", 1.0},
                                    {"sign(5, 1-T)", -5.0},
                                    {"if(.NOT. T > 1, 0, 5)", 5.0},
                                    {"if(T > 1 .AND. T < 2, 5, 0)", 5.0},
                                    {"if(T >= 1 .OR. T < 0, 5, 0)", 5.0},
                                    {"if((T-1)**2 > 0, 5, 0)", 5.0}}) {
    EXPECT_EQ(formula(text).at(1).f, right) << text;
    EXPECT_EQ(formula(text).at(1).d1, 0) << text;
  }
  EXPECT_EQ(formula("if(T > 1, T-1, 0)").at(1).d1, 1);
  EXPECT_EQ(formula("abs(sign(T))").at(0).f, 1);
  const Expression rest = formula("3*sign(V) + 2*D");
  EXPECT_EQ(rest.law(1, 0, 0).value, 2) << "at rest a sign is none";
  EXPECT_EQ(rest.law(1, -2, 0).value, -1);
}

TEST(Expression, FaultsOfComparisons) {
  EXPECT_NE(fault("1 < T < 2").hint.find(".AND."), std::string::npos);
  EXPECT_EQ(fault("1 < T < 2").at, 6);
  EXPECT_NE(fault("T = 2").hint.find("=="), std::string::npos);
  EXPECT_NE(fault("T != 2").hint.find("/="), std::string::npos);
  EXPECT_NE(fault("T^2").hint.find("**"), std::string::npos);
  EXPECT_NE(fault("T && X").hint.find(".AND."), std::string::npos);
  EXPECT_NE(fault("T > 1 ? 2 : 3").hint.find("if("), std::string::npos);
  EXPECT_EQ(fault("if(T, 1)").message, "if takes 3 arguments");
  EXPECT_EQ(fault("sign(1, 2, 3)").message, "sign takes 1 or 2 arguments");
  EXPECT_EQ(fault("tanh(1, 2)").message, "tanh takes 1 argument");
  fault("if(1,2,");
  fault("T <");
  fault(".NOT.");
  std::string deep = "T";
  for (int i = 0; i < 70; ++i) deep = "if(T, 1, " + deep + ")";
  EXPECT_NE(fault(deep).message.find("deep"), std::string::npos);
}

TEST(Expression, LawsOfElongationRateAndTime) {
  const Expression f = formula("3*D**2*V + sin(T)*d - v**3");
  EXPECT_TRUE(f.is_law());
  EXPECT_TRUE(f.uses_time());
  const Expression::Law y = f.law(0.4, -0.7, 0.2);
  EXPECT_NEAR(y.value, 3 * 0.16 * -0.7 + std::sin(0.2) * 0.4 + 0.343, 1e-15);
  EXPECT_NEAR(y.by_elongation, 6 * 0.4 * -0.7 + std::sin(0.2), 1e-15);
  EXPECT_NEAR(y.by_rate, 3 * 0.16 - 3 * 0.49, 1e-15);
  EXPECT_FALSE(formula("2*T").is_law());
  EXPECT_FALSE(formula("2*D").uses_time());
  EXPECT_FALSE(formula("2*V").constant());
  EXPECT_FALSE(fault("2*D", false).message.empty());
}

TEST(Expression, DecisionsAlongAMotion) {
  const Expression damper = formula("100*D + IF(V > 0, 4*V, V) + MAX(D, 0.1*T) - SIGN(D, V - 1) + ABS(D - 1)*ABS(V)");
  EXPECT_EQ(damper.decisions(), (std::vector<std::string>{">", "max", "sign", "sign (2)", "abs", "abs (2)"}));
  const Taylor x(0.3, -2, 5);
  const double time = 4, size = 7;
  std::vector<Expression::Decision> found(damper.decisions().size());
  damper.decide(x, time, size, found);
  const double values[] = {-2, 0.3 - 0.4, 0.3, -3, -0.7, -2}, rates[] = {5, -2 - 0.1, -2, 5, -2, 5};
  // each with its terms, and with the rounding of D and V as far as it depends on them
  const double sizes[] = {2 + 2, 0.7 + 7, 0.3 + 7, 3 + 2, 0.7 + 7, 2 + 2};
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i].value, values[i], 1e-15) << damper.decisions()[i];
    EXPECT_NEAR(found[i].rate, rates[i], 1e-14) << damper.decisions()[i];
    EXPECT_NEAR(found[i].size, sizes[i], 1e-14) << damper.decisions()[i];
  }

  const Expression play = formula("max(0, X**2 - 4)");
  play.decide({3, 0.5, 0}, time, 1, found);
  EXPECT_NEAR(found[0].value, -5, 1e-14) << "0 less x² − 4";
  EXPECT_NEAR(found[0].rate, -3, 1e-14);
  EXPECT_TRUE(formula("SIN(X) == 2*X").decisions().empty());
}

TEST(Expression, CornersAndJumpsToTheLastDigit) {
  using Places = std::vector<double>;
  const auto corners = [](std::string_view text, std::size_t most = 100) { return formula(text).corners(0, 2, most); };
  EXPECT_EQ(corners("if(T < 1, -2.5, 0)"), Places{1});
  EXPECT_EQ(corners("if(T <= 1, -2.5, 0)"), Places{1});
  EXPECT_EQ(corners("if(T >= 0.25 .AND. T < 1.75, 3, 0)*T"), (Places{0.25, 1.75}));
  EXPECT_EQ(corners("max(0, T - 0.3) + sign(T - 0.3001)"), (Places{0.3, 0.3001}));  // between two looks
  EXPECT_EQ(corners("min(T, 0.5, 2)"), Places{0.5});
  EXPECT_EQ(corners("sign(T - 0.5, T - 1.5)"), (Places{0.5, 1.5}));
  const Places folds = corners("abs(sin(PI*T*2))");
  ASSERT_EQ(folds.size(), 3u);
  for (std::size_t k = 0; k < folds.size(); ++k) EXPECT_NEAR(folds[k], 0.5 * static_cast<double>(k + 1), 4e-16);
  EXPECT_EQ(corners("abs((T - 1)**2)"), Places{}) << "touches zero";
  EXPECT_EQ(corners("sin(T) + T**2"), Places{});
  EXPECT_EQ(corners("abs(sin(60*T))", 10), Places{}) << "a measured curve";
}

TEST(Expression, OutsideItsDomainNotANumber) {
  EXPECT_TRUE(std::isnan(formula("sqrt(T)").value(-1)));
  EXPECT_TRUE(std::isnan(formula("log(T)").at(-1).f));
  EXPECT_FALSE(std::isfinite(formula("1/T").value(0)));
}

}  // namespace
}  // namespace engrane
