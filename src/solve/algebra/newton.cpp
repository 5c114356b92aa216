// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/newton.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include "solve/algebra/guarded.hpp"
#include "solve/algebra/rows.hpp"

namespace engrane::solve {

namespace {

/// Residuals of stiff meshes in dynamics contain at most this many times PREC of rounding.
constexpr double most_rounding = 1000;

/// Weight of the loads that an iteration at rest only tried on its way, if nothing larger remains.
constexpr double share_of_tried = 1e-3;

/// Instructions of an element's residual for each of its slots, including setting and measuring the configuration, and the cost
/// of a tangent over that: counted for chains of 3, 20 and 100 links (docs/decisions/0024-kept-factors.md).
constexpr double residual_of_slot = 225, tangent_over_residual = 5.4;

/// A correction this small does not change the tangent: what is left of the forces is rounding, or a kink that a new tangent
/// would not see either.
constexpr double same_tangent = 1e-10;
/// A tangent is used again if the correction is expected to leave this fraction of PREC.
constexpr double share_of_precision = 1e-2;
/// Largest number of uses of one tangent.
constexpr int most_uses = 3;

/// Violation below which a constraint counts as closed, and the largest correction, over the violation, that is attributed to
/// it.
constexpr double closed = 1e-9, most_of_open = 2;

/// Largest correction, relative to the extent, beside which a residual that no longer falls may be rounding. What hardly changes
/// its volume answers rounded positions with forces that bend it by more than they were rounded.
constexpr double small_correction = 1e-11;

/// Change of the other unknown of a Border, over its size, that leaves a negligible error of second order.
constexpr double settled_border = 1e-6;

/// Sliding speed that counts as zero, over the speed below which friction is regularised.
constexpr double resting = 1e-3;

/// Whether factors for one may be used for the other; how good they are shows in their contraction.
bool similar(const Weights& a, const Weights& b) {
  const auto near = [](double x, double y) { return std::abs(x - y) <= 0.2 * std::abs(y); };
  return near(a.q, b.q) && near(a.v, b.v) && near(a.a, b.a) && a.multipliers == b.multipliers;
}

/// Norms of residuals and corrections, which decide nothing here, are only computed for SNES options such as -snes_monitor.
PetscBool snes_is_watched() {
  char* options = nullptr;
  check_petsc(PetscOptionsGetAll(nullptr, &options));
  const bool watched = std::string_view(options).find("-snes_") != std::string_view::npos;
  check_petsc(PetscFree(options));
  return watched ? PETSC_TRUE : PETSC_FALSE;
}

PetscErrorCode no_jacobian(SNES, Vec, Mat, Mat, void*) { return 0; }

}  // namespace

Newton::Newton(Assembler& assembler, LinearSolver& solver, double precision, int iterations)
    : assembler_(assembler),
      solver_(solver),
      precision_(precision),
      iterations_(iterations),
      frames_(assembler),
      references_(assembler, precision) {
  *residual_.out() = assembler.new_vector();
  check_petsc(SNESCreate(assembler.comm(), snes_.out()));
  check_petsc(SNESSetType(snes_, SNESNEWTONLS));
  check_petsc(SNESSetKSP(snes_, solver.ksp()));
  check_petsc(SNESSetFunction(snes_, residual_, form_function, this));
  // tangents are made by choose_factors(): SNES would look up nine of its options before each
  check_petsc(SNESSetJacobian(snes_, assembler.matrix(), assembler.matrix(), no_jacobian, nullptr));
  check_petsc(SNESSetLagJacobian(snes_, -1));
  SNESLineSearch search = nullptr;
  check_petsc(SNESGetLineSearch(snes_, &search));
  check_petsc(SNESLineSearchSetType(search, SNESLINESEARCHBASIC));
  const auto& parts = assembler.model().parts;
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (parts[p].element->layout().slides > 0) sliding_parts_.push_back(static_cast<int>(p));
  check_petsc(SNESLineSearchSetPreCheck(search, change_step, this));
  if (!sliding_parts_.empty()) *trial_.out() = assembler.new_vector();
  for (const Model::Part& part : parts) {
    const Layout& layout = part.element->layout();
    evaluation_ += residual_of_slot * static_cast<double>(layout.slots());
  }
  // one more than are judged: SNES evaluates no residual after its last iteration
  check_petsc(SNESSetTolerances(snes_, 0, 0, 0, iterations + 1, 100000));
  check_petsc(SNESLineSearchSetComputeNorms(search, snes_is_watched()));
  check_petsc(SNESSetConvergenceTest(snes_, test_convergence, this, nullptr));
  check_petsc(SNESSetFromOptions(snes_));
  check_petsc(SNESSetUp(snes_));
  // those set by SNESSetUp() are for inexact Newton methods
  check_petsc(KSPSetPreSolve(solver.ksp(), before_solution, this));
  check_petsc(KSPSetPostSolve(solver.ksp(), after_solution, this));
}

NewtonReport Newton::solve(Vec x, Weights weights, bool keep, const Apply& apply, Configuration& work, Border* border) {
  border_ = border;
  apply_ = &apply;
  work_ = &work;
  weights_ = weights;
  keep_ = keep;
  NewtonReport report;
  // no copy before the first solution, for whose factors a large model needs the memory
  loads_before_.clear();
  if (references_.remembers()) loads_before_ = references_.memory();
  references_.begin(work);
  solver_.correct_only(keep);
  rows_.clear();
  failure_ = nullptr;
  solving_ = true;
  const PetscErrorCode code = SNESSolve(snes_, nullptr, x);
  solving_ = refined_ = false;
  open_ = 1;
  SNESConvergedReason reason = SNES_CONVERGED_ITERATING;
  if (code == 0) check_petsc(SNESGetConvergedReason(snes_, &reason));
  report.converged = reason > 0;
  if (!report.converged) refuse_last();
  rethrow(failure_);
  solver_.rethrow();
  check_petsc(code);
  report.singular = reason == SNES_DIVERGED_LINEAR_SOLVE;
  if (reason == SNES_DIVERGED_MAX_IT)
    report.reason = "no convergence in " + std::to_string(rows_.size() - 1) + " iterations";
  else if (report.singular)
    report.reason = "the tangent matrix is singular";
  else if (reason < 0)
    report.reason = "the iteration left the range of numbers";
  policy_.end(report.converged);
  if (report.singular) solver_.reset();
  // Loads that an iteration only tried on its way are no reference. At rest, where there may be no others, a thousandth of them
  // is one for their rounding.
  if (report.converged) {
    const double tried = weights.a > 0 ? 0 : share_of_tried;
    std::vector<double> memory = references_.memory();
    for (std::size_t i = 0; i < memory.size(); ++i)
      memory[i] = std::max(loads_before_.empty() ? 0.0 : loads_before_[i], tried * memory[i]);
    references_.restore(std::move(memory));
    references_.take(work, assembler_.carried());
  }
  report.iterations = std::max(0, static_cast<int>(rows_.size()) - 1);
  report.rows = rows_;
  return report;
}

/// Beside the large forces of an iteration that failed the next one would count as converged at once.
void Newton::refuse_last() {
  loads_before_.resize(references_.memory().size());
  references_.restore(loads_before_);
}

PetscErrorCode Newton::form_function(SNES snes, Vec x, Vec f, void* context) {
  auto& self = *static_cast<Newton*>(context);
  return guarded(self.failure_, [&]() -> PetscErrorCode {
    (*self.apply_)(self.assembler_.gather(x), *self.work_);
    self.assembler_.residual(*self.work_, f);
    self.references_.take(*self.work_, self.assembler_.carried());
    const Imbalance found = self.imbalance_ = imbalance(self.assembler_, self.references_, f);
    self.row_ = {0, found.force, found.moment, found.length, found.angle, 0, found.worst};
    return std::isfinite(found.largest()) ? 0 : SNESSetFunctionDomainError(snes);
  });
}

void Newton::make_tangent() {
  // work_ is the configuration of the last residual, at the same point
  const bool comparable = matrix_of_factors_ == assembler_.changes() && similar(weights_, weights_of_factors_);
  if (keep_) frames_.take_old(*work_, assembler_.matrix(), comparable);
  assembler_.tangent(*work_, weights_);
  if (one_tangent_) assembler_.forget_places();
  if (keep_) frames_.renew(*work_, assembler_.matrix(), [this](int equation) { return references_.length(equation); });
  fresh_ = true;
  policy_.renewed();
  matrix_of_factors_ = assembler_.changes();
  weights_of_factors_ = weights_;
}

PetscErrorCode Newton::before_solution(KSP, Vec right, Vec, void* context) {
  auto& self = *static_cast<Newton*>(context);
  return guarded(self.failure_, [&] {
    if (self.solving_ && self.keep_ && !self.fresh_) self.frames_.turn_right_side(*self.work_, right);
    return 0;
  });
}

PetscErrorCode Newton::after_solution(KSP, Vec, Vec solution, void* context) {
  auto& self = *static_cast<Newton*>(context);
  return guarded(self.failure_, [&] {
    if (self.solving_ && self.keep_ && !self.fresh_) self.frames_.turn_solution(solution);
    self.fresh_ = false;
    return 0;
  });
}

void Newton::choose_factors() {
  if (one_tangent_) {
    const bool made = policy_.usable() && matrix_of_factors_ == assembler_.changes();
    if (!made) make_tangent();
    return;
  }
  if (rows_.size() == 1) {
    if (!keep_ || matrix_of_factors_ != assembler_.changes() || !similar(weights_, weights_of_factors_)) policy_.forget();
    double renewal = 0;
    if (policy_.usable()) {
      const SolverWork work = solver_.work();
      renewal = (tangent_over_residual * evaluation_ + work.factor) / (evaluation_ + work.solution);
    }
    policy_.begin(imbalance_.largest() / precision_, renewal);
  } else {
    policy_.corrected(imbalance_.largest() / precision_);
  }
  const bool serve = keep_ ? !policy_.due() : tangent_serves_again();
  if (!serve) make_tangent();
  uses_ = serve ? uses_ + 1 : 1;
}

/// A tangent at x_k leaves the fraction θ of the residual. θ is half of the relative change of the tangent on the way to x_k+1,
/// so that there it would leave 2 θ.
bool Newton::tangent_serves_again() const {
  if (rows_.size() < 2 || uses_ >= most_uses || !sliding_parts_.empty() || matrix_of_factors_ != assembler_.changes())
    return false;
  if (changed_ <= same_tangent) return true;
  const NewtonRow& before = rows_[rows_.size() - 2];
  const double left = imbalance_.largest();
  const double theta = left / std::max({before.force, before.moment, before.length, before.angle});
  return uses_ == 1 && 2 * theta * left <= share_of_precision * precision_;
}

void Newton::save(Snapshot& snapshot) const {
  references_.save(snapshot);
  if (one_tangent_ || !policy_.usable() || matrix_of_factors_ != assembler_.changes()) return;
  policy_.save(snapshot);
  frames_.save(snapshot);
  snapshot.put("newton/weights", {weights_of_factors_.q, weights_of_factors_.v, weights_of_factors_.a});
  solver_.save_factors(snapshot);
}

void Newton::load(const Snapshot& snapshot) {
  references_.load_memory(snapshot);
  policy_.forget();
  if (!snapshot.has("newton/factors") || !solver_.load_factors(snapshot)) return;
  policy_.load(snapshot);
  frames_.load(snapshot);
  const std::vector<double>& weights = snapshot.array("newton/weights");
  weights_of_factors_ = {weights.at(0), weights.at(1), weights.at(2)};
  matrix_of_factors_ = assembler_.changes();
  fresh_ = false;  // they are turned with the nodes from the first solution on
}

std::vector<Vec3> Newton::sliding() const {
  std::vector<Vec3> speeds;
  for (const int part : sliding_parts_) {
    const Element& element = *assembler_.model().parts[static_cast<std::size_t>(part)].element;
    const auto count = static_cast<std::size_t>(element.layout().slides);
    speeds.resize(speeds.size() + count, Vec3::Zero());
    element.sliding(assembler_.view(part, *work_), std::span(speeds).last(count));
  }
  return speeds;
}

PetscErrorCode Newton::change_step(SNESLineSearch, Vec x, Vec step, PetscBool* changed, void* context) {
  auto& self = *static_cast<Newton*>(context);
  return guarded(self.failure_, [&] {
    if (self.border_) self.border_->complete(x, step);
    const bool shortened = !self.sliding_parts_.empty() && self.keep_sliding(x, step);
    *changed = self.border_ || shortened ? PETSC_TRUE : PETSC_FALSE;
    return 0;
  });
}

/// The curve of a regularised friction is flat on both sides and steep in between: a tangent on one side leads far over to the
/// other, and back. A step that would reverse a sliding direction is shortened to where the sliding stops; from there tangents
/// lead towards the solution. True if the step has been changed.
bool Newton::keep_sliding(Vec x, Vec step) {
  const std::vector<Vec3> before = sliding();
  check_petsc(VecWAXPY(trial_, -1, step, x));
  (*apply_)(assembler_.gather(trial_), *work_);
  const std::vector<Vec3> after = sliding();
  double part = 1;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double first = before[i].norm(), towards = before[i].dot(after[i]);
    if (!(towards < 0) || std::max(first, after[i].norm()) < 1 || first < resting) continue;
    part = std::min(part, first * first / (first * first - towards));
  }
  if (part < 1) check_petsc(VecScale(step, part));
  return part < 1;
}

