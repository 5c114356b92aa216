// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/fillings.hpp"

#include <cmath>
#include <numeric>

namespace engrane {

namespace {

/// Derivatives at the points of Lobatto quadrature in [0, 1] of the cubics that are 1 at one of the points and 0 at the others.
constexpr std::array<std::array<double, 4>, 4> slopes_at_points{{
    {-6, (5 + 5 * sqrt5) / 2, (5 - 5 * sqrt5) / 2, 1},
    {-(1 + sqrt5) / 2, 0, sqrt5, (1 - sqrt5) / 2},
    {(sqrt5 - 1) / 2, -sqrt5, 0, (1 + sqrt5) / 2},
    {-1, (5 * sqrt5 - 5) / 2, -(5 + 5 * sqrt5) / 2, 6},
}};

}  // namespace

Fillings::Fillings(Assembler& assembler) : assembler_(assembler) {
  for (const int p : assembler.own_parts())
    if (const Filled* part = filled(*assembler.model().part(p).element)) parts_.push_back({p, part});
}

Fillings::At Fillings::at(const Configuration& c) const {
  At found;
  found.reserve(parts_.size());
  for (const Part& p : parts_) found.push_back(p.filled->filling(assembler_.view(p.part, c)));
  return found;
}

std::vector<double> Fillings::works(const At& from, const At& to, const At& sizes) const {
  std::vector<double> works(parts_.size());
  for (std::size_t i = 0; i < works.size(); ++i)
    works[i] = parts_[i].filled->work_of_filling(from[i].content, to[i].content, sizes[i].size);
  return works;
}

double Fillings::work(const At& from, const At& to) const {
  const std::vector<double> first = works(from, to, from), second = works(from, to, to);
  return (std::accumulate(first.begin(), first.end(), 0.0) + std::accumulate(second.begin(), second.end(), 0.0)) / 2;
}

double Fillings::work(const std::array<const At*, 4>& points, std::size_t end, const std::array<double, 4>& weights) const {
  const std::vector<double> all = works(*points.front(), *points[end], *points[end]);
  double sum = std::accumulate(all.begin(), all.end(), 0.0);
  for (std::size_t i = 0; i < parts_.size(); ++i)
    for (std::size_t p = 0; p < points.size(); ++p) {
      double change = 0;  // derivative of the content by the fraction of the step
      for (std::size_t j = 0; j < points.size(); ++j) change += slopes_at_points[p][j] * (*points[j])[i].content;
      sum += weights[p] * parts_[i].filled->slope_beside((*points[p])[i], (*points[end])[i].size) * change;
    }
  return sum;
}

double Fillings::power(const At& at) {
  double sum = 0;
  for (const Filled::Filling& f : at) sum += f.power;
  return sum;
}

}  // namespace engrane
