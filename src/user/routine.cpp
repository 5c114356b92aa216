// SPDX-License-Identifier: BSD-3-Clause
#include "user/routine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <mutex>
#include <optional>
#include <span>
#include <utility>

#include "base/text.hpp"
#include "user/crash.hpp"

namespace engrane::user {

namespace {

constexpr double not_given = ENGRANE_NOT_GIVEN;

}  // namespace

/// Entry of y: the value, a derivative of another entry with respect to an argument (`of` ≥ 0), or any other result.
struct Entry {
  const char* name;
  int of = -1;
  std::size_t by = 0;
};

/// Argument of a kind, and the values that it is promised to have.
struct Argument {
  const char* name;
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();

  bool may_be(double value) const { return value >= least && value <= most; }
};

struct Signature {
  const char* name;
  std::vector<Argument> arguments;
  std::vector<Entry> results;
  bool chain;  ///< the successive derivatives with respect to argument 0 (entries 1, 2, …) are part of the result
};

namespace {

const Signature& signature(Kind kind) {
  static const Signature function{"function of one variable",
                                  {{"variable"}},
                                  {{"value"}, {"derivative", 0, 0}, {"second derivative", 1, 0}, {"third derivative", 2, 0}},
                                  true};
  static const Signature force{"force law",
                               {{"elongation"}, {"rate"}, {"time"}},
                               {{"force"},
                                {"derivative of the force by the elongation", 0, 0},
                                {"derivative of the force by the rate", 0, 1},
                                {"energy stored"}},
                               false};
  static const Signature mesh{"mesh stiffness",
                              {{"place in the tooth pitch", 0, 1}, {"deflection", 0}},
                              {{"factor"},
                               {"derivative of the factor by the place", 0, 0},
                               {"second derivative of the factor by the place", 1, 0},
                               {"derivative of the factor by the deflection", 0, 1}},
                              true};
  static const Signature friction{"friction law",
                                  {{"sliding speed", 0}, {"normal force", 0}},
                                  {{"coefficient"},
                                   {"derivative of the coefficient by the speed", 0, 0},
                                   {"derivative of the coefficient by the normal force", 0, 1}},
                                  false};
  switch (kind) {
    case Kind::function:
      return function;
    case Kind::force:
      return force;
    case Kind::mesh:
      return mesh;
    case Kind::friction:
      break;
  }
  return friction;
}

std::string words(const Signature& s, const Arguments& x) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < s.arguments.size(); ++i) all.push_back(fmt::format("{} {:.6g}", s.arguments[i].name, x[i]));
  return join(all);
}

std::string status_words(int status) {
  if (status == ENGRANE_WRONG_PARAMETERS) return "says that its parameters are wrong";
  if (status == ENGRANE_OUTSIDE) return "says that this is outside what it is good for";
  return fmt::format("reports its error {}", status);
}

std::mutex failure_mutex;
std::string failure;

void remember(std::string text) {
  const std::lock_guard lock(failure_mutex);
  failure = std::move(text);
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

constexpr std::size_t most_points = 5;
using Points = std::array<double, most_points>;

/// The polynomial through values at the steps `first`, `first` + 1, …, and its derivatives, at the step 0.
constexpr Points derivatives_at_zero(int first, Points values, std::size_t count) {
  for (std::size_t order = 1; order < count; ++order)  // Newton's divided differences
    for (std::size_t i = count - 1; i >= order; --i) values[i] = (values[i] - values[i - 1]) / static_cast<double>(order);
  Points powers{};  // coefficients of the polynomial in powers of the step
  for (std::size_t i = count; i-- > 0;) {
    const double step = first + static_cast<int>(i);
    for (std::size_t k = count - 1; k > 0; --k) powers[k] = powers[k - 1] - step * powers[k];
    powers[0] = values[i] - step * powers[0];
  }
  double factorial = 1;
  for (std::size_t k = 2; k < count; ++k) powers[k] *= factorial *= static_cast<double>(k);
  return powers;
}

/// What a value contributes to each derivative, by the shift of the points from their place in the middle and by point.
using Contributions = std::array<std::array<Points, most_points>, most_points>;

constexpr Contributions contributions(int beside) {
  const auto count = static_cast<std::size_t>(2 * beside + 1);
  Contributions all{};
  for (std::size_t shift = 0; shift < count; ++shift)
    for (std::size_t i = 0; i < count; ++i) {
      Points one{};
      one[i] = 1;
      all[shift][i] = derivatives_at_zero(static_cast<int>(shift) - 2 * beside, one, count);
    }
  return all;
}
constexpr Contributions of_three = contributions(1), of_five = contributions(2);

}  // namespace

std::string describe(Kind kind) { return signature(kind).name; }

std::string last_failure() {
  const std::lock_guard lock(failure_mutex);
  return failure;
}

void forget_failures() {
  const std::lock_guard lock(failure_mutex);
  failure.clear();
}

Routine::Routine(std::shared_ptr<const Source> source, Kind kind, Arguments scale)
    : source_(std::move(source)), kind_(kind), signature_(&signature(kind)), scale_(scale) {
  for (std::size_t i = 0; i < source_->scale.size() && i < scale_.size(); ++i)
    if (source_->scale[i] > 0) scale_[i] = source_->scale[i];
}

