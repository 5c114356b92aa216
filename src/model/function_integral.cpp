// SPDX-License-Identifier: BSD-3-Clause
#include "model/function_integral.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace engrane {

namespace {

constexpr double narrowest = 1e-14;  ///< narrowest panel relative to its distance from 0; accepted without a further check
constexpr double widest = 0.05;      ///< widest panel relative to its distance from 0
constexpr std::size_t most_panels = 1'000'000;

struct Rule {
  double area = 0;
  double gauss = 0;      ///< the embedded 7-point rule
  double magnitude = 0;  ///< of |f|
};

/// 15-point Kronrod rule with the embedded Gauss rule on [a, b] (Piessens et al., QUADPACK, 1983).
Rule kronrod(const std::function<double(double)>& f, double a, double b) {
  constexpr std::array<double, 8> nodes{0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
                                        0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
                                        0.586087235467691130294144691693013, 0.405845151377397166906606412076961,
                                        0.207784955007898467600689403773245, 0.0};
  constexpr std::array<double, 8> kronrod_weights{0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
                                                  0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
                                                  0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
                                                  0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
  constexpr std::array<double, 4> gauss_weights{0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
                                                0.381830050505118944950369775488975, 0.417959183673469387755102040816327};
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  Rule rule;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double offset = half * nodes[i];
    const double right = f(middle + offset);
    const double left = i + 1 < nodes.size() ? f(middle - offset) : 0;
    rule.area += kronrod_weights[i] * (left + right);
    rule.magnitude += kronrod_weights[i] * (std::abs(left) + std::abs(right));
    if (i % 2 == 1) rule.gauss += gauss_weights[i / 2] * (left + right);
  }
  rule.area *= half;
  rule.gauss *= half;
  rule.magnitude *= std::abs(half);
  return rule;
}

}  // namespace

void PanelIntegral::extend(Side& side, double sign) const {
  const double start = side.ends.back();
  double width = side.width;
  for (;;) {
    const double end = start + sign * width;
    // An uneven cut: on halves, an oscillation that cancels over the whole panel would cancel again.
    const double cut = start + sign * 0.382 * width;
    const Rule whole = kronrod(f_, start, end), near = kronrod(f_, start, cut), far = kronrod(f_, cut, end);
    const double magnitude = near.magnitude + far.magnitude;
    // Abscissas are rounded, which makes areas uncertain by that rounding times the rise of the function.
    const double blur = 1e-15 * std::abs(end) * (std::abs(f_(end) - f_(cut)) + std::abs(f_(cut) - f_(start)));
    const auto agree = [&](double tolerance) {
      return std::abs(whole.area - near.area - far.area) <= tolerance &&
             std::abs(near.area - near.gauss) + std::abs(far.area - far.gauss) <= 1e-6 * magnitude + tolerance;
    };
    const double tolerance = 1e-13 * magnitude + 1e-16 * side.magnitude + blur;
    // near 0, a difference may be mere rounding of its terms, as in 1 - cos(T)
    const auto rounding = [&] { return rounding_ ? width * (rounding_(start) + rounding_(cut) + rounding_(end)) : 0; };
    const bool last_resort = width <= narrowest * std::max(std::abs(start), first_);
    if (agree(tolerance) || last_resort || agree(tolerance + rounding())) {
      side.broken = !std::isfinite(whole.area);
      side.ends.push_back(end);
      side.areas.push_back(side.areas.back() + near.area + far.area);
      side.magnitude += magnitude;
      side.width = std::min(2 * width, std::max(first_, widest * std::abs(end)));
      return;
    }
    width /= 2;
  }
}

double PanelIntegral::operator()(double x) const {
  if (!std::isfinite(x)) return std::numeric_limits<double>::quiet_NaN();
  const std::lock_guard lock(mutex_);
  const double sign = x < 0 ? -1 : 1;
  Side& side = x < 0 ? left_ : right_;
  while (std::abs(side.ends.back()) < std::abs(x)) {
    if (side.broken || side.ends.size() > most_panels) return std::numeric_limits<double>::quiet_NaN();
    extend(side, sign);
  }
  const auto after =
      std::upper_bound(side.ends.begin(), side.ends.end(), x, [sign](double v, double end) { return sign * v < sign * end; });
  const auto k = static_cast<std::size_t>(after - side.ends.begin()) - 1;
  if (side.ends[k] == x) return side.areas[k];
  return side.areas[k] + kronrod(f_, side.ends[k], x).area;
}

}  // namespace engrane
