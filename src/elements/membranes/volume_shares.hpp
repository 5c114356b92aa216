// SPDX-License-Identifier: BSD-3-Clause
// The volume that a surface encloses, as a sum over its cells: shares of one constraint, which the pressure holds.
#pragma once

#include <vector>

#include "elements/structural/pressures.hpp"
#include "model/block.hpp"

namespace engrane::elements::membranes {

/// Shares of Φ = (Σ V_e − V)/A, of cells of so many nodes or of pieces of the rim.
///
/// By Gauss's theorem a cell has V_e = ⅓ ∫ (x − o)·n dA: the cone from it to the point o. Cones of a rim in a plane through o are
/// flat, so that planes through o close the surface. Out of its plane a rim of the cones alone would feel the pressure on the
/// cone: its pieces add ⅓ ∮ h m·((x − o) × dx), with m the normal of the plane and h the height over it, which is zero and leaves
/// no force in the plane. What is left is the pressure on the cells.
class VolumeShares final : public Block {
 public:
  /// The layout of the whole constraint's multipliers.
  VolumeShares(std::size_t nodes, bool rim, std::vector<Multiplier> multipliers);

  struct Piece {
    std::vector<int> nodes;      ///< corners, then middles
    Vec3 origin;                 ///< o
    Vec3 normal = Vec3::Zero();  ///< m; of a rim
    double area = 1;             ///< A
  };
  std::size_t add(Piece piece);

  std::size_t size() const override { return pieces_.size(); }
  const Layout& layout() const override { return layout_; }
  std::span<const int> node_ids(std::size_t e) const override { return pieces_[e].nodes; }
  bool in_mesh() const override { return false; }

  void residual(std::size_t first, std::span<const State> states, std::span<double> r) const override;
  void tangent(std::size_t first, std::span<const State> states, Weights weights, std::span<double> r,
               std::span<double> k) const override;
  void constraint_rates(std::size_t e, const State& state, std::span<double> phi, std::span<double> rate,
                        std::span<double> second) const override;

  /// A Φ of a piece whose nodes are at `x`.
  double volume(const Piece& piece, const std::vector<Vec3>& x) const;

 private:
  /// V_e with its derivatives by the places of the nodes.
  struct Derivatives {
    double value = 0;
    Eigen::VectorXd gradient;
    Eigen::MatrixXd hessian;
  };
  void evaluate(const Piece& piece, const std::vector<Vec3>& x, bool second, Derivatives& out) const;
  void add_cell(const Piece& piece, const std::vector<Vec3>& x, bool second, Derivatives& out) const;
  void add_rim(const Piece& piece, const std::vector<Vec3>& x, bool second, Derivatives& out) const;
  std::vector<Vec3> places(const Piece& piece, const State& state) const;

  bool rim_;
  Layout layout_;
  std::vector<structural::FaceSample> samples_;
  std::vector<Piece> pieces_;
};

}  // namespace engrane::elements::membranes
