// SPDX-License-Identifier: BSD-3-Clause
#include "app/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "app/model_json.hpp"
#include "app/version.hpp"
#include "math/rotation.hpp"

namespace engrane::app {

using namespace output;
using namespace solve;

namespace {

/// More nodes than this get histories only where a check asks; fields show the rest.
constexpr std::size_t most_observed_nodes = 64;

void add_vector(std::vector<Named>& channels, const char* prefix, Dimension d, const char* help) {
  for (const char axis : {'X', 'Y', 'Z'}) channels.push_back({fmt::format("{}{}", prefix, axis), d, help});
}

std::vector<Named> node_channels(bool moves, bool supported) {
  std::vector<Named> c;
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

std::vector<Named> run_channels(bool moves) {
  std::vector<Named> channels{{"STEP", dimension::time, "time step"},
                              {"ITERATIONS", dimension::none, "Newton iterations of the step"},
                              {"EVENTS", dimension::none, "events met since the start: teeth that begin or cease to touch"},
                              {"POTENTIAL_ENERGY", dimension::energy, "potential energy"}};
  if (moves) channels.push_back({"KINETIC_ENERGY", dimension::energy, "kinetic energy"});
  channels.push_back({"EXTERNAL_WORK", dimension::energy, "work of applied forces and drives"});
  if (moves) channels.push_back({"DISSIPATED_ENERGY", dimension::energy, "energy lost to damping"});
  channels.push_back({"ENERGY_ERROR", dimension::energy, "what the energy balance fails to close by"});
  return channels;
}

}  // namespace

Recorder::Recorder(const Reading& reading, SolverContext& context)
    : reading_(reading), context_(context), moves_(!reading.model.commands.analysis.type.is("STATIC")) {
  const Model& model = reading.model;
  const auto& commands = model.commands;
  int next = 0;
  std::map<std::pair<std::string, std::string>, std::vector<std::size_t>> kinds;
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    std::string names;
    for (const Named& channel : model.parts[p].element->channels()) names += channel.name + " ";
    if (!names.empty()) kinds[{model.parts[p].type, names}].push_back(p);
  }
  channel_begin_.assign(model.parts.size(), 0);
  std::map<std::string, int> variants;
  for (const auto& [kind, parts] : kinds) {
    const int variant = ++variants[kind.first];
    HistoryTable table{fmt::format("element/{}{}", kind.first, variant > 1 ? fmt::format("_{}", variant) : ""),
                       kind.first,
                       {},
                       model.parts[parts.front()].element->channels()};
    for (const std::size_t p : parts) {
      table.ids.push_back(model.parts[p].element->id());
      channel_begin_[p] = next;
      next += static_cast<int>(table.channels.size());
    }
    groups_.push_back(std::move(table));
  }
  std::set<int> supported, observed;
  for (const Support& s : model.supports) supported.insert(s.node);
  supported_.assign(supported.begin(), supported.end());
  if (model.nodes.size() <= most_observed_nodes + 1)
    for (std::size_t i = 1; i < model.nodes.size(); ++i) observed.insert(static_cast<int>(i));
  for (const deck::CheckCard& check : commands.checks)
    if (check.node) observed.insert(model.node_index(*check.node));
  observed.erase(-1);
  observed_nodes_.assign(observed.begin(), observed.end());
  node_begin_ = next;
  std::stable_partition(observed_nodes_.begin(), observed_nodes_.end(), [&](int node) { return !supported.contains(node); });
  for (const bool held : {false, true}) {
    HistoryTable table{held ? "node/SUPPORTED" : "node/NODE", "", {}, node_channels(moves_, held)};
    for (const int node : observed_nodes_)
      if (supported.contains(node) == held) table.ids.push_back(model.nodes[static_cast<std::size_t>(node)].id);
    if (table.ids.empty()) continue;
    next += static_cast<int>(table.columns());
    groups_.push_back(std::move(table));
  }
  run_begin_ = next;
  groups_.push_back({"run", "", {}, run_channels(moves_)});
  next += static_cast<int>(groups_.back().channels.size());
  values_.assign(static_cast<std::size_t>(next), 0.0);

