// SPDX-License-Identifier: BSD-3-Clause
#include "solve/run/tangent_course.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "math/rotation.hpp"
#include "solve/constraints/diagnosis.hpp"
#include "solve/schemes/load_derivative.hpp"

namespace engrane::solve {

namespace {

/// Step over H for the derivative of the loads.
constexpr double step_of_loads = 1e-3;

using Eigen::Index;

/// The rotation of an element as a body, linear in the displacements and rotations of its nodes: of cells by least squares, of
/// lines that of the chord and, about it, the mean of the nodes.
class BodyTurn {
 public:
  BodyTurn(const std::vector<Vec3>& places, bool line) : arms_(places.size(), Vec3::Zero()) {
    std::vector<std::size_t> by;
    for (std::size_t i = 0; i < places.size(); ++i) by.push_back(i);
    if (line) {
      const auto from_first = [&](std::size_t i) { return (places[i] - places[0]).norm(); };
      by = {0, *std::max_element(by.begin(), by.end(), [&](auto a, auto b) { return from_first(a) < from_first(b); })};
      axis_ = (places[by[1]] - places[0]).normalized();
      if (!axis_.allFinite()) axis_ = Vec3::Zero();
    }
    for (const std::size_t i : by) middle_ += places[i] / static_cast<double>(by.size());
    Mat3 spread = Mat3::Zero();
    for (const std::size_t i : by) {
      arms_[i] = places[i] - middle_;
      spread += arms_[i].squaredNorm() * Mat3::Identity() - arms_[i] * arms_[i].transpose();
    }
    constexpr double on_a_line = 1e-9;
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(spread);
    for (int k = 0; k < 3; ++k)
      if (const double own = axes.eigenvalues()[k]; own > on_a_line * axes.eigenvalues()[2])
        inverse_ += axes.eigenvectors().col(k) * axes.eigenvectors().col(k).transpose() / own;
  }

  const Vec3& middle() const { return middle_; }
  Vec3 by_displacement(std::size_t node, const Vec3& u) const { return inverse_ * arms_[node].cross(u); }
  Vec3 by_rotation(const Vec3& turn) const { return axis_ * axis_.dot(turn) / static_cast<double>(arms_.size()); }
  /// Whether a displacement of the node counts, and with it in the mean displacement.
  bool counts(std::size_t node) const { return !arms_[node].isZero(0); }

