// SPDX-License-Identifier: BSD-3-Clause
#include "model/groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace engrane {

namespace {

void sort_and_unite(std::vector<int>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

}  // namespace

bool lies_in(const std::vector<double>& box, const Vec3& x) {
  return x[0] >= box[0] && x[0] <= box[1] && x[1] >= box[2] && x[1] <= box[3] && x[2] >= box[4] && x[2] <= box[5];
}

void warn_of_no_effect(const deck::Record& record, const std::vector<std::string>& groups, const char* members,
                       Diagnostics& diagnostics) {
  const std::string_view key = record.schema->key();
  const bool one = groups.size() == 1;
  diagnostics.warning(record.where("GROUP"), fmt::format("{} \"{}\" {} no {}: this {} has no effect", one ? "group" : "groups",
                                                         fmt::join(groups, "\", \""), one ? "has" : "have", members,
                                                         key.empty() ? record.schema->name : key));
}

void NodeGroups::add(const deck::Record& record, const deck::GroupCard& card) {
  if (!card.kind.is("NODES")) {  // references to groups of elements and faces are resolved elsewhere
    const char* what = card.kind.is("FACES") ? "faces" : "elements";
    for (const std::string& name : card.names) of_others_[name] = what;
    return;
  }
  Group group;
  group.all = card.all && nodes_.by_number().size() > 1;
  for (const int id : card.ids) {
    if (nodes_.contains(id))
      group.nodes.push_back(id);
    else
      diagnostics_.missing(".NOE", record.location, fmt::format("node {} of this group does not exist", id));
  }
  for (const std::string& name : card.united) {
    const auto other = find(name);
    if (!other)
      report_unknown_group(record, "UNION", name);
    else if (!groups_[*other].empty())
      group.united.push_back(*other);
  }
  if (!card.box.empty()) {
    const std::vector<int> inside = nodes_in(card.box);
    group.nodes.insert(group.nodes.end(), inside.begin(), inside.end());
  }
  const auto [known, first] = last_record_.try_emplace(card.group, 0);
  if (!first) group.united.push_back(known->second);
  sort_and_unite(group.nodes);
  if (group.empty()) diagnostics_.warning(record.location, "this group has no nodes");
  const bool another_name = group.nodes.empty() && !group.all && group.united.size() == 1;
  const std::size_t index = another_name ? group.united.front() : groups_.size();
  if (!another_name) groups_.push_back(std::move(group));
  known->second = index;
  for (const std::string& name : card.names) declared_[name] = index;
}

/// Nodes in a box, including its faces and excluding the ground.
std::vector<int> NodeGroups::nodes_in(const std::vector<double>& box) {
  const auto& nodes = nodes_.by_number();
  const auto at = [&](int i) -> const NodePositions::Node& { return nodes[static_cast<std::size_t>(i)]; };
  if (by_x_.size() != nodes.size()) {
    by_x_.resize(nodes.size());
    std::iota(by_x_.begin(), by_x_.end(), 0);
    std::sort(by_x_.begin(), by_x_.end(), [&](int a, int b) { return at(a).x[0] < at(b).x[0]; });
  }
  const auto first = std::lower_bound(by_x_.begin(), by_x_.end(), box[0], [&](int i, double x) { return at(i).x[0] < x; });
  std::vector<int> inside;
  for (auto i = first; i != by_x_.end() && at(*i).x[0] <= box[1]; ++i) {
    const auto& [id, x] = at(*i);
    if (id != 0 && lies_in(box, x)) inside.push_back(id);
  }
  return inside;
}

std::vector<int> NodeGroups::resolve(const deck::Record& record, const deck::NodeTarget& target) {
  std::vector<int> ids;
  for (const int id : target.nodes) {
    if (id != 0 && nodes_.contains(id))
      ids.push_back(id);
    else if (id == 0)
      diagnostics_.error(record.where("NOEUD"), "node 0 is the ground: it is fixed and takes no load");
    else
      diagnostics_.missing(".NOE", record.where("NOEUD"), fmt::format("node {} does not exist", id));
  }
  ++searches_;
  bool known = true;
  for (const std::string& name : target.groups) {
    if (const auto group = find(name)) {
      append(*group, ids);
    } else {
      report_unknown_group(record, "GROUP", name);
      known = false;
    }
  }
  if (known && ids.empty() && target.nodes.empty() && !target.groups.empty()) report_no_nodes(record, target);
  sort_and_unite(ids);
  return ids;
}

/// Appends the nodes of a group and of its unions, visiting each group once per search.
void NodeGroups::append(std::size_t group, std::vector<int>& ids) {
  std::vector<std::size_t> open{group};
  while (!open.empty()) {
    const std::size_t index = open.back();
    open.pop_back();
    Group& g = groups_[index];
    if (std::exchange(g.search, searches_) == searches_) continue;
    ids.insert(ids.end(), g.nodes.begin(), g.nodes.end());
    if (g.all)
      for (const auto& node : nodes_.by_number())
        if (node.id != 0) ids.push_back(node.id);
    open.insert(open.end(), g.united.begin(), g.united.end());
  }
}

/// Warns about a record that applies to no node, as its groups are empty. An archive without them keeps other histories.
void NodeGroups::report_no_nodes(const deck::Record& record, const deck::NodeTarget& target) const {
  if (!record.get<deck::ArchiveCard>()) warn_of_no_effect(record, target.groups, "nodes", diagnostics_);
}

std::optional<std::size_t> NodeGroups::find(const std::string& name) const {
  const auto it = declared_.find(name);
  return it == declared_.end() ? std::nullopt : std::optional(it->second);
}

void NodeGroups::report_unknown_group(const deck::Record& record, std::string_view keyword, const std::string& name) const {
  if (const auto other = of_others_.find(name); other != of_others_.end()) {
    diagnostics_.error(record.where(keyword), fmt::format("group \"{}\" holds {}, and nodes are meant here", name, other->second),
                       "declare a group of NOEUDS");
    return;
  }
  std::vector<std::string> known;
  for (const auto& [key, group] : declared_) known.push_back(key);
  std::sort(known.begin(), known.end());  // for a deterministic choice among equally near names
  const std::string near = nearest(name, known);
  diagnostics_.missing(".SEL", record.where(keyword), fmt::format("there is no group \"{}\" above this line", name),
                       near.empty() ? "declare it with .SEL GROUP" : fmt::format("did you mean \"{}\"?", near));
}

}  // namespace engrane
