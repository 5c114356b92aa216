// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/open_loop.hpp"

#include <fmt/format.h>

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <map>
#include <queue>

#include "math/angle.hpp"
#include "solve/constraints/constraint_factors.hpp"
#include "solve/constraints/mobility.hpp"

namespace engrane::solve {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

/// Constraint violations over the extent, or in radians.
Vector scaled_open(Assembler& assembler, const Configuration& c) {
  const std::vector<double> phi = assembler.violations(c);
  const Vector sizes = constraint_sizes(assembler);
  return Eigen::Map<const Vector>(phi.data(), sizes.size()).cwiseQuotient(sizes);
}

/// −Jᵀ(JJᵀ + μ)⁻¹ φ with Jᵀ = `gradient`, from [−1 Jᵀ; J μ] [y; z] = [0; φ], since the product JJᵀ is full where one body has
/// many constraints.
Vector damped_step(const Sparse& gradient, const Vector& phi, double mu) {
  const Eigen::Index n = gradient.rows(), m = gradient.cols();
  std::vector<Eigen::Triplet<double, Eigen::Index>> entries;
  for (Eigen::Index i = 0; i < n; ++i) entries.emplace_back(i, i, -1.0);
  for (Eigen::Index j = 0; j < m; ++j) {
    entries.emplace_back(n + j, n + j, mu);
    for (Sparse::InnerIterator it(gradient, j); it; ++it) {
      entries.emplace_back(it.row(), n + j, it.value());
      entries.emplace_back(n + j, it.row(), it.value());
    }
  }
  Sparse whole(n + m, n + m);
  whole.setFromTriplets(entries.begin(), entries.end());
  Vector right(n + m);
  right << Vector::Zero(n), phi;
  return -Eigen::SparseLU<Sparse>(whole).solve(right).head(n);
}

/// Moves `c` to where the weighted sum of squares of the violations is smallest, by Levenberg–Marquardt steps −Jᵀ(JJᵀ + μ)⁻¹ φ.
/// These are least movements where the constraints can be closed, and still advance where they cannot.
void narrow(Assembler& assembler, const MotionSlots& motion, const Vector& weight, Configuration& c) {
  constexpr double longest = 0.25;  // of the extent, or radians
  const Vector scale = weight.cwiseQuotient(constraint_sizes(assembler));
  double mu = 1e-3;
  Vector open = weight.cwiseProduct(scaled_open(assembler, c));
  // a drive may ask for many turns
  const int most_steps = 300 + static_cast<int>(std::min(5000.0, 2 / longest * open.lpNorm<Eigen::Infinity>()));
  int idle = 0;
  for (int step = 0; step < most_steps && idle < 5 && open.squaredNorm() > 1e-28; ++step) {
    const ConstraintMatrix gradients(assembler, c, ConstraintColumns::gradients);
    const Sparse gradient = gradients.matrix * scale.asDiagonal();
    bool better = false;
    for (int attempt = 0; attempt < 12 && !better; ++attempt) {
      Vector way = damped_step(gradient, open, mu);
      if (const double most = way.size() > 0 ? way.lpNorm<Eigen::Infinity>() : 0; most > longest) way *= longest / most;
      std::vector<double> y(motion.size(), 0.0);
      gradients.to_slots(way, y);
      Configuration tried = c;
      motion.move(c, y, tried);
      tried = at_start_of_step(std::move(tried));
      const Vector then = weight.cwiseProduct(scaled_open(assembler, tried));
      better = then.allFinite() && then.squaredNorm() < open.squaredNorm();
      if (!better) {
        mu *= 6;
        continue;
      }
      idle = then.squaredNorm() > (1 - 1e-9) * open.squaredNorm() ? idle + 1 : 0;
      mu = std::max(mu / 4, 1e-14);
      open = then;
      c = std::move(tried);
      assembler.count_turns(c);  // the gap of a drive that asks for more than half a turn
    }
    if (!better) return;
  }
}

std::string node_name(const Model& model, int node) {
  return node == 0 ? "ground" : fmt::format("node {}", model.nodes[static_cast<std::size_t>(node)].id);
}

}  // namespace

