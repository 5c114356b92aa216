// SPDX-License-Identifier: BSD-3-Clause
#include "elements/beams/section_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace engrane::elements::beams {

namespace {

constexpr double pi = std::numbers::pi;
using Vec2 = SectionShape::Vec2;

/// Circle with a concentric hole of diameter `ratio` · `diameter`; shear factors from Cowper's table 1.
SectionShape tube(double diameter, double ratio, double poisson) {
  SectionShape s;
  const double square = diameter * diameter, m = ratio * ratio;
  s.area = pi / 4 * square * (1 - m);
  s.moments.diagonal().setConstant(pi / 64 * square * square * (1 - m * m));
  s.torsion = s.moments.trace();
  const double whole = (1 + m) * (1 + m);
  s.shear_factors *= 6 * (1 + poisson) * whole / ((7 + 6 * poisson) * whole + (20 + 12 * poisson) * m);
  s.radius = diameter / 2;
  constexpr int corners = 24;
  for (int k = 0; k < corners; ++k)
    s.outline.push_back(s.radius * Vec2(std::cos(2 * pi * k / corners), std::sin(2 * pi * k / corners)));
  return s;
}

/// Torsion: Timoshenko and Goodier (1970), Theory of Elasticity, art. 109; shear factor of Cowper.
SectionShape rectangle(double height, double width, double poisson) {
  SectionShape s;
  s.area = height * width;
  s.moments.diagonal() << s.area * height * height / 12, s.area * width * width / 12;
  const double small = std::min(height, width), large = std::max(height, width);
  double sum = 0;
  constexpr int terms = 41;  // the last term is below rounding error
  for (int n = terms; n > 0; n -= 2) sum += std::tanh(n * pi * large / (2 * small)) / std::pow(n, 5);
  s.torsion = large * small * small * small / 3 * (1 - 192 / std::pow(pi, 5) * small / large * sum);
  s.shear_factors *= 10 * (1 + poisson) / (12 + 11 * poisson);
  s.outline = {{-height / 2, -width / 2}, {height / 2, -width / 2}, {height / 2, width / 2}, {-height / 2, width / 2}};
  return s;
}

Loop loop_of(const std::vector<double>& numbers) {
  Loop loop;
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) loop.emplace_back(numbers[i], numbers[i + 1]);
  return loop;
}

/// Orients a loop counterclockwise, or clockwise for a hole.
Loop turned(Loop loop, bool hole) {
  double area = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
    area += a[0] * b[1] - a[1] * b[0];
  }
  if ((area < 0) != hole) std::reverse(loop.begin(), loop.end());
  return loop;
}

}  // namespace

std::vector<Loop> loops_of(const deck::ProfileCard& card) {
  const std::vector<double>& size = card.shape.values;
  if (card.shape.is("POLYGON")) {
    std::vector<Loop> loops = {turned(loop_of(size), false)};
    if (!card.hole.empty()) loops.push_back(turned(loop_of(card.hole), true));
    return loops;
  }
  if (!(card.shape.is("H") || card.shape.is("U") || card.shape.is("L") || card.shape.is("BOX"))) return {};
  const double h = size[0], b = size[1], t = size[2], flange = card.shape.is("H") || card.shape.is("U") ? size[3] : t;
  if (card.shape.is("L")) return {{{0, 0}, {h, 0}, {h, t}, {t, t}, {t, b}, {0, b}}};
  if (card.shape.is("U")) return {{{0, 0}, {h, 0}, {h, b}, {h - flange, b}, {h - flange, t}, {flange, t}, {flange, b}, {0, b}}};
  if (card.shape.is("BOX")) return {{{0, 0}, {h, 0}, {h, b}, {0, b}}, {{t, t}, {t, b - t}, {h - t, b - t}, {h - t, t}}};
  const double from = (b - t) / 2, to = (b + t) / 2, top = h - flange;
  return {{{0, 0},
           {flange, 0},
           {flange, from},
           {top, from},
           {top, 0},
           {h, 0},
           {h, b},
           {top, b},
           {top, to},
           {flange, to},
           {flange, b},
           {0, b}}};
}

SectionShape shape_of(const deck::ProfileCard& card, double poisson) {
  const std::vector<double>& size = card.shape.values;
  SectionShape shape;
  if (card.shape.is("CIRCLE"))
    shape = tube(size[0], 0, poisson);
  else if (card.shape.is("TUBE"))
    shape = tube(size[0], size[1] / size[0], poisson);
  else if (card.shape.is("RECTANGLE"))
    shape = rectangle(size[0], size[1], poisson);
  else if (card.shape.given())
    shape = polygon_shape(loops_of(card), poisson);
  else {
    shape.area = *card.area;
    shape.moments.diagonal() << (*card.moments)[1], (*card.moments)[0];
    shape.torsion = *card.torsion;
  }
  if (card.factors) shape.shear_factors = Vec2((*card.factors)[0], (*card.factors)[1]).asDiagonal();
  return shape;
}

}  // namespace engrane::elements::beams
