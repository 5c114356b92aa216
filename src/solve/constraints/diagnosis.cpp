// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/diagnosis.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "math/rotation.hpp"
#include "solve/constraints/column_basis.hpp"
#include "solve/constraints/constraint_factors.hpp"
#include "solve/constraints/mobility.hpp"

namespace engrane::solve {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

/// The lists of all ranks, one after the other.
template <class T>
std::vector<T> from_all(const std::vector<T>& mine, MPI_Datatype type, MPI_Comm comm) {
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  const auto count = static_cast<int>(mine.size());
  std::vector<int> counts(static_cast<std::size_t>(ranks)), begin;
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  int total = 0;
  for (const int of_rank : counts) {
    begin.push_back(total);
    total += of_rank;
  }
  std::vector<T> all(static_cast<std::size_t>(total));
  MPI_Allgatherv(mine.data(), count, type, all.data(), counts.data(), begin.data(), type, comm);
  return all;
}

/// The whole matrix, on every rank.
Sparse whole_matrix(Assembler& assembler) {
  std::vector<int> rows, columns;
  std::vector<double> values;
  PetscInt first = 0, end = 0;
  check_petsc(MatGetOwnershipRange(assembler.matrix(), &first, &end));
  for (PetscInt row = first; row < end; ++row) {
    PetscInt count = 0;
    const PetscInt* at = nullptr;
    const PetscScalar* entries = nullptr;
    check_petsc(MatGetRow(assembler.matrix(), row, &count, &at, &entries));
    for (PetscInt i = 0; i < count; ++i) {
      if (entries[i] == 0) continue;
      rows.push_back(row);
      columns.push_back(at[i]);
      values.push_back(entries[i]);
      if (!assembler.half() || at[i] == row) continue;
      rows.push_back(at[i]);
      columns.push_back(row);
      values.push_back(entries[i]);
    }
    check_petsc(MatRestoreRow(assembler.matrix(), row, &count, &at, &entries));
  }
  rows = from_all(rows, MPI_INT, assembler.comm());
  columns = from_all(columns, MPI_INT, assembler.comm());
  values = from_all(values, MPI_DOUBLE, assembler.comm());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) entries.emplace_back(rows[i], columns[i], values[i]);
  const int n = assembler.numbering().equations();
  Sparse matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Scales rows and columns so that their sizes do not hide the null space, columns to length 1 in the end. Returns the column
/// factors.
Vector equilibrate(Sparse& matrix) {
  Vector scale = Vector::Ones(matrix.cols());
  const auto inverse = [](const Vector& size) { return Vector((size.array() > 0).select(size.cwiseInverse(), 1.0)); };
  constexpr int passes = 4;
  for (int pass = 0; pass <= passes; ++pass) {
    if (pass < passes) {
      Vector row = Vector::Zero(matrix.rows());
      for (Eigen::Index j = 0; j < matrix.cols(); ++j)
        for (Sparse::InnerIterator it(matrix, j); it; ++it) row[it.row()] = std::max(row[it.row()], std::abs(it.value()));
      matrix = inverse(row).asDiagonal() * matrix;
    }
    Vector column(matrix.cols());
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) column[j] = matrix.col(j).norm();
    matrix = matrix * inverse(column).asDiagonal();
    scale = scale.cwiseProduct(inverse(column));
  }
  return scale;
}

/// Remainder of a column of length 1 that is rounding.
constexpr double singular_to_rounding = 1e-12;

/// A vector that the matrix all but annihilates, and the number of such vectors.
struct NullVector {
  Vector entries;
  Eigen::Index of = 0;
};

/// `farthest`: largest remainder of a column after the others, which are all of length 1, that counts as none.
NullVector nearest_null_vector(Sparse matrix, double farthest) {
  const Vector scale = equilibrate(matrix);
  for (double tolerance = singular_to_rounding; tolerance <= farthest; tolerance *= 100) {
    const ColumnBasis basis(matrix, tolerance);
    if (!basis.dependent().empty()) return {Vector(basis.null().col(0)).cwiseProduct(scale), basis.null().cols()};
  }
  return {};
}

