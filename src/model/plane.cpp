// SPDX-License-Identifier: BSD-3-Clause
#include "model/plane.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <set>
#include <tuple>
#include <utility>

#include "math/sparse_qr.hpp"
#include "model/model.hpp"
#include "model/pulses.hpp"

namespace engrane {

namespace {

/// Duration of the run; the step for a single equilibrium.
double span_of(const deck::SteppingCard& stepping) {
  return stepping.end > stepping.start ? stepping.end - stepping.start : stepping.step;
}

/// Residues of cancelling terms below this fraction of them are rounding errors.
constexpr double residue = 1e-12;

/// A configuration in the plane: every node displaced within it by a random amount, with a random velocity.
struct Probe {
  std::vector<NodeState> nodes;
  double time = 0;
  double homotopy = 0;
};

/// When functions of time are largest, and when they change fastest: a load or a drive may act for a short part of the run.
std::set<double> busiest_times(const Model& model) {
  constexpr int samples = 500;
  constexpr std::size_t most_corners = 1'000'000;
  const double begin = model.commands.stepping.start, end = begin + span_of(model.commands.stepping);
  std::set<double> busiest;
  for (const Function* function : model.of_time) {
    std::vector<double> times = function->corners(begin, end, most_corners);
    for (const double t : short_pulses(*function, begin, end, end - begin)) times.push_back(t);
    for (int i = 0; i <= samples; ++i) times.push_back(begin + (end - begin) * i / samples);
    std::sort(times.begin(), times.end());
    const std::size_t count = times.size();
    for (std::size_t i = 1; i < count; ++i) times.push_back(0.5 * (times[i - 1] + times[i]));
    double largest = 0, steepest = 0;
    std::optional<double> at_largest, at_steepest;
    for (const double t : times) {
      const Function::Jet f = function->at(t);
      if (std::abs(f.f) > largest) std::tie(largest, at_largest) = std::pair(std::abs(f.f), t);
      if (std::abs(f.d1) > steepest) std::tie(steepest, at_steepest) = std::pair(std::abs(f.d1), t);
    }
    for (const auto& time : {at_largest, at_steepest})
      if (time) busiest.insert(*time);
  }
  return busiest;
}

/// Configurations as different as in a run: the reference with open gaps and with all contacts closed, one near it, and two far
/// away; and the reference whenever loads and drives do most.
std::vector<Probe> probes(const Model& model, int normal) {
  struct Shape {
    double move, turn, homotopy;
  };
  const std::set<double> busiest = busiest_times(model);
  std::vector<Shape> shapes{{0, 0, 0}, {0, 0, 1}, {1e-3, 0.02, 0}, {0.1, 0.7, 1}, {0.2, 3, 0}};
  const std::size_t others = shapes.size();
  shapes.resize(others + busiest.size(), {0, 0, 0});
  std::mt19937 generator(5);  // fixed seed: the same in every run
  std::uniform_real_distribution<double> any(-1, 1);
  const deck::SteppingCard& stepping = model.commands.stepping;
  const double span = span_of(stepping), extent = model.extent(), rate = 10 / span;
  const int first = (normal + 1) % 3, second = (normal + 2) % 3;
  std::vector<Probe> all;
  auto busy = busiest.begin();
  for (const Shape& shape : shapes) {
    Probe probe{std::vector<NodeState>(model.nodes.size()), stepping.start, shape.homotopy};
    if (all.size() >= others) probe.time = *busy++;
    if (shape.move > 0) probe.time += 0.5 * (1 + any(generator)) * span;
    for (std::size_t i = 0; i < probe.nodes.size(); ++i) {
      NodeState& node = probe.nodes[i];
      node.x = model.nodes[i].x;
      if (i == 0) continue;
      for (const int c : {first, second}) {
        node.x[c] += shape.move * extent * any(generator);
        node.v[c] = extent * rate * any(generator);
        node.a[c] = extent * rate * rate * any(generator);
      }
      const double angle = shape.turn * any(generator);
      node.R(first, first) = node.R(second, second) = std::cos(angle);
      node.R(second, first) = std::sin(angle);
      node.R(first, second) = -node.R(second, first);
      node.W[normal] = rate * any(generator);
      node.A[normal] = rate * rate * any(generator);
    }
    all.push_back(std::move(probe));
  }
  return all;
}

/// Largest in-plane and out-of-plane magnitudes over all probes.
struct Parts {
  double in = 0, out = 0;
  void add(bool leaves, double size) {
    if (!std::isfinite(size)) return;  // the probe is outside the domain of the element
    double& largest = leaves ? out : in;
    largest = std::max(largest, std::abs(size));
  }
  bool acts_in() const { return in > residue * out; }
  bool acts_out() const { return out > residue * in; }
};

/// Examines one element after another.
class Examination {
 public:
  Examination(const Model& model, int normal) : model_(model), normal_(normal), probes_(probes(model, normal)) {
    plane_.normal = normal;
  }

