// SPDX-License-Identifier: BSD-3-Clause
#include "solve/run/buckling.hpp"

#include <slepceps.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <numeric>
#include <utility>

#include "solve/algebra/guarded.hpp"
#include "solve/algebra/probe.hpp"
#include "solve/run/tangent_course.hpp"
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
/// Eigenvalues whose imaginary part is less than this fraction are equal ones that rounding has made a pair.
constexpr double real_pair = 1e-4;
/// Times closer than this fraction belong to the same buckling load, and their modes to one space.
constexpr double equal = 1e-6;
/// Part of a mode that is not in the space of those known, at least, of a new one.
constexpr double another_mode = 1e-2;
constexpr int most_searches = 8;
constexpr double precision = 1e-10;
/// Times farther away than this many runs are rounding, and so are those nearer than that fraction of one.
constexpr double never = 1e15;

struct Slepc {
  Slepc() { check_petsc(SlepcInitializeNoArguments()); }
  ~Slepc() { SlepcFinalize(); }
};

struct Pair {
  double time;                 ///< from that of the equilibrium
  std::vector<double> vector;  ///< by equation
};

/// Searches for the times θ nearest to an equilibrium at which K + θ K₁ is singular: the largest eigenvalues 1/θ of −K⁻¹ K₁.
class ModeSearch {
 public:
  ModeSearch(SolverContext& context, TangentCourse& course) : context_(context), course_(course) {
    for (Owned<Vec>* vector : {&begin_, &real_, &other_}) *vector->out() = context.assembler.new_vector();
    PetscInt local = 0;
    check_petsc(VecGetLocalSize(begin_, &local));
    check_petsc(VecGetSize(begin_, &size_));
    check_petsc(MatCreateShell(context.assembler.comm(), local, local, size_, size_, this, shell_.out()));
    check_petsc(MatShellSetOperation(shell_, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
  }

  /// Nearest times with their modes. A search finds one mode of each time, and by rounding others of times that have several: it
  /// is made again from other vectors until nothing is added.
  std::vector<Pair> find(int count) {
    std::vector<Pair> found;
    for (int search = 0; search < most_searches; ++search) {
      const std::vector<Pair> before = found;
      for (Pair& pair : from_vector(search, count)) add(std::move(pair), found);
      std::stable_sort(found.begin(), found.end(),
                       [](const Pair& a, const Pair& b) { return std::abs(a.time) * (1 + equal) < std::abs(b.time); });
      if (static_cast<int>(found.size()) > count) found.resize(static_cast<std::size_t>(count));
      if (std::equal(found.begin(), found.end(), before.begin(), before.end(),
                     [](const Pair& a, const Pair& b) { return std::abs(a.time - b.time) <= equal * std::abs(b.time); }))
        break;
    }
    // of loads ±λ that buckle alike, rounding decides which comes first
    for (std::size_t i = 1; i < found.size(); ++i)
      if (found[i - 1].time < 0 && found[i].time > 0 && std::abs(found[i - 1].time + found[i].time) <= same * found[i].time)
        std::swap(found[i - 1], found[i]);
    return found;
  }

 private:
  static PetscErrorCode multiply(Mat shell, Vec x, Vec y) {
    ModeSearch* self = nullptr;
    PetscCall(MatShellGetContext(shell, &self));
    return guarded(self->failure_, [&] {
      self->course_.respond(x, y);
      return 0;
    });
  }

  std::vector<Pair> from_vector(int start, int count) {
    Owned<EPS> eps;
    check_petsc(EPSCreate(context_.assembler.comm(), eps.out()));
    check_petsc(EPSSetOperators(eps, shell_, nullptr));
    check_petsc(EPSSetProblemType(eps, EPS_NHEP));
    check_petsc(EPSSetWhichEigenpairs(eps, EPS_LARGEST_MAGNITUDE));
    check_petsc(EPSSetDimensions(eps, std::min<PetscInt>(count, size_), PETSC_DEFAULT, PETSC_DEFAULT));
    check_petsc(EPSSetTolerances(eps, precision, PETSC_DEFAULT));
    check_petsc(EPSSetOptionsPrefix(eps, "buckling_"));
    fill_probe(begin_, start);
    Vec first = begin_;
    check_petsc(EPSSetInitialSpace(eps, 1, &first));
    check_petsc(EPSSetFromOptions(eps));
    const PetscErrorCode code = EPSSolve(eps);
    rethrow(failure_);
    check_petsc(code);
    PetscInt converged = 0;
    check_petsc(EPSGetConverged(eps, &converged));
    std::vector<Pair> pairs;
    for (PetscInt i = 0; i < converged && static_cast<int>(pairs.size()) < count; ++i) {
      PetscScalar value = 0, imaginary = 0;
      check_petsc(EPSGetEigenpair(eps, i, &value, &imaginary, real_, other_));
      // any other complex pair is no loss of stability at rest
      if (value == 0 || std::abs(imaginary) > real_pair * std::abs(value)) continue;
      const double time = 1 / value;
      if (std::abs(time) > never * (context_.options.end - context_.options.begin)) continue;  // rounding: nothing buckles
      const auto all = context_.assembler.gather(imaginary < 0 ? other_ : real_);
      pairs.push_back({time, {all.begin(), all.end()}});
    }
    return pairs;
  }

  /// Adds a mode unless it is one of those found with the same time, or a sum of them.
  void add(Pair pair, std::vector<Pair>& found) const {
    std::vector<std::vector<double>> known;  // orthonormal
    const auto is_new = [&](std::vector<double> vector) {
      const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
        return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
      };
      const double size = std::sqrt(dot(vector, vector));
      for (int twice = 0; twice < 2; ++twice)
        for (const std::vector<double>& one : known) {
          const double part = dot(one, vector);
          for (std::size_t e = 0; e < vector.size(); ++e) vector[e] -= part * one[e];
        }
      const double rest = std::sqrt(dot(vector, vector));
      if (!(rest > another_mode * size)) return false;
      for (double& value : vector) value /= rest;
      known.push_back(std::move(vector));
      return true;
    };
    for (const Pair& one : found)
      if (std::abs(one.time - pair.time) <= equal * std::abs(pair.time)) is_new(motion_of(one.vector));
    if (is_new(motion_of(pair.vector))) found.push_back(std::move(pair));
  }

  /// Without multipliers, and with rotations as displacements at the distance of the extent.
  std::vector<double> motion_of(std::vector<double> mode) const {
    for (std::size_t e = 0; e < mode.size(); ++e) {
      const Unknown& u = context_.numbering.unknown(static_cast<int>(e));
      if (u.multiplier) mode[e] = 0;
      if (u.rotational()) mode[e] *= context_.model.extent();
    }
    return mode;
  }

  SolverContext& context_;
  TangentCourse& course_;
  PetscInt size_ = 0;
  Owned<Mat> shell_;
  Owned<Vec> begin_, real_, other_;
  std::exception_ptr failure_;  ///< thrown inside a callback
};

/// Removes the times that another difference of the tangent does not give: a system that buckles in fewer ways than were asked
/// for has rounding in their place.
void keep_confirmed(std::vector<Pair>& found, const std::vector<Pair>& again) {
  std::erase_if(found, [&](const Pair& pair) {
    return std::none_of(again.begin(), again.end(),
                        [&](const Pair& other) { return std::abs(other.time - pair.time) <= alike_later * std::abs(pair.time); });
  });
}

}  // namespace

