// SPDX-License-Identifier: BSD-3-Clause
#include "model/function.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "math/spline.hpp"
#include "model/function_failure.hpp"
#include "model/function_integral.hpp"
#include "model/jump.hpp"
#include "model/user_function.hpp"

namespace engrane {

namespace {

class CurveFunction final : public Function {
 public:
  explicit CurveFunction(Curve curve) : curve_(std::move(curve)) {}
  Jet at(double x) const override { return curve_.at(x); }
  double integral(double x) const override { return curve_.integral(x); }
  std::vector<double> corners(double from, double to, std::size_t most) const override { return curve_.corners(from, to, most); }
  std::vector<double> joints(double from, double to, std::size_t most) const override { return curve_.joints(from, to, most); }
  double period() const override { return curve_.period(); }

 private:
  Curve curve_;
};

class SinusFunction final : public Function {
 public:
  SinusFunction(double amplitude, double frequency, double phase_degrees, double mean)
      : amplitude_(amplitude),
        omega_(2 * std::numbers::pi * frequency),
        phase_(std::fmod(phase_degrees, 360) * std::numbers::pi / 180),
        mean_(mean) {}

  Jet at(double x) const override {
    const double s = amplitude_ * std::sin(omega_ * x + phase_), c = amplitude_ * std::cos(omega_ * x + phase_);
    return {mean_ + s, omega_ * c, -omega_ * omega_ * s, -omega_ * omega_ * omega_ * c};
  }
  double integral(double x) const override {
    // cos φ - cos(ωx + φ) = 2 sin(ωx/2) sin(ωx/2 + φ): avoids cancellation for small ωx
    const double half = omega_ * x / 2;
    const double width = half == 0 ? x : x * std::sin(half) / half;
    return mean_ * x + amplitude_ * width * std::sin(half + phase_);
  }

 private:
  double amplitude_, omega_, phase_, mean_;
};

/// y0, then y0 + (y1 - y0)(10 s³ - 15 s⁴ + 6 s⁵), then y1.
class StepFunction final : public Function {
 public:
  StepFunction(double t0, double y0, double t1, double y1) : t0_(t0), y0_(y0), width_(t1 - t0), rise_(y1 - y0) {
    from_t0_to_zero_ = from_t0(0);
  }

  Jet at(double x) const override {
    const double s = (x - t0_) / width_;
    if (s < 0) return {y0_, 0, 0, 0};
    if (s >= 1) return {y0_ + rise_, 0, 0, 0};
    const double w = width_;
    return {y0_ + rise_ * s * s * s * (10 + s * (6 * s - 15)), rise_ * 30 * s * s * (1 - s) * (1 - s) / w,
            rise_ * 60 * s * (1 - s) * (1 - 2 * s) / (w * w), rise_ * (60 + 360 * s * (s - 1)) / (w * w * w)};
  }
  double integral(double x) const override { return from_t0(x) - from_t0_to_zero_; }
  std::vector<double> corners(double from, double to, std::size_t most) const override {
    std::vector<double> found;
    for (const double x : {t0_, t0_ + width_})
      if (rise_ != 0 && from < x && x < to) found.push_back(x);
    return found.size() <= most ? found : std::vector<double>();
  }

 private:
  double from_t0(double x) const {
    const double s = (x - t0_) / width_;
    if (s < 0) return y0_ * (x - t0_);
    if (s >= 1) return y0_ * (x - t0_) + rise_ * width_ * (s - 0.5);
    return y0_ * (x - t0_) + rise_ * width_ * s * s * s * s * (2.5 + s * (s - 3));
  }
  double t0_, y0_, width_, rise_;
  double from_t0_to_zero_ = 0;
};

class FormulaFunction final : public Function {
 public:
  /// `name`: "function 3", for messages.
  FormulaFunction(Expression formula, std::string name, std::string text)
      : formula_(std::move(formula)),
        name_(std::move(name)),
        text_(std::move(text)),
        integral_([this](double x) { return formula_.value(x); }, [this](double x) { return formula_.rounding(x); }) {
    if (formula_.constant()) constant_ = formula_.value(0);
  }

  Jet at(double x) const override {
    if (constant_) return {*constant_, 0, 0, 0};
    const Jet j = formula_.at(x);
    const std::array values{j.f, j.d1, j.d2, j.d3};
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!std::isfinite(values[i])) {
        note(static_cast<int>(i), values[i], x);
        break;
      }
    return j;
  }
  double integral(double x) const override {
    if (constant_) return *constant_ * x;
    const double area = integral_(x);
    if (!std::isfinite(area)) {
      const double value = formula_.value(x);
      if (std::isfinite(value))
        note_function_failure(0, fmt::format("{}, EXPR \"{}\", {} somewhere between 0 and {:.10g}, which its integral needs",
                                             name_, text_, describe_not_finite(area), x));
      else
        note(0, value, x);
    }
    return area;
  }
  const Expression* formula() const override { return &formula_; }
  const Expression* law() const override { return formula_.is_law() ? &formula_ : nullptr; }
  std::vector<double> corners(double from, double to, std::size_t most) const override {
    return formula_.is_law() || !std::isfinite(to - from) ? std::vector<double>() : formula_.corners(from, to, most);
  }

