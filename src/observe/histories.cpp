// SPDX-License-Identifier: BSD-3-Clause
#include "observe/histories.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "math/rotation.hpp"
#include "observe/history_interpolation.hpp"

namespace engrane::observe {

namespace {

void add_vector(std::vector<Channel>& channels, const char* prefix, Dimension d, const char* help) {
  for (const char axis : {'X', 'Y', 'Z'}) channels.push_back({fmt::format("{}{}", prefix, axis), d, help});
}

/// Indices of the selected channels of one owner.
std::vector<int> selected_places(const Selection& selection, bool of_part, int index, const std::vector<Channel>& channels) {
  const bool chosen = selection.chooses(of_part, index);
  std::vector<int> places;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const std::string& name = channels[i].name;
    if ((chosen && (selection.channels.empty() || selection.channels.contains(name))) ||
        (!selection.singles.empty() && selection.singles.contains({of_part, index, name})))
      places.push_back(static_cast<int>(i));
  }
  return places;
}

/// Columns of these channels of an owner whose columns begin at `first`; empty if one of them is not kept.
std::vector<std::size_t> kept(const Table& table, const std::vector<int>& channels, std::size_t first) {
  std::vector<std::size_t> columns;
  for (const int channel : channels) {
    const auto at = std::find(table.places.begin(), table.places.end(), channel);
    if (at == table.places.end()) return {};
    columns.push_back(first + static_cast<std::size_t>(at - table.places.begin()));
  }
  return columns;
}

/// Names of single channels of a part or node.
std::vector<std::string> singles_of(const Selection& selection, bool of_part, int index) {
  std::vector<std::string> names;
  for (auto at = selection.singles.lower_bound({of_part, index, ""});
       at != selection.singles.end() && at->of_part == of_part && at->index == index; ++at)
    names.push_back(at->channel);
  return names;
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

Histories::Histories(Assembler& assembler, const Reactions& reactions, ElementFields& fields, bool moves,
                     const Selection& selection)
    : assembler_(assembler), supports_(reactions), fields_(fields), moves_(moves) {
  add_parts(selection);
  part_tables_ = tables_.size();
  add_nodes(selection);
  for (const Table& table : tables_) columns_ += table.columns();
  values_.assign(assembler.rank() == 0 ? columns_ : 0, 0.0);
  find_known();
  plan_gathering();
}

std::vector<FieldChannel> Histories::selected_fields(const Selection& selection, int part) const {
  const Model::Part& owner = assembler_.model().part(part);
  const Element& element = *owner.element;
  if (element.fields().empty()) return {};
  // elements with channels of their own have fields beside them, for pictures; cells have nothing else
  if (selection.channels.empty() && selection.parts.contains(part) && element.channels().empty())
    return field_channels(element, owner.nodes.size());
  std::set<std::string> names;
  if (selection.chooses(true, part)) names = selection.channels;
  for (std::string& name : singles_of(selection, true, part)) names.insert(std::move(name));
  std::vector<FieldChannel> found;
  for (const std::string& name : names)
    if (auto one = field_channel(element, owner.nodes.size(), name)) found.push_back(std::move(*one));
  return found;
}

void Histories::add_parts(const Selection& selection) {
  const Model& model = assembler_.model();
  // owners with the same channels share a table, as most elements of a type do
  std::map<std::string, std::map<std::string, Table>> kinds;
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const Model::Part& part = model.parts[p];
    const std::vector<Channel>& channels = part.element->channels();
    std::vector<int> places = selected_places(selection, true, static_cast<int>(p), channels);
    const std::vector<FieldChannel> fields = selected_fields(selection, static_cast<int>(p));
    if (places.empty() && fields.empty()) continue;
    std::string names;
    for (const int place : places) names += signature(place, channels[static_cast<std::size_t>(place)]);
    for (const auto& [channel, values] : fields)
      names += signature(static_cast<int>(values.first), channel) + fmt::format("{} {}\n", values.count, values.stride);
    Table& table = kinds[part.type][names];
    table.ids.push_back(part.element->id());
    table.owners.push_back(static_cast<int>(p));
    if (table.channels.empty()) {
      for (const int place : places) table.channels.push_back(channels[static_cast<std::size_t>(place)]);
      for (const auto& [channel, values] : fields) {
        table.channels.push_back(channel);
        table.of_fields.push_back(values);
      }
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

std::vector<std::pair<Channel, AverageValue>> Histories::selected_averages(const Selection& selection, int node,
                                                                           const Element* of) const {
  std::set<std::string> names;
  if (selection.chooses(false, node)) names = selection.channels;
  for (std::string& name : singles_of(selection, false, node)) names.insert(std::move(name));
  std::vector<std::pair<Channel, AverageValue>> found;
  const std::vector<AveragedField>& averages = fields_.averages();
  if (names.empty() || !of) return found;
  for (Channel& channel : averaged_channels(*of)) {
    if (!names.contains(channel.name)) continue;
    for (std::size_t f = 0; f < averages.size(); ++f) {
      const std::vector<std::string> known = component_names(averages[f].named.name, averages[f].components);
      const auto at = std::find(known.begin(), known.end(), channel.name);
      if (at == known.end()) continue;
      found.emplace_back(std::move(channel), AverageValue{f, static_cast<std::size_t>(at - known.begin())});
      break;
    }
  }
  return found;
}

void Histories::add_nodes(const Selection& selection) {
  const Model& model = assembler_.model();
  const std::vector<Channel> channels[2] = {node_channels(moves_, false), node_channels(moves_, true)};
  const std::vector<const Element*> averaged = elements_averaged(model);
  std::map<std::pair<std::vector<int>, std::vector<AverageValue>>, Table> variants;
  for (std::size_t n = 1; n < model.nodes.size(); ++n) {
    const auto& all = channels[supports_.supported(static_cast<int>(n)) ? 1 : 0];
    const std::vector<int> places = selected_places(selection, false, static_cast<int>(n), all);
    const auto averages = selected_averages(selection, static_cast<int>(n), averaged[n]);
    if (places.empty() && averages.empty()) continue;
    averages_ = averages_ || !averages.empty();
    std::vector<AverageValue> values;
    for (const auto& [channel, value] : averages) values.push_back(value);
    Table& table = variants[{places, values}];
    table.ids.push_back(model.nodes[n].id);
    table.owners.push_back(static_cast<int>(n));
    if (!table.channels.empty()) continue;
    for (const int place : places) table.channels.push_back(all[static_cast<std::size_t>(place)]);
    for (const auto& [channel, value] : averages) table.channels.push_back(channel);
    table.places = places;
    table.of_averages = std::move(values);
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
      const std::size_t first = column;
      for (const int place : tables_[t].places) {
        for (const auto& d : all)
          if (d.channel == place) {
            const Dimension of_source =
                d.sources.empty() ? dimension::none : element.channels()[static_cast<std::size_t>(d.sources[0])].dimension;
            known_.push_back({column, part, d, known, of_source, sources_.size(), {}});
            if (!of_motion(of_source)) known_.back().columns = kept(tables_[t], d.sources, first);
            if (known_.back().columns.empty()) sources_.resize(sources_.size() + d.sources.size());
          }
        ++column;
      }
      column += tables_[t].of_fields.size();
    }
}

const std::vector<double>& Histories::sources(const Configuration& c) {
  int seen = -1;
  if (sources_.empty() || assembler_.rank() != 0) return sources_;
  for (const Known& known : known_) {
    const std::vector<int>& channels = known.determined.sources;
    if (channels.empty() || !known.columns.empty()) continue;
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
      if (tables_[t].of_fields.empty()) continue;
      std::size_t size = 0;
      for (const Field& field : element.fields()) size += field.size(model.part(part).nodes.size());
      of_fields_.assign(size, 0.0);
      element.evaluate_fields(assembler_.view(part, c), of_fields_);
      for (const FieldValues& values : tables_[t].of_fields) own_.push_back(values.largest(of_fields_));
    }
  if (averages_) fields_.evaluate(c);
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

double Histories::average(const AverageValue& value, int node) const {
  const AveragedField& field = fields_.averages()[value.field];
  if (field.rows.empty()) return 0;  // not evaluated yet
  const auto at = [&](std::size_t point) { return field.rows[point * field.width() + value.component]; };
  const std::vector<int>& copies = fields_.points().copies();
  double found = at(static_cast<std::size_t>(node) - 1);
  for (std::size_t i = 0; i < copies.size(); ++i) {
    if (copies[i] != node) continue;
    const double other = at(assembler_.model().nodes.size() - 1 + i);
    if (std::isnan(found) || std::abs(other) > std::abs(found)) found = other;
  }
  return found;
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
      for (const AverageValue& value : tables_[t].of_averages) *out++ = average(value, index);
    }
}

}  // namespace engrane::observe