std::vector<BucklingMode> find_buckling(SolverContext& context, const Configuration& equilibrium, int count) {
  const Slepc slepc;
  TangentCourse course(context, equilibrium);
  if (!course.loaded())
    throw SolutionFailure(
        "no buckling loads: nothing moves when time grows; give loads or prescribed displacements a function of time, NF");
  ModeSearch search(context, course);
  double step = first_step * context.options.step, before = 0;
  std::vector<Pair> found;
  for (int pass = 0;; ++pass) {
    if (pass == most_passes) return {};  // rounding
    course.differentiate(step);
    found = search.find(count);
    if (found.empty()) return {};
    const double nearest = std::abs(found.front().time);
    if (nearest * never < context.options.end - context.options.begin) return {};
    if (std::abs(nearest - before) <= same * nearest) break;
    before = nearest;
    step = good_step * nearest;
  }
  if (found.size() > 1) {
    course.differentiate(step / 2);
    keep_confirmed(found, search.find(count));
  }
  const double left_out = course.left_out();
  std::vector<BucklingMode> modes;
  for (const Pair& pair : found) {
    BucklingMode& mode = modes.emplace_back();
    mode.load_time = equilibrium.load_time() + pair.time;
    mode.turn = course.fastest_turn() * std::abs(pair.time);
    mode.left_out = left_out * std::abs(pair.time);
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