 private:
  void note(int order, double value, double x) const {
    static constexpr std::array of{"", "the derivative of ", "the second derivative of ", "the third derivative of "};
    note_function_failure(order, fmt::format("{}{}, EXPR \"{}\", {} at {} = {:.10g}", of[static_cast<std::size_t>(order)], name_,
                                             text_, describe_not_finite(value), formula_.variable(), x));
  }

  Expression formula_;
  std::string name_, text_;
  std::optional<double> constant_;  ///< if the formula does not use its variable
  PanelIntegral integral_;
};

/// Checks one record and builds its function.
class FunctionBuilder {
 public:
  FunctionBuilder(const deck::Record& record, Diagnostics& diagnostics, const FunctionSetting& setting)
      : record_(record), card_(*record.get<deck::FunctionCard>()), diagnostics_(diagnostics), setting_(setting) {}

  std::unique_ptr<Function> build() {
    const std::vector<std::pair<std::string, bool>> forms{{"TABLE", !card_.table.empty()},     {"SINUS", !card_.sinus.empty()},
                                                          {"RAMP", !card_.ramp.empty()},       {"STEP", !card_.step.empty()},
                                                          {"EXPR", !card_.expression.empty()}, {"USER", !card_.user.empty()}};
    std::vector<std::string> given;
    for (const auto& [name, is_given] : forms)
      if (is_given) given.push_back(name);
    if (given.size() != 1) {
      const std::string what = given.empty() ? " gives no values" : " is given by " + join(given) + " at once";
      return fail(given.empty() ? record_.location : record_.where(given[1]), "function " + std::to_string(record_.id) + what,
                  "give exactly one of TABLE, SINUS, RAMP, STEP, EXPR or USER");
    }
    if (given[0] != "TABLE") {
      if (card_.spline) return fail(record_.where("SPLINE"), "SPLINE joins the points of a TABLE; this function has none");
      if (card_.period) return fail(record_.where("PERIOD"), "PERIOD repeats a TABLE; this function has none");
    }
    if (given[0] != "USER")
      for (const char* keyword : {"PARAM", "SCALE"})
        if (record_.given(keyword))
          return fail(record_.where(keyword), std::string(keyword) + " is for a USER routine; this function has none");
    if (given[0] == "USER") return make_user_function(record_, setting_, diagnostics_);
    if (given[0] == "TABLE") return table();
    if (given[0] == "SINUS") return sinus();
    if (given[0] == "EXPR") return formula();
    return transition(given[0], given[0] == "RAMP" ? card_.ramp : card_.step);
  }

 private:
  std::unique_ptr<Function> fail(Location where, std::string message, std::string hint = {}) {
    diagnostics_.error(where, std::move(message), std::move(hint));
    return nullptr;
  }

  std::unique_ptr<Function> table() {
    const Location where = record_.where("TABLE");
    const std::vector<double>& t = card_.table;
    if (t.size() % 2 != 0)
      return fail(where, "TABLE has " + counted(t.size(), "number") + "; the last abscissa lacks its ordinate",
                  "give abscissa and ordinate in turn");
    std::vector<double> x, y;
    for (std::size_t i = 0; i < t.size(); i += 2) {
      if (!x.empty() && t[i] <= x.back())
        return fail(where,
                    "the abscissas of TABLE must increase: point " + std::to_string(i / 2 + 1) + " at " + format_number(t[i]) +
                        " follows one at " + format_number(x.back()),
                    "give abscissa and ordinate in turn, the abscissas in increasing order");
      x.push_back(t[i]);
      y.push_back(t[i + 1]);
    }
    if (!card_.period) return std::make_unique<CurveFunction>(card_.spline ? Curve::natural_spline(x, y) : Curve::lines(x, y));

    const double period = *card_.period, reach = x.back() - x.front();
    const Location at_period = record_.where("PERIOD");
    if (!(period > 0)) return fail(at_period, "PERIOD must be positive, not " + format_number(period));
    if (reach > period * (1 + 1e-12))
      return fail(at_period,
                  "PERIOD " + format_number(period) + " is shorter than the table, which reaches over " + format_number(reach));
    const bool whole = x.size() > 1 && period - reach <= 1e-12 * period;
    if (card_.spline && whole && y.back() != y.front())
      return fail(where,
                  "a periodic spline must end where it began: the table starts with " + format_number(y.front()) +
                      " and ends, one period later, with " + format_number(y.back()),
                  "repeat the first ordinate or leave the last point out");
    return std::make_unique<CurveFunction>(card_.spline ? Curve::periodic_spline(x, y, period) : Curve::lines(x, y, period));
  }

