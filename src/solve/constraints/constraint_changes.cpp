// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/constraint_changes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "solve/constraints/constraint_factors.hpp"

namespace engrane::solve {

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon(), none = std::numeric_limits<double>::quiet_NaN();
/// Rounding of positions is visible if its force, as several steps add it up, exceeds this fraction of the loads.
constexpr double seen = 5e-7;
/// And this fraction of the squared rotation of a step: the scheme's own error of reactions is about a tenth of that square.
constexpr double seen_of_scheme = 0.01;
/// Root of the mean square of the rounding of a position of the size of its length, over ε of that length.
constexpr double rounded = 0.3;
/// A constraint has parts of hardly any mass on both sides if its stiffness is below this fraction of another's on one of them.
constexpr double light = 1e-6;
/// Violations that sums of changes leave are closed so slowly that the force for it is this fraction of the loads.
constexpr double closing = 1e-9;
/// A constraint open by more than this fraction of its length is closed by positions.
constexpr double open_by_far = 1e-9;
/// Above this fraction of the length the quadrature error may exceed the rounding of positions.
constexpr double smooth = 1e-14;

}  // namespace

ConstraintChanges::ConstraintChanges(Assembler& assembler, const Newton& newton, const MotionSlots& motion, double gain)
    : assembler_(assembler), newton_(newton), motion_(motion), gain_(gain) {
  const Model& model = assembler.model();
  const int count = assembler.numbering().slots() - assembler.numbering().motion_slots();
  std::map<std::pair<int, bool>, std::vector<int>> of_node;
  for (int m = 0; m < count; ++m) {
    const Unknown& u = assembler.numbering().multiplier(m);
    for (const int node : model.parts[static_cast<std::size_t>(u.part)].nodes)
      if (node != 0) of_node[{node, u.rotational()}].push_back(m);
  }
  for (auto& [node, multipliers] : of_node)
    if (multipliers.size() > 1) joined_.push_back(std::move(multipliers));
}

const std::vector<double>& ConstraintChanges::stiffnesses() {
  if (scale_ == assembler_.scale()) return stiffness_;
  scale_ = assembler_.scale();
  std::vector<double>& k = stiffness_ = scale_;
  for (bool more = true; more;) {
    more = false;
    for (const std::vector<int>& constraints : joined_) {
      double largest = 0;
      for (const int m : constraints) largest = std::max(largest, k[static_cast<std::size_t>(m)]);
      for (const int m : constraints)
        if (double& own = k[static_cast<std::size_t>(m)]; own < light * largest) {
          own = largest;
          more = true;
        }
    }
  }
  return k;
}

void ConstraintChanges::begin(const Configuration& from, std::span<const double> y) {
  parts_.clear();
  const std::size_t count = assembler_.scale().size();
  given_.assign(count, none);
  const std::vector<double>& stiffness = stiffnesses();
  std::vector<double> noise(count, 0.0);
  for (std::size_t m = 0; m < count; ++m) {
    const int i = static_cast<int>(m);
    if (assembler_.released(i)) continue;
    noise[m] = newton_.relative_force(i, epsilon * newton_.length(i)) * stiffness[m] / assembler_.scale()[m];
    const double turn = moved(i, y) / newton_.length(i);
    if (rounded * gain_ * noise[m] <= std::max(seen, seen_of_scheme * turn * turn)) {
      noise[m] = 0;
      continue;
    }
    const int part = assembler_.numbering().multiplier(i).part;
    if (!parts_.empty() && part <= parts_.back()) continue;
    parts_.push_back(part);
    // and the elements whose shares make up its constraints
    const auto& parts = assembler_.model().parts;
    for (auto next = static_cast<std::size_t>(part) + 1; next < parts.size() && parts[next].element->layout().shares_multipliers;
         ++next)
      parts_.push_back(static_cast<int>(next));
  }
  if (!any()) return;
  assembler_.constraint_rates(from, parts_, phi_, rate_[0], second_[0]);
  for (std::size_t m = 0; m < count; ++m)
    if (noise[m] > 0 && std::abs(phi_[m]) < open_by_far * newton_.length(static_cast<int>(m)))
      given_[m] = phi_[m] * closing / noise[m];
}

void ConstraintChanges::state(const Configuration& from, double h, std::span<const double> y) {
  if (!any()) return;
  // two-point Gauss quadrature, of the order h⁵ in Φ
  const double apart = 1 / std::sqrt(3.0);
  std::vector<double> part(y.begin(), y.end()), speed(y.begin(), y.end());
  for (double& v : speed) v /= h;
  const std::vector<double> still(y.size(), 0.0);
  for (const int point : {0, 1}) {
    const double s = 0.5 + (point == 0 ? -0.5 : 0.5) * apart;
    for (std::size_t i = 0; i < y.size(); ++i) part[i] = s * y[i];
    between_ = from;
    between_.time = from.time + s * h;
    motion_.move(from, part, between_);
    motion_.set_velocities(speed, between_);
    motion_.set_accelerations(still, between_);
    assembler_.constraint_rates(between_, parts_, phi_, rate_[point], second_[point]);
  }
  auto& [value, rounding] = assembler_.stated;
  value = given_;
  rounding.assign(given_.size(), 0.0);
  for (std::size_t m = 0; m < value.size(); ++m) {
    if (std::isnan(value[m])) continue;
    const double length = newton_.length(static_cast<int>(m));
    // the rates at both points and their slopes there give the fourth derivative, on which the quadrature error depends
    const double left_out = h * std::abs(rate_[1][m] - rate_[0][m] - 0.5 * apart * h * (second_[0][m] + second_[1][m]));
    value[m] = left_out < smooth * length ? value[m] + 0.5 * h * (rate_[0][m] + rate_[1][m]) : none;
    rounding[m] = epsilon * moved(static_cast<int>(m), y);
  }
}

double ConstraintChanges::moved(int multiplier, std::span<const double> y) const {
  const Unknown& u = assembler_.numbering().multiplier(multiplier);
  const double length = newton_.length(multiplier);
  const bool turns = u.rotational();
  double most = 0;
  for (const int node : assembler_.model().parts[static_cast<std::size_t>(u.part)].nodes)
    for (std::size_t k = 0; k < 6; ++k)
      if (k >= 3 || !turns) most = std::max(most, std::abs(y[6 * static_cast<std::size_t>(node) + k]) * (k >= 3 ? length : 1));
  return most;
}

void ConstraintChanges::end() {
  parts_.clear();
  assembler_.stated = {};
}

}  // namespace engrane::solve
