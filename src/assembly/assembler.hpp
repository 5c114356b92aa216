// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "assembly/numbering.hpp"
#include "assembly/petsc.hpp"
#include "assembly/scatter.hpp"
#include "base/snapshot.hpp"
#include "model/block.hpp"

namespace engrane {

/// One value per Measure.
struct Magnitudes {
  double of[4] = {0, 0, 0, 0};
  double& operator[](Measure m) { return of[static_cast<int>(m)]; }
  double operator[](Measure m) const { return of[static_cast<int>(m)]; }
};

/// Assembles the element contributions of a model into PETSc matrices and vectors. Each rank evaluates its own elements and its
/// ghost elements (Numbering::evaluated), so its rows are complete without communication. Every rank holds the whole
/// Configuration.
///
/// The assembled system is scaled: the row and column of multiplier i are multiplied by k_i (paper, eq. 2). The unknown is then
/// λ, and the constraint row is −kΦ, of the same magnitude as the forces.
class Assembler {
 public:
  /// `half`: store the upper triangle only (see Scatter), for a tangent that is symmetric in every state.
  Assembler(const Model& model, const Numbering& numbering, MPI_Comm comm, bool half = false);

  MPI_Comm comm() const { return comm_; }
  const Model& model() const { return model_; }
  const Numbering& numbering() const { return numbering_; }
  int rank() const { return rank_; }
  /// Elements owned by this rank: indices into Model::parts, ascending.
  const std::vector<int>& own_parts() const { return numbering_.partition().own(); }
  bool owns(int part) const { return numbering_.partition().owner(part) == rank_; }
  Mat matrix() const { return scatter_.matrix(); }
  /// Whether matrix() stores only the diagonal and the upper triangle.
  bool half() const { return scatter_.half(); }
  Vec new_vector() const { return scatter_.new_vector(); }
  /// Returns a new matrix with the structure of matrix(). The caller owns it.
  Mat new_matrix() const { return scatter_.new_matrix(); }

  /// Scale factor k of each multiplier, in the order of Configuration::multipliers.
  const std::vector<double>& scale() const { return scale_; }
  /// Between the multipliers kλ of a configuration and the unknowns λ, by equation: writes one from the other, or adds changes of
  /// unknowns. Those without an equation stay as they are.
  void multipliers_to_unknowns(const Configuration& configuration, std::span<double> unknowns) const;
  void unknowns_to_multipliers(std::span<const double> unknowns, Configuration& configuration) const;
  void add_to_multipliers(std::span<const double> change, std::span<double> multipliers) const;
  double penalty = 0;           ///< penalty factor p of the augmented Lagrangian
  double contact_homotopy = 0;  ///< see State::contact_homotopy

  /// Chooses k so that the constraint rows are of the same magnitude as the rows they act on (Bottasso, Dopico and Trainelli
  /// 2008: the condition number then does not grow as h → 0). If `fixed` is positive, it is used for all multipliers instead.
  void choose_scale(const Configuration& configuration, Weights weights, double fixed);

  /// Replaces the constraint equations of these multipliers (ascending) by kλ = `values` of the multiplier. Restores the
  /// equations of all other multipliers that are not idle.
  void release(const std::vector<int>& multipliers, const std::vector<double>& values);
  /// Sets the constraints that are currently inactive (ascending): their equation becomes kλ = 0, and every analysis ignores
  /// them. Initially these are all grips that are not holding. Constraints without an equation (Numbering) are always idle.
  void set_idle(const std::vector<int>& multipliers);
  bool idle(int multiplier) const { return idle_[static_cast<std::size_t>(multiplier)]; }
  int idle_count() const { return idle_count_; }
  /// Whether the constraint equation is switched off: released by release(), or idle.
  bool released(int multiplier) const { return released_[static_cast<std::size_t>(multiplier)]; }
  /// Prescribed value kλ of a released multiplier.
  double released_value(int multiplier) const { return released_values_[static_cast<std::size_t>(multiplier)]; }

  /// Scale factors, and the released and idle constraints with their values, for a restart.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

  /// Values of Φ that residual() uses instead of those of the elements, where Φ is known more accurately than positions can
  /// give it, and their rounding errors; in the order of the multipliers. NaN: use the element's value. Both are empty if there
  /// are none.
  struct StatedConstraints {
    std::vector<double> value, rounding;
    bool has(std::size_t multiplier) const { return !value.empty() && !std::isnan(value[multiplier]); }
  } stated;

  /// Computes the scaled residual.
  void residual(const Configuration& configuration, Vec r);
  /// Largest magnitude that any element contributed to each equation in the last residual, on every rank; 0 for multipliers.
  const std::vector<double>& carried() const { return carried_; }
  /// Counter of all changes that invalidate factors of matrix(): writing to it, changing scales, or changing the released or
  /// idle constraints.
  long changes() const { return changes_; }
  /// Assembles the scaled tangent in matrix().
  void tangent(const Configuration& configuration, Weights weights) { tangent(configuration, weights, matrix()); }
  /// Changes the tangent of an element, square and row-major in its slots, before it is added.
  using Change = std::function<void(int part, std::span<double> k)>;
  /// As above, into a matrix from new_matrix().
  void tangent(const Configuration& configuration, Weights weights, Mat into, const Change& change = {});

  /// Frees the memory for entry positions, which the next tangent would have to find again. For matrices that are assembled
  /// once.
  void forget_places() { scatter_.forget_places(); }