int Routine::call(const Arguments& x, Results& y) const noexcept {
  constexpr int version = ENGRANE_USER_VERSION;
  const int kind = static_cast<int>(kind_), count = static_cast<int>(source_->parameters.size());
  static constexpr double none = 0;  // valid address to pass when there are no parameters
  int status = ENGRANE_FINE;
  y.fill(not_given);
  const Running running(source_->name.c_str(), source_->library->file().c_str());
  try {
    source_->address(&version, &kind, x.data(), count > 0 ? source_->parameters.data() : &none, &count, y.data(), &status);
  } catch (...) {
    status = 1;
  }
  return status;
}

std::optional<Routine::Refusal> Routine::complete(const Arguments& x, Results& y) const noexcept {
  const auto& results = signature_->results;
  for (std::size_t i = 1; i < results.size(); ++i) {
    if (y[i] != not_given || results[i].of < 0) continue;
    const auto base = static_cast<std::size_t>(results[i].of);
    const std::size_t by = results[i].by;
    const bool chain = signature_->chain && by == 0;
    const double h = chain ? 1e-3 * scale_[0] : 1e-5 * std::max(scale_[by], std::abs(x[by]));
    Results found{};
    if (const auto refusal = differentiate(x, y[base], base, by, h, chain ? 2 : 1, found)) return refusal;
    // the successive derivatives all come from the same five values
    for (std::size_t k = 1; i < results.size() && results[i].by == by && k <= (chain ? 3 : 1); ++k, ++i)
      if (y[i] == not_given) y[i] = found[k];
    --i;
  }
  const double* last = y.data() + results.size();
  if (std::all_of(static_cast<const double*>(y.data()), last, [](double v) { return std::isfinite(v); })) return {};
  return Refusal{ENGRANE_FINE, x};
}

std::optional<Routine::Refusal> Routine::differentiate(const Arguments& x, double value, std::size_t base, std::size_t by,
                                                       double h, int beside, Results& derivatives) const noexcept {
  std::optional<Refusal> refusal;
  constexpr int furthest = 4;
  std::array<double, 2 * furthest + 1> values;  // in steps to either side; NaN where not asked yet, or refused
  values.fill(nan);
  values[furthest] = value;
  const auto known = [&](int step) {
    const auto at = static_cast<std::size_t>(furthest + step);
    if (std::isfinite(values[at])) return true;
    Refusal asked{ENGRANE_FINE, x, true};
    asked.at[by] += step * h;
    if (!signature_->arguments[by].may_be(asked.at[by])) return false;
    Results y;
    asked.status = call(asked.at, y);
    if (asked.status == ENGRANE_FINE && y[base] != not_given && std::isfinite(y[base])) {
      values[at] = y[base];
      return true;
    }
    if (!refusal) refusal = asked;
    return false;
  };
  for (const int shift : {0, 1, -1, 2, -2}) {
    if (std::abs(shift) > beside) break;
    bool complete = true;
    for (int step = shift - beside; step <= shift + beside && complete; ++step) complete = known(step);
    if (!complete) continue;
    derivatives.fill(0);
    const auto& parts = (beside == 1 ? of_three : of_five)[static_cast<std::size_t>(shift + beside)];
    for (int i = 0; i <= 2 * beside; ++i) {
      const double change = values[static_cast<std::size_t>(furthest + shift - beside + i)] - value;
      for (std::size_t k = 1; k < derivatives.size(); ++k) derivatives[k] += parts[static_cast<std::size_t>(i)][k] * change;
    }
    for (double power = h; double& derivative : std::span(derivatives).subspan(1)) {
      derivative /= power;
      power *= h;
    }
    return {};
  }
  return refusal ? refusal : Refusal{ENGRANE_OUTSIDE, x};
}

Results Routine::at(const Arguments& x) const noexcept {
  Results y;
  std::optional<Refusal> refusal = Refusal{call(x, y), x};
  const bool none = refusal->status == ENGRANE_FINE && y[0] == not_given;
  if (refusal->status == ENGRANE_FINE && !none) refusal = complete(x, y);
  if (!refusal) return y;
  try {
    remember(fmt::format("{} {} (at {}{})", source_->label(),
                         refusal->status != ENGRANE_FINE ? status_words(refusal->status)
                         : none                          ? "gives no value"
                                                         : "gives a result that is not a finite number",
                         words(*signature_, refusal->at),
                         refusal->beside ? ", for a derivative that it does not give at " + words(*signature_, x) : ""));
  } catch (...) {  // without memory for the message, the NaNs still signal the failure
  }
  y.fill(nan);
  return y;
}

bool Routine::gives(std::size_t i, const Arguments& x) const {
  Results y;
  return call(x, y) == ENGRANE_FINE && y[i] != not_given;
}