 private:
  std::vector<Vec3> arms_;  ///< from the middle; 0 for nodes that do not count
  Vec3 middle_ = Vec3::Zero(), axis_ = Vec3::Zero();
  Mat3 inverse_ = Mat3::Zero();
};

}  // namespace

TangentCourse::TangentCourse(SolverContext& context, const Configuration& equilibrium)
    : context_(context), tangent_(context), motion_(context.motion.size(), 0.0) {
  for (Owned<Mat>* matrix : {&change_, &rotations_}) *matrix->out() = context.assembler.new_matrix();
  for (Owned<Vec>* vector : {&product_, &way_}) *vector->out() = context.assembler.new_vector();
  constexpr const char* why = "no buckling loads: the tangent matrix is singular";
  if (!tangent_.factor(equilibrium)) throw SolutionFailure(explain_singular(context.assembler, why, Resistance::at_rest));
  if (tangent_.neutral(way_))
    if (const std::string free = explain_unresisted(context.assembler, equilibrium, why); !free.empty())
      throw SolutionFailure(free);
  LoadDerivative derivative(context, step_of_loads * context.options.step);
  derivative.find(tangent_.place(), product_);
  tangent_.solve(product_, way_);
  check_petsc(VecScale(way_, -1));
  const auto all = context.assembler.gather(way_);
  along_.assign(all.begin(), all.end());
  context.motion.scatter(along_, motion_);
  context.motion.prescribe_rates(tangent_.place().load_time(), motion_);
  tangent_.evaluate(tangent_.place(), rotations_, [this](int part, std::span<double> k) { set_to_rotation(part, k); });
  MPI_Allreduce(MPI_IN_PLACE, &fastest_turn_, 1, MPI_DOUBLE, MPI_MAX, context.assembler.comm());
}

bool TangentCourse::loaded() const {
  return std::any_of(along_.begin(), along_.end(), [](double value) { return value != 0; });
}

void TangentCourse::set_to_rotation(int part, std::span<double> k) {
  const Model::Part& of = context_.model.part(part);
  if (!of.element->turns_with_nodes()) {
    std::fill(k.begin(), k.end(), 0.0);
    return;
  }
  const bool line = of.element->cell_shape() == CellShape::none;
  struct At {
    Vec3 place, displacement, turn;
    Mat3 axes;
  };
  std::vector<At> nodes;
  std::vector<Vec3> places;
  for (const int node : of.nodes) {
    const NodeState& state = tangent_.place().nodes[static_cast<std::size_t>(node)];
    const double* rates = &motion_[6 * static_cast<std::size_t>(node)];
    nodes.push_back({state.x, Vec3(rates), state.R * Vec3(rates + 3), state.R});
    places.push_back(state.x);
  }
  const BodyTurn body(places, line);
  Vec3 mean = Vec3::Zero(), turn = Vec3::Zero();
  double count = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!body.counts(i)) continue;
    mean += nodes[i].displacement;
    turn += body.by_displacement(i, nodes[i].displacement);
    ++count;
  }
  mean /= std::max(count, 1.0);
  fastest_turn_ = std::max(fastest_turn_, turn.norm());
  // Where A takes a displacement of the element as it stands to one of the element as it will stand after unit time: it turns
  // with the body and, where it turns the body, goes on to the places that its nodes will have relative to it.
  const auto slots = context_.numbering.part_slots(part);
  const auto n = static_cast<Index>(slots.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  const auto node_of = [&](Index i) -> std::size_t {
    const int node = slots[static_cast<std::size_t>(i)] / 6;
    return static_cast<std::size_t>(std::find(of.nodes.begin(), of.nodes.end(), node) - of.nodes.begin());
  };
  for (Index column = 0; column < n; ++column) {
    const std::size_t moved = node_of(column);
    if (moved == of.nodes.size()) continue;  // not one of a node
    const int component = slots[static_cast<std::size_t>(column)] % 6;
    const Vec3 unit = Vec3::Unit(component % 3);
    const bool displaces = component < 3;
    const Vec3 turned = displaces ? body.by_displacement(moved, unit) : body.by_rotation(nodes[moved].axes * unit);
    for (Index row = 0; row < n; ++row) {
      const std::size_t i = node_of(row);
      if (i == of.nodes.size()) continue;
      const int of_row = slots[static_cast<std::size_t>(row)] % 6;
      const At& at = nodes[i];
      Vec3 change;
      if (of_row < 3) {
        change = turned.cross(at.displacement - mean - turn.cross(at.place - body.middle()));
        if (displaces && i == moved) change += turn.cross(unit);
      } else {
        change = -(at.axes.transpose() * (at.turn - turn).cross(turned));
      }
      a(row, column) = change[of_row % 3];
    }
  }
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> matrix(k.data(), n, n);
  matrix = (matrix * a + a.transpose() * matrix).eval();
}

void TangentCourse::differentiate(double step) {
  static constexpr std::array<double, 5> weights{-25.0 / 12, 4, -3, 4.0 / 3, -1.0 / 4};
  check_petsc(MatCopy(tangent_.matrix(), change_, SAME_NONZERO_PATTERN));
  check_petsc(MatScale(change_, weights[0]));
  Owned<Mat> later;
  *later.out() = context_.assembler.new_matrix();
  for (std::size_t k = 1; k < weights.size(); ++k) {
    tangent_.evaluate(at(static_cast<double>(k) * step), later);
    check_petsc(MatAXPY(change_, weights[k], later, SAME_NONZERO_PATTERN));
  }
  check_petsc(MatScale(change_, 1 / step));
  check_petsc(MatAXPY(change_, 1, rotations_, SAME_NONZERO_PATTERN));
}

void TangentCourse::respond(Vec x, Vec y) {
  check_petsc(MatMult(change_, x, product_));
  tangent_.solve(product_, y);
  check_petsc(VecScale(y, -1));
}

double TangentCourse::left_out() {
  PetscReal gained = 0, whole = 0;
  check_petsc(MatMult(rotations_, way_, product_));
  check_petsc(VecDot(way_, product_, &gained));
  check_petsc(MatMult(tangent_.matrix(), way_, product_));
  check_petsc(VecDot(way_, product_, &whole));
  return whole != 0 ? std::abs(gained / whole) : 0;
}

const Configuration& TangentCourse::at(double theta) {
  std::vector<double> y(context_.motion.size(), 0.0), step(along_.size());
  for (std::size_t i = 0; i < step.size(); ++i) step[i] = theta * along_[i];
  context_.motion.scatter(step, y);
  const Configuration& base = tangent_.place();
  context_.motion.prescribe_increment(base.load_time(), base.load_time() + theta, y);
  moved_ = base;
  context_.motion.move(base, y, moved_);
  moved_ = at_start_of_step(std::move(moved_));
  moved_.lead += theta;
  context_.assembler.add_to_multipliers(step, moved_.multipliers);
  return moved_;
}

}  // namespace engrane::solve
