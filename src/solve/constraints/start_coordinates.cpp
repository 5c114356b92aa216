// SPDX-License-Identifier: BSD-3-Clause
// Joints whose initial values are given by the deck.
#include "solve/constraints/start_coordinates.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "math/angle.hpp"
#include "math/rotation.hpp"
#include "solve/constraints/start.hpp"

namespace engrane::solve {

std::vector<StartCoordinates::Wanted> StartCoordinates::wanted(bool velocity) const {
  std::vector<Wanted> all;
  for (const InitialCoordinate& one : assembler_.model().initial_coordinates)
    if (one.velocity == velocity) all.push_back({&one, one.value});
  return all;
}

double StartCoordinates::channel(const Configuration& c, const InitialCoordinate& coordinate, std::size_t behind) const {
  const Element& element = *assembler_.model().parts[static_cast<std::size_t>(coordinate.part)].element;
  std::vector<double> values(element.channels().size());
  element.observe(assembler_.view(coordinate.part, c), values);
  return values[static_cast<std::size_t>(coordinate.channel) + behind];
}

const Named& StartCoordinates::named(const InitialCoordinate& coordinate) const {
  const Element& element = *assembler_.model().parts[static_cast<std::size_t>(coordinate.part)].element;
  return element.channels()[static_cast<std::size_t>(coordinate.channel) + (coordinate.velocity ? 1 : 0)];
}

std::vector<double> StartCoordinates::missed(const Configuration& c, const std::vector<Wanted>& all) const {
  std::vector<double> missed;
  for (const Wanted& one : all)
    missed.push_back((one.coordinate->velocity ? rate(c, *one.coordinate) : value(c, *one.coordinate)) - one.value);
  return missed;
}

double StartCoordinates::size(const Wanted& one) const {
  const Element& element = *assembler_.model().parts[static_cast<std::size_t>(one.coordinate->part)].element;
  const bool angle = element.channels()[static_cast<std::size_t>(one.coordinate->channel)].dimension == dimension::angle;
  return (angle ? 1.0 : assembler_.model().extent()) + std::abs(one.value);
}

std::vector<double> StartCoordinates::gradient(const Configuration& c, const InitialCoordinate& coordinate) const {
  const Numbering& numbering = assembler_.numbering();
  std::vector<double> gradient(static_cast<std::size_t>(numbering.equations()), 0.0);
  const std::vector<int>& nodes = assembler_.model().parts[static_cast<std::size_t>(coordinate.part)].nodes;
  Configuration moving = c;
  const auto at = [&moving](int node) -> NodeState& { return moving.nodes[static_cast<std::size_t>(node)]; };
  for (const int node : nodes) at(node).v = at(node).W = Vec3::Zero();
  for (const int node : nodes)
    for (int k = 0; k < 6; ++k) {
      const int equation = numbering.equation(6 * node + k);
      if (equation < 0) continue;
      double& speed = (k < 3 ? at(node).v : at(node).W)[k % 3];
      speed = 1;
      gradient[static_cast<std::size_t>(equation)] = rate(moving, coordinate);
      speed = 0;
    }
  return gradient;
}

double StartCoordinates::free_response(const std::vector<double>& gradient) const {
  const double extent = assembler_.model().extent();
  double sum = 0;
  for (std::size_t e = 0; e < gradient.size(); ++e) {
    const Unknown& u = assembler_.numbering().unknown(static_cast<int>(e));
    const double g = gradient[e] * (u.measure == Measure::force ? extent : 1.0);
    sum += g * g;
  }
  return sum;
}

std::string StartCoordinates::name(const InitialCoordinate& coordinate) const {
  const Model::Part& part = assembler_.model().parts[static_cast<std::size_t>(coordinate.part)];
  return fmt::format("{} of {}", named(coordinate).name, part.name());
}

std::string StartCoordinates::shown(const InitialCoordinate& coordinate, double value) const {
  const Dimension d = named(coordinate).dimension;
  if (d == dimension::angle) return fmt::format("{:.6g} deg", value / degree);
  return fmt::format("{:.6g} {}", value, assembler_.model().units.label(d));
}

std::vector<StartCoordinates::Wanted> Start::undecided(const Configuration& c, const std::vector<StartCoordinates::Wanted>& all,
                                                       std::span<const int> held) {
  if (all.empty()) return {};
  constexpr double none = 1e-9;  // of the response of the same nodes without joints
  assembler_.projection(c, Assembler::Metric::geometric, held);
  std::vector<StartCoordinates::Wanted> free;
  std::vector<std::vector<double>> gradients, responses;
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(all.size()), static_cast<Eigen::Index>(all.size()));
  for (const StartCoordinates::Wanted& one : all) {
    std::vector<double> gradient = coordinates_.gradient(c, *one.coordinate), response;
    std::vector<double> right = gradient;
    if (!solve(right, response)) return {};
    // a row of the Cholesky factor of G D⁻¹ Gᵀ: its pivot is what the rows before it leave of this one
    const auto row = static_cast<Eigen::Index>(free.size());
    const auto times = [&](const std::vector<double>& g) {
      double sum = 0;
      for (std::size_t e = 0; e < g.size(); ++e) sum += g[e] * response[e];
      return sum;
    };
    for (Eigen::Index k = 0; k < row; ++k)
      factor(row, k) =
          (times(gradients[static_cast<std::size_t>(k)]) - factor.row(row).head(k).dot(factor.row(k).head(k))) / factor(k, k);
    const double pivot = times(gradient) - factor.row(row).head(row).squaredNorm();
    if (pivot <= none * coordinates_.free_response(gradient)) continue;
    factor(row, row) = std::sqrt(pivot);
    free.push_back(one);
    gradients.push_back(std::move(gradient));
  }
  return free;
}