Fault Routine::check(const std::vector<Arguments>& samples) const {
  const Signature& s = *signature_;
  const std::string& file = source_->library->file();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Arguments& x = samples[i];
    const std::string place = "at " + words(s, x);
    Results y, again;
    const int status = call(x, y);
    if (status == ENGRANE_WRONG_KIND)
      return {fmt::format("{} of {} says that it is no {} (kind {})", source_->name, file, s.name, static_cast<int>(kind_)),
              "name another routine, or use it for what it computes"};
    if (status != ENGRANE_FINE) {
      if (i > 0) continue;  // a law need not be defined at every sample
      return {
          fmt::format("{} {} ({})", source_->label(), status_words(status), place),
          fmt::format("it was called with {}; see its source",
                      source_->parameters.empty() ? "no PARAM" : counted(source_->parameters.size(), "number") + " in PARAM")};
    }
    if (y[0] == not_given)
      return {source_->label() + " gives no value", "y[0] (y(1) in Fortran) is the " + std::string(s.results[0].name)};
    if (!std::isfinite(y[0])) {
      if (i > 0) continue;
      return {fmt::format("{} gives a {} that is not a finite number ({})", source_->label(), s.results[0].name, place), ""};
    }
    call(x, again);
    if (again[0] != y[0])
      return {fmt::format("{} answers {:.6g} and then {:.6g} to the same question ({})", source_->label(), y[0], again[0], place),
              "its result must follow from x and p alone: it may keep nothing from one call to the next"};
    if (Fault fault = check_derivatives(x, y); !fault.good()) return fault;
  }
  return {};
}

namespace {

/// Whether gaps of differences with steps of a tenth each go to zero: those of a derivative that is zero, as that of x³ at 0, are
/// as large as the differences themselves.
bool vanish(const std::vector<double>& gaps) {
  constexpr double falls = 0.3;
  const std::size_t n = gaps.size();
  return n >= 3 && gaps[n - 1] <= falls * gaps[n - 2] && gaps[n - 2] <= falls * gaps[n - 3];
}

}  // namespace

Fault Routine::check_derivatives(const Arguments& x, const Results& y) const {
  const Signature& s = *signature_;
  for (std::size_t i = 1; i < s.results.size(); ++i) {
    std::size_t base = 0, by = s.results[i].by;
    double given = y[i];
    Arguments place = x;
    if (kind_ == Kind::force && i == 3) {  // the energy: its derivative is the force at zero rate
      if (y[3] == not_given) continue;
      Results still;
      place[1] = 0;
      if (call(place, still) != ENGRANE_FINE) continue;
      base = 3;
      by = 0;
      given = still[0];
    } else {
      base = static_cast<std::size_t>(s.results[i].of);
      if (given == not_given || y[base] == not_given) continue;
    }
    Results middle;
    if (call(place, middle) != ENGRANE_FINE) continue;
    // At a corner, any slope between the one-sided slopes is right. As the scales may be unknown, the best agreement of several
    // step sizes counts.
    double best = std::numeric_limits<double>::infinity(), difference = 0;
    bool known = false;
    std::vector<double> gaps;
    for (const double relative : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
      const double h = relative * std::max(scale_[by], std::abs(place[by]));
      Results low, high;
      Arguments left = place, right = place;
      left[by] -= h;
      right[by] += h;
      if (!s.arguments[by].may_be(left[by]) || !s.arguments[by].may_be(right[by])) continue;
      if (call(left, low) != ENGRANE_FINE || call(right, high) != ENGRANE_FINE) continue;
      const double fall = (middle[base] - low[base]) / h, rise = (high[base] - middle[base]) / h;
      if (!std::isfinite(fall) || !std::isfinite(rise)) continue;
      known = true;
      const double central = 0.5 * (fall + rise);
      const double size = std::max(std::abs(given), std::abs(central));
      const double noise = 1e-15 * std::abs(middle[base]) / h + 1e-6 * std::abs(middle[base]) / scale_[by];
      double gap = std::abs(given - central) - noise;
      // with small steps, one-sided slopes differ only at a corner
      const double low_side = std::min(fall, rise), high_side = std::max(fall, rise);
      if (relative <= 1e-4 && given >= low_side - 1e-4 * size && given <= high_side + 1e-4 * size) gap = 0;
      gaps.push_back(std::max(gap, 0.0));
      gap = size > 0 ? std::max(gap, 0.0) / size : 0;
      if (gap < best) {
        best = gap;
        difference = central;
      }
    }
    if (!known || best <= 1e-4 || vanish(gaps)) continue;
    const std::string y_name = fmt::format("y[{}] (y({}) in Fortran)", i, i + 1);
    if (kind_ == Kind::force && i == 3)
      return {fmt::format("{}: the {} changes by {:.6g} per elongation, and the force at rest is {:.6g} (at {})",
                          source_->label(), s.results[i].name, difference, given, words(s, place)),
              fmt::format("correct {}, or leave it alone: all work then counts as lost", y_name)};
    return {fmt::format("{}: the {} is given as {:.6g}, and differences of its {} make it {:.6g} (at {})", source_->label(),
                        s.results[i].name, given, s.results[base].name, difference, words(s, place)),
            fmt::format("correct {}, or leave it alone: differences then take its place", y_name)};
  }
  return {};
}

}  // namespace engrane::user
