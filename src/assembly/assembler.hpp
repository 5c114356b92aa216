// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "assembly/numbering.hpp"
#include "assembly/petsc.hpp"
#include "assembly/scatter.hpp"
#include "base/snapshot.hpp"
#include "model/block.hpp"

namespace engrane {

/// A number for each Measure.
struct Magnitudes {
  double of[4] = {0, 0, 0, 0};
  double& operator[](Measure m) { return of[static_cast<int>(m)]; }
  double operator[](Measure m) const { return of[static_cast<int>(m)]; }
};

/// Sums the elements of a model into PETSc. Each rank evaluates its own elements and their neighbours (Numbering::evaluated), and
/// has its equations whole without a message; every rank holds the whole Configuration.
///
/// The assembled system is scaled: rows and columns of multiplier i carry k_i (paper, eq. 2), so that the unknown is λ
/// and the row is −kΦ, of the size of the forces.
class Assembler {
 public:
  /// `half`: as Scatter has it, for a tangent that is symmetric in every state.
  Assembler(const Model& model, const Numbering& numbering, MPI_Comm comm, bool half = false);

  MPI_Comm comm() const { return comm_; }
  const Model& model() const { return model_; }
  const Numbering& numbering() const { return numbering_; }
  int rank() const { return rank_; }
  /// This rank's elements, by index into Model::parts, ascending.
  const std::vector<int>& own_parts() const { return numbering_.partition().own(); }
  bool owns(int part) const { return numbering_.partition().owner(part) == rank_; }
  Mat matrix() const { return scatter_.matrix(); }
  /// Whether matrix() has only its diagonal and what is above it.
  bool half() const { return scatter_.half(); }
  Vec new_vector() const { return scatter_.new_vector(); }
  /// A matrix like matrix(), of the caller's.
  Mat new_matrix() const { return scatter_.new_matrix(); }

  /// Scale k of each multiplier, in the order of Configuration::multipliers.
  const std::vector<double>& scale() const { return scale_; }
  double penalty = 0;           ///< p of the augmented Lagrangian
  double contact_homotopy = 0;  ///< of contacts, State::contact_homotopy

  /// Chooses k so that constraint rows are as large as the rows they act on (Bottasso, Dopico and Trainelli 2008: the
  /// condition number then does not grow as h → 0). A positive `fixed` is used for all instead.
  void choose_scale(const Configuration& configuration, Weights weights, double fixed);

  /// Replaces the equations of these multipliers (ascending) by kλ = what `values` has for them; of all others as they are.
  void release(const std::vector<int>& multipliers, const std::vector<double>& values);
  /// Constraints that are none at present (ascending): equations kλ = 0, left out of every analysis. At first all grips that hold
  /// nothing. Constraints without equation (Numbering) are always idle.
  void set_idle(const std::vector<int>& multipliers);
  bool idle(int multiplier) const { return idle_[static_cast<std::size_t>(multiplier)]; }
  int idle_count() const { return idle_count_; }
  /// Whether the constraint has no say: given up by release(), or idle.
  bool released(int multiplier) const { return released_[static_cast<std::size_t>(multiplier)]; }
  /// What the multiplier of a released constraint is to be.
  double released_value(int multiplier) const { return released_values_[static_cast<std::size_t>(multiplier)]; }

  /// Scale factors, and which constraints are released with which values, for a restart.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

  /// Values of Φ that residual() takes for those of the elements, in the order of the multipliers, where they are known better
  /// than from positions (NaN: they are not); and what is rounding of them. Both empty: of none.
  struct StatedConstraints {
    std::vector<double> value, rounding;
    bool has(std::size_t multiplier) const { return !value.empty() && !std::isnan(value[multiplier]); }
  } stated;

  /// The scaled residual.
  void residual(const Configuration& configuration, Vec r);
  /// The largest that an element contributed to each equation in the last residual, of multipliers 0; on every rank.
  const std::vector<double>& carried() const { return carried_; }
  /// Counts what makes factors of matrix() useless: every writing into it, other scales, other constraints released or idle.
  long changes() const { return changes_; }
  /// The scaled tangent, in matrix().
  void tangent(const Configuration& configuration, Weights weights) { tangent(configuration, weights, matrix()); }
  /// The same in a matrix of new_matrix().
  void tangent(const Configuration& configuration, Weights weights, Mat into);

