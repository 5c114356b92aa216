// SPDX-License-Identifier: BSD-3-Clause
// The gradients of all constraints as one sparse matrix, and what a rank-revealing factorisation says of them.
#pragma once

#include <Eigen/Dense>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <Eigen/SparseQR>
#include <vector>

#include "assembly/assembler.hpp"

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

/// An open constraint over the extent, or in radians.
double relative_open(const Assembler& assembler, int multiplier, double phi);

/// Tangents of elements are taken per increment of a step's rotation vector; this takes them at its start.
Configuration outside_of_steps(Configuration c);

/// One column per multiplier, one row per free motion; rows are scaled with the size of their motion.
struct ConstraintMatrix {
  ConstraintMatrix(Assembler& assembler, const Configuration& configuration, ConstraintColumns kind);

  /// Writes a scaled motion, one entry per row, into `y`, one entry per motion slot.
  void to_slots(const Eigen::VectorXd& motion, std::vector<double>& y) const;

  Eigen::SparseMatrix<double> matrix;
  std::vector<std::size_t> slot;  ///< of a row
  std::vector<double> row_size;
};

/// The QR of a ConstraintMatrix with columns of length 1 (Eigen's SparseQR; Davis 2011).
class ConstraintFactors {
 public:
  /// Columns whose remainder after all others is below `tolerance` count as dependent.
  ConstraintFactors(Assembler& assembler, const Configuration& configuration, ConstraintColumns kind, double tolerance);

  Eigen::Index rank() const { return rank_; }
  Eigen::Index rows() const { return gradients_.matrix.rows(); }
  Eigen::Index columns() const { return length_.size(); }
  Eigen::Index deficiency() const { return columns() - rank_; }
  /// The multiplier at a place of the pivoted order: the first rank() are independent.
  int pivot(Eigen::Index place) const { return rank_ == 0 ? static_cast<int>(place) : qr_.colsPermutation().indices()[place]; }

  /// A basis of the multipliers that make no force, one column for each dependent one.
  Eigen::MatrixXd null_multipliers(bool scaled_back) const;
  /// The part of `wish` (scaled, one entry per row) that closes no constraint: a possible motion.
  Eigen::VectorXd possible_motion(const Eigen::VectorXd& wish) const;
  /// The least (scaled) motion that closes the independent constraints, to first order.
  Eigen::VectorXd closing_motion(const std::vector<double>& phi) const;
  void to_slots(const Eigen::VectorXd& motion, std::vector<double>& y) const { gradients_.to_slots(motion, y); }

 private:
  ConstraintMatrix gradients_;
  Eigen::VectorXd length_;
  Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> qr_;
  Eigen::Index rank_ = 0;
};

}  // namespace engrane::solve
