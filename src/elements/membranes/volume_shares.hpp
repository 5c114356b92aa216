// SPDX-License-Identifier: BSD-3-Clause
// Volume enclosed by a surface as a sum over its cells: shares of one constraint whose multiplier is the pressure.
#pragma once

#include <vector>

#include "elements/structural/pressures.hpp"
#include "model/block.hpp"

namespace engrane::elements::membranes {

/// Shares of Φ = (Σ V_e − V)/A: of cells with a given number of nodes, or of edges of the rim.
///
/// By the divergence theorem a cell contributes V_e = ⅓ ∫ (x − o)·n dA, the volume of the cone from it to the point o. The cone
/// over a rim in a plane through o is flat, so that planes through o close the surface. With these terms alone, however, a
/// rim would be loaded normal to its plane by the pressure on that cone. Its edges therefore add ⅓ ∮ h m·((x − o) × dx), with m
/// the normal of the plane and h the height above it. As long as the rim is in its plane this term and its in-plane forces
/// vanish. Only the pressure on the cells remains.
class VolumeShares final : public Block {
 public:
  /// `multipliers`: those of the whole constraint.
  VolumeShares(std::size_t nodes, bool rim, std::vector<Multiplier> multipliers);

  struct Piece {
    std::vector<int> nodes;      ///< corners, then mid-side nodes
    Vec3 origin;                 ///< o
    Vec3 normal = Vec3::Zero();  ///< m; only for a rim
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

  /// V_e of a piece whose nodes are at `x`.
  double volume(const Piece& piece, const std::vector<Vec3>& x) const;

 private:
  /// V_e and its derivatives by the positions of the nodes.
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