  /// Norm that the projections at the start minimise.
  enum class Metric {
    geometric,  ///< smallest movement: translations divided by the extent, rotations in radians
    mass,       ///< smallest kinetic energy
    dynamic     ///< mass matrix; the multiplier columns keep all forces that depend on the multipliers, not only −Bᵀ
  };
  /// Assembles the unscaled projection matrix [D −Bᵀ; −B 0] in matrix(), with D chosen by `metric`. Unknowns without mass get a
  /// negligible D. The equations in `held` (any order) get one so large that all other unknowns move first.
  void projection(const Configuration& configuration, Metric metric, std::span<const int> held = {}) {
    projection(configuration, metric, held, matrix());
  }
  /// As above, into a matrix from new_matrix(), with `give` times the stiffness of each element added to D; empty: 0 for all.
  void projection(const Configuration& configuration, Metric metric, std::span<const int> held, Mat into,
                  std::span<const double> give = {});
  /// Substitute inertia of motions without mass in the last projection by mass, as a moment of inertia: masses times the square
  /// of the extent.
  double missing_inertia() const { return missing_inertia_; }
  /// Unscaled Φ and its first two time derivatives along the motion, in the order of the multipliers; zero for idle ones.
  void constraint_rates(const Configuration& configuration, std::vector<double>& phi, std::vector<double>& rate,
                        std::vector<double>& second);
  /// As above, for the constraints of the elements `parts` (indices into Model::parts); zero for all others.
  void constraint_rates(const Configuration& configuration, std::span<const int> parts, std::vector<double>& phi,
                        std::vector<double>& rate, std::vector<double>& second);

  /// Returns Φ alone.
  std::vector<double> violations(const Configuration& configuration);

  /// Returns the unscaled residual of every slot, including those without an equation (reactions of supports), on every rank.
  std::vector<double> slot_residual(const Configuration& configuration);

  /// Returns all entries of a distributed vector, on every rank. Valid until the next call.
  std::span<const double> gather(Vec x);
  /// Fills a distributed vector from values that every rank has.
  void spread(std::span<const double> all, Vec x) const;

  /// State of one element. Its spans refer to the configuration.
  State view(int part, const Configuration& configuration) const;
  /// Residual and tangent of one element, not scaled, in its slots (Numbering::part_slots); the tangent is square and row-major.
  struct ElementTangent {
    std::span<const double> r, k;
  };
  /// Valid until the next call of this function or of element_residual().
  ElementTangent element_tangent(int part, const Configuration& configuration, Weights weights) const;
  std::span<const double> element_residual(int part, const Configuration& configuration) const;

  /// Lets every element update its turn counters. Also used during iterations that search for a position.
  void count_turns(Configuration& configuration);
  /// Lets every element update its history from an accepted configuration.
  void commit(Configuration& configuration);

 private:
  const Element& element(int part) const { return *model_.part(part).element; }
  /// Substitute inertia of motions without mass, by measure of the equation: a negligible part of the largest inertia of that
  /// kind or, where there is none, of the other kind by the extent. Sets missing_inertia_.
  Magnitudes find_missing_inertia(const Magnitudes& heaviest);
  /// Finds gravity_ and varying_gravity_.
  void find_gravity(double time) const;
  void write_history(Configuration& configuration,
                     void (Element::*write)(const State&, std::span<double>, std::span<double>) const);
  /// Elements that are evaluated together: consecutive entries of Numbering::evaluated(), starting at `first`.
  struct Batch {
    std::size_t first;
    ElementRange range;
    std::size_t slots;  ///< number of slots of each element
  };
  void find_batches();
  int evaluated(std::size_t at) const { return numbering_.evaluated()[at]; }
  bool is_ghost(std::size_t at) const { return at >= own_parts().size(); }
  /// Evaluates the residuals and calls `use(part, r)` for each element that this rank evaluates.
  template <class Use>
  void for_each_residual(const Configuration& configuration, Use&& use);
  /// As above for tangents: `use(at, k)` for element evaluated(at); `use` may modify k.
  template <class Use>
  void for_each_tangent(const Configuration& configuration, Weights weights, Use&& use);
  /// Fills states_ with the states of the batch's elements.
  std::span<const State> views(const Batch& batch, const Configuration& configuration);
  /// Multiplies the rows and columns of an element's multipliers by their k, and zeroes the rows of released ones.
  void scale_multipliers(int part, std::span<double> k) const;
  int equation_of(std::size_t multiplier) const {
    return numbering_.equation(numbering_.motion_slots() + static_cast<int>(multiplier));
  }
  bool numbered(int multiplier) const;
  void note_released();
  /// Whether the equation belongs to a released constraint.
  bool released_equation(int equation) const;

  const Model& model_;
  const Numbering& numbering_;
  MPI_Comm comm_;
  int rank_ = 0, size_ = 1;
  Scatter scatter_;
  Owned<Vec> everywhere_;
  Owned<VecScatter> to_all_;
  std::vector<double> scale_;
  std::vector<bool> released_, idle_;
  int idle_count_ = 0;
  long changes_ = 0;
  double missing_inertia_ = 0;
  std::vector<double> released_values_;
  bool any_released_ = false;
  std::vector<double> gathered_, carried_;
  mutable double gravity_time_ = std::numeric_limits<double>::quiet_NaN();
  mutable Vec3 gravity_ = Vec3::Zero();  ///< gravity at gravity_time_
  mutable std::optional<VaryingGravity> varying_gravity_;
  std::vector<int> constrained_parts_;  ///< elements with multipliers, on all ranks
  std::vector<Batch> batches_;          ///< partition of Numbering::evaluated(), in order
  // buffers for one batch
  std::vector<State> states_;
  std::vector<double> local_r_, local_k_;
  mutable std::vector<double> element_r_, element_k_;  ///< buffers of element_tangent()
};

}  // namespace engrane
