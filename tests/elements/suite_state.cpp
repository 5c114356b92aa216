// SPDX-License-Identifier: BSD-3-Clause
// States, elements and functions to test with.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "elements/suite.hpp"
#include "math/rotation.hpp"

namespace engrane::suite {

namespace {
using Vector = std::vector<double>;
}

double uniform(Random& random) { return std::uniform_real_distribution<double>(-1, 1)(random); }

Vec3 uniform_vector(Random& random) {
  const double a = uniform(random), b = uniform(random), c = uniform(random);
  return {a, b, c};
}

Mat3 uniform_rotation(Random& random) {
  std::normal_distribution<double> normal;
  const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
  return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}

Vec3 uniform_vector(const Subject& subject, Random& random) {
  Vec3 v = uniform_vector(random);
  if (subject.in_plane) v[2] = 0;
  return v;
}

Mat3 uniform_rotation(const Subject& subject, Random& random) {
  return subject.in_plane ? rotation_exp(Vec3(std::numbers::pi * uniform(random) * Vec3::UnitZ())) : uniform_rotation(random);
}

StateBuffer::StateBuffer(const Element& element, const NodeMap& places) {
  const Layout& layout = element.layout();
  ids.assign(element.node_ids().begin(), element.node_ids().end());
  nodes.resize(ids.size());
  start_R.assign(ids.size(), Mat3::Identity());
  y.assign(ids.size(), Vec3::Zero());
  for (std::size_t i = 0; i < ids.size(); ++i)
    if (ids[i] != 0) nodes[i].x = places.at(ids[i]);
  scalars.assign(layout.scalars.size(), 0.0);
  scalar_rates = scalar_accelerations = scalars;
  multipliers.assign(layout.multipliers.size(), 0.0);
  history.assign(static_cast<std::size_t>(layout.history), 0.0);
  element.start(scalars, history);
}

State StateBuffer::view() const {
  State s;
  s.nodes = nodes;
  s.scalars = scalars;
  s.scalar_rates = scalar_rates;
  s.scalar_accelerations = scalar_accelerations;
  s.multipliers = multipliers;
  s.history = history;
  s.time = time;
  s.gravity = gravity;
  s.penalty = penalty;
  return s;
}

void StateBuffer::commit(const Element& element) {
  std::vector<double> committed_scalars = scalars, committed_history = history;
  element.commit(view(), committed_scalars, committed_history);
  scalars = committed_scalars;
  history = committed_history;
}

void StateBuffer::turn(std::size_t i, const Mat3& from, const Vec3& by) {
  const Vec3 vector = by;  // may view y[i]
  start_R[i] = from;
  y[i] = vector;
  nodes[i].R = start_R[i] * rotation_exp(vector);
  nodes[i].T = rotation_tangent(vector);
}

void StateBuffer::add(std::size_t slot, Level level, double amount) {
  if (slot < 6 * nodes.size()) {
    const std::size_t i = slot / 6;
    const auto c = static_cast<Eigen::Index>(slot % 3);
    NodeState& node = nodes[i];
    const bool translation = slot % 6 < 3;
    if (level == Level::velocity) {
      (translation ? node.v : node.W)[c] += amount;
    } else if (level == Level::acceleration) {
      (translation ? node.a : node.A)[c] += amount;
    } else if (translation) {
      node.x[c] += amount;
    } else {
      Vec3 vector = y[i];
      vector[c] += amount;
      turn(i, Mat3(start_R[i]), vector);
    }
    return;
  }
  slot -= 6 * nodes.size();
  if (slot < scalars.size()) {
    (level == Level::position ? scalars : level == Level::velocity ? scalar_rates : scalar_accelerations)[slot] += amount;
    return;
  }
  // a multiplier has no rates, and its column is the same in every tangent
  multipliers[slot - scalars.size()] += amount;
}

double StateBuffer::velocity(std::size_t slot) const {
  if (slot >= 6 * nodes.size()) return scalar_rates[slot - 6 * nodes.size()];
  const NodeState& node = nodes[slot / 6];
  return (slot % 6 < 3 ? node.v : node.W)[static_cast<Eigen::Index>(slot % 3)];
}

StateBuffer StateBuffer::after(double t) const {
  StateBuffer later = *this;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    NodeState& node = later.nodes[i];
    const NodeState& now = nodes[i];
    node.x = now.x + t * now.v + 0.5 * t * t * now.a;
    node.v = now.v + t * now.a;
    later.turn(i, now.R, t * now.W + 0.5 * t * t * now.A);
    node.W = node.T * (now.W + t * now.A);
  }
  for (std::size_t i = 0; i < scalars.size(); ++i) {
    later.scalars[i] = scalars[i] + t * scalar_rates[i] + 0.5 * t * t * scalar_accelerations[i];
    later.scalar_rates[i] = scalar_rates[i] + t * scalar_accelerations[i];
  }
  later.time = time + t;
  return later;
}