bool Newton::left_to_rounding() const {
  const std::vector<double> size = rounding_of_unknowns(assembler_, references_, *work_);
  return is_noise(residual_, magnitudes_times(assembler_.matrix(), size));
}

bool Newton::balanced_by_itself() {
  if (weights_.a > 0 || rows_.size() == 1 || row_.correction <= no_correction) return true;
  std::vector<double> memory = references_.memory();
  refuse_last();
  references_.take(*work_, assembler_.carried());
  const bool balanced = imbalance(assembler_, references_, residual_).within(precision_);
  references_.restore(std::move(memory));
  references_.take(*work_, assembler_.carried());
  return balanced;
}

bool Newton::judge(int iteration) {
  row_.iteration = iteration;
  double forces = 0;  // largest change of a multiplier
  if (iteration > 0) {
    Vec update = nullptr;
    check_petsc(SNESGetSolutionUpdate(snes_, &update));
    PetscInt first = 0, end = 0;
    check_petsc(VecGetOwnershipRange(update, &first, &end));
    const PetscScalar* values = nullptr;
    check_petsc(VecGetArrayRead(update, &values));
    for (PetscInt row = first; row < end; ++row) {
      const auto equation = static_cast<int>(row);
      double& largest = assembler_.numbering().unknown(equation).multiplier ? forces : row_.correction;
      largest = std::max(largest, references_.relative_change(equation, values[row - first]));
    }
    check_petsc(VecRestoreArrayRead(update, &values));
    double both[2] = {row_.correction, forces};
    MPI_Allreduce(MPI_IN_PLACE, both, 2, MPI_DOUBLE, MPI_MAX, assembler_.comm());
    row_.correction = both[0];
    forces = both[1];
  }
  rows_.push_back(row_);
  // so far away the stiffest laws resist with any force
  if (weights_.a == 0 && row_.correction > 1) refuse_last();
  if (refined_ && iteration == 1 && row_.force + row_.moment > 0 && solver_.direct()) return false;
  if (imbalance_.within(precision_) && std::max(imbalance_.length, imbalance_.angle) <= open_ && balanced_by_itself())
    return true;
  // one node alone stands in the plane of a path at once, while the load that keeps it there is still sought
  if (border_ && iteration > 0 && !border_->has_settled(settled_border)) {
    changed_ = std::max(row_.correction, forces);
    return false;
  }
  const double changed_before = std::exchange(changed_, std::max(row_.correction, forces)), changed = changed_;
  if (iteration > 1 && changed <= no_correction) return true;
  const double left = imbalance_.largest();
  const NewtonRow& before = rows_[rows_.size() - std::min<std::size_t>(rows_.size(), 2)];
  const bool stands = iteration > 1 && left > 0.5 * std::max(before.force, before.moment);
  // Positions are at rounding level, which is no lower for parts that carry next to nothing than for others. Behind a branching
  // point of a path rounding decides much.
  const bool rests = iteration > 1 && row_.correction <= (stands && !border_ ? small_correction : no_correction);
  if (iteration > 0 && (one_tangent_ || rests) && left_to_rounding()) return true;
  if (iteration < 2 || !(left <= std::sqrt(precision_))) return false;
  if (changed <= negligible_correction) return true;
  // In dynamics the last two corrections predict the next one, since corrections with their own tangents shrink quadratically.
  // Residuals of stiff meshes contain more rounding of positions than PREC allows, which another iteration would only confirm.
  // At rest soft parts beside stiff ones may still move when corrections have become small, and what kept factors leave is not
  // rounding.
  const double theta = changed / changed_before, next = changed * (uses_ == 1 ? theta * theta : theta);
  const bool near = weights_.a > 0 && !keep_ && left <= most_rounding * precision_ && sliding_parts_.empty();
  if (near && theta < 1 && next <= negligible_correction) return true;
  // forces that are small beside stiffness times the rounding of positions follow that rounding and never settle; at rest this
  // may be the rounding of an angle of many turns, by which its constraint then stays open
  const auto rounds = [this](const NewtonRow& row) {
    const double open = std::max(row.length, row.angle);
    return row.correction <= std::max(no_correction, weights_.a == 0 && open <= closed ? most_of_open * open : 0.0);
  };
  return rounds(row_) && rounds(before) && stands;
}

PetscErrorCode Newton::test_convergence(SNES, PetscInt iteration, PetscReal, PetscReal, PetscReal, SNESConvergedReason* reason,
                                        void* context) {
  auto& self = *static_cast<Newton*>(context);
  *reason = SNES_CONVERGED_ITERATING;
  return guarded(self.failure_, [&] {
    if (!std::isfinite(self.imbalance_.largest()))
      *reason = SNES_DIVERGED_FNORM_NAN;
    else if (self.judge(static_cast<int>(iteration)))
      *reason = SNES_CONVERGED_FNORM_ABS;
    else if (iteration >= self.iterations_)
      *reason = SNES_DIVERGED_MAX_IT;
    else
      self.choose_factors();
    return 0;
  });
}

}  // namespace engrane::solve
