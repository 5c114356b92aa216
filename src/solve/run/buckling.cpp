// SPDX-License-Identifier: BSD-3-Clause
#include "solve/run/buckling.hpp"

#include <fmt/format.h>
#include <slepceps.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "solve/algebra/guarded.hpp"
#include "solve/algebra/probe.hpp"
#include "solve/constraints/diagnosis.hpp"
#include "solve/schemes/equilibrium_tangent.hpp"
#include "solve/schemes/load_derivative.hpp"
#include "solve/schemes/mode_text.hpp"

namespace engrane::solve {

namespace {

/// Finite-difference step for the change of the tangent: at first over H, then over the nearest buckling time.
constexpr double first_step = 1e-3, good_step = 1e-2;
/// Times that change by more than this fraction with another difference are rounding.
constexpr double same = 1e-3;
/// Such a fraction for modes after the first, whose difference is not chosen for them.
constexpr double alike_later = 1e-2;
constexpr int most_passes = 8;
constexpr double precision = 1e-10;
/// Times farther away than this many runs are rounding, and so are those nearer than that fraction of one.
constexpr double never = 1e15;

struct Slepc {
  Slepc() { check_petsc(SlepcInitializeNoArguments()); }
  ~Slepc() { SlepcFinalize(); }
};

class Problem {
 public:
  Problem(SolverContext& context, const Configuration& equilibrium) : context_(context), tangent_(context) {
    *change_.out() = context.assembler.new_matrix();
    for (Owned<Vec>* vector : {&loads_, &way_, &product_}) *vector->out() = context.assembler.new_vector();
    if (!tangent_.factor(equilibrium))
      throw SolutionFailure(
          explain_singular(context.assembler, "no buckling loads: the tangent matrix is singular", Resistance::at_rest));
    if (tangent_.neutral(way_)) {
      const std::string free =
          explain_unresisted(context.assembler, equilibrium, "no buckling loads: the tangent matrix is singular");
      if (!free.empty()) throw SolutionFailure(free);
    }
    LoadDerivative derivative(context, first_step * context.options.step);
    derivative.find(tangent_.place(), loads_);
    tangent_.solve(loads_, way_);
    check_petsc(VecScale(way_, -1));
    const auto all = context.assembler.gather(way_);
    along_.assign(all.begin(), all.end());
  }

  bool loaded() const {
    return std::any_of(along_.begin(), along_.end(), [](double value) { return value != 0; });
  }

  /// K′ by the forward difference of order 4: exact where the tangent is a polynomial of that degree.
  void differentiate(double step) {
    static constexpr std::array<double, 5> weights{-25.0 / 12, 4, -3, 4.0 / 3, -1.0 / 4};
    check_petsc(MatCopy(tangent_.matrix(), change_, SAME_NONZERO_PATTERN));
    check_petsc(MatScale(change_, weights[0]));
    Owned<Mat> later;
    *later.out() = context_.assembler.new_matrix();
    for (std::size_t k = 1; k < weights.size(); ++k) {
      tangent_.evaluate(moved(static_cast<double>(k) * step), later);
      check_petsc(MatAXPY(change_, weights[k], later, SAME_NONZERO_PATTERN));
    }
    check_petsc(MatScale(change_, 1 / step));
  }

