// SPDX-License-Identifier: BSD-3-Clause
#include "app/selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "observe/field_channels.hpp"
#include "observe/observer.hpp"

namespace engrane::app {

namespace {

/// Whether the deck has an element with this number. Faulty elements count: they were not built, but already reported.
bool is_in_deck(const deck::Deck& deck, int id) {
  for (const auto* records : {&deck.records, &deck.faulty})
    for (const deck::Record& record : *records)
      if (record.id == id && record.schema->command() == ".MCE") return true;
  return false;
}

/// Index of the first part of the element with each id. Nodal loads are left out: they are parts without a number of their own.
std::map<int, int> parts_by_id(const Model& model) {
  std::map<int, int> parts;
  for (std::size_t p = 0; p < model.parts.size(); ++p)
    if (!model.parts[p].is_nodal_load()) parts.try_emplace(model.parts[p].element->id(), static_cast<int>(p));
  return parts;
}

bool is_large(const Model& model) { return model.parts.size() + model.nodes.size() - 1 > most_with_all_histories; }

std::string joined(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : " ") + name;
  return list;
}

/// Reports a channel that `owner` (described in words) does not have. `declared_by`: the command that may be at fault, see
/// Diagnostics::missing.
void report_channel(std::string_view declared_by, const Location& where, const std::string& owner, const std::string& wanted,
                    const std::vector<std::string>& names, Diagnostics& diagnostics) {
  const std::string near = nearest(wanted, names), list = joined(names);
  diagnostics.missing(declared_by, where, fmt::format("{} has no output {}", owner, wanted),
                      names.empty()  ? "it has none"
                      : near.empty() ? "it has " + list
                                     : fmt::format("did you mean {}? It has {}", near, list));
}

std::vector<std::string> names_of(const std::vector<Channel>& channels) {
  std::vector<std::string> names;
  for (const Channel& channel : channels) names.push_back(channel.name);
  return names;
}

/// Names of the channels that the fields of an element give.
std::vector<std::string> names_of_fields(const Model::Part& part) {
  std::vector<std::string> names;
  for (const auto& [channel, values] : observe::field_channels(*part.element, part.nodes.size())) names.push_back(channel.name);
  return names;
}

bool gives(const Model::Part& part, const std::string& name) {
  return observe::field_channel(*part.element, part.nodes.size(), name).has_value();
}

/// The number at the end of `STRESS:XX:9`, where an element has the component but not so many places; empty otherwise.
std::string missing_place(const Model::Part& part, const std::string& name) {
  const std::size_t colon = name.rfind(':');
  if (colon == std::string::npos) return {};
  const auto component = observe::field_channel(*part.element, part.nodes.size(), name.substr(0, colon));
  if (!component) return {};
  return fmt::format("{} has values at {} points: `{}:1` is the first", name.substr(0, colon), component->values.count,
                     name.substr(0, colon));
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The command whose absence explains why a node or the run lacks a channel: some channels depend on the analysis, others on
/// supports.
std::string_view declares(const std::string& channel, const Model& model) {
  if (contains(names_of(observe::run_channels(model, true)), channel)) return ".SAM";
  if (contains(names_of(observe::node_channels(true, false)), channel)) return ".SAM";
  if (contains(names_of(observe::node_channels(true, true)), channel)) return ".CLM";
  return {};
}

bool is_supported(const Model& model, int node) {
  return std::any_of(model.supports.begin(), model.supports.end(), [node](const Support& s) { return s.node == node; });
}

void check_check(const deck::Record& record, const deck::CheckCard& check, const deck::Deck& deck, const Model& model,
                 const std::map<int, int>& parts, Diagnostics& diagnostics) {
  std::string owner = "the run";
  std::vector<std::string> names = names_of(observe::run_channels(model, moves(model)));
  if (check.element) {
    const auto found = parts.find(*check.element);
    if (found == parts.end()) {
      if (!is_in_deck(deck, *check.element))
        diagnostics.missing(".MCE", record.where("ELEMENT"), fmt::format("there is no element {}", *check.element));
      return;
    }
    const Model::Part& part = model.part(found->second);
    owner = fmt::format("{} {}", part.type, *check.element);
    if (gives(part, check.quantity)) return;
    if (const std::string why = missing_place(part, check.quantity); !why.empty()) {
      diagnostics.error(record.where("QUANTITY"), fmt::format("{} has no output {}", owner, check.quantity), why);
      return;
    }
    names = names_of(part.element->channels());
    for (std::string& name : names_of_fields(part)) names.push_back(std::move(name));
  } else if (check.node) {
    const int node = model.node_index(*check.node);
    if (node <= 0) {
      diagnostics.missing(".NOE", record.where("NODE"), fmt::format("there is no node {}", *check.node));
      return;
    }
    owner = fmt::format("node {}", *check.node);
    names = names_of(observe::node_channels(moves(model), is_supported(model, node)));
    if (const Element* const of = observe::elements_averaged(model)[static_cast<std::size_t>(node)])
      for (std::string& name : names_of(observe::averaged_channels(*of))) names.push_back(std::move(name));
  }
  if (!contains(names, check.quantity))
    report_channel(check.element ? std::string_view() : declares(check.quantity, model), record.where("QUANTITY"), owner,
                   check.quantity, names, diagnostics);
}

/// Reports elements that `.SAI` records name but the deck does not have, each only once: first those named by number, then
/// those of groups.
void check_archived_elements(const deck::Deck& deck, const Model& model, const std::map<int, int>& parts,
                             Diagnostics& diagnostics) {
  std::set<int> told;
  const auto check = [&](const Location& where, const std::vector<int>& ids) {
    for (const int id : ids)
      if (!parts.contains(id) && !is_in_deck(deck, id) && told.insert(id).second)
        diagnostics.missing(".MCE", where, fmt::format("there is no element {}", id));
  };
  for (const deck::Record& record : deck.records)
    if (const auto* said = record.get<deck::ArchiveCard>()) check(record.where("ELEMENT"), said->elements);
  for (const deck::Record& record : deck.records)
    if (record.get<deck::ArchiveCard>() && record.given("GROUP"))
      check(record.where("GROUP"), model.commands.archive.elements);  // includes the members of groups
}

void check_archive(const deck::Record& record, const deck::ArchiveCard& archive, const Model& model, Diagnostics& diagnostics) {
  std::vector<std::string> types;
  for (const Model::Part& part : model.parts)
    if (!contains(types, part.type)) types.push_back(part.type);
  for (const std::string& kind : archive.kinds)
    if (!contains(types, kind)) {
      const std::string near = nearest(kind, types);
      diagnostics.missing(".MCE", record.where("TYPE"), fmt::format("no element is a {}", kind),
                          near.empty() ? "there are " + joined(types) : fmt::format("did you mean {}?", near));
    }
  // channels that none of the selected elements and nodes has
  const observe::Selection selection = select_histories(model);
  std::vector<std::string> names;
  const auto add = [&names](const std::vector<Channel>& channels) {
    for (const Named& channel : channels)
      if (!contains(names, channel.name)) names.push_back(channel.name);
  };
  // elements of a block share one vector of fields
  std::set<const std::vector<Field>*> seen;
  std::set<std::string> given;
  for (std::size_t p = 0; p < model.parts.size() && !archive.channels.empty(); ++p) {
    if (!selection.chooses(true, static_cast<int>(p))) continue;
    const Model::Part& part = model.parts[p];
    add(part.element->channels());
    if (part.element->fields().empty() || !seen.insert(&part.element->fields()).second) continue;
    for (const auto& [channel, values] : observe::field_channels(*part.element, part.nodes.size())) add({channel});
    for (const std::string& channel : archive.channels)
      if (gives(part, channel)) given.insert(channel);
  }
  std::vector<const Element*> averaged;
  if (!archive.channels.empty()) averaged = observe::elements_averaged(model);
  seen.clear();
  for (std::size_t n = 1; n < model.nodes.size() && !archive.channels.empty(); ++n) {
    if (!selection.chooses(false, static_cast<int>(n))) continue;
    add(observe::node_channels(moves(model), is_supported(model, static_cast<int>(n))));
    if (averaged[n] && seen.insert(&averaged[n]->fields()).second) add(observe::averaged_channels(*averaged[n]));
  }
  // an element with a faulty record might have had it
  const auto declared_by = [&](const std::string& channel) {
    const std::string_view of_nodes = declares(channel, model);
    return of_nodes.empty() ? std::string_view(".MCE") : of_nodes;
  };
  for (const std::string& channel : archive.channels)
    if (!contains(names, channel) && !given.contains(channel))
      report_channel(declared_by(channel), record.where("CHANNEL"), "what is selected", channel, names, diagnostics);
}

/// Checks that `.PATH` and `.BUCKLING` are used in statics with large displacements, and `.PATH` without TOL, since it controls
/// its steps differently.
void check_stability(const deck::Record& record, const Model& model, Diagnostics& diagnostics) {
  const auto* path = record.get<deck::PathCard>();
  if (!path && !record.get<deck::BucklingCard>()) return;
  const std::string& type = model.commands.analysis.type.tag;
  if (type != "STATIC")
    diagnostics.error(record.location, fmt::format("{} is for a STATIC analysis, not a {} one", record.schema->name, type),
                      "give .SAM TYPE STATIC");
  if (model.commands.analysis.displacements.is("SMALL"))
    diagnostics.error(
        record.location,
        fmt::format("{} needs forces that change with displacements, and those of the cells are SMALL", record.schema->name),
        "give DISPLACEMENTS LARGE in .SAM");
  if (!path) return;
  if (model.commands.stepping.tolerance)
    diagnostics.error(record.location, ".PATH chooses its steps itself, and .SUB has TOL", "leave TOL out");
  if (path->node && model.node_index(*path->node) <= 0)
    diagnostics.missing(".NOE", record.where("NODE"), fmt::format("there is no node {}", *path->node));
}

}  // namespace

bool moves(const Model& model) { return !model.commands.analysis.type.is("STATIC"); }

bool selects(const deck::ArchiveCard& archive) {
  return !archive.elements.empty() || !archive.kinds.empty() || !archive.nodes.empty() || !archive.groups.empty();
}

observe::Selection select_histories(const Model& model) {
  const deck::ArchiveCard& archive = model.commands.archive;
  const std::map<int, int> parts = parts_by_id(model);
  observe::Selection selection;
  selection.all_parts = selection.all_nodes =
      !selects(archive) && !archive.keep.is("NONE") && (archive.keep.is("ALL") || !archive.channels.empty() || !is_large(model));
  for (const int id : archive.elements)
    if (const auto found = parts.find(id); found != parts.end()) selection.parts.insert(found->second);
  for (std::size_t p = 0; p < model.parts.size(); ++p)
    if (contains(archive.kinds, model.parts[p].type)) selection.parts.insert(static_cast<int>(p));
  for (const int id : archive.nodes) selection.nodes.insert(model.node_index(id));
  selection.channels.insert(archive.channels.begin(), archive.channels.end());
  for (const deck::CheckCard& check : model.commands.checks) {
    if (check.element) {
      if (const auto found = parts.find(*check.element); found != parts.end())
        selection.singles.insert({true, found->second, check.quantity});
    } else if (check.node) {
      selection.singles.insert({false, model.node_index(*check.node), check.quantity});
    }
  }
  return selection;
}

observe::Selection select_compared(const Model& model) {
  observe::Selection selection = select_histories(model);
  const deck::ArchiveCard& archive = model.commands.archive;
  const std::vector<deck::CheckCard>& checks = model.commands.checks;
  const bool names_some =
      std::any_of(checks.begin(), checks.end(), [](const auto& check) { return check.element || check.node; });
  if (!selects(archive) && archive.channels.empty() && names_some) selection.all_parts = selection.all_nodes = false;
  return selection;
}

int checked_channel(const observe::Observer& observer, const deck::CheckCard& check) {
  const std::string owner = check.element ? fmt::format("element/{}", *check.element)
                            : check.node  ? fmt::format("node/{}", *check.node)
                                          : std::string("run");
  return observer.channel(owner, check.quantity);
}

std::string left_out_histories(const Model& model) {
  const deck::ArchiveCard& archive = model.commands.archive;
  if (!is_large(model) || selects(archive) || archive.keep.given() || !archive.channels.empty()) return "";
  return fmt::format(
      "histories are kept of the run and of what .CHK compares only: the model has {} elements and nodes, more than {}; "
      ".SAI selects others, or all with KEEP ALL",
      model.parts.size() + model.nodes.size() - 1, most_with_all_histories);
}

void check_targets(const deck::Deck& deck, const Model& model, Diagnostics& diagnostics) {
  const std::map<int, int> parts = parts_by_id(model);
  check_archived_elements(deck, model, parts, diagnostics);
  for (const deck::Record& record : deck.records) {
    if (const auto* check = record.get<deck::CheckCard>()) check_check(record, *check, deck, model, parts, diagnostics);
    if (const auto* archive = record.get<deck::ArchiveCard>()) check_archive(record, *archive, model, diagnostics);
    check_stability(record, model, diagnostics);
  }
}

}  // namespace engrane::app