/// Names nodes of cells in one place that a motion takes apart, with advice; empty if there are none. `null`: the motion, by
/// equation.
std::string unshared_nodes(const Assembler& assembler, const Vector& null) {
  constexpr double apart = 1e-3;  // of the largest translation
  constexpr double near = 1e-6;   // of the model's extent, as in docs/meshes.md
  const Model& model = assembler.model();
  std::vector<Vec3> motion(model.nodes.size(), Vec3::Zero());
  double largest = 0;
  for (Eigen::Index e = 0; e < null.size(); ++e) {
    const Unknown& u = assembler.numbering().unknown(static_cast<int>(e));
    if (u.multiplier || u.node < 0 || u.item > 2) continue;
    motion[static_cast<std::size_t>(u.node)][u.item] = null[e];
    largest = std::max(largest, std::abs(null[e]));
  }
  std::vector<bool> of_cells(model.nodes.size(), false);
  for (const Model::Part& part : model.parts)
    if (part.element->cell_shape() != CellShape::none)
      for (const int node : part.nodes) of_cells[static_cast<std::size_t>(node)] = true;
  // sorted along a direction that is none of a regular mesh: few nodes have neighbours within the tolerance there
  const Vec3 along = Vec3(0.83, -0.51, 0.22).normalized();
  std::vector<std::pair<double, std::size_t>> sorted;
  for (std::size_t i = 0; i < of_cells.size(); ++i)
    if (of_cells[i]) sorted.emplace_back(along.dot(model.nodes[i].x), i);
  std::sort(sorted.begin(), sorted.end());
  const double tolerance = near * model.extent();
  int pairs = 0;
  std::pair<int, int> first{std::numeric_limits<int>::max(), 0};
  for (std::size_t i = 0; i < sorted.size(); ++i)
    for (std::size_t j = i + 1; j < sorted.size() && sorted[j].first - sorted[i].first <= tolerance; ++j) {
      const std::size_t a = sorted[i].second, b = sorted[j].second;
      if ((model.nodes[a].x - model.nodes[b].x).norm() > tolerance || !((motion[a] - motion[b]).norm() > apart * largest))
        continue;
      ++pairs;
      first = std::min(first, std::minmax({model.nodes[a].id, model.nodes[b].id}));
    }
  if (pairs == 0) return {};
  return fmt::format(
      ". Nodes {} and {} are in one place, and this motion takes them apart{}: cells are joined only by nodes that they share; "
      "name the same node in both, or join such nodes of a mesh file by engrane import --merge 1e-6",
      first.first, first.second, pairs > 1 ? fmt::format(" (the first of {} such pairs)", pairs) : "");
}