StateBuffer random_state(const Subject& s, const Element& element, Random& random) {
  StateBuffer state(element, s.nodes);
  for (std::size_t i = 0; i < state.nodes.size(); ++i) {
    if (state.is_ground(i)) continue;
    NodeState& node = state.nodes[i];
    node.x += s.length * uniform_vector(s, random);
    node.v = s.velocity * uniform_vector(s, random);
    node.a = s.velocity * s.velocity / s.length * uniform_vector(s, random);
    node.W = s.velocity / s.length * uniform_vector(random);
    node.A = std::pow(s.velocity / s.length, 2) * uniform_vector(random);
    const Vec3 axis = uniform_vector(random).normalized();
    state.turn(i, rotation_exp(s.turn * std::abs(uniform(random)) * axis), 0.4 * uniform_vector(random));
  }
  for (std::size_t i = 0; i < state.scalars.size(); ++i) {
    state.scalars[i] += s.scalar * uniform(random);
    state.scalar_rates[i] = s.scalar * s.velocity / s.length * uniform(random);
    state.scalar_accelerations[i] = s.scalar * std::pow(s.velocity / s.length, 2) * uniform(random);
  }
  for (double& multiplier : state.multipliers) multiplier = s.force * uniform(random);
  state.time = std::abs(uniform(random)) * s.length / s.velocity;
  state.gravity = uniform_vector(s, random);
  state.penalty = s.penalty;
  if (s.adjust) s.adjust(state, random);
  return state;
}

namespace {

/// For each slot of the element its place where every node has six; what it does not ask for is zero there.
std::vector<std::size_t> full_places(const Layout& layout) {
  std::vector<std::size_t> places;
  const std::size_t nodes = layout.nodes.size();
  for (std::size_t i = 0; i < nodes; ++i)
    for (std::size_t c = 0; c < 6; ++c)
      if (layout.has(i, static_cast<int>(c))) places.push_back(6 * i + c);
  for (std::size_t i = 0; places.size() < static_cast<std::size_t>(layout.slots()); ++i) places.push_back(6 * nodes + i);
  return places;
}

std::size_t full_count(const Layout& layout) {
  return 6 * layout.nodes.size() + layout.scalars.size() + layout.multipliers.size();
}

}  // namespace

std::vector<double> residual_of(const Element& element, const StateBuffer& state) {
  const auto places = full_places(element.layout());
  Vector r(places.size(), std::numeric_limits<double>::quiet_NaN()), full(full_count(element.layout()), 0.0);
  element.residual(state.view(), r);
  for (std::size_t i = 0; i < r.size(); ++i) full[places[i]] = r[i];
  return full;
}

std::vector<double> tangent_of(const Element& element, const StateBuffer& state, Weights weights, std::vector<double>* residual) {
  const auto places = full_places(element.layout());
  const std::size_t n = places.size(), count = full_count(element.layout());
  Vector r(n), k(n * n, std::numeric_limits<double>::quiet_NaN()), full(count * count, 0.0);
  element.tangent(state.view(), weights, r, k);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) full[places[i] * count + places[j]] = k[i * n + j];
  if (residual) {
    residual->assign(count, 0.0);
    for (std::size_t i = 0; i < n; ++i) (*residual)[places[i]] = r[i];
  }
  return full;
}

double channel_of(const Element& element, const StateBuffer& state, const std::string& name) {
  const auto& channels = element.channels();
  Vector values(channels.size());
  element.observe(state.view(), values);
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (channels[i].name == name) return values[i];
  ADD_FAILURE() << "no channel " << name;
  return 0;
}

double derived_of(const Element& element, const std::string& name) {
  for (const Derived& d : element.derived())
    if (d.name == name) return d.value;
  ADD_FAILURE() << "nothing derived of the name " << name;
  return 0;
}

Function::Jet Wave::at(double t) const {
  const double s = amplitude_ * std::sin(rate_ * t + phase_), c = amplitude_ * std::cos(rate_ * t + phase_);
  return {mean_ + s, rate_ * c, -rate_ * rate_ * s, -rate_ * rate_ * rate_ * c};
}

double Wave::integral(double t) const {
  return mean_ * t + amplitude_ / rate_ * (std::cos(phase_) - std::cos(rate_ * t + phase_));
}

std::unique_ptr<Element> build_record(const ElementType& type, std::any data, const NodeMap& nodes, const BuildOptions& options) {
  static const FunctionMap none;
  deck::Record record;
  record.schema = &type.schema;
  record.id = options.id;
  record.data = std::move(data);
  Diagnostics own;
  Diagnostics& diagnostics = options.diagnostics ? *options.diagnostics : own;
  const FunctionMap& functions = options.functions ? *options.functions : none;
  BuildContext context{nodes, functions, diagnostics, record, options.wheel_inertia, options.records, {}, options.blocks};
  context.temperatures = options.temperatures;
  std::vector<std::unique_ptr<Element>> others;
  context.find_element = [&](int id) -> BuildContext::Found {
    if (!options.records) return {};
    for (const deck::Record& other : *options.records) {
      if (other.id != id) continue;
      const auto& types = element_types();
      const auto its =
          std::find_if(types.begin(), types.end(), [&](const auto& t) { return t.schema.name == other.schema->name; });
      Diagnostics unheard;
      BuildContext alone{nodes, functions, unheard, other, options.wheel_inertia};
      others.push_back(its == types.end() ? nullptr : its->build(alone));
      return {&other, others.back().get(), !others.back()};
    }
    return {};
  };
  auto element = type.build(context);
  for (const Diagnostic& d : own.all())
    if (d.severity == Severity::error) ADD_FAILURE() << type.schema.name << ": " << d.message << " (" << d.hint << ")";
  return element;
}

NodeMap turned(const NodeMap& nodes, const Mat3& turn) {
  NodeMap result;
  for (const auto& [id, x] : nodes) result[id] = turn * x;
  return result;
}

}  // namespace engrane::suite