std::string loop_of(const Model& model, int part) {
  std::vector<int> held(model.nodes.size(), 0);
  for (const Support& s : model.supports) held[static_cast<std::size_t>(s.node)] |= 1 << s.component;
  // a node whose position is held counts as the ground, but keeps its name
  const auto fixed = [&](int node) { return (held[static_cast<std::size_t>(node)] & 7) == 7; };
  struct Way {
    int from, part;
  };
  const std::vector<int>& ends = model.parts[static_cast<std::size_t>(part)].nodes;
  if (ends.size() < 2) return {};
  const int begin = ends[0], target = ends[1];
  std::map<int, Way> seen{{begin, {-1, -1}}};
  std::queue<int> front({begin});
  const auto reach = [&](int node, Way way) {
    if (seen.try_emplace(node, way).second) front.push(node);
  };
  std::vector<std::vector<int>> parts_at(model.nodes.size());
  for (std::size_t p = 0; p < model.parts.size(); ++p)
    if (static_cast<int>(p) != part && !model.parts[p].element->layout().multipliers.empty())
      for (const int node : model.parts[p].nodes) parts_at[static_cast<std::size_t>(node)].push_back(static_cast<int>(p));
  bool supported = false;
  while (!front.empty() && !seen.contains(target)) {
    const int node = front.front();
    front.pop();
    for (const int p : parts_at[static_cast<std::size_t>(node)])
      for (const int next : model.parts[static_cast<std::size_t>(p)].nodes) reach(next, {node, p});
    if (supported || (node != 0 && !fixed(node))) continue;
    supported = true;
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
      if (i == 0 || fixed(static_cast<int>(i))) reach(static_cast<int>(i), {node, -1});
  }
  if (!seen.contains(target)) return {};
  std::string text = node_name(model, target);
  for (int node = target; node != begin;) {
    const Way& way = seen.at(node);
    const std::string by = way.part >= 0 ? model.part(way.part).name() : "support";
    text = fmt::format("{} - {} - ", node_name(model, way.from), by) + text;
    node = way.from;
  }
  return text;
}

std::string explain_open_loop(Assembler& assembler, const MotionSlots& motion, const Configuration& given) {
  const Model& model = assembler.model();
  const Numbering& numbering = assembler.numbering();
  Configuration c = at_start_of_step(given);
  Vector open = scaled_open(assembler, c);
  if (open.size() == 0) return "the mechanism does not close";
  if (!open.allFinite()) return "the mechanism does not close: a constraint is not a finite number where the parts are put";
  narrow(assembler, motion, Vector::Ones(open.size()), c);
  open = scaled_open(assembler, c);
  // a drive that asks for too much is more often the cause than the lengths along the loop
  Eigen::Index widest = 0;
  const double largest = open.cwiseAbs().maxCoeff(&widest);
  double driven = 1e-2 * largest;
  for (Eigen::Index m = 0; m < open.size(); ++m)
    if (std::abs(open[m]) > driven && is_drive(model, numbering.multiplier(static_cast<int>(m)))) {
      driven = std::abs(open[m]);
      widest = m;
    }
  const Unknown& u = numbering.multiplier(static_cast<int>(widest));
  const bool drive = is_drive(model, u);
  const Model::Part& joint = model.parts[static_cast<std::size_t>(u.part)];
  Vector weight = Vector::Ones(open.size());
  std::vector<int> members;
  for (Eigen::Index m = 0; m < open.size(); ++m) {
    const Unknown& other = numbering.multiplier(static_cast<int>(m));
    if (other.part != u.part || is_drive(model, other) != drive) continue;
    members.push_back(static_cast<int>(m));
    weight[m] = 1e-4;
  }
  narrow(assembler, motion, weight, c);
  open = scaled_open(assembler, c);
  double length = 0, angle = 0;
  for (const int m : members) (numbering.multiplier(m).measure == Measure::length ? length : angle) += open[m] * open[m];
  length = std::sqrt(length) * model.extent();
  angle = std::sqrt(angle);
  std::string gap;
  if (length > 1e-6 * model.extent()) gap = fmt::format("{:.4g} {}", length, model.units.label(dimension::length));
  if (angle > 1e-6) gap += fmt::format("{}{:.4g} deg", gap.empty() ? "" : " and ", angle / degree);
  if (gap.empty())
    return fmt::format(
        "the mechanism does not close from where its parts are put, although it can be closed elsewhere: {} stays open by "
        "{:.3g} {}; give initial positions nearer to it (.INI DEP), or a drive that begins nearer",
        joint.name(), largest * (u.measure == Measure::length ? model.extent() : 1.0),
        model.units.label(u.measure == Measure::length ? dimension::length : dimension::angle));
  const std::string name = joint.name();
  std::string text =
      drive ? fmt::format("the mechanism does not close: with all joints closed the drive of {} is short by {}", name, gap)
            : fmt::format("the mechanism does not close: with all other joints closed {} stays open by {}", name, gap);
  const std::string loop = loop_of(model, u.part);
  if (!loop.empty()) text += fmt::format("; its loop: {} - {} - {}", loop, name, node_name(model, joint.nodes[0]));
  return text + (drive ? "; ask less of the drive, or make the parts of the loop longer"
                       : "; see that the places of nodes and joints, the lengths and the drives along it agree");
}

}  // namespace engrane::solve