  const auto& s = commands.stepping;
  frame_step_ = commands.archive.field_step.value_or((s.end - s.start) / 200);
  sample_step_ = commands.archive.history_step.value_or(0);
  next_frame_ = next_sample_ = s.start;
}

ResultsLayout Recorder::layout() const {
  const Model& model = reading_.model;
  ResultsLayout layout;
  layout.title = model.title;
  layout.analysis = model.commands.analysis.type.tag;
  layout.deck_text = deck::canonical_text(reading_.deck);
  layout.model_json = model_json(model);
  layout.version = version;
  layout.libraries = library_versions();
  layout.units = model.units;
  for (std::size_t i = 1; i < model.nodes.size(); ++i) {
    layout.node_ids.push_back(model.nodes[i].id);
    layout.points.push_back(model.nodes[i].x);
  }
  for (const Model::Part& part : model.parts) {
    Cell cell{{}, part.element->id(), false};
    for (const int node : part.nodes)
      if (node > 0 && std::find(cell.points.begin(), cell.points.end(), node - 1) == cell.points.end())
        cell.points.push_back(node - 1);
    if (!cell.points.empty()) layout.cells.push_back(std::move(cell));
  }
  layout.history = groups_;
  layout.velocities = moves_;
  const auto& s = model.commands.stepping;
  layout.expected_samples = static_cast<std::size_t>(std::min(1e9, (s.end - s.start) / std::max(s.step, sample_step_))) + 2;
  return layout;
}

int Recorder::channel(const std::string& owner, const std::string& name) const {
  std::size_t index = 0;
  for (const HistoryTable& table : groups_)
    for (std::size_t i = 0; i < table.owners(); ++i)
      for (const Named& channel : table.channels) {
        if (channel.name == name && table.owner(i) == owner) return static_cast<int>(index);
        ++index;
      }
  return -1;
}

void Recorder::observe(const Configuration& c, const StepReport& step) {
  // half a step early is on time: sums of steps do not meet sums of intervals to the last digit
  const double early = 0.5 * (step.number == 0 ? 0.0 : step.step);
  const bool last = c.time >= reading_.model.commands.stepping.end;
  // spectra want samples at equal intervals: what lies between multiples of H for an event is for energies and checks only
  sample_due_ = last || (step.regular && c.time + early >= next_sample_);
  frame_due_ = last || (step.regular && c.time + early >= next_frame_);
  if (step.regular) {
    while (sample_step_ > 0 && next_sample_ <= c.time + early) next_sample_ += sample_step_;
    while (frame_step_ > 0 && next_frame_ <= c.time + early) next_frame_ += frame_step_;
  }

  reactions_ = reactions_at(c);
  if (context_.redundancy.active() && (last || (step.number & (step.number - 1)) == 0)) find_not_unique(c);
  observe_elements(c, step);
  observe_nodes(c);
  if (frame_due_) fill_fields(c);
}

void Recorder::observe_elements(const Configuration& c, const StepReport& step) {
  Energies sum;
  const auto& parts = reading_.model.parts;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const Element& element = *parts[p].element;
    const State state = context_.assembler.view(static_cast<int>(p), c);
    const Energies e = element.energies(state);
    sum.kinetic += e.kinetic;
    sum.potential += e.potential;
    sum.external += e.external;
    sum.dissipated += e.dissipated;
    element.observe(state, std::span(values_).subspan(static_cast<std::size_t>(channel_begin_[p]), element.channels().size()));
  }
  for (const Reaction& reaction : reactions_) {
    const NodeState& node = c.nodes[static_cast<std::size_t>(reaction.node)];
    sum.external += reaction.force.dot(node.v) + reaction.torque.dot(node.R * node.W);
  }
  energies_.kinetic = sum.kinetic;
  energies_.potential = sum.potential;
  if (step.number == 0) {
    energies_.initial = sum.kinetic + sum.potential;
  } else if (!moves_) {
    energies_.external_work += static_work(before_, c);
  } else {
    const double half = 0.5 * (c.time - last_time_);
    energies_.external_work += half * (external_power_ + sum.external);
    energies_.dissipated += half * (dissipated_power_ + sum.dissipated);
  }
  energies_.largest_error = std::max(energies_.largest_error, std::abs(energies_.error()));
  external_power_ = sum.external;
  dissipated_power_ = sum.dissipated;
  last_time_ = c.time;
  double* run = values_.data() + run_begin_;
  run[0] = step.step;
  run[1] = step.newton ? step.newton->iterations : 0;
  events_ += static_cast<double>(step.events.size());
  run[2] = events_;
  run[3] = energies_.potential;
  if (moves_) {
    run[4] = energies_.kinetic;
    run[5] = energies_.external_work;
    run[6] = energies_.dissipated;
    run[7] = energies_.error();
  } else {
    run[4] = energies_.external_work;
    run[5] = energies_.error();
    before_ = c;
  }
}

double Recorder::static_work(const Configuration& from, const Configuration& to) {
  const double time = to.time - from.time;
  if (!(time > 0)) return 0;
  double work = 0;
  for (const Configuration* end : {&from, &to}) {
    Configuration c = *end;
    // a function of time may have a corner where the step ends: its slope is that of the step
    c.time += (end == &from ? 1e-8 : -1e-8) * time;
    for (std::size_t i = 0; i < c.nodes.size(); ++i) {
      c.nodes[i].v = (to.nodes[i].x - from.nodes[i].x) / time;
      // the rotation vector between the two is the same in the axes of either
      c.nodes[i].W = rotation_log(from.nodes[i].R.transpose() * to.nodes[i].R) / time;
    }
    for (std::size_t i = 0; i < c.scalars.size(); ++i) c.scalar_rates[i] = (to.scalars[i] - from.scalars[i]) / time;
    const auto& parts = reading_.model.parts;
    for (std::size_t p = 0; p < parts.size(); ++p)
      work += 0.5 * time * parts[p].element->energies(context_.assembler.view(static_cast<int>(p), c)).external;
    // reactions are those of the equilibrium, which has no dampers
    for (const Reaction& reaction : reactions_at(*end)) {
      const NodeState& node = c.nodes[static_cast<std::size_t>(reaction.node)];
      work += 0.5 * time * (reaction.force.dot(node.v) + reaction.torque.dot(node.R * node.W));
    }
  }
  return work;
}

