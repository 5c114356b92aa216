// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "assembly/numbering.hpp"
#include "assembly/petsc.hpp"
#include "base/snapshot.hpp"

namespace engrane {

/// Largest contribution of any element to rows of each Measure: what residuals are compared with.
struct Magnitudes {
  double of[4] = {0, 0, 0, 0};
  double& operator[](Measure m) { return of[static_cast<int>(m)]; }
  double operator[](Measure m) const { return of[static_cast<int>(m)]; }
};

/// Sums the elements of a model into PETSc. Each rank evaluates its own share of the elements; every rank holds the
/// whole Configuration.
///
/// The assembled system is scaled: rows and columns of multiplier i carry k_i (paper, eq. 2), so that the unknown is λ
/// and the row is −kΦ, of the size of the forces.
class Assembler {
 public:
  Assembler(const Model& model, const Numbering& numbering, MPI_Comm comm);

  MPI_Comm comm() const { return comm_; }
  const Model& model() const { return model_; }
  const Numbering& numbering() const { return numbering_; }
  int rank() const { return rank_; }
  Mat matrix() const { return matrix_; }
  Vec new_vector() const;

  /// Scale k of each multiplier, in the order of Configuration::multipliers.
  const std::vector<double>& scale() const { return scale_; }
  double penalty = 0;           ///< p of the augmented Lagrangian
  double contact_homotopy = 0;  ///< of contacts, State::contact_homotopy

  /// Chooses k so that constraint rows are as large as the rows they act on (Bottasso, Dopico and Trainelli 2008: the
  /// condition number then does not grow as h → 0). A positive `fixed` is used for all instead.
  void choose_scale(const Configuration& configuration, Weights weights, double fixed);

  /// Replaces the equations of these multipliers (ascending) by kλ = what `values` has for them; of all others as they are.
  void release(const std::vector<int>& multipliers, const std::vector<double>& values);
  bool released(int multiplier) const { return released_[static_cast<std::size_t>(multiplier)]; }
  /// What the multiplier of a released constraint is to be.
  double released_value(int multiplier) const { return released_values_[static_cast<std::size_t>(multiplier)]; }

  /// Scale factors, and which constraints are released with which values, for a restart.
  void save(Snapshot& snapshot) const;
  void load(const Snapshot& snapshot);

  /// The scaled residual; returns the largest element contributions.
  Magnitudes residual(const Configuration& configuration, Vec r);
  /// The scaled tangent, in matrix().
  void tangent(const Configuration& configuration, Weights weights);

  /// What the projections of the start move with.
  enum class Metric {
    geometric,  ///< least movement: translations over the extent, rotations in radians
    mass,       ///< least kinetic energy
    dynamic     ///< the mass matrix, and the multipliers' columns with all forces that follow them
  };
  /// [D −Bᵀ; −B 0] (unscaled) in matrix(), D by metric. Unknowns without mass get a negligible one; the equations in
  /// `held` one so large that everything else moves first.
  void projection(const Configuration& configuration, Metric metric, std::span<const int> held = {});
  /// Φ and its time derivatives along the motion (unscaled), in the order of the multipliers.
  void constraint_rates(const Configuration& configuration, std::vector<double>& phi, std::vector<double>& rate,
                        std::vector<double>& second);

  /// Residual of every slot, those without equation included (reactions of supports): unscaled, on every rank.
  std::vector<double> slot_residual(const Configuration& configuration);

  /// All entries of a distributed vector, on every rank. Valid until the next call.
  std::span<const double> gather(Vec x);
  /// Fills a distributed vector from values that every rank has.
  void spread(std::span<const double> all, Vec x) const;

  /// State of one element, copied from the configuration into buffers of this object; valid until the next call.
  State view(int part, const Configuration& configuration);

  /// Lets every element keep what it remembers of an accepted configuration, such as whole turns.
  void commit(Configuration& configuration);

 private:
  struct Share {
    int part;
    std::size_t coo_begin;             ///< first of this element's entries in the COO arrays
    std::vector<std::size_t> entries;  ///< local index row·n + column of each entry
    std::size_t row_begin;
    std::vector<std::size_t> rows;  ///< local slots that have an equation
    std::vector<double> factor;     ///< k of the local slot, 1 but for multipliers
    std::vector<char> kept;         ///< whether the local slot has its own equation, 0 for released constraints
  };
  void add_entries(const Share& share, std::span<const double> k);
  void set_matrix_values();
  /// Whether an equation is a released constraint's.
  bool released_equation(int equation) const;
  void update_factors();

  const Model& model_;
  const Numbering& numbering_;
  MPI_Comm comm_;
  int rank_ = 0, size_ = 1;
  std::vector<Share> shares_;
  Owned<Mat> matrix_;
  Owned<Vec> template_, everywhere_;
  Owned<VecScatter> scatter_;
  PetscInt first_row_ = 0, end_row_ = 0;
  std::vector<double> coo_values_, row_values_;
  std::size_t diagonal_begin_ = 0;
  std::vector<double> scale_;
  std::vector<bool> released_;
  std::vector<double> released_values_;
  bool any_released_ = false;
  std::vector<double> gathered_;
  // one element's buffers
  std::vector<NodeState> local_nodes_;
  std::vector<double> local_r_, local_k_, local_mass_;
};

}  // namespace engrane
