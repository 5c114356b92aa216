// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "deck/cards/cards.hpp"
#include "model/node_positions.hpp"

namespace engrane {

/// The named sets of nodes that `.SEL` declares, and which nodes a record speaks of. A group of groups refers to them and holds
/// no nodes of theirs: unions of unions cost what they say, not what they contain.
class NodeGroups {
 public:
  NodeGroups(const NodePositions& nodes, Diagnostics& diagnostics) : nodes_(nodes), diagnostics_(diagnostics) {}

  void add(const deck::Record& record, const deck::GroupCard& card);

  /// Node ids of a target, ascending, without repetition; unknown nodes and groups are errors at the record's keywords.
  std::vector<int> resolve(const deck::Record& record, const deck::NodeTarget& target);

 private:
  struct Group {
    std::vector<int> nodes;           ///< of its own
    std::vector<std::size_t> united;  ///< groups declared before it
    bool all = false;                 ///< every node but the ground
    int search = 0;                   ///< the last one that came by

    bool empty() const { return nodes.empty() && united.empty() && !all; }
  };

  std::optional<std::size_t> find(const std::string& name) const;
  std::vector<int> nodes_in(const std::vector<double>& box);
  void append(std::size_t group, std::vector<int>& ids);
  void report_unknown_group(const deck::Record& record, std::string_view keyword, const std::string& name) const;

  const NodePositions& nodes_;
  Diagnostics& diagnostics_;
  std::vector<Group> groups_;                               ///< in the order of the deck
  std::unordered_map<std::string, std::size_t> declared_;   ///< by number and by name; the last of a name counts
  std::unordered_map<std::string, const char*> of_others_;  ///< groups of elements and faces: what they hold
  std::vector<int> by_x_;                                   ///< indices of the nodes by first coordinate, once asked for
  int searches_ = 0;                                        ///< how many targets were resolved
};

}  // namespace engrane
