// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/diagnosis.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace engrane::solve {

namespace {

constexpr int largest_dense = 1500;

/// The matrix, whole, on every rank; its rows and columns scaled so that their sizes do not hide the null space.
Eigen::MatrixXd dense_copy(Assembler& assembler, Eigen::VectorXd& column_scale) {
  const int n = assembler.numbering().equations();
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
  PetscInt first = 0, end = 0;
  check_petsc(MatGetOwnershipRange(assembler.matrix(), &first, &end));
  for (PetscInt row = first; row < end; ++row) {
    PetscInt count = 0;
    const PetscInt* columns = nullptr;
    const PetscScalar* values = nullptr;
    check_petsc(MatGetRow(assembler.matrix(), row, &count, &columns, &values));
    for (PetscInt i = 0; i < count; ++i) dense(row, columns[i]) = values[i];
    check_petsc(MatRestoreRow(assembler.matrix(), row, &count, &columns, &values));
  }
  MPI_Allreduce(MPI_IN_PLACE, dense.data(), n * n, MPI_DOUBLE, MPI_SUM, assembler.comm());
  column_scale = Eigen::VectorXd::Ones(n);
  for (int pass = 0; pass < 4; ++pass)
    for (int i = 0; i < n; ++i) {
      if (const double r = dense.row(i).cwiseAbs().maxCoeff(); r > 0) dense.row(i) /= r;
      if (const double c = dense.col(i).cwiseAbs().maxCoeff(); c > 0) {
        dense.col(i) /= c;
        column_scale[i] /= c;
      }
    }
  return dense;
}

/// What to do about a motion that nothing resists; `order`: equations, those that move most first.
std::string advice(const Assembler& assembler, const std::vector<int>& order, const Eigen::VectorXd& null) {
  const Model& model = assembler.model();
  const double largest = std::abs(null[order[0]]);
  if (model.commands.analysis.type.is("STATIC"))
    return ". Statics needs something that holds every motion: a support (.CLM FIX), a joint, a spring or a drive; what is to "
           "move freely needs TYPE DYNAMIC";
  std::string nodes;
  int last = -1;
  for (const int e : order) {
    if (std::abs(null[e]) < 0.1 * largest) break;
    const Unknown& u = assembler.numbering().unknown(e);
    if (u.multiplier || u.node < 0 || u.node == last) continue;
    bool inert = false;
    for (const Model::Part& part : model.parts)
      if (part.element->is_body()) inert = inert || std::find(part.nodes.begin(), part.nodes.end(), u.node) != part.nodes.end();
    if (inert) continue;
    last = u.node;
    nodes += fmt::format("{}node {}", nodes.empty() ? "" : ", ", model.nodes[static_cast<std::size_t>(u.node)].id);
  }
  if (nodes.empty())
    return ". A body that may turn needs a moment of inertia about every axis that it can turn about (INERTIA ... J), or "
           "something "
           "that holds it";
  return ". No inertia acts on " + nodes +
         ": give it a mass (INERTIA), make it part of a body (RIGID), or hold it by a support or spring";
}

}  // namespace

std::string explain_singular(Assembler& assembler, const std::string& what) {
  const Numbering& numbering = assembler.numbering();
  const int n = numbering.equations();
  if (n == 0 || n > largest_dense) return what;
  Eigen::VectorXd scale;
  const Eigen::MatrixXd dense = dense_copy(assembler, scale);
  if (!dense.allFinite()) return what + ": the matrix is not finite";
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(dense, Eigen::ComputeThinV);
  const Eigen::VectorXd null = svd.matrixV().col(n - 1).cwiseProduct(scale);
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return std::abs(null[a]) > std::abs(null[b]); });
  const double largest = std::abs(null[order[0]]);
  bool moves = false;
  for (const int e : order)
    if (!numbering.unknown(e).multiplier && std::abs(null[e]) > 0.1 * largest) moves = true;
  std::string names;
  int listed = 0;
  // of reactions also the small ones: that of a hinge far away is no less undetermined than the tooth force it comes from
  const int most = moves ? 6 : 12;
  for (const int e : order) {
    if (std::abs(null[e]) < (moves ? 0.1 : 1e-3) * largest || listed == most) break;
    if (!moves && !numbering.unknown(e).multiplier) continue;
    names += fmt::format("{}{}", listed++ ? ", " : "", numbering.describe(e));
  }
  const auto deficient = (svd.singularValues().array() < 1e-12 * svd.singularValues()[0]).count();
  const std::string more = deficient > 1 ? fmt::format(" (one of {} such)", deficient) : "";
  return moves ? fmt::format("{}: nothing resists a motion of {}{}{}", what, names, more, advice(assembler, order, null))
               : fmt::format("{}: the reactions {} are not determined{}", what, names, more);
}

std::string explain_residual(Assembler& assembler, const Configuration& configuration, const NewtonReport& report) {
  if (report.rows.empty() || report.rows.back().worst < 0) return {};
  const Numbering& numbering = assembler.numbering();
  const int equation = report.rows.back().worst;
  const Unknown& unknown = numbering.unknown(equation);
  std::string text = "largest residual at " + numbering.describe(equation);
  if (unknown.part >= 0) return text;
  // of the elements on that node, the one that pushes hardest
  double hardest = 0;
  const Model::Part* culprit = nullptr;
  const auto& parts = assembler.model().parts;
  std::vector<double> r;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto& slots = numbering.part_slots(static_cast<int>(p));
    if (std::find(slots.begin(), slots.end(), unknown.slot) == slots.end()) continue;
    r.assign(slots.size(), 0);
    parts[p].element->residual(assembler.view(static_cast<int>(p), configuration), r);
    for (std::size_t i = 0; i < slots.size(); ++i)
      if (slots[i] == unknown.slot && std::abs(r[i]) >= hardest) {
        hardest = std::abs(r[i]);
        culprit = &parts[p];
      }
  }
  if (culprit) text += fmt::format(" from {} {}", culprit->type, culprit->element->id());
  return text;
}

std::string explain_not_finite(Assembler& assembler, const Configuration& configuration) {
  const auto& parts = assembler.model().parts;
  std::vector<double> r, k;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const Element& element = *parts[p].element;
    const auto n = static_cast<std::size_t>(element.layout().slots());
    r.assign(n, 0);
    k.assign(n * n, 0);
    element.tangent(assembler.view(static_cast<int>(p), configuration), {1, 1, 1}, r, k);
    const auto finite = [](double x) { return std::isfinite(x); };
    if (std::all_of(r.begin(), r.end(), finite) && std::all_of(k.begin(), k.end(), finite)) continue;
    return fmt::format("{} {} gives a force or a slope of it that is not a finite number", parts[p].type, element.id());
  }
  return {};
}

}  // namespace engrane::solve