  /// Of a matrix that is made once: gives back the memory of what another tangent would need, and would find again.
  void forget_places() { scatter_.forget_places(); }

  /// What the projections of the start move with.
  enum class Metric {
    geometric,  ///< least movement: translations over the extent, rotations in radians
    mass,       ///< least kinetic energy
    dynamic     ///< the mass matrix, and the multipliers' columns with all forces that follow them
  };
  /// [D −Bᵀ; −B 0] (unscaled) in matrix(), D by metric. Unknowns without mass get a negligible one; the equations in
  /// `held`, in any order, one so large that everything else moves first.
  void projection(const Configuration& configuration, Metric metric, std::span<const int> held = {}) {
    projection(configuration, metric, held, matrix());
  }
  /// The same in a matrix of new_matrix(), with `give` times the stiffness added to masses.
  void projection(const Configuration& configuration, Metric metric, std::span<const int> held, Mat into, double give = 0);
  /// Φ and its time derivatives along the motion (unscaled), in the order of the multipliers; zero where idle.
  void constraint_rates(const Configuration& configuration, std::vector<double>& phi, std::vector<double>& rate,
                        std::vector<double>& second);
  /// The same of the constraints of some elements, by index into Model::parts; zero for all others.
  void constraint_rates(const Configuration& configuration, std::span<const int> parts, std::vector<double>& phi,
                        std::vector<double>& rate, std::vector<double>& second);

  /// Residual of every slot, those without equation included (reactions of supports): unscaled, on every rank.
  std::vector<double> slot_residual(const Configuration& configuration);

  /// All entries of a distributed vector, on every rank. Valid until the next call.
  std::span<const double> gather(Vec x);
  /// Fills a distributed vector from values that every rank has.
  void spread(std::span<const double> all, Vec x) const;

  /// State of one element: views the configuration.
  State view(int part, const Configuration& configuration) const;

  /// Lets every element follow its whole turns, also on the way to a position that is sought.
  void count_turns(Configuration& configuration);
  /// Lets every element keep what it remembers of an accepted configuration.
  void commit(Configuration& configuration);

 private:
  const Element& element(int part) const { return *model_.parts[static_cast<std::size_t>(part)].element; }
  const Vec3& gravity_at(double time) const;
  void write_history(Configuration& configuration,
                     void (Element::*write)(const State&, std::span<double>, std::span<double>) const);
  /// Elements that are evaluated together: number `first` of Numbering::evaluated() and those after it.
  struct Batch {
    std::size_t first;
    ElementRange range;
    std::size_t slots;  ///< of each
  };
  void find_batches();
  int evaluated(std::size_t at) const { return numbering_.evaluated()[at]; }
  bool is_ghost(std::size_t at) const { return at >= own_parts().size(); }
  /// Evaluates residuals, and calls `use(part, r)` for each element that this rank evaluates.
  template <class Use>
  void for_each_residual(const Configuration& configuration, Use&& use);
  /// The same with tangents: `use(at, k)` for element evaluated(at); k may be changed.
  template <class Use>
  void for_each_tangent(const Configuration& configuration, Weights weights, Use&& use);
  /// States of a batch's elements, in states_.
  std::span<const State> views(const Batch& batch, const Configuration& configuration);
  /// Multiplies rows and columns of an element's multipliers by their k, and clears those that are released.
  void scale_multipliers(int part, std::span<double> k) const;
  bool numbered(int multiplier) const;
  void note_released();
  /// Whether an equation is a released constraint's.
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
  std::vector<double> released_values_;
  bool any_released_ = false;
  std::vector<double> gathered_, carried_;
  mutable double gravity_time_ = std::numeric_limits<double>::quiet_NaN();
  mutable Vec3 gravity_ = Vec3::Zero();  ///< at that time
  std::vector<int> constrained_parts_;   ///< elements with multipliers, of all ranks
  std::vector<Batch> batches_;           ///< of Numbering::evaluated(), in its order
  // one batch's buffers
  std::vector<State> states_;
  std::vector<double> local_r_, local_k_;
};

}  // namespace engrane
