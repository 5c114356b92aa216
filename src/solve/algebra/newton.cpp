// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/newton.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace engrane::solve {

namespace {

constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
/// A correction this small (over the extent, or in radians) changes nothing that anybody can see: what residual is left
/// is the rounding of the sums themselves.
constexpr double negligible_correction = 1e-13;
/// And below this nothing moves at all, whatever the forces are compared with: a freely spinning body has forces that
/// cancel inside its one element, and leaves nothing but rounding to judge by.
constexpr double no_correction = 2e-15;

/// Instructions of an element's residual for each of its slots, those of measuring it included, and what a tangent costs over
/// that: fitted to counts of joints, bodies and gears.
constexpr double residual_of_slot = 250, tangent_over_residual = 6;

/// What forces that an iteration at rest tried on its way count for, where nothing larger stays.
constexpr double share_of_tried = 1e-3;

/// A sliding speed that counts as none, over the speed below which friction is regularised.
constexpr double resting = 1e-3;

/// Whether factors for the one may serve for the other: how well, their contraction tells.
bool similar(const Weights& a, const Weights& b) {
  const auto near = [](double x, double y) { return std::abs(x - y) <= 0.2 * std::abs(y); };
  return near(a.q, b.q) && near(a.v, b.v) && near(a.a, b.a) && a.multipliers == b.multipliers;
}

}  // namespace

Newton::Newton(Assembler& assembler, LinearSolver& solver, double precision, int iterations)
    : assembler_(assembler), solver_(solver), precision_(precision), references_(assembler, precision) {
  *residual_.out() = assembler.new_vector();
  check_petsc(SNESCreate(assembler.comm(), snes_.out()));
  check_petsc(SNESSetType(snes_, SNESNEWTONLS));
  check_petsc(SNESSetKSP(snes_, solver.ksp()));
  check_petsc(SNESSetFunction(snes_, residual_, form_function, this));
  check_petsc(SNESSetJacobian(snes_, assembler.matrix(), assembler.matrix(), form_jacobian, this));
  SNESLineSearch search = nullptr;
  check_petsc(SNESGetLineSearch(snes_, &search));
  check_petsc(SNESLineSearchSetType(search, SNESLINESEARCHBASIC));
  const auto& parts = assembler.model().parts;
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (parts[p].element->layout().slides > 0) sliding_parts_.push_back(static_cast<int>(p));
  if (!sliding_parts_.empty()) {
    *trial_.out() = assembler.new_vector();
    check_petsc(SNESLineSearchSetPreCheck(search, keep_sliding, this));
  }
  for (const Model::Part& part : parts) {
    const Layout& layout = part.element->layout();
    evaluation_ +=
        residual_of_slot * static_cast<double>(6 * part.nodes.size() + layout.multipliers.size() + layout.scalars.size());
  }
  check_petsc(SNESSetTolerances(snes_, 0, 0, 0, iterations, 100000));
  check_petsc(SNESSetConvergenceTest(snes_, test_convergence, this, nullptr));
  check_petsc(SNESSetFromOptions(snes_));
}

NewtonReport Newton::solve(Vec x, Weights weights, bool keep, const Apply& apply, Configuration& work) {
  apply_ = &apply;
  work_ = &work;
  weights_ = weights;
  keep_ = keep;
  NewtonReport report;
  const std::vector<double> before = references_.memory();
  references_.begin(work);
  Owned<Vec> guess;
  *guess.out() = assembler_.new_vector();
  check_petsc(VecCopy(x, guess));
  for (;;) {
    rows_.clear();
    failure_.clear();
    const PetscErrorCode code = SNESSolve(snes_, nullptr, x);
    if (!failure_.empty()) throw PetscFailure(failure_);
    check_petsc(code);
    SNESConvergedReason reason = SNES_CONVERGED_ITERATING;
    check_petsc(SNESGetConvergedReason(snes_, &reason));
    report.converged = reason > 0;
    report.singular = reason == SNES_DIVERGED_LINEAR_SOLVE;
    if (report.singular && solver_.enlarge()) {
      check_petsc(VecCopy(guess, x));
      continue;
    }
    if (reason == SNES_DIVERGED_MAX_IT)
      report.reason = "no convergence in " + std::to_string(rows_.size() - 1) + " iterations";
    else if (report.singular)
      report.reason = "the tangent matrix is singular";
    else if (reason < 0)
      report.reason = "the iteration left the range of numbers";
    break;
  }
  policy_.end(report.converged);
  if (report.singular) solver_.reset();
  // What an iteration tried on its way is no measure of loads. At rest, where there may be none, its thousandth is one of their
  // rounding.
  if (report.converged) {
    const double tried = weights.a > 0 ? 0 : share_of_tried;
    std::vector<double> memory = references_.memory();
    for (std::size_t i = 0; i < memory.size(); ++i) memory[i] = std::max(before[i], tried * memory[i]);
    references_.restore(std::move(memory));
    references_.take(work, assembler_.carried());
  } else {
    references_.restore(before);
  }
  report.iterations = std::max(0, static_cast<int>(rows_.size()) - 1);
  report.rows = rows_;
  return report;
}