  std::vector<PlaneFault> run(std::size_t most) {
    look_at_conditions();
    // without constraints nothing balances out-of-plane forces
    const bool carried = std::any_of(model_.parts.begin(), model_.parts.end(),
                                     [](const Model::Part& part) { return !part.element->layout().multipliers.empty(); });
    for (const Model::Part& part : model_.parts) {
      if (faults_.size() >= most || (most == 1 && !carried && !pushed_.empty())) break;
      look_at(part);
    }
    if (faults_.empty() && !pushed_.empty()) look_at_what_carries();
    if (faults_.size() > most) faults_.resize(most);
    return std::move(faults_);
  }

  PlaneModel take() { return std::move(plane_); }

 private:
  const char* name() const { return plane_name(normal_); }
  char axis() const { return "xyz"[normal_]; }
  void fault(const Location& location, std::string what, std::string hint) {
    faults_.push_back({location, std::move(what), std::move(hint)});
  }
  std::string node_name(int node) const { return fmt::format("node {}", model_.node(node).id); }
  bool leaves(int component) const { return plane_.leaves_out(component); }

  /// Checks supports, initial values and gravity.
  void look_at_conditions() {
    for (const Support& s : model_.supports)
      if (leaves(s.component) && s.value != 0)
        fault({},
              fmt::format("{} is prescribed a displacement out of the plane {} (component {})", node_name(s.node), name(),
                          s.component + 1),
              "prescribe displacements in the plane only");
    for (const InitialValue& v : model_.initial)
      if (leaves(v.component) && v.value != 0)
        fault({},
              fmt::format("the initial {} of {} leads out of the plane {} (component {})",
                          v.velocity ? "velocity" : "displacement", node_name(v.node), name(), v.component + 1),
              "leave that component out");
    for (const InitialSpin& s : model_.initial_spins)
      if (!(std::hypot(s.omega[(normal_ + 1) % 3], s.omega[(normal_ + 2) % 3]) <= residue * s.omega.norm()))
        fault({}, fmt::format("the initial spin of {} leads out of the plane {}", node_name(s.node), name()),
              fmt::format("its AXIS must be along {}", axis()));
    for (const InitialCoordinate& one : model_.initial_coordinates)
      if (one.value != 0) look_at_coordinate(one);
    for (const Gravity& g : model_.gravity)
      if (std::abs(g.acceleration[normal_]) > residue * g.acceleration.norm())
        fault({}, fmt::format("gravity has a component normal to the plane {}", name()), "leave that component out");
  }

  /// A coordinate whose rate is zero whatever the velocities in the plane are can only change out of it.
  void look_at_coordinate(const InitialCoordinate& one) {
    const Model::Part& part = model_.part(one.part);
    const auto channel = static_cast<std::size_t>(one.channel);
    const std::vector<Channel>& channels = part.element->channels();
    prepare(part);
    std::vector<double> values(channels.size());
    part.element->observe(view(part, probes_.front()), values);
    const double size = channels[channel].dimension.length == 0 ? 1 : model_.extent();
    if (!(std::abs(values[channel + 1]) <= residue * size / span_of(model_.commands.stepping))) return;
    fault(one.location,
          fmt::format("the initial {} of {} leads out of the plane {}", channels[channel + (one.velocity ? 1 : 0)].name,
                      part.name(), name()),
          "leave it out, or solve in space (PLANE NO)");
  }

  State view(const Model::Part& part, const Probe& probe) const {
    State state;
    state.nodes = {probe.nodes, part.nodes};
    state.scalars = scalars_;
    state.scalar_rates = rates_;
    state.scalar_accelerations = accelerations_;
    state.multipliers = multipliers_;
    state.history = history_;
    state.time = probe.time;
    state.h = model_.commands.stepping.step;
    state.gravity = model_.gravity_at(probe.time);
    state.contact_homotopy = probe.homotopy;
    return state;
  }