  std::unique_ptr<Function> sinus() {
    const std::vector<double>& v = card_.sinus;
    if (v.size() < 2 || v.size() > 4)
      return fail(record_.where("SINUS"), "SINUS takes two to four numbers, not " + std::to_string(v.size()),
                  "give amplitude, frequency [Hz], phase [degrees], mean");
    return std::make_unique<SinusFunction>(v[0], v[1], v.size() > 2 ? v[2] : 0, v.size() > 3 ? v[3] : 0);
  }

  std::unique_ptr<Function> transition(const std::string& name, const std::vector<double>& v) {
    if (v.size() != 4)
      return fail(record_.where(name), name + " takes four numbers, not " + std::to_string(v.size()), "give t0 y0 t1 y1");
    if (v[2] <= v[0])
      return fail(record_.where(name),
                  name + " must end after it starts: t1 = " + format_number(v[2]) + " is not beyond t0 = " + format_number(v[0]));
    if (name == "STEP") return std::make_unique<StepFunction>(v[0], v[1], v[2], v[3]);
    return std::make_unique<CurveFunction>(Curve::lines(std::vector{v[0], v[2]}, std::vector{v[1], v[3]}));
  }

  std::unique_ptr<Function> formula() {
    Expression::Parsed parsed = Expression::parse(card_.expression);
    if (parsed.good())
      return std::make_unique<FormulaFunction>(std::move(parsed.expression), fmt::format("function {}", record_.id),
                                               card_.expression);
    const Expression::Fault& fault = parsed.fault;
    Location where = record_.where("EXPR");
    std::string message = fault.message;
    // The caret can point into the text only if the deck contains it literally.
    const auto size = static_cast<int>(card_.expression.size());
    if (where.known() && (where.length == size + 2 || where.length == size)) {
      where.column += static_cast<int>(fault.at) + (where.length == size + 2 ? 1 : 0);
      where.length = static_cast<int>(fault.length);
    } else {
      message += " (column " + std::to_string(fault.at + 1) + " of the expression \"" + card_.expression + "\")";
    }
    return fail(where, "EXPR: " + message, fault.hint);
  }

  const deck::Record& record_;
  const deck::FunctionCard& card_;
  Diagnostics& diagnostics_;
  const FunctionSetting& setting_;
};

/// A function with a corner where the run ends: its slopes there are those of the run, up to `corner`, not of what would follow.
/// A TABLE that ends with the run would otherwise stop the drive in the last instant.
class SmoothToTheEnd final : public Function {
 public:
  SmoothToTheEnd(std::unique_ptr<Function> function, double end, double corner)
      : function_(std::move(function)), end_(end), before_(function_->at(number_before(std::min(corner, end)))) {}
  Jet at(double x) const override {
    Jet jet = function_->at(x);
    if (x == end_) jet = {jet.f, before_.d1, before_.d2, before_.d3};
    return jet;
  }
  double integral(double x) const override { return function_->integral(x); }
  std::vector<double> corners(double from, double to, std::size_t most) const override {
    return function_->corners(from, to, most);
  }
  std::vector<double> joints(double from, double to, std::size_t most) const override {
    return function_->joints(from, to, most);
  }
  double period() const override { return function_->period(); }
  const Expression* formula() const override { return function_->formula(); }
  const Expression* law() const override { return function_->law(); }

 private:
  std::unique_ptr<Function> function_;
  double end_;
  Jet before_;
};

/// The corner of the function at x; the first of several that differ by rounding.
std::optional<double> corner_at(const Function& function, double x) {
  const double way = 1e-12 * std::abs(x);
  const std::vector<double> found = function.corners(x - way, x + way, 10);
  return found.empty() ? std::nullopt : std::optional(found.front());
}

}  // namespace

std::unique_ptr<Function> make_function(const deck::Record& record, Diagnostics& diagnostics, const FunctionSetting& setting) {
  auto function = FunctionBuilder(record, diagnostics, setting).build();
  const std::optional<double> corner = function ? corner_at(*function, setting.end) : std::nullopt;
  return corner ? std::make_unique<SmoothToTheEnd>(std::move(function), setting.end, *corner) : std::move(function);
}

}  // namespace engrane