PetscErrorCode Newton::form_function(SNES snes, Vec x, Vec f, void* context) {
  auto& self = *static_cast<Newton*>(context);
  try {
    (*self.apply_)(self.assembler_.gather(x), *self.work_);
    self.assembler_.residual(*self.work_, f);
    self.references_.take(*self.work_, self.assembler_.carried());
    self.measure(f);
  } catch (const std::exception& e) {
    self.failure_ = e.what();
    return PETSC_ERR_LIB;
  }
  const double worst = std::max({self.row_.force, self.row_.moment, self.row_.length, self.row_.angle});
  if (!std::isfinite(worst)) return SNESSetFunctionDomainError(snes);
  return 0;
}

PetscErrorCode Newton::form_jacobian(SNES, Vec, Mat, Mat, void* context) {
  auto& self = *static_cast<Newton*>(context);
  try {
    // work_ is the configuration of the last residual, which SNES evaluates at the same point just before
    self.assembler_.tangent(*self.work_, self.weights_);
    self.solver_.note_matrix();
    self.policy_.renewed();
    self.matrix_of_factors_ = self.assembler_.changes();
    self.weights_of_factors_ = self.weights_;
  } catch (const std::exception& e) {
    self.failure_ = e.what();
    return PETSC_ERR_LIB;
  }
  return 0;
}

double Newton::excess() const { return std::max({row_.force, row_.moment, row_.length, row_.angle}) / precision_; }

void Newton::choose_factors() {
  if (rows_.size() == 1) {
    if (!keep_ || matrix_of_factors_ != assembler_.changes() || !similar(weights_, weights_of_factors_)) policy_.forget();
    double renewal = 0;
    if (policy_.usable()) {
      const LinearSolver::Work work = solver_.work();
      renewal = (tangent_over_residual * evaluation_ + work.factor) / (evaluation_ + work.solution);
    }
    policy_.begin(excess(), renewal);
  } else {
    policy_.corrected(excess());
  }
  // SNES asks for a tangent once (-2) or not at all (-1)
  check_petsc(SNESSetLagJacobian(snes_, keep_ && !policy_.due() ? -1 : -2));
}

void Newton::save(Snapshot& snapshot) const {
  references_.save(snapshot);
  if (!policy_.usable() || matrix_of_factors_ != assembler_.changes()) return;
  policy_.save(snapshot);
  snapshot.put("newton/weights", {weights_of_factors_.q, weights_of_factors_.v, weights_of_factors_.a});
  solver_.save_factors(snapshot);
}

