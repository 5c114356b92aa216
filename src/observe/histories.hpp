// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "assembly/assembler.hpp"
#include "observe/reactions.hpp"

namespace engrane::observe {

/// Whose histories are wanted, and which.
struct Selection {
  bool all_parts = true, all_nodes = true;
  std::set<int> parts, nodes;      ///< beside these; indices into Model::parts and Model::nodes
  std::set<std::string> channels;  ///< of those; all when empty
  /// One channel of one part or node, selected whatever the rest says.
  struct Single {
    bool of_part = true;
    int index = 0;
    std::string channel;
    auto operator<=>(const Single&) const = default;
  };
  std::set<Single> singles;
};

/// Histories of parts or nodes that have the same channels. Its columns are the channels of the first owner, then those of the
/// next, and so on.
struct Table {
  std::string path;         ///< `element/GEAR`, `element/GEAR_2`, `node/NODE`
  std::string type;         ///< of elements: the card's name
  std::vector<int> ids;     ///< of the owners in the deck
  std::vector<int> owners;  ///< their indices into Model::parts or Model::nodes
  std::vector<Channel> channels;
  std::vector<int> places;  ///< of the channels among all that an owner has

  std::size_t columns() const { return owners.size() * channels.size(); }
};

/// Channels of a node: position and rotation, in motion their rates, on a support the reactions.
std::vector<Channel> node_channels(bool moves, bool supported);

/// The histories of elements and nodes that a run keeps: what they are, and their values. Each rank evaluates the elements
/// that it owns.
class Histories {
 public:
  /// Collective. `moves`: the analysis has velocities.
  Histories(Assembler& assembler, const Reactions& reactions, bool moves, const Selection& selection);

  /// Tables of elements, then of nodes.
  const std::vector<Table>& tables() const { return tables_; }
  /// Columns of all tables together.
  std::size_t columns() const { return columns_; }

  /// Values in the order of the columns, on rank 0; nothing on the others. Collective.
  const std::vector<double>& evaluate(const Configuration& c, const std::vector<Reaction>& reactions);
  /// The columns of nodes, from node_columns() on, without reactions; those of elements are as before. On rank 0.
  const std::vector<double>& evaluate_nodes(const Configuration& c);
  std::size_t node_columns() const { return destination_.size(); }
  /// So many of the tables are of elements.
  std::size_t part_tables() const { return part_tables_; }

 private:
  void add_parts(const Selection& selection);
  void add_nodes(const Selection& selection);
  void plan_gathering();
  void put_nodes(const Configuration& c, const std::vector<Reaction>& reactions);

  Assembler& assembler_;
  const Reactions& supports_;
  bool moves_;
  std::vector<Table> tables_;
  std::size_t part_tables_ = 0;
  std::size_t columns_ = 0;
  std::vector<double> values_;
  std::vector<double> own_, element_;        ///< this rank's columns; all channels of one element
  std::vector<int> counts_, displacements_;  ///< rank 0: columns that come from each rank
  std::vector<std::size_t> destination_;     ///< rank 0: where the gathered numbers belong
  std::vector<double> gathered_;
};

}  // namespace engrane::observe
