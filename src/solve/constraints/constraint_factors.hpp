// SPDX-License-Identifier: BSD-3-Clause
// The gradients of all constraints as one sparse matrix, and which of them are independent.
#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <string>
#include <vector>

#include "assembly/assembler.hpp"
#include "solve/constraints/column_basis.hpp"

namespace engrane::solve {

/// Whether the columns are those of B (gradients of the constraints) or of the forces caused by the multipliers. They differ
/// where a force depends on the magnitude of a multiplier (the separating force of gears).
enum class ConstraintColumns { gradients, forces };

/// Size that makes an unknown or its equation comparable with others: the extent for translations, 1 for rotations.
double size_of(const Unknown& u, double extent);

/// The element's description of the unknown of a multiplier.
const Multiplier& multiplier_of(const Model& model, const Unknown& multiplier);
bool is_drive(const Model& model, const Unknown& multiplier);
bool is_grip(const Model& model, const Unknown& multiplier);

/// Sizes of the constraints, one for each multiplier: the extent for lengths, 1 for angles.
Eigen::VectorXd constraint_sizes(const Assembler& assembler);
/// Magnitudes of the constraint violations, over the extent or in radians.
Eigen::VectorXd relative_open(const Assembler& assembler, const std::vector<double>& phi);

/// The free motions as rows of a matrix, scaled by their size.
struct MotionRows {
  explicit MotionRows(const Assembler& assembler);

  /// Returns a motion with a component in every free one, as a generic direction.
  Eigen::VectorXd any() const;
  /// Name of the largest component of a scaled motion: "node 3 (x)". A node is preferred to a scalar of an element if it is at
  /// least a tenth as large.
  std::string largest_part(const Numbering& numbering, const Eigen::VectorXd& motion) const;

  std::vector<std::size_t> slot;  ///< motion slot of each row
  std::vector<int> row;           ///< row of each motion slot; -1: held
  std::vector<double> size;       ///< of each row: the extent for translations, 1 for rotations
  std::vector<int> first_rows;    ///< first row of each node, and of each scalar of elements
};

/// One column per multiplier, one row per free motion; rows are scaled by the size of their motion.
struct ConstraintMatrix {
  ConstraintMatrix(Assembler& assembler, const Configuration& configuration, ConstraintColumns kind);

  /// Writes a scaled motion, one entry per row, into `y`, one entry per motion slot.
  void to_slots(const Eigen::VectorXd& motion, std::vector<double>& y) const;

  MotionRows rows;
  Eigen::SparseMatrix<double> matrix;
};

/// Determines which columns of a ConstraintMatrix are independent when all are scaled to length 1.
class ConstraintFactors {
 public:
  /// Columns whose remainder after the others is below `tolerance` count as dependent.
  ConstraintFactors(Assembler& assembler, const Configuration& configuration, ConstraintColumns kind, double tolerance);

  Eigen::Index rank() const { return basis_.rank(); }
  Eigen::Index rows() const { return basis_.rows(); }
  Eigen::Index columns() const { return basis_.columns(); }
  /// Number of dependent columns, without those of idle constraints, which are empty.
  Eigen::Index deficiency() const { return static_cast<Eigen::Index>(dependent().size()); }
  const std::vector<int>& dependent() const { return any_idle_ ? dependent_ : basis_.dependent(); }

  /// Basis of the multipliers that cause no force, one column for each dependent constraint; for columns of length 1.
  const Eigen::SparseMatrix<double>& null_multipliers() const { return any_idle_ ? null_ : basis_.null(); }
  /// Returns the (scaled) motion near `wish` that violates no constraint, to first order.
  Eigen::VectorXd possible_motion(const Eigen::VectorXd& wish) const { return basis_.left_null(wish); }
  /// Returns a (scaled) motion that closes the independent constraints, to first order.
  Eigen::VectorXd closing_motion(const std::vector<double>& phi) const;
  void to_slots(const Eigen::VectorXd& motion, std::vector<double>& y) const { gradients_.to_slots(motion, y); }
  const MotionRows& motions() const { return gradients_.rows; }

 private:
  ConstraintMatrix gradients_;
  Eigen::VectorXd length_;
  ColumnBasis basis_;
  bool any_idle_ = false;
  std::vector<int> dependent_;        ///< those of basis_ that are not idle
  Eigen::SparseMatrix<double> null_;  ///< their columns of basis_.null()
};

}  // namespace engrane::solve
