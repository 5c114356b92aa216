// SPDX-License-Identifier: BSD-3-Clause
#include "model/groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace engrane {

void NodeGroups::add(const deck::Record& record, const deck::GroupCard& card) {
  if (card.kind.is("ELEMENTS")) return;  // nothing refers to groups of elements yet
  std::set<int> members;
  for (const int id : card.ids) {
    if (nodes_.contains(id))
      members.insert(id);
    else
      diagnostics_.error(record.location, fmt::format("node {} of this group does not exist", id));
  }
  if (card.all)
    for (const auto& [id, x] : nodes_)
      if (id != 0) members.insert(id);
  for (const std::string& name : card.united) {
    if (const auto* other = find(name))
      members.insert(other->begin(), other->end());
    else
      report_unknown_group(record, "UNION", name);
  }
  if (!card.box.empty()) {
    for (const auto& [id, x] : nodes_) {
      bool inside = id != 0;
      for (int c = 0; c < 3; ++c) {
        const auto i = static_cast<std::size_t>(2 * c);
        inside = inside && x[c] >= card.box[i] && x[c] <= card.box[i + 1];
      }
      if (inside) members.insert(id);
    }
  }
  if (members.empty()) diagnostics_.warning(record.location, "this group has no nodes");
  const std::vector<int> ids(members.begin(), members.end());
  if (card.number != 0) groups_[std::to_string(card.number)] = ids;
  if (!card.name.empty()) groups_[card.name] = ids;
}

std::vector<int> NodeGroups::resolve(const deck::Record& record, const deck::NodeTarget& target) const {
  std::set<int> ids;
  for (const int id : target.nodes) {
    if (id != 0 && nodes_.contains(id))
      ids.insert(id);
    else
      diagnostics_.error(record.where("NOEUD"), id == 0 ? std::string("node 0 is the ground: it is fixed and takes no load")
                                                        : fmt::format("node {} does not exist", id));
  }
  for (const std::string& name : target.groups) {
    if (const auto* group = find(name))
      ids.insert(group->begin(), group->end());
    else
      report_unknown_group(record, "GROUP", name);
  }
  return {ids.begin(), ids.end()};
}

const std::vector<int>* NodeGroups::find(const std::string& name) const {
  const auto it = groups_.find(name);
  return it == groups_.end() ? nullptr : &it->second;
}

void NodeGroups::report_unknown_group(const deck::Record& record, std::string_view keyword, const std::string& name) const {
  std::vector<std::string> known;
  for (const auto& [key, ids] : groups_) known.push_back(key);
  const std::string near = nearest(name, known);
  diagnostics_.error(record.where(keyword), fmt::format("there is no group \"{}\" above this line", name),
                     near.empty() ? "declare it with .SEL GROUP" : fmt::format("did you mean \"{}\"?", near));
}

}  // namespace engrane