/// Advice on a motion that nothing resists; `order`: equations, those that move most first.
std::string advice(const Assembler& assembler, const std::vector<int>& order, const Vector& null, Resistance resistance) {
  const Model& model = assembler.model();
  const double largest = std::abs(null[order[0]]);
  if (resistance != Resistance::in_motion)
    return unshared_nodes(assembler, null) +
           fmt::format(". {} needs something that holds every motion: a support (.CLM FIX), a joint, a spring or a drive; ",
                       resistance == Resistance::at_rest ? "Statics" : "The equilibrium of START STATIC") +
           (resistance == Resistance::at_rest
                ? "what is to move freely needs TYPE DYNAMIC"
                : "if this motion is to be free, hold it by a spring too weak to matter, or leave START STATIC out and give "
                  "positions by .INI DEP") +
           plane_advice(model);
  std::vector<bool> bodies(model.nodes.size(), false);
  for (const Model::Part& part : model.parts)
    if (part.element->is_body())
      for (const int node : part.nodes) bodies[static_cast<std::size_t>(node)] = true;
  std::string nodes;
  int last = -1;
  for (const int e : order) {
    if (std::abs(null[e]) < 0.1 * largest) break;
    const Unknown& u = assembler.numbering().unknown(e);
    if (u.multiplier || u.node < 0 || u.node == last) continue;
    if (bodies[static_cast<std::size_t>(u.node)]) continue;
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

/// Whether the matrix alone shows that the rounding of positions is no visible part of the loads. In a linear model without
/// constraints it is a sum of positive semidefinite parts, none of which has a larger entry than its diagonal.
bool surely_resolved(const Assembler& assembler, const References& references, double visible, double least_load) {
  const auto& unknowns = assembler.numbering().unknowns();
  const bool forces = std::all_of(unknowns.begin(), unknowns.end(),
                                  [](const Unknown& u) { return !u.multiplier && u.measure == Measure::force; });
  if (!forces || unknowns.empty()) return false;
  Owned<Vec> diagonal;
  *diagonal.out() = assembler.new_vector();
  check_petsc(MatGetDiagonal(assembler.matrix(), diagonal));
  PetscReal stiffest = 0;
  check_petsc(VecNorm(diagonal, NORM_INFINITY, &stiffest));
  double reach = 0, load = std::numeric_limits<double>::infinity();
  for (int row = 0; row < assembler.numbering().equations(); ++row) {
    reach = std::max(reach, references.length(row));
    load = std::min(load, std::max(references.load(row), least_load));
  }
  return std::numeric_limits<double>::epsilon() * stiffest * reach <= visible * load;
}

/// Whether a null vector moves something, and is not of reactions alone.
bool moves(const Numbering& numbering, const Vector& null) {
  const double largest = null.cwiseAbs().maxCoeff();
  for (Eigen::Index e = 0; e < null.size(); ++e)
    if (!numbering.unknown(static_cast<int>(e)).multiplier && std::abs(null[e]) > 0.1 * largest) return true;
  return false;
}

/// `what`, followed by the unknowns of a null vector.
std::string describe(const Assembler& assembler, const std::string& what, const NullVector& nearest, Resistance resistance) {
  const Numbering& numbering = assembler.numbering();
  const Vector& null = nearest.entries;
  std::vector<int> order(static_cast<std::size_t>(null.size()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return std::abs(null[a]) > std::abs(null[b]); });
  const double largest = std::abs(null[order[0]]);
  const bool motion = moves(numbering, null);
  std::string names;
  int listed = 0;
  // of reactions also small ones: that of a hinge far away is no less undetermined than the tooth force that causes it
  const int most = motion ? 6 : 12;
  for (const int e : order) {
    if (std::abs(null[e]) < (motion ? 0.1 : 1e-3) * largest || listed == most) break;
    if (!motion && !numbering.unknown(e).multiplier) continue;
    names += fmt::format("{}{}", listed++ ? ", " : "", numbering.describe(e));
  }
  const std::string more = nearest.of > 1 ? fmt::format(" (one of {} such)", nearest.of) : "";
  return motion ? fmt::format("{}: nothing resists a motion of {}{}{}", what, names, more,
                              advice(assembler, order, null, resistance))
                : fmt::format("{}: the reactions {} are not determined{}", what, names, more);
}

}  // namespace

std::string explain_singular(Assembler& assembler, const std::string& what, Resistance resistance) {
  if (assembler.numbering().equations() == 0) return what;
  const Sparse matrix = whole_matrix(assembler);
  if (!Vector::Map(matrix.valuePtr(), matrix.nonZeros()).allFinite()) return what + ": the matrix is not finite";
  const NullVector nearest = nearest_null_vector(matrix, 1);
  return nearest.of == 0 ? what : describe(assembler, what, nearest, resistance);
}

std::string explain_null_vector(const Assembler& assembler, const std::string& what, std::span<const double> null,
                                Resistance resistance) {
  return describe(assembler, what, {Vector::Map(null.data(), static_cast<Eigen::Index>(null.size())), 1}, resistance);
}

std::string explain_unresisted(Assembler& assembler, const Configuration& equilibrium, const std::string& what,
                               Resistance resistance) {
  constexpr int most_equations = 100'000;  // more cost minutes
  const int n = assembler.numbering().equations();
  if (n == 0 || n > most_equations) return {};
  assembler.tangent(at_start_of_step(equilibrium), {1, 0, 0});
  const Sparse matrix = whole_matrix(assembler);
  if (!Vector::Map(matrix.valuePtr(), matrix.nonZeros()).allFinite()) return {};
  const NullVector nearest = nearest_null_vector(matrix, singular_to_rounding);
  return nearest.of > 0 && moves(assembler.numbering(), nearest.entries) ? describe(assembler, what, nearest, resistance)
                                                                         : std::string();
}

std::string plane_advice(const Model& model) {
  const bool plane_cells = std::any_of(model.parts.begin(), model.parts.end(), [](const Model::Part& part) {
    return part.element->cell_shape() != CellShape::none && part.element->layout().needs_any(0, NodeNeed::in_plane);
  });
  return plane_cells && !model.plane.active() ? "; if all motion is in the plane of the cells, .SAM PLANE XY solves it there"
                                              : "";
}

std::string explain_free_motion(Assembler& assembler, const Configuration& configuration, const Mobility& mobility) {
  const int freedom = mobility.freedom();
  if (freedom <= 0) return {};
  const ConstraintFactors factors(assembler, at_start_of_step(configuration), ConstraintColumns::gradients, 1e-9);
  std::string text = fmt::format(
      "a KINEMATIC analysis needs drives that leave no freedom, but {} free here, for example that of {}: give a joint a DRIVE, "
      "prescribe a displacement, or use TYPE DYNAMIC",
      freedom == 1 ? "1 motion is" : fmt::format("{} motions are", freedom),
      factors.motions().largest_part(assembler.numbering(), factors.possible_motion(factors.motions().any())));
  bool driven = false;
  for (int m = 0; m < static_cast<int>(configuration.multipliers.size()) && !driven; ++m)
    driven = is_drive(assembler.model(), assembler.numbering().multiplier(m));
  // links in line take a freedom that the drive has elsewhere, and leave one to the rest
  if (driven && mobility.redundant() > 0)
    text += "; if the drives move everything elsewhere, this is a dead position, with links in line: start a little beside it";
  return text;
}

std::string explain_unresolved(const Assembler& assembler, const References& references, bool one_tangent,
                               const Configuration& configuration, double energy) {
  constexpr double visible = 1e-3, epsilon = std::numeric_limits<double>::epsilon();
  const Numbering& numbering = assembler.numbering();
  const auto& parts = assembler.model().parts;
  const double extent = assembler.model().extent(), least = energy / extent;
  if (one_tangent && surely_resolved(assembler, references, visible, least)) return {};
  struct {
    double part;
    int rank;
  } worst{visible, assembler.rank()};  // layout of MPI_DOUBLE_INT
  double worst_noise = 0;
  int worst_equation = -1, culprit = -1;
  // where constraints are closed by positions there are no remainders
  const std::vector<double>& remainders = configuration.remainders;
  const bool kept = std::any_of(remainders.begin(), remainders.end(), [](double left) { return left != 0; });
  for (const int p : assembler.own_parts()) {
    const Element& element = *parts[static_cast<std::size_t>(p)].element;
    if (kept && element.sees_remainders()) continue;
    const auto& slots = numbering.part_slots(p);
    const std::size_t n = slots.size(), of_nodes = static_cast<std::size_t>(element.layout().node_slots());
    const auto k = assembler.element_tangent(p, configuration, {1, 0, 0, 0}).k;
    // rounding in one direction is compared with what the element carries in any: a beam in pure bending has no axial force
    double carried = 0;
    for (std::size_t i = 0; i < of_nodes; ++i)
      if (const int row = numbering.equation(slots[i]); row >= 0)
        carried = std::max(carried, references.load(row) / (numbering.unknown(row).rotational() ? extent : 1));
    // parts of a mesh that waves have not reached yet carry no forces of interest
    const double elsewhere = element.cell_shape() == CellShape::none ? 0 : references.largest_force();
    for (std::size_t i = 0; i < of_nodes; ++i) {
      const int row = numbering.equation(slots[i]);
      if (row < 0) continue;
      double noise = 0, place = 0;
      for (std::size_t j = 0; j < of_nodes; ++j) {
        const int column = numbering.equation(slots[j]);
        if (column < 0) continue;
        noise = std::max(noise, std::abs(k[i * n + j]) * epsilon * references.length(column));
        place = std::max(place, epsilon * references.length(column));
      }
      // a machine without loads has no forces to resolve
      if (!(energy > 1e3 * noise * place)) continue;
      const double lever = numbering.unknown(row).rotational() ? extent : 1;
      const double part = noise / std::max(lever * std::max(carried, least), elsewhere);
      if (!(part > worst.part)) continue;
      worst.part = part;
      worst_noise = noise;
      worst_equation = row;
      culprit = p;
    }
  }
  // the first rank with the worst value broadcasts the rest
  MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE_INT, MPI_MAXLOC, assembler.comm());
  MPI_Bcast(&worst_equation, 1, MPI_INT, worst.rank, assembler.comm());
  MPI_Bcast(&culprit, 1, MPI_INT, worst.rank, assembler.comm());
  MPI_Bcast(&worst_noise, 1, MPI_DOUBLE, worst.rank, assembler.comm());
  if (worst_equation < 0) return {};
  const Model::Part& stiff = parts[static_cast<std::size_t>(culprit)];
  const bool turns = numbering.unknown(worst_equation).rotational();
  return fmt::format(
      "{} is so stiff that the rounding of positions makes {:.2g} {} in it, {:.2g} of the loads of {}: its forces are known "
      "no "
      "better. Take a rigid joint (WELD, DISTANCE) for it, or a stiffness at most {:.0g} of this one",
      stiff.name(), worst_noise, assembler.model().units.label(turns ? dimension::moment : dimension::force), worst.part,
      numbering.describe(worst_equation), 1e-6 / worst.part);
}

