// SPDX-License-Identifier: BSD-3-Clause
// What rigid and mean links between a node and a group of nodes have in common.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "deck/cards/cards.hpp"
#include "elements/common/rotation_vector.hpp"
#include "model/registry.hpp"
#include "model/templated_block.hpp"

namespace engrane::elements::structural {

/// `N master GROUP "rim"`, `N master MEMBERS 1 2 3`.
struct LinkData : deck::NodeTarget {
  int master = 0;
};

/// Share of one node of the group in the constraints of a link:
///
///     Φ = Σ_i A_i g_i,   g_i = R_0ᵀ (x_i − x_0) − d_i
///
/// The gap g_i is how far node i is from where the master would carry it, in the master's material axes. With small displacements
///
///     g_i = x_i − x_0 − d_i − θ × d_i
///
/// in space, with θ the rotation vector of the master: constraints and forces are linear, as those of the cells.
struct NodeLink {
  using Weights = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor, 6, 3>;
  Vec3 place;       ///< d_i: of the node in the reference configuration, from the master
  Weights weights;  ///< A_i: a row for each constraint
  bool shares = false;
  bool in_plane = false;  ///< the node does not move along z, which is no unknown of it
  bool small = false;     ///< displacements are small

  /// The residual is −Aᵀλ at the node, and its reaction on the master. A penalty acts on constraints that are whole: of a share
  /// it would be a stiffness between nodes that may move.
  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const {
    const auto& master = motion.node[0];
    const Vec3T<T> apart = motion.node[1].x - master.x, at_rest = place.template cast<T>();
    Vec3T<T> arm = small ? Vec3T<T>(apart - cross(RotationVector<T>::of(master.R).theta, at_rest)) : rotate_back(master.R, apart);
    if (in_plane) arm[2] = T(place[2]);
    Vec3T<T> f(T(0), T(0), T(0));
    for (Eigen::Index row = 0; row < weights.rows(); ++row) {
      T phi(0);
      for (int c = 0; c < 3; ++c) phi += weights(row, c) * (arm[c] - place[c]);
      T force = balance.constraint(static_cast<int>(row), phi);
      if (shares) force += state.penalty * phi;
      for (int c = 0; c < 3; ++c) f[c] += weights(row, c) * force;
    }
    const Vec3T<T> force = small ? f : rotate(master.R, f);
    balance.force(0, force);
    balance.moment(0, small ? rotate_back(master.R, Vec3T<T>(cross(at_rest, f))) : Vec3T<T>(cross(arm, f)));
    balance.force(1, Vec3T<T>(-force));
  }
};

/// The first shares of the links of a model, or all others.
class NodeLinks final : public TemplatedBlock<NodeLink, 2, 15> {
 public:
  using TemplatedBlock::TemplatedBlock;
  bool in_mesh() const override { return false; }
  bool is_linear(std::size_t e) const override { return data(e).small; }
};

/// The nodes that a link joins.
struct LinkedGroup {
  std::vector<int> nodes;    ///< ids, ascending
  std::vector<Vec3> places;  ///< of each, from the master
  bool in_plane = false;     ///< nodes of plane cells
  bool small = false;        ///< displacements of the deck's cells are
};

/// What a card names, where a link can join it; faults are reported.
std::optional<LinkedGroup> linked_group(const LinkData& data, BuildContext& context);

/// The layout of a share. Nodes are −1: those of a block (Block::layout).
Layout link_layout(bool in_plane, std::vector<Multiplier> multipliers);

/// Adds the keywords of LinkData to a card.
template <class Data>
void add_link_nodes(deck::Card<Data>& card) {
  card.add("N", &Data::master, "the node with rotations that the group is linked to")
      .refers(deck::Reference::node)
      .at_least(1)
      .required();
  card.add("GROUP", &Data::groups, "groups of nodes: names or numbers")
      .refers(deck::Reference::group)
      .values(1, deck::any_number);
  card.add("MEMBERS", &Data::nodes, "nodes of the group, beside those of GROUP")
      .refers(deck::Reference::node)
      .at_least(1)
      .values(1, deck::any_number);
}

}  // namespace engrane::elements::structural