  void prepare(const Model::Part& part) {
    const Layout& layout = part.element->layout();
    scalars_.assign(layout.scalars.size(), 0);
    history_.assign(static_cast<std::size_t>(layout.history), 0);
    multipliers_.assign(layout.multipliers.size(), 0);
    part.element->start(scalars_, history_);
    rates_.assign(scalars_.size(), 0);
    accelerations_.assign(scalars_.size(), 0);
    for (std::size_t i = 0; i < scalars_.size(); ++i) {
      const double size = layout.scalars[i].dimension.length == 0 ? 0.1 : 1e-3 * model_.extent();
      scalars_[i] += size * std::cos(1.0 + static_cast<double>(i));
      rates_[i] = size * std::cos(2.0 + static_cast<double>(i));
      accelerations_[i] = size * std::cos(3.0 + static_cast<double>(i));
    }
    // component of each node slot; −1: of the ground, or not of a node
    components_.assign(static_cast<std::size_t>(layout.slots()), -1);
    nodes_.assign(components_.size(), 0);
    std::size_t slot = 0;
    for (std::size_t i = 0; i < layout.needs.size(); ++i)
      for (int c = 0; c < 6; ++c)
        if (layout.has(i, c)) {
          nodes_[slot] = part.nodes[i];
          components_[slot++] = part.nodes[i] == 0 ? -1 : c;
        }
    r_.assign(components_.size(), 0);
  }

  void look_at(const Model::Part& part) {
    const Layout& layout = part.element->layout();
    const std::size_t count = layout.multipliers.size();
    if (!layout.shares_multipliers) {
      plane_.out_of_plane.resize(plane_.out_of_plane.size() + count, false);
      gradients_.assign(count, {});
    }
    const std::size_t begin = plane_.out_of_plane.size() - count;
    prepare(part);
    if (count > 0 && !look_at_constraints(part, begin)) return;
    look_at_forces(part, begin);
  }

  /// Finds the constraints that act in the plane, from their gradients, and checks that all others are satisfied; returns false
  /// with a fault. A constraint that acts both in and out of plane counts as in-plane and exerts out-of-plane forces.
  bool look_at_constraints(const Model::Part& part, std::size_t begin) {
    const Layout& layout = part.element->layout();
    const std::size_t n = components_.size(), count = layout.multipliers.size(), first = n - count;
    std::vector<Parts> open(count);
    std::vector<double> k(n * n), phi(count), rate(count), second(count);
    const double extent = model_.extent(), span = span_of(model_.commands.stepping);
    for (const Probe& probe : probes_) {
      part.element->tangent(view(part, probe), {1, 0, 0, 0}, r_, k);
      part.element->constraint_rates(view(part, probe), phi, rate, second);
      for (std::size_t m = 0; m < count; ++m) {
        const bool holds = layout.multipliers[m].role != Role::grip;  // friction at rest gives way
        for (std::size_t j = 0; j < first; ++j) {
          const int c = components_[j];
          const double value = k[(first + m) * n + j];
          if (c >= 0) {
            gradients_[m].add(leaves(c), c < 3 ? value * extent : value);
            if (&probe == probes_.data() && holds && leaves(c) && value != 0)
              gradient_.emplace_back(6 * nodes_[j] + c, static_cast<int>(begin + m), c < 3 ? value * extent : value);
          } else if (j >= static_cast<std::size_t>(layout.node_slots()))
            gradients_[m].add(
                false,
                value * (layout.scalars[j - static_cast<std::size_t>(layout.node_slots())].dimension.length == 0 ? 1 : extent));
        }
        const double size = layout.multipliers[m].dimension.length == 0 ? 1 : extent;
        open[m].in = size;
        for (const double value : {phi[m], rate[m] * span, second[m] * span * span}) open[m].add(true, value);
      }
    }
    for (std::size_t m = 0; m < count; ++m) {
      const Multiplier& multiplier = layout.multipliers[m];
      const bool out = gradients_[m].out > 0 && !gradients_[m].acts_in();
      plane_.out_of_plane[begin + m] = out;
      if (!out || multiplier.role == Role::grip || !open[m].acts_out()) continue;
      fault(part.location,
            fmt::format("{} moves its nodes out of the plane {}: its {} is not zero there", part.name(), name(),
                        multiplier.help.empty() ? multiplier.name : multiplier.help),
            fmt::format("put its nodes at the same {}, its axes along {} or in the plane, and drive it in the plane only", axis(),
                        axis()));
      return false;
    }
    return true;
  }

  /// Trial value of a multiplier: the magnitude of the element's own forces, if any.
  double multiplier_size(const Multiplier& multiplier, double forces) const {
    return (forces > 0 ? forces : 1) / (multiplier.dimension.length == 0 ? 1 : model_.extent());
  }

