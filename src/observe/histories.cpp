// SPDX-License-Identifier: BSD-3-Clause
#include "observe/histories.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "math/rotation.hpp"

namespace engrane::observe {

namespace {

void add_vector(std::vector<Channel>& channels, const char* prefix, Dimension d, const char* help) {
  for (const char axis : {'X', 'Y', 'Z'}) channels.push_back({fmt::format("{}{}", prefix, axis), d, help});
}

/// Indices of the selected channels of one owner.
std::vector<int> selected_places(const Selection& selection, bool of_part, int index, const std::vector<Channel>& channels) {
  const bool chosen =
      of_part ? selection.all_parts || selection.parts.contains(index) : selection.all_nodes || selection.nodes.contains(index);
  std::vector<int> places;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const std::string& name = channels[i].name;
    if ((chosen && (selection.channels.empty() || selection.channels.contains(name))) ||
        (!selection.singles.empty() && selection.singles.contains({of_part, index, name})))
      places.push_back(static_cast<int>(i));
  }
  return places;
}

/// Text that is equal for channels that may share a column heading.
std::string signature(int place, const Named& c) {
  const Dimension& d = c.dimension;
  return fmt::format("{} {} {} {} {} {} {}\n", place, c.name, c.help, d.length, d.mass, d.time, d.angle);
}

}  // namespace

std::vector<Channel> node_channels(bool moves, bool supported) {
  std::vector<Channel> c;
  add_vector(c, "U", dimension::length, "displacement");
  add_vector(c, "R", dimension::angle, "rotation vector");
  if (moves) {
    add_vector(c, "V", dimension::velocity, "velocity");
    add_vector(c, "W", dimension::angular_velocity, "angular velocity");
    add_vector(c, "A", dimension::acceleration, "acceleration");
    add_vector(c, "E", dimension::angular_acceleration, "angular acceleration");
  }
  if (supported) {
    add_vector(c, "F", dimension::force, "reaction force");
    add_vector(c, "M", dimension::moment, "reaction torque");
  }
  return c;
}

Histories::Histories(Assembler& assembler, const Reactions& reactions, bool moves, const Selection& selection)
    : assembler_(assembler), supports_(reactions), moves_(moves) {
  add_parts(selection);
  part_tables_ = tables_.size();
  add_nodes(selection);
  for (const Table& table : tables_) columns_ += table.columns();
  values_.assign(assembler.rank() == 0 ? columns_ : 0, 0.0);
  find_known();
  plan_gathering();
}

void Histories::add_parts(const Selection& selection) {
  const Model& model = assembler_.model();
  // owners with the same channels share a table, as most elements of a type do
  std::map<std::string, std::map<std::string, Table>> kinds;
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const Model::Part& part = model.parts[p];
    const std::vector<Channel>& channels = part.element->channels();
    std::vector<int> places = selected_places(selection, true, static_cast<int>(p), channels);
    if (places.empty()) continue;
    std::string names;
    for (const int place : places) names += signature(place, channels[static_cast<std::size_t>(place)]);
    Table& table = kinds[part.type][names];
    table.ids.push_back(part.element->id());
    table.owners.push_back(static_cast<int>(p));
    if (table.channels.empty()) {
      for (const int place : places) table.channels.push_back(channels[static_cast<std::size_t>(place)]);
      table.type = part.type;
      table.places = std::move(places);
    }
  }
  for (auto& [type, variants] : kinds) {
    int number = 0;
    for (auto& [names, table] : variants) {
      table.path = ++number == 1 ? fmt::format("element/{}", type) : fmt::format("element/{}_{}", type, number);
      tables_.push_back(std::move(table));
    }
  }
}

void Histories::add_nodes(const Selection& selection) {
  const Model& model = assembler_.model();
  const std::vector<Channel> channels[2] = {node_channels(moves_, false), node_channels(moves_, true)};
  std::map<std::vector<int>, Table> variants;
  for (std::size_t n = 1; n < model.nodes.size(); ++n) {
    const auto& all = channels[supports_.supported(static_cast<int>(n)) ? 1 : 0];
    const std::vector<int> places = selected_places(selection, false, static_cast<int>(n), all);
    if (places.empty()) continue;
    Table& table = variants[places];
    table.ids.push_back(model.nodes[n].id);
    table.owners.push_back(static_cast<int>(n));
    if (!table.channels.empty()) continue;
    for (const int place : places) table.channels.push_back(all[static_cast<std::size_t>(place)]);
    table.places = places;
  }
  int number = 0;
  for (auto& [chosen, table] : variants) {
    table.path = ++number == 1 ? "node/NODE" : fmt::format("node/NODE_{}", number);
    tables_.push_back(std::move(table));
  }
}

