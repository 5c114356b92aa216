// SPDX-License-Identifier: BSD-3-Clause
#include "math/spline.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace engrane {

namespace {

/// Whether the gap between the last abscissa and one period after the first is zero up to rounding.
bool closes(double gap, double period) { return gap <= 1e-12 * period; }

/// Solves a symmetric, diagonally dominant tridiagonal system in place: d the diagonal, e the off-diagonal, b the right-hand
/// side.
void solve_tridiagonal(std::vector<double> d, const std::vector<double>& e, std::vector<double>& b) {
  const std::size_t n = d.size();
  for (std::size_t i = 1; i < n; ++i) {
    const double w = e[i - 1] / d[i - 1];
    d[i] -= w * e[i - 1];
    b[i] -= w * b[i - 1];
  }
  for (std::size_t i = n; i-- > 0;) b[i] = (b[i] - (i + 1 < n ? e[i] * b[i + 1] : 0)) / d[i];
}

/// Solves the cyclic system of a periodic spline, tridiagonal with a corner entry e[n-1], by the Sherman–Morrison formula.
void solve_cyclic(std::vector<double> d, const std::vector<double>& e, std::vector<double>& b) {
  const std::size_t n = d.size();
  const double corner = e[n - 1];
  const double g = -d[0];
  d[0] -= g;
  d[n - 1] -= corner * corner / g;
  std::vector<double> u(n, 0.0);
  u[0] = g;
  u[n - 1] = corner;
  solve_tridiagonal(d, e, b);
  solve_tridiagonal(d, e, u);
  const double r = corner / g;
  const double factor = (b[0] + r * b[n - 1]) / (1 + u[0] + r * u[n - 1]);
  for (std::size_t i = 0; i < n; ++i) b[i] -= factor * u[i];
}

}  // namespace

double Curve::Piece::value(double x) const {
  const double s = x - origin;
  return c0 + s * (c1 + s * (c2 + s * c3));
}

Jet Curve::Piece::jet(double x) const {
  const double s = x - origin;
  return {value(x), c1 + s * (2 * c2 + 3 * s * c3), 2 * c2 + 6 * s * c3, 6 * c3};
}

double Curve::Piece::integral(double x) const {
  const double s = x - origin;
  return area + s * (c0 + s * (c1 / 2 + s * (c2 / 3 + s * c3 / 4)));
}

void Curve::sum_areas(double end) {
  // outwards from the piece that begins at the anchor or contains it
  std::size_t first = 0;
  if (period_ || pieces_.front().x0 > 0) {
    const double x0 = pieces_[0].x0;
    pieces_[0].area = (period_ ? 0 : x0 * pieces_[0].value(x0)) - pieces_[0].integral(x0);
  } else {
    first = static_cast<std::size_t>(find(0).piece - pieces_.data());
    pieces_[first].area = -pieces_[first].integral(0);
  }
  const auto meet = [this](std::size_t i, std::size_t known, double x) {
    pieces_[i].area = 0;
    pieces_[i].area = pieces_[known].integral(x) - pieces_[i].integral(x);
  };
  for (std::size_t i = first + 1; i < pieces_.size(); ++i) meet(i, i - 1, pieces_[i].x0);
  for (std::size_t i = first; i-- > 0;) meet(i, i + 1, pieces_[i + 1].x0);
  if (!period_) return;
  area_of_period_ = pieces_.back().integral(end);
  from_anchor_to_zero_ = from_anchor(0);
}

Curve Curve::lines(std::span<const double> x, std::span<const double> y, std::optional<double> period) {
  assert(!x.empty() && x.size() == y.size());
  const std::size_t n = x.size();
  Curve curve;
  curve.period_ = period;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double slope = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
    if (period || x[i] >= 0) {
      curve.pieces_.push_back({x[i], x[i], y[i], slope});
    } else if (x[i + 1] <= 0) {
      curve.pieces_.push_back({x[i], x[i + 1], y[i + 1], slope});
    } else {  // y(0) = 0 exactly where the points are opposite
      const double middle = y[i] + (y[i + 1] - y[i]) * (-x[i] / (x[i + 1] - x[i]));
      curve.pieces_.push_back({x[i], 0, middle, slope});
    }
  }
  const double gap = period ? *period - (x[n - 1] - x[0]) : 0;
  if (!period || (n == 1 && closes(gap, *period)))
    curve.pieces_.push_back({x[n - 1], x[n - 1], y[n - 1]});
  else if (!closes(gap, *period))
    curve.pieces_.push_back({x[n - 1], x[n - 1], y[n - 1], (y[0] - y[n - 1]) / gap});
  curve.sum_areas(period ? x[0] + *period : x[n - 1]);
  return curve;
}

Curve Curve::hermite(std::span<const double> x, std::span<const double> y, std::span<const double> slope) {
  Curve curve;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const std::size_t near = std::abs(x[i + 1]) < std::abs(x[i]) ? i + 1 : i, far = 2 * i + 1 - near;
    const double h = x[far] - x[near];
    const double secant = (y[far] - y[near]) / h;
    curve.pieces_.push_back({x[i], x[near], y[near], slope[near], (3 * secant - 2 * slope[near] - slope[far]) / h,
                             (slope[near] + slope[far] - 2 * secant) / (h * h)});
  }
  return curve;
}

