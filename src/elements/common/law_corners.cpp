// SPDX-License-Identifier: BSD-3-Clause
#include "elements/common/law_corners.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace engrane::elements {

namespace {

constexpr std::size_t most_corners = 20;
constexpr double least = std::numeric_limits<double>::min();

/// Corners within one period, in [0, period).
std::vector<double> corners_of_period(const Function& function, double period) {
  // an interval's ends are not included: search more than one period and remove duplicates
  std::vector<double> found = function.corners(-period / 4, period * 5 / 4, 2 * most_corners);
  for (double& x : found) x -= period * std::floor(x / period);
  std::sort(found.begin(), found.end());
  const auto same = [&](double a, double b) { return b - a < 1e-12 * period; };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());
  if (found.size() > 1 && same(found.back(), found.front() + period)) found.pop_back();
  return found;
}

}  // namespace

LawCorners::LawCorners(const Function& function) : period_(function.period()) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (const Expression* formula = function.formula()) {
    *this = LawCorners(*formula);
    return;
  }
  places_ = period_ > 0 ? corners_of_period(function, period_) : function.corners(-infinity, infinity, most_corners);
  if (places_.size() > most_corners) places_.clear();
}

LawCorners::LawCorners(const Expression& formula) {
  if (const std::size_t count = formula.decisions().size(); count > 0 && count <= most_corners) formula_ = &formula;
}

LawCorners::LawCorners(std::vector<double> places, double period) : places_(std::move(places)), period_(period) {
  if (places_.size() > most_corners) places_.clear();
}

void LawCorners::name(std::vector<SwitchNames>& names, const std::string& law) const {
  if (formula_) {
    for (const std::string& decision : formula_->decisions()) {
      const std::string what = fmt::format("{} passes the corner of {}, ", law, decision);
      if (decision.starts_with("abs") || decision.starts_with("sign"))
        names.push_back({what + "operand positive", what + "operand negative"});
      else
        names.push_back({what + "first operand larger", what + "first operand smaller"});
    }
    return;
  }
  for (const double place : places_) {
    const std::string what = fmt::format("{} passes its corner at {:.6g}", law, place);
    if (period_ > 0) {  // in the next period its sign changes the other way
      const std::string passes = fmt::format("{} or periods of {:.6g} from it", what, period_);
      names.push_back({passes, passes});
    } else {
      names.push_back({what + " upwards", what + " downwards"});
    }
  }
}

std::size_t LawCorners::switches(const Taylor& x, double time, double size, std::span<Switch> values) const {
  if (formula_) {
    std::vector<Expression::Decision> decisions(formula_->decisions().size());
    formula_->decide(x, time, size, decisions);
    std::transform(decisions.begin(), decisions.end(), values.begin(), [](const Expression::Decision& d) {
      return std::isfinite(d.value) ? Switch{d.value, d.rate, d.size + least} : Switch{};
    });
    return decisions.size();
  }
  for (std::size_t i = 0; i < places_.size(); ++i) {
    Switch& s = values[i];
    s = {x.value - places_[i], x.d1, std::abs(places_[i]) + size + least};
    if (period_ > 0) {  // zero at every repetition of the corner, with the same slope magnitude
      const double wave = std::numbers::pi / period_, angle = wave * std::remainder(s.value, 2 * period_);
      s.value = std::sin(angle) / wave;
      s.rate *= std::cos(angle);
    }
  }
  return places_.size();
}

}  // namespace engrane::elements