void Newton::load(const Snapshot& snapshot) {
  references_.load_memory(snapshot);
  policy_.forget();
  if (!snapshot.has("newton/factors") || !solver_.load_factors(snapshot)) return;
  policy_.load(snapshot);
  const std::vector<double>& weights = snapshot.array("newton/weights");
  weights_of_factors_ = {weights.at(0), weights.at(1), weights.at(2)};
  matrix_of_factors_ = assembler_.changes();
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

/// The curve of a regularised friction is flat on both sides and steep between: from one side its tangent leads far over to the
/// other, and back. A step that would reverse a sliding ends where it stops; from there tangents lead towards the solution.
PetscErrorCode Newton::keep_sliding(SNESLineSearch, Vec x, Vec step, PetscBool* changed, void* context) {
  auto& self = *static_cast<Newton*>(context);
  *changed = PETSC_FALSE;
  try {
    const std::vector<Vec3> before = self.sliding();
    check_petsc(VecWAXPY(self.trial_, -1, step, x));
    (*self.apply_)(self.assembler_.gather(self.trial_), *self.work_);
    const std::vector<Vec3> after = self.sliding();
    double part = 1;
    for (std::size_t i = 0; i < before.size(); ++i) {
      const double first = before[i].norm(), towards = before[i].dot(after[i]);
      if (!(towards < 0) || std::max(first, after[i].norm()) < 1 || first < resting) continue;
      part = std::min(part, first * first / (first * first - towards));
    }
    if (part < 1) {
      check_petsc(VecScale(step, part));
      *changed = PETSC_TRUE;
    }
  } catch (const std::exception& e) {
    self.failure_ = e.what();
    return PETSC_ERR_LIB;
  }
  return 0;
}

void Newton::measure(Vec f) {
  const Numbering& numbering = assembler_.numbering();
  double worst[6] = {0, 0, 0, 0, 0, 0};  // four measures, kΦ over force, open constraint in roundings
  double worst_of_all = -1;
  int worst_row = -1;
  PetscInt first = 0, end = 0;
  check_petsc(VecGetOwnershipRange(f, &first, &end));
  const PetscScalar* values = nullptr;
  check_petsc(VecGetArrayRead(f, &values));
  for (PetscInt row = first; row < end; ++row) {
    const Unknown& u = numbering.unknown(static_cast<int>(row));
    double value = std::abs(values[row - first]), reference = references_.load(static_cast<int>(row));
    if (u.multiplier) {
      // kΦ is the force (or moment) that the open constraint stands for
      const double as_force = value / reference;
      const auto m = static_cast<std::size_t>(u.slot - numbering.motion_slots());
      value /= assembler_.scale()[m];
      reference = references_.length(static_cast<int>(row));
      const double open = value / (assembler_.stated.has(m) ? assembler_.stated.rounding[m] : reference * rounding);
      if (open > 1) worst[4] = std::max(worst[4], as_force);
      worst[5] = std::max(worst[5], open);
    }
    const double relative = value / reference;
    double& largest = worst[static_cast<int>(u.measure)];
    largest = std::isnan(relative) ? relative : std::max(largest, relative);
    if (!(relative <= worst_of_all)) {
      worst_of_all = relative;
      worst_row = static_cast<int>(row);
    }
  }
  check_petsc(VecRestoreArrayRead(f, &values));
  struct {
    double value;
    int row;
  } located{worst_of_all, worst_row};
  int size = 1;
  MPI_Comm_size(assembler_.comm(), &size);
  if (size > 1) {
    MPI_Allreduce(MPI_IN_PLACE, worst, 6, MPI_DOUBLE, MPI_MAX, assembler_.comm());
    MPI_Allreduce(MPI_IN_PLACE, &located, 1, MPI_DOUBLE_INT, MPI_MAXLOC, assembler_.comm());
  }
  row_ = {0, worst[0], worst[1], worst[2], worst[3], 0, located.row};
  constraint_force_ = worst[4];
  scaled_open_ = worst[5];
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
      const Unknown& u = assembler_.numbering().unknown(static_cast<int>(row));
      const double size = std::abs(values[row - first]), change = size / references_.length(static_cast<int>(row));
      if (!u.multiplier) {
        row_.correction = std::max(row_.correction, change);
        continue;
      }
      // a multiplier over its k is the displacement that its force stands for; where k is small, as of what has no mass, the
      // force itself tells that nothing changes any more
      const double k = assembler_.scale()[static_cast<std::size_t>(u.slot - assembler_.numbering().motion_slots())];
      forces = std::max(forces, std::min(change, k * size / references_.load(static_cast<int>(row))));
    }
    check_petsc(VecRestoreArrayRead(update, &values));
    double both[2] = {row_.correction, forces};
    MPI_Allreduce(MPI_IN_PLACE, both, 2, MPI_DOUBLE, MPI_MAX, assembler_.comm());
    row_.correction = both[0];
    forces = both[1];
  }
  rows_.push_back(row_);
  const bool balanced = std::max({row_.force, row_.moment}) <= precision_;
  const bool closed = std::max({row_.length, row_.angle}) <= precision_ && constraint_force_ <= precision_;
  if (balanced && closed) return true;
  const double changed = std::max(row_.correction, forces);
  if (iteration > 1 && changed <= no_correction) return true;
  const double left = std::max({row_.force, row_.moment, row_.length, row_.angle});
  if (iteration < 2 || !(left <= std::sqrt(precision_))) return false;
  if (changed <= negligible_correction) return true;
  // forces that are small beside stiffness times the rounding of positions follow that rounding and never settle
  const NewtonRow& before = rows_[rows_.size() - 2];
  return std::max(row_.correction, before.correction) <= no_correction && left > 0.5 * std::max(before.force, before.moment);
}

PetscErrorCode Newton::test_convergence(SNES, PetscInt iteration, PetscReal, PetscReal, PetscReal fnorm,
                                        SNESConvergedReason* reason, void* context) {
  auto& self = *static_cast<Newton*>(context);
  *reason = SNES_CONVERGED_ITERATING;
  if (!std::isfinite(fnorm)) {
    *reason = SNES_DIVERGED_FNORM_NAN;
    return 0;
  }
  try {
    if (self.judge(static_cast<int>(iteration)))
      *reason = SNES_CONVERGED_FNORM_ABS;
    else
      self.choose_factors();
  } catch (const std::exception& e) {
    self.failure_ = e.what();
    return PETSC_ERR_LIB;
  }
  return 0;
}

}  // namespace engrane::solve
