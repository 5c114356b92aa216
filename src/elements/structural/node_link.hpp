// SPDX-License-Identifier: BSD-3-Clause
// Common parts of rigid and mean links between a node and a group of nodes.
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

/// Contribution of one node of the group to the constraints of a link:
///
///     Φ = Σ_i A_i g_i,   g_i = R_0ᵀ (x_i − x_0) − d_i
///
/// The gap g_i is the displacement of node i relative to its position on the rigid master, in the master's body axes.
/// With small displacements
///
///     g_i = x_i − x_0 − d_i − θ × d_i
///
/// in global axes, with θ the rotation vector of the master: constraints and forces are linear, like those of the cells.
struct NodeLink {
  using Weights = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor, 6, 3>;
  Vec3 place;                         ///< d_i: position of the node relative to the master in the reference configuration
  Weights weights;                    ///< A_i: one row per constraint
  bool shares = false;                ///< the constraints are sums over several nodes
  bool small = false;                 ///< small displacements
  std::optional<double> height = {};  ///< z of a node that has no unknown along it

  /// Residual: −Aᵀλ at the node and its reaction on the master. If the constraint is shared, the penalty term that
  /// Balance::constraint() includes is removed: on a single share it would act as a stiffness between nodes that are free to
  /// move relative to each other.
  template <class T>
  void evaluate(const Motion<T, 2>& motion, const State& state, Balance<T, 2>& balance) const {
    const auto& master = motion.node[0];
    Vec3T<T> apart = motion.node[1].x - master.x;
    if (height) apart[2] = T(*height) - master.x[2];
    const Vec3T<T> at_rest = place.template cast<T>();
    const Vec3T<T> arm =
        small ? Vec3T<T>(apart - cross(RotationVector<T>::of(master.R).theta, at_rest)) : rotate_back(master.R, apart);
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
    balance.moment(0, small ? moment_on_node(master.R, Vec3T<T>(cross(at_rest, f))) : Vec3T<T>(cross(arm, f)));
    balance.force(1, Vec3T<T>(-force));
  }
};

/// Block of the node links of a model that have the same layout.
class NodeLinks final : public TemplatedBlock<NodeLink, 2, 15> {
 public:
  using TemplatedBlock::TemplatedBlock;
  bool in_mesh() const override { return false; }
  bool is_linear(std::size_t e) const override { return data(e).small; }
};

/// The group of nodes that a link joins to its master.
struct LinkedGroup {
  std::vector<int> nodes;             ///< ids, ascending
  std::vector<Vec3> places;           ///< positions relative to the master
  std::optional<double> height = {};  ///< z of the nodes of plane cells; none in space
  bool in_plane() const { return height.has_value(); }
  bool small = false;  ///< the deck's cells have small displacements
};

/// Group named by a card. Returns nothing, with errors reported, if a link cannot join it.
std::optional<LinkedGroup> linked_group(const LinkData& data, BuildContext& context);

/// Layout of a share. Node ids are −1, as in blocks (Block::layout).
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