  struct Pair {
    double time;
    std::vector<double> vector;  ///< by equation
  };
  /// Nearest times, from the equilibrium's own, with their modes.
  std::vector<Pair> solve(int count) {
    Owned<Mat> shell;
    PetscInt local = 0, global = 0;
    check_petsc(VecGetLocalSize(way_, &local));
    check_petsc(VecGetSize(way_, &global));
    check_petsc(MatCreateShell(context_.assembler.comm(), local, local, global, global, this, shell.out()));
    check_petsc(MatShellSetOperation(shell, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
    Owned<EPS> eps;
    check_petsc(EPSCreate(context_.assembler.comm(), eps.out()));
    check_petsc(EPSSetOperators(eps, shell, nullptr));
    check_petsc(EPSSetProblemType(eps, EPS_NHEP));
    check_petsc(EPSSetWhichEigenpairs(eps, EPS_LARGEST_MAGNITUDE));
    check_petsc(EPSSetDimensions(eps, std::min<PetscInt>(count, global), PETSC_DEFAULT, PETSC_DEFAULT));
    check_petsc(EPSSetTolerances(eps, precision, PETSC_DEFAULT));
    check_petsc(EPSSetOptionsPrefix(eps, "buckling_"));
    fill_probe(product_);
    Vec first = product_;
    check_petsc(EPSSetInitialSpace(eps, 1, &first));
    check_petsc(EPSSetFromOptions(eps));
    const PetscErrorCode code = EPSSolve(eps);
    rethrow(failure_);
    check_petsc(code);
    PetscInt converged = 0;
    check_petsc(EPSGetConverged(eps, &converged));
    std::vector<Pair> pairs;
    Owned<Vec> real;
    *real.out() = context_.assembler.new_vector();
    for (PetscInt i = 0; i < converged && static_cast<int>(pairs.size()) < count; ++i) {
      PetscScalar value = 0, imaginary = 0;
      check_petsc(EPSGetEigenpair(eps, i, &value, &imaginary, real, nullptr));
      // a complex pair is no loss of stability at rest
      if (value == 0 || imaginary != 0) continue;
      if (std::abs(value) * never * (context_.options.end - context_.options.begin) < 1) continue;  // rounding: nothing buckles
      const auto all = context_.assembler.gather(real);
      pairs.push_back({-1 / value, {all.begin(), all.end()}});
    }
    // of loads ±λ that buckle alike, rounding decides which comes first
    for (std::size_t i = 1; i < pairs.size(); ++i)
      if (pairs[i - 1].time < 0 && pairs[i].time > 0 && std::abs(pairs[i - 1].time + pairs[i].time) <= same * pairs[i].time)
        std::swap(pairs[i - 1], pairs[i]);
    return pairs;
  }

 private:
  static PetscErrorCode multiply(Mat shell, Vec x, Vec y) {
    Problem* self = nullptr;
    PetscCall(MatShellGetContext(shell, &self));
    return guarded(self->failure_, [&] {
      check_petsc(MatMult(self->change_, x, self->loads_));
      self->tangent_.solve(self->loads_, y);
      return 0;
    });
  }

  /// The equilibrium later by `time`, if everything goes on as it does.
  const Configuration& moved(double time) {
    std::vector<double> y(context_.motion.size(), 0.0), step(along_.size());
    for (std::size_t i = 0; i < step.size(); ++i) step[i] = time * along_[i];
    context_.motion.scatter(step, y);
    const Configuration& base = tangent_.place();
    context_.motion.prescribe_increment(base.load_time(), base.load_time() + time, y);
    moved_ = base;
    context_.motion.move(base, y, moved_);
    moved_ = at_start_of_step(std::move(moved_));
    moved_.lead += time;
    context_.assembler.add_to_multipliers(step, moved_.multipliers);
    return moved_;
  }

  SolverContext& context_;
  EquilibriumTangent tangent_;
  Owned<Mat> change_;
  Owned<Vec> loads_, way_, product_;
  Configuration moved_;
  std::vector<double> along_;
  std::exception_ptr failure_;  ///< thrown inside a callback
};

/// Removes the times that another difference of the tangent does not give: a system that buckles in fewer ways than were asked
/// for has rounding in their place.
void keep_confirmed(std::vector<Problem::Pair>& found, const std::vector<Problem::Pair>& again) {
  std::erase_if(found, [&](const Problem::Pair& pair) {
    return std::none_of(again.begin(), again.end(), [&](const Problem::Pair& other) {
      return std::abs(other.time - pair.time) <= alike_later * std::abs(pair.time);
    });
  });
}

}  // namespace

std::vector<BucklingMode> find_buckling(SolverContext& context, const Configuration& equilibrium, int count) {
  const Slepc slepc;
  Problem problem(context, equilibrium);
  if (!problem.loaded())
    throw SolutionFailure(
        "no buckling loads: nothing moves when time grows; give loads or prescribed displacements a function of time, NF");
  double step = first_step * context.options.step, before = 0;
  std::vector<Problem::Pair> found;
  for (int pass = 0; pass < most_passes; ++pass) {
    problem.differentiate(step);
    found = problem.solve(count);
    if (found.empty()) return {};
    const double nearest = std::abs(found.front().time);
    if (nearest * never < context.options.end - context.options.begin) return {};
    if (std::abs(nearest - before) <= same * nearest) break;
    before = nearest;
    step = good_step * nearest;
    if (pass + 1 == most_passes) return {};  // rounding
  }
  if (found.size() > 1) {
    problem.differentiate(step / 2);
    keep_confirmed(found, problem.solve(count));
  }
  std::vector<BucklingMode> modes;
  for (const Problem::Pair& pair : found) {
    BucklingMode& mode = modes.emplace_back();
    mode.load_time = equilibrium.load_time() + pair.time;
    mode.largest = largest_components(context.numbering, pair.vector);
    std::vector<double> motion(context.motion.size(), 0.0);
    context.motion.scatter(pair.vector, motion);
    double largest = 0;
    for (std::size_t i = 0; i < context.model.nodes.size(); ++i) {
      const Vec3 u(motion[6 * i], motion[6 * i + 1], motion[6 * i + 2]);
      mode.displacement.push_back(u);
      mode.rotation.push_back(equilibrium.nodes[i].R * Vec3(motion[6 * i + 3], motion[6 * i + 4], motion[6 * i + 5]));
      for (const double part : u)
        if (std::abs(part) > std::abs(largest)) largest = part;
    }
    if (largest == 0) continue;
    for (auto* parts : {&mode.displacement, &mode.rotation})
      for (Vec3& part : *parts) part /= largest;
  }
  return modes;
}

}  // namespace engrane::solve