std::vector<double> Recorder::reaction_values(const Configuration& c) {
  std::vector<double> values(values_.size(), 0.0);
  const auto& parts = reading_.model.parts;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const Element& element = *parts[p].element;
    if (element.layout().multipliers.empty()) continue;
    element.observe(context_.assembler.view(static_cast<int>(p), c),
                    std::span(values).subspan(static_cast<std::size_t>(channel_begin_[p]), element.channels().size()));
  }
  const std::vector<Reaction> reactions = reactions_at(c);
  auto at = static_cast<std::size_t>(node_begin_);
  const std::size_t plain = node_channels(moves_, false).size();
  for (const int index : observed_nodes_) {
    const auto found = std::find_if(reactions.begin(), reactions.end(), [index](const Reaction& r) { return r.node == index; });
    at += plain;
    if (found == reactions.end()) continue;
    for (const Vec3* part : {&found->force, &found->torque})
      for (Eigen::Index k = 0; k < 3; ++k) values[at++] = (*part)[k];
  }
  return values;
}

void Recorder::find_not_unique(const Configuration& c) {
  const std::vector<Eigen::VectorXd> undetermined = context_.redundancy.undetermined(c);
  if (undetermined.empty()) return;
  double size = 0;
  for (const double multiplier : c.multipliers) size = std::max(size, std::abs(multiplier));
  if (size == 0) size = 1;
  const std::vector<double> values = reaction_values(c);
  std::set<int> found(not_unique_.begin(), not_unique_.end());
  for (const Eigen::VectorXd& change : undetermined) {
    Configuration other = c;
    for (std::size_t m = 0; m < other.multipliers.size(); ++m)
      other.multipliers[m] += size * change[static_cast<Eigen::Index>(m)];
    const std::vector<double> changed = reaction_values(other);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (std::abs(changed[i] - values[i]) > 1e-7 * (size + std::abs(values[i]))) found.insert(static_cast<int>(i));
  }
  not_unique_.assign(found.begin(), found.end());
}

std::vector<Recorder::Reaction> Recorder::reactions_at(const Configuration& c) {
  std::vector<Reaction> reactions;
  if (supported_.empty()) return reactions;
  const std::vector<double> residual = context_.assembler.slot_residual(c);
  for (const int node : supported_) {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (int i = 0; i < 6; ++i) {
      const int slot = 6 * node + i;
      if (context_.numbering.equation(slot) < 0) (i < 3 ? force : moment)[i % 3] = residual[static_cast<std::size_t>(slot)];
    }
    reactions.push_back({node, force, c.nodes[static_cast<std::size_t>(node)].R * moment});
  }
  return reactions;
}

void Recorder::observe_nodes(const Configuration& c) {
  double* out = values_.data() + node_begin_;
  const auto put = [&out](const Vec3& v) { out = std::copy(v.data(), v.data() + 3, out); };
  for (const int index : observed_nodes_) {
    const NodeState& node = c.nodes[static_cast<std::size_t>(index)];
    put(node.x - reading_.model.nodes[static_cast<std::size_t>(index)].x);
    put(rotation_log(node.R));
    if (moves_) {
      put(node.v);
      put(node.R * node.W);
      put(node.a);
      put(node.R * node.A);
    }
    for (const Reaction& reaction : reactions_)
      if (reaction.node == index) {
        put(reaction.force);
        put(reaction.torque);
      }
  }
}

void Recorder::fill_fields(const Configuration& c) {
  for (auto* field : {&displacement_, &rotation_, &velocity_, &angular_, &reaction_force_, &reaction_torque_}) field->clear();
  const auto put = [](std::vector<double>& field, const Vec3& v) { field.insert(field.end(), v.data(), v.data() + 3); };
  for (std::size_t i = 1; i < c.nodes.size(); ++i) {
    const NodeState& node = c.nodes[i];
    put(displacement_, node.x - reading_.model.nodes[i].x);
    put(rotation_, rotation_log(node.R));
    if (moves_) {
      put(velocity_, node.v);
      put(angular_, node.R * node.W);
    }
    put(reaction_force_, Vec3::Zero());
    put(reaction_torque_, Vec3::Zero());
  }
  for (const Reaction& reaction : reactions_) {
    const auto at = 3 * static_cast<std::size_t>(reaction.node - 1);
    for (std::size_t k = 0; k < 3; ++k) {
      reaction_force_[at + k] = reaction.force[static_cast<Eigen::Index>(k)];
      reaction_torque_[at + k] = reaction.torque[static_cast<Eigen::Index>(k)];
    }
  }
}

FrameValues Recorder::frame() const { return {displacement_, rotation_, velocity_, angular_, reaction_force_, reaction_torque_}; }

}  // namespace engrane::app
