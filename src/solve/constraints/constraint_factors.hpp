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

/// Whether the columns are those of B (gradients of the constraints) or of the forces that multipliers make, which differ
/// where a force follows the size of a multiplier (the separating force of gears).
enum class ConstraintColumns { gradients, forces };

/// Size that makes an unknown or its equation comparable with others: the extent for translations, 1 for rotations.
double size_of(const Unknown& u, double extent);

/// The unknown of a multiplier, index into Configuration::multipliers.
const Unknown& multiplier_unknown(const Numbering& numbering, int multiplier);

/// What the element says of the unknown of a multiplier.
const Multiplier& multiplier_of(const Model& model, const Unknown& multiplier);
bool is_drive(const Model& model, const Unknown& multiplier);
bool is_grip(const Model& model, const Unknown& multiplier);

/// Sizes of the constraints, one for each multiplier: the extent for lengths, 1 for angles.
Eigen::VectorXd constraint_sizes(const Assembler& assembler);
/// Open constraints over the extent, or in radians.
Eigen::VectorXd relative_open(const Assembler& assembler, const std::vector<double>& phi);

/// Tangents of elements are taken per increment of a step's rotation vector; this takes them at its start.
Configuration outside_of_steps(Configuration c);

/// The free motions as rows of a matrix, scaled with their size.
struct MotionRows {
  explicit MotionRows(const Assembler& assembler);

  /// A motion with a part of every free one, for what is to be tried in any direction but a special one.
  Eigen::VectorXd any() const;
  /// "node 3 (x)": where a scaled motion is largest; rather a node than a number of an element, where they are of one size.
  std::string largest_part(const Numbering& numbering, const Eigen::VectorXd& motion) const;

  std::vector<std::size_t> slot;  ///< of a row
  std::vector<int> row;           ///< of a motion slot; -1: held
  std::vector<double> size;       ///< of a row: the extent for translations, 1 for rotations
  std::vector<int> first_rows;    ///< of the nodes, and of the elements' scalars each
};

/// One column per multiplier, one row per free motion; rows are scaled with the size of their motion.
struct ConstraintMatrix {
  ConstraintMatrix(Assembler& assembler, const Configuration& configuration, ConstraintColumns kind);

  /// Writes a scaled motion, one entry per row, into `y`, one entry per motion slot.
  void to_slots(const Eigen::VectorXd& motion, std::vector<double>& y) const;

  MotionRows rows;
  Eigen::SparseMatrix<double> matrix;
};

/// Which columns of a ConstraintMatrix are independent when all have length 1.
class ConstraintFactors {
 public:
  /// Columns whose remainder after the others is below `tolerance` count as dependent.
  ConstraintFactors(Assembler& assembler, const Configuration& configuration, ConstraintColumns kind, double tolerance);

  Eigen::Index rank() const { return basis_.rank(); }
  Eigen::Index rows() const { return basis_.rows(); }
  Eigen::Index columns() const { return basis_.columns(); }
  /// How many columns are dependent; idle constraints, whose columns are empty, do not count.
  Eigen::Index deficiency() const { return static_cast<Eigen::Index>(dependent().size()); }
  const std::vector<int>& dependent() const { return any_idle_ ? dependent_ : basis_.dependent(); }

  /// A basis of the multipliers that make no force, one column for each dependent one, for columns of length 1.
  const Eigen::SparseMatrix<double>& null_multipliers() const { return any_idle_ ? null_ : basis_.null(); }
  /// The (scaled) motion that closes no constraint and is near to `wish`.
  Eigen::VectorXd possible_motion(const Eigen::VectorXd& wish) const { return basis_.left_null(wish); }
  /// A (scaled) motion that closes the independent constraints, to first order.
  Eigen::VectorXd closing_motion(const std::vector<double>& phi) const;
  void to_slots(const Eigen::VectorXd& motion, std::vector<double>& y) const { gradients_.to_slots(motion, y); }
  const MotionRows& motions() const { return gradients_.rows; }

 private:
  ConstraintMatrix gradients_;
  Eigen::VectorXd length_;
  ColumnBasis basis_;
  bool any_idle_ = false;
  std::vector<int> dependent_;        ///< those of basis_ that are not idle
  Eigen::SparseMatrix<double> null_;  ///< and their columns
};

}  // namespace engrane::solve