  /// Checks whether forces and moments stay in the plane, whatever the multipliers of the in-plane constraints.
  void look_at_forces(const Model::Part& part, std::size_t begin) {
    const Layout& layout = part.element->layout();
    const double extent = model_.extent();
    Parts forces;
    double largest = 0;
    std::size_t worst = 0;
    for (const Probe& probe : probes_)
      for (const bool carries : {false, true}) {
        if (carries && multipliers_.empty()) continue;
        for (std::size_t m = 0; m < multipliers_.size(); ++m)
          multipliers_[m] = carries && !plane_.out_of_plane[begin + m]
                                ? multiplier_size(layout.multipliers[m], forces.in) * std::cos(4.0 + 3.0 * static_cast<double>(m))
                                : 0;
        part.element->residual(view(part, probe), r_);
        for (std::size_t i = 0; i < static_cast<std::size_t>(layout.node_slots()); ++i) {
          const int c = components_[i];
          if (c < 0) continue;
          const double size = std::abs(c < 3 ? r_[i] * extent : r_[i]);
          forces.add(leaves(c), size);
          if (leaves(c) && size > largest) {
            largest = size;
            worst = i;
          }
        }
      }
    if (forces.acts_out()) {
      const int c = components_[worst];
      PlaneFault pushes{part.location,
                        fmt::format("{} is not of the plane {}: it {} {} {} {}", part.name(), name(), c < 3 ? "pushes" : "turns",
                                    node_name(nodes_[worst]), c < 3 ? "along" : "about", "xyz"[c % 3]),
                        hint_for(part)};
      // joints cannot justify loads given out of plane
      (part.element->is_load() ? faults_ : pushed_).push_back(std::move(pushes));
    }
    look_at_friction(part, begin, forces.in);
  }

  /// In-plane forces must not depend on out-of-plane reactions, which are unknown in the plane problem.
  void look_at_friction(const Model::Part& part, std::size_t begin, double forces) {
    const Layout& layout = part.element->layout();
    if (!layout.has_friction()) return;
    std::vector<double> before(layout.grips.size()), after(before.size()), first;
    bool follows = false;
    for (const Probe& probe : probes_) {
      for (const bool carries : {false, true}) {
        for (std::size_t m = 0; m < multipliers_.size(); ++m)
          multipliers_[m] = carries || !plane_.out_of_plane[begin + m]
                                ? multiplier_size(layout.multipliers[m], forces) * std::cos(4.0 + 3.0 * static_cast<double>(m))
                                : 0;
        first = r_;
        part.element->residual(view(part, probe), r_);
        part.element->grip_limits(view(part, probe), carries ? after : before);
      }
      for (std::size_t i = 0; i < static_cast<std::size_t>(layout.node_slots()); ++i)
        if (components_[i] >= 0 && !leaves(components_[i]))
          follows = follows || std::abs(r_[i] - first[i]) > 1e-9 * std::abs(r_[i]);
      for (std::size_t i = 0; i < before.size(); ++i)
        follows = follows || std::abs(after[i] - before[i]) > 1e-9 * std::abs(before[i]);
    }
    if (follows)
      rubbed_.push_back({part.location,
                         fmt::format("the friction of {} follows from forces out of the plane {}", part.name(), name()),
                         "leave out its friction, or remove what pushes out of the plane"});
  }

  /// If elements exert out-of-plane forces: checks whether constraints that act only out of plane restrain all nodes there.
  void look_at_what_carries() {
    faults_ = rubbed_;
    const std::vector<int> slots = slots_out_of_plane(model_, plane_);
    std::vector<int> row(6 * model_.nodes.size(), -1);
    for (std::size_t i = 0; i < slots.size(); ++i) row[static_cast<std::size_t>(slots[i])] = static_cast<int>(i);
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto& entry : gradient_)
      if (const int at = row[static_cast<std::size_t>(entry.row())];
          at >= 0 && plane_.out_of_plane[static_cast<std::size_t>(entry.col())])
        entries.emplace_back(entry.col(), at, entry.value());
    Eigen::SparseMatrix<double> gradient(static_cast<Eigen::Index>(plane_.out_of_plane.size()),
                                         static_cast<Eigen::Index>(slots.size()));
    gradient.setFromTriplets(entries.begin(), entries.end());
    gradient.makeCompressed();
    for (Eigen::Index j = 0; j < gradient.cols(); ++j)
      if (const double length = gradient.col(j).norm(); length > 0) gradient.col(j) /= length;
    const bool held = gradient.rows() >= gradient.cols() && rank_of(gradient, 1e-9) == gradient.cols();
    if (!held) {
      for (PlaneFault& fault : pushed_) fault.what += ", and no joints hold all nodes against that";
      faults_.insert(faults_.begin(), pushed_.begin(), pushed_.end());
    }
    plane_.carries = true;
  }