Curve Curve::natural_spline(std::span<const double> x, std::span<const double> y) {
  assert(!x.empty() && x.size() == y.size());
  const std::size_t n = x.size();
  if (n == 1) return lines(x, y);
  // the unknowns are slopes; scaling the rows by 1/h makes the system symmetric
  std::vector<double> d(n), e(n), m(n);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double w = 1 / (x[i + 1] - x[i]);
    const double load = 3 * w * w * (y[i + 1] - y[i]);
    d[i] += 2 * w;
    d[i + 1] += 2 * w;
    e[i] = w;
    m[i] += load;
    m[i + 1] += load;
  }
  solve_tridiagonal(d, e, m);
  Curve curve = hermite(x, y, m);
  curve.pieces_.push_back({x[n - 1], x[n - 1], y[n - 1]});
  curve.sum_areas(x[n - 1]);
  return curve;
}

Curve Curve::periodic_spline(std::span<const double> x, std::span<const double> y, double period) {
  assert(!x.empty() && x.size() == y.size() && period > 0);
  std::vector<double> xs(x.begin(), x.end()), ys(y.begin(), y.end());
  if (closes(period - (xs.back() - xs.front()), period)) {
    assert(xs.size() > 1);
    xs.pop_back();
    ys.pop_back();
  }
  const std::size_t n = xs.size();
  if (n == 1) return lines(xs, ys);
  xs.push_back(xs.front() + period);
  ys.push_back(ys.front());
  std::vector<double> d(n), e(n), m(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double w = 1 / (xs[i + 1] - xs[i]);
    const double load = 3 * w * w * (ys[i + 1] - ys[i]);
    const std::size_t next = (i + 1) % n;
    d[i] += 2 * w;
    d[next] += 2 * w;
    e[i] = w;
    m[i] += load;
    m[next] += load;
  }
  if (n == 2) {
    // with two points, each is both neighbours of the other, so the two off-diagonal entries coincide and add up
    const double beside = e[0] + e[1], determinant = d[0] * d[1] - beside * beside;
    m = {(m[0] * d[1] - m[1] * beside) / determinant, (m[1] * d[0] - m[0] * beside) / determinant};
  } else {
    solve_cyclic(d, e, m);
  }
  m.push_back(m[0]);
  Curve curve = hermite(xs, ys, m);
  curve.period_ = period;
  curve.sum_areas(xs.back());
  return curve;
}

Curve::Place Curve::find(double x) const {
  const double first = pieces_.front().x0;
  Place place;
  if (period_) {
    place.turns = std::floor((x - first) / *period_);
    // rounding of the quotient may put a point just before a whole turn after it
    if (x < begin(first, place.turns))
      place.turns -= 1;
    else if (x >= begin(first, place.turns + 1))
      place.turns += 1;
  }
  // rounding of the abscissa within the period could put a corner before itself
  auto after =
      std::upper_bound(pieces_.begin(), pieces_.end(), x, [&](double v, const Piece& p) { return v < begin(p.x0, place.turns); });
  if (after != pieces_.begin()) --after;
  place.piece = &*after;
  place.x = period_ ? std::max(first + std::fma(-place.turns, *period_, x - first), after->x0) : x;
  return place;
}

Jet Curve::at(double x) const {
  const Place place = find(x);
  const Piece& p = *place.piece;
  if (place.x < p.x0) return {p.value(p.x0), 0, 0, 0};  // before the first point
  return p.jet(place.x);
}

std::vector<double> Curve::joints(double from, double to, std::size_t most, int derivative) const {
  const std::size_t n = pieces_.size(), orders = static_cast<std::size_t>(derivative) + 1;
  const double first = pieces_.front().x0;
  using Side = std::array<double, 4>;
  const auto side = [](const Jet& j) { return Side{j.f, j.d1, j.d2, j.d3}; };
  std::vector<Side> starts(n), ends(n);  // limits of each piece at its start and at that of the next one
  Side largest{};
  for (std::size_t i = 0; i < n; ++i) {
    const Piece& p = pieces_[i];
    starts[i] = side(p.jet(p.x0));
    ends[i] = side(p.jet(i + 1 < n ? pieces_[i + 1].x0 : period_ ? first + *period_ : p.x0));
    for (std::size_t k = 0; k < orders; ++k) largest[k] = std::max({largest[k], std::abs(starts[i][k]), std::abs(ends[i][k])});
  }
  std::vector<double> corners;
  for (std::size_t i = 0; i < n; ++i) {
    const Side after = starts[i], before = i > 0 ? ends[i - 1] : period_ ? ends[n - 1] : Side{after[0]};
    bool jumps = false;  // smaller differences are rounding errors
    for (std::size_t k = 0; k < orders; ++k)
      jumps = jumps || std::abs(after[k] - before[k]) > (k == 0 ? 1e-12 : 1e-9) * largest[k];
    if (jumps) corners.push_back(pieces_[i].x0);
  }
  std::vector<double> found;
  if (corners.empty() || (period_ && !std::isfinite(to - from))) return found;
  for (double turns = period_ ? std::floor((from - first) / *period_) : 0;; ++turns) {
    for (const double corner : corners) {
      const double x = begin(corner, turns);
      if (from < x && x < to) found.push_back(x);
      if (found.size() > most) return {};
    }
    if (!period_ || begin(first, turns + 1) >= to) return found;
  }
}

double Curve::from_anchor(double x) const {
  const Place place = find(x);
  const Piece& p = *place.piece;
  if (place.x < p.x0) return p.integral(p.x0) + (place.x - p.x0) * p.value(p.x0);
  return place.turns * area_of_period_ + p.integral(place.x);
}

}  // namespace engrane