void Histories::find_known() {
  std::size_t column = 0;
  for (std::size_t t = 0; t < part_tables_; ++t)
    for (const int part : tables_[t].owners) {
      const Element& element = *assembler_.model().part(part).element;
      const auto* known = dynamic_cast<const DeterminedChannels*>(&element);
      const std::vector<DeterminedChannels::Determined> all = known ? known->determined() : decltype(known->determined())();
      for (const int place : tables_[t].places) {
        for (const auto& d : all)
          if (d.channel == place) {
            const Dimension of_source =
                d.sources.empty() ? dimension::none : element.channels()[static_cast<std::size_t>(d.sources[0])].dimension;
            known_.push_back({column, part, d, known, of_source, sources_.size()});
            sources_.resize(sources_.size() + d.sources.size());
          }
        ++column;
      }
    }
}

const std::vector<double>& Histories::sources(const Configuration& c) {
  int seen = -1;
  if (sources_.empty() || assembler_.rank() != 0) return sources_;
  for (const Known& known : known_) {
    const std::vector<int>& channels = known.determined.sources;
    if (channels.empty()) continue;
    const int part = known.part;
    if (std::exchange(seen, part) != part) {
      const Element& element = *assembler_.model().part(part).element;
      element_.resize(element.channels().size());
      element.observe(assembler_.view(part, c), element_);
    }
    for (std::size_t i = 0; i < channels.size(); ++i) sources_[known.first + i] = element_[static_cast<std::size_t>(channels[i])];
  }
  return sources_;
}

void Histories::plan_gathering() {
  int ranks = 1;
  MPI_Comm_size(assembler_.comm(), &ranks);
  if (assembler_.rank() != 0) return;
  // each rank sends the columns of its owners, table by table
  const Partition& partition = assembler_.numbering().partition();
  for (int r = 0; r < ranks; ++r) {
    displacements_.push_back(static_cast<int>(destination_.size()));
    std::size_t column = 0;
    for (std::size_t t = 0; t < part_tables_; ++t)
      for (const int owner : tables_[t].owners)
        for (std::size_t k = 0; k < tables_[t].channels.size(); ++k, ++column)
          if (partition.owner(owner) == r) destination_.push_back(column);
    counts_.push_back(static_cast<int>(destination_.size()) - displacements_.back());
  }
  gathered_.resize(destination_.size());
}

const std::vector<double>& Histories::evaluate(const Configuration& c, const std::vector<Reaction>& reactions) {
  const Model& model = assembler_.model();
  own_.clear();
  for (std::size_t t = 0; t < part_tables_; ++t)
    for (const int part : tables_[t].owners) {
      if (!assembler_.owns(part)) continue;
      const Element& element = *model.part(part).element;
      element_.resize(element.channels().size());
      element.observe(assembler_.view(part, c), element_);
      for (const int place : tables_[t].places) own_.push_back(element_[static_cast<std::size_t>(place)]);
    }
  MPI_Gatherv(own_.data(), static_cast<int>(own_.size()), MPI_DOUBLE, gathered_.data(), counts_.data(), displacements_.data(),
              MPI_DOUBLE, 0, assembler_.comm());
  if (assembler_.rank() != 0) return values_;
  for (std::size_t i = 0; i < destination_.size(); ++i) values_[destination_[i]] = gathered_[i];
  put_nodes(c, reactions);
  return values_;
}

const std::vector<double>& Histories::evaluate_nodes(const Configuration& c) {
  put_nodes(c, {});
  return values_;
}

void Histories::put_nodes(const Configuration& c, const std::vector<Reaction>& reactions) {
  const Model& model = assembler_.model();
  double* out = values_.data() + destination_.size();
  std::vector<double> all;
  for (std::size_t t = part_tables_; t < tables_.size(); ++t)
    for (const int index : tables_[t].owners) {
      const NodeState& node = c.nodes[static_cast<std::size_t>(index)];
      all.clear();
      const auto put = [&all](const Vec3& v) { all.insert(all.end(), v.data(), v.data() + 3); };
      put(node.x - model.node(index).x + Eigen::Map<const Vec3>(&c.remainders[6 * static_cast<std::size_t>(index)]));
      put(rotation_log(node.R));
      if (moves_) {
        put(node.v);
        put(node.R * node.W);
        put(node.a);
        put(node.R * node.A);
      }
      const auto reaction = std::lower_bound(reactions.begin(), reactions.end(), index,
                                             [](const Reaction& r, int wanted) { return r.node < wanted; });
      if (reaction != reactions.end() && reaction->node == index) {
        put(reaction->force);
        put(reaction->torque);
      } else {
        all.resize(all.size() + 6, 0.0);
      }
      for (const int place : tables_[t].places) *out++ = all[static_cast<std::size_t>(place)];
    }
}

}  // namespace engrane::observe
