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

/// Whether a place lies in the box xmin xmax ymin ymax zmin zmax of `.SEL`, or on its faces.
bool lies_in(const std::vector<double>& box, const Vec3& x);

/// Warns that a record on these groups has no effect: `members`, such as "nodes", are in none of them.
void warn_of_no_effect(const deck::Record& record, const std::vector<std::string>& groups, const char* members,
                       Diagnostics& diagnostics);

/// The named node sets of `.SEL`, and the resolution of node targets. A union refers to its groups and does not copy their
/// nodes: nested unions cost as much as their declarations, not their contents.
class NodeGroups {
 public:
  NodeGroups(const NodePositions& nodes, Diagnostics& diagnostics) : nodes_(nodes), diagnostics_(diagnostics) {}

  void add(const deck::Record& record, const deck::GroupCard& card);

  /// Returns the node ids of a target, ascending and unique. Unknown nodes and groups are errors at the record's keywords; groups
  /// that are all empty are a warning there.
  std::vector<int> resolve(const deck::Record& record, const deck::NodeTarget& target);

 private:
  struct Group {
    std::vector<int> nodes;           ///< of its own
    std::vector<std::size_t> united;  ///< groups declared earlier
    bool all = false;                 ///< every node but the ground
    int search = 0;                   ///< number of the last search that visited it

    bool empty() const { return nodes.empty() && united.empty() && !all; }
  };

  std::optional<std::size_t> find(const std::string& name) const;
  std::vector<int> nodes_in(const std::vector<double>& box);
  void append(std::size_t group, std::vector<int>& ids);
  void report_no_nodes(const deck::Record& record, const deck::NodeTarget& target) const;
  void report_unknown_group(const deck::Record& record, std::string_view keyword, const std::string& name) const;

  const NodePositions& nodes_;
  Diagnostics& diagnostics_;
  std::vector<Group> groups_;                               ///< in the order of the deck
  std::unordered_map<std::string, std::size_t> declared_;   ///< by number and by name
  std::unordered_map<int, std::size_t> last_record_;        ///< by GroupCard::group: that of its last record so far
  std::unordered_map<std::string, const char*> of_others_;  ///< groups of elements and faces: what they contain
  std::vector<int> by_x_;                                   ///< node indices sorted by first coordinate; built on first use
  int searches_ = 0;                                        ///< number of targets resolved
};

}  // namespace engrane