  std::string hint_for(const Model::Part& part) const {
    if (part.element->is_load()) return fmt::format("give it forces in the plane and moments about {} only", axis());
    if (part.element->is_body())
      return fmt::format("its nodes and its centre of mass must be at the same {0}, and {0} be a principal axis of its inertia",
                         axis());
    return fmt::format(
        "its axes must be along {0} or in the plane, its nodes at the same {0}; helical, bevel and crossed gears act in space",
        axis());
  }

  const Model& model_;
  int normal_;
  std::vector<Probe> probes_;
  PlaneModel plane_;
  std::vector<PlaneFault> faults_;
  std::vector<PlaneFault> pushed_, rubbed_;       ///< faults unless joints carry the forces, and faults if they must
  std::vector<Eigen::Triplet<double>> gradient_;  ///< out-of-plane entries of the Jacobian of what holds, by slot and multiplier
  std::vector<Parts> gradients_;                  ///< of the current own multipliers, over all elements that share them
  // of the current element
  std::vector<double> scalars_, rates_, accelerations_, multipliers_, history_, r_;
  std::vector<int> components_, nodes_;
};

}  // namespace

const char* plane_name(int normal) {
  static constexpr const char* names[] = {"YZ", "ZX", "XY"};
  return names[normal];
}

std::vector<PlaneFault> examine_plane(const Model& model, int normal, std::size_t most, PlaneModel& plane) {
  Examination examination(model, normal);
  std::vector<PlaneFault> faults = examination.run(most);
  if (faults.empty()) plane = examination.take();
  return faults;
}

PlaneModel find_plane(const Model& model) {
  PlaneModel best;
  std::size_t most = 0;
  for (const int normal : {2, 0, 1}) {
    PlaneModel plane;
    if (!examine_plane(model, normal, 1, plane).empty()) continue;
    const PlaneSaving saving = plane_saving(model, plane);
    if (best.active() && saving.motions + saving.multipliers <= most) continue;
    most = saving.motions + saving.multipliers;
    best = std::move(plane);
  }
  return best;
}

bool asks_plane_cells_for_z(const Model& model) {
  const auto is_cell = [](const Model::Part& part) { return part.element->cell_shape() != CellShape::none; };
  std::vector<bool> flat(model.nodes.size(), false);
  for (const Model::Part& part : model.parts)
    for (std::size_t i = 0; i < part.nodes.size() && is_cell(part); ++i)
      if (!part.element->layout().has(i, 2)) flat[static_cast<std::size_t>(part.nodes[i])] = true;
  return std::any_of(model.parts.begin(), model.parts.end(), [&](const Model::Part& part) {
    if (is_cell(part)) return false;
    bool touches = false, moves_along_z = false;  // a link may do both at different nodes
    for (std::size_t i = 0; i < part.nodes.size(); ++i) {
      touches = touches || flat[static_cast<std::size_t>(part.nodes[i])];
      moves_along_z = moves_along_z || (part.nodes[i] > 0 && part.element->layout().has(i, 2));
    }
    return touches && moves_along_z;
  });
}

std::vector<int> slots_out_of_plane(const Model& model, const PlaneModel& plane) {
  std::vector<bool> needed(6 * model.nodes.size(), false);
  for (const Model::Part& part : model.parts)
    for (std::size_t i = 0; i < part.nodes.size(); ++i)
      for (int c = 0; c < 6; ++c)
        if (part.nodes[i] > 0 && part.element->layout().has(i, c)) needed[static_cast<std::size_t>(6 * part.nodes[i] + c)] = true;
  for (const Support& s : model.supports) needed[static_cast<std::size_t>(6 * s.node + s.component)] = false;
  std::vector<int> slots;
  for (std::size_t slot = 0; slot < needed.size(); ++slot)
    if (needed[slot] && plane.leaves_out(static_cast<int>(slot % 6))) slots.push_back(static_cast<int>(slot));
  return slots;
}

PlaneSaving plane_saving(const Model& model, const PlaneModel& plane) {
  return {slots_out_of_plane(model, plane).size(),
          static_cast<std::size_t>(std::count(plane.out_of_plane.begin(), plane.out_of_plane.end(), true))};
}

}  // namespace engrane