bool Start::add_coordinates(const Configuration& c, const std::vector<StartCoordinates::Wanted>& wanted,
                            std::vector<double>& step) {
  if (wanted.empty()) return true;
  const auto n = static_cast<Eigen::Index>(wanted.size());
  const auto equations = static_cast<Eigen::Index>(step.size());
  const std::vector<double> missed = coordinates_.missed(c, wanted);
  // the smallest step that also reaches the coordinates: y + Z μ with B Z = 0, so that G (y + Z μ) = −missed
  Eigen::MatrixXd gradients(equations, n), responses(equations, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    std::vector<double> right = coordinates_.gradient(c, *wanted[static_cast<std::size_t>(i)].coordinate), response;
    gradients.col(i) = Eigen::Map<const Eigen::VectorXd>(right.data(), equations);
    if (!solve(right, response)) return false;
    responses.col(i) = Eigen::Map<const Eigen::VectorXd>(response.data(), equations);
  }
  Eigen::Map<Eigen::VectorXd> all(step.data(), equations);
  const Eigen::VectorXd open = Eigen::Map<const Eigen::VectorXd>(missed.data(), n) + gradients.transpose() * all;
  const Eigen::MatrixXd response = gradients.transpose() * responses;
  all -= responses * response.fullPivLu().solve(open);
  return all.allFinite();
}

void Start::move_coordinates(Configuration& c, StartReport& report) {
  const std::vector<StartCoordinates::Wanted> asked = coordinates_.wanted(false);
  if (asked.empty()) return;
  const std::vector<int> held = held_positions();
  const std::vector<StartCoordinates::Wanted> free = undecided(c, asked, held);
  // all of them advance along a path by the same fraction: no loop folds over on such a path
  constexpr double shortest = 1e-4;
  std::vector<double> from;
  for (const StartCoordinates::Wanted& one : free) from.push_back(coordinates_.value(c, *one.coordinate));
  double done = 0, part = 1;
  while (done < 1 && !free.empty()) {
    const double next = std::min(1.0, done + part);
    std::vector<StartCoordinates::Wanted> now = free;
    for (std::size_t i = 0; i < now.size(); ++i) now[i].value = from[i] + next * (free[i].value - from[i]);
    Configuration tried = c;
    const Closing closing = close(tried, held, {}, now);
    const double moved = distance(c, tried).size;
    if (!closing.closed || closing.far || moved > longest_step_) {
      part /= 2;
      if (!too_short(part, shortest, closing)) continue;
      std::string reached;
      for (const StartCoordinates::Wanted& one : free)
        reached +=
            fmt::format("{}the {} stays at {} on its way to {}", reached.empty() ? "" : ", ", coordinates_.name(*one.coordinate),
                        coordinates_.shown(*one.coordinate, coordinates_.value(c, *one.coordinate)),
                        coordinates_.shown(*one.coordinate, one.value));
      throw SolutionFailure("initial values cannot be reached: " + reached +
                            ". Joints, bars or supports stop the mechanism there, or it is in a dead position");
    }
    c = std::move(tried);
    assembler_.count_turns(c);
    done = next;
    part = next_part(part, closing, moved);
  }
  verify_coordinates(c, asked);
  for (const StartCoordinates::Wanted& one : asked)
    report.coordinates.push_back(
        fmt::format("{} = {}", coordinates_.name(*one.coordinate), coordinates_.shown(*one.coordinate, one.value)));
}

void Start::remark_on_guesses(const Configuration& c, StartReport& report) const {
  constexpr double kept = 0.01;      // of what was asked for
  constexpr double rounding = 1e-9;  // over the extent or in radians, below which nothing counts as moved
  const Model& model = assembler_.model();
  std::map<int, double> asked;
  for (const InitialValue& value : model.initial)
    if (!value.velocity && !value.imposed) asked[6 * value.node + value.component] += value.value;
  double worst = kept;
  std::string remark;
  for (const auto& [slot, amount] : asked) {
    const int equation = assembler_.numbering().equation(slot), component = slot % 6;
    if (equation < 0 || amount == 0) continue;
    const auto i = static_cast<std::size_t>(slot / 6);
    const bool turn = component >= 3;
    const double now = turn ? rotation_log(c.nodes[i].R)[component - 3] : c.nodes[i].x[component] - model.nodes[i].x[component];
    const double off = std::abs(now - amount) / std::abs(amount);
    if (off <= worst || std::abs(now - amount) <= rounding * (turn ? 1.0 : model.extent())) continue;
    worst = off;
    const double unit = turn ? degree : 1;
    remark = fmt::format(
        "the initial {} of {} was given as {:.6g} {} and is {:.6g}, the closest that joints and supports "
        "allow. Add IMPOSED to hold it, or set a joint's value with DEP ELEMENT",
        turn ? "rotation" : "displacement", assembler_.numbering().describe(equation), amount / unit,
        turn ? "deg" : model.units.label(dimension::length), now / unit);
  }
  if (!remark.empty()) report.remarks.push_back(remark);
}

void Start::verify_coordinates(const Configuration& c, const std::vector<StartCoordinates::Wanted>& asked) const {
  const std::vector<double> missed = coordinates_.missed(c, asked);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const InitialCoordinate& coordinate = *asked[i].coordinate;
    if (std::abs(missed[i]) <= 1e-8 * coordinates_.size(asked[i])) continue;
    throw SolutionFailure(fmt::format(
        "the initial {} is {} and cannot be {}: drives, joints, supports or other initial values leave it no choice, or it "
        "starts in a dead position",
        coordinates_.name(coordinate), coordinates_.shown(coordinate, asked[i].value + missed[i]),
        coordinates_.shown(coordinate, asked[i].value)));
  }
}

}  // namespace engrane::solve