std::string explain_small_turns(const Model& model, const Configuration& tried) {
  constexpr double far = 1;  // rad, far beyond what is small
  if (!has_cells(model) || !model.commands.analysis.displacements.is("SMALL")) return {};
  for (std::size_t i = 1; i < tried.nodes.size(); ++i) {
    if (!(rotation_log(tried.nodes[i].R).norm() > far)) continue;
    return fmt::format(
        "; node {} turned by more than a radian, which is not small: cells of small displacements do not go with the finite "
        "motion "
        "of joints and springs there. Divide all loads by the same number and multiply the results by it, or take DISPLACEMENTS "
        "LARGE",
        model.nodes[i].id);
  }
  return {};
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
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto& slots = numbering.part_slots(static_cast<int>(p));
    if (std::find(slots.begin(), slots.end(), unknown.slot) == slots.end()) continue;
    const auto r = assembler.element_residual(static_cast<int>(p), configuration);
    for (std::size_t i = 0; i < slots.size(); ++i)
      if (slots[i] == unknown.slot && std::abs(r[i]) >= hardest) {
        hardest = std::abs(r[i]);
        culprit = &parts[p];
      }
  }
  if (culprit) text += " from " + culprit->name();
  return text;
}

std::string explain_not_finite(Assembler& assembler, const Configuration& configuration) {
  const auto& parts = assembler.model().parts;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const Element& element = *parts[p].element;
    const auto [r, k] = assembler.element_tangent(static_cast<int>(p), configuration, {1, 1, 1});
    const auto finite = [](double x) { return std::isfinite(x); };
    if (std::all_of(r.begin(), r.end(), finite) && std::all_of(k.begin(), k.end(), finite)) continue;
    const std::string kind = element.cell_shape() == CellShape::none ? parts[p].type : "cell";
    const std::string why = element.why_not_finite();
    return fmt::format("{} {} {}", kind, element.id(), why.empty() ? gives_not_finite : why);
  }
  return {};
}

}  // namespace engrane::solve
