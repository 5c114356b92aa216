// SPDX-License-Identifier: BSD-3-Clause
#include "user/routine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
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

struct Signature {
  const char* name;
  std::vector<const char*> arguments;
  std::vector<Entry> results;
  bool chain;  ///< the successive derivatives with respect to argument 0 (entries 1, 2, …) are part of the result
};

namespace {

const Signature& signature(Kind kind) {
  static const Signature function{"function of one variable",
                                  {"variable"},
                                  {{"value"}, {"derivative", 0, 0}, {"second derivative", 1, 0}, {"third derivative", 2, 0}},
                                  true};
  static const Signature force{"force law",
                               {"elongation", "rate", "time"},
                               {{"force"},
                                {"derivative of the force by the elongation", 0, 0},
                                {"derivative of the force by the rate", 0, 1},
                                {"energy stored"}},
                               false};
  static const Signature mesh{"mesh stiffness",
                              {"place in the tooth pitch", "deflection"},
                              {{"factor"},
                               {"derivative of the factor by the place", 0, 0},
                               {"second derivative of the factor by the place", 1, 0},
                               {"derivative of the factor by the deflection", 0, 1}},
                              true};
  static const Signature friction{"friction law",
                                  {"sliding speed", "normal force"},
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
  for (std::size_t i = 0; i < s.arguments.size(); ++i) all.push_back(fmt::format("{} {:.6g}", s.arguments[i], x[i]));
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

bool Routine::complete(const Arguments& x, Results& y) const noexcept {
  const auto& results = signature_->results;
  for (std::size_t i = 1; i < results.size(); ++i) {
    if (y[i] != not_given || results[i].of < 0) continue;
    const auto base = static_cast<std::size_t>(results[i].of);
    const std::size_t by = results[i].by;
    Results step{};
    Arguments moved = x;
    const auto value = [&](double offset) {
      moved[by] = x[by] + offset;
      return call(moved, step) == ENGRANE_FINE ? step[base] : nan;
    };
    if (signature_->chain && by == 0) {
      const double h = 1e-3 * scale_[0];
      const double a = value(-2 * h), b = value(-h), c = value(h), d = value(2 * h);
      double next[3] = {(a - 8 * b + 8 * c - d) / (12 * h), (-a + 16 * b - 30 * y[base] + 16 * c - d) / (12 * h * h),
                        (-a + 2 * b - 2 * c + d) / (2 * h * h * h)};
      // the successive derivatives all come from the same five values
      for (std::size_t k = 0; i < results.size() && results[i].by == 0 && k < 3; ++k, ++i)
        if (y[i] == not_given) y[i] = next[k];
      --i;
    } else {
      const double h = 1e-5 * std::max(scale_[by], std::abs(x[by]));
      const double low = value(-h), left = moved[by], high = value(h), right = moved[by];
      y[i] = (high - low) / (right - left);
    }
  }
  const double* last = y.data() + results.size();
  return std::all_of(static_cast<const double*>(y.data()), last, [](double v) { return std::isfinite(v); });
}

Results Routine::at(const Arguments& x) const noexcept {
  Results y;
  const int status = call(x, y);
  const char* what = nullptr;
  if (status != ENGRANE_FINE)
    what = "";
  else if (y[0] == not_given)
    what = "gives no value";
  else if (!complete(x, y))
    what = "gives a result that is not a finite number";
  if (!what) return y;
  try {
    remember(fmt::format("{} {} (at {})", source_->label(), status != ENGRANE_FINE ? status_words(status) : what,
                         words((*signature_), x)));
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
    for (const double relative : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
      const double h = relative * std::max(scale_[by], std::abs(place[by]));
      Results low, high;
      Arguments left = place, right = place;
      left[by] -= h;
      right[by] += h;
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
      gap = size > 0 ? std::max(gap, 0.0) / size : 0;
      if (gap < best) {
        best = gap;
        difference = central;
      }
    }
    if (!known || best <= 1e-4) continue;
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
