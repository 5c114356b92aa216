// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "deck/cards/cards.hpp"
#include "math/vector.hpp"

namespace engrane {

/// The named sets of nodes that `.SEL` declares, and which nodes a record speaks of.
class NodeGroups {
 public:
  NodeGroups(const std::map<int, Vec3>& nodes, Diagnostics& diagnostics) : nodes_(nodes), diagnostics_(diagnostics) {}

  void add(const deck::Record& record, const deck::GroupCard& card);

  /// Node ids of a target, without repetition; unknown nodes and groups are errors at the record's keywords.
  std::vector<int> resolve(const deck::Record& record, const deck::NodeTarget& target) const;

 private:
  const std::vector<int>* find(const std::string& name) const;
  void report_unknown_group(const deck::Record& record, std::string_view keyword, const std::string& name) const;

  const std::map<int, Vec3>& nodes_;
  Diagnostics& diagnostics_;
  std::map<std::string, std::vector<int>> groups_;  ///< by number and by name
};

}  // namespace engrane
