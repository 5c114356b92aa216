// SPDX-License-Identifier: BSD-3-Clause
#include "solve/run/restart_jump.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "model/coordinate_channels.hpp"
#include "model/speed_jumps.hpp"
#include "solve/constraints/constraint_factors.hpp"
#include "solve/constraints/diagnosis.hpp"

namespace engrane::solve {

namespace {

/// Violation that accepted positions may have, over the extent or in radians. Drifts across events and the positions beside a
/// singular one, a millionth of a step away, are closed less well than steps.
constexpr double closed = 1e-5;

/// Index of the channel of the coordinate that a multiplier drives; nothing if that is not certain.
std::optional<std::size_t> driven_channel(const Element& element, int item) {
  const auto* owner = dynamic_cast<const CoordinateChannels*>(&element);
  if (!owner) return {};
  const std::vector<Multiplier>& multipliers = element.layout().multipliers;
  const auto is_length = [&](std::size_t m) { return multipliers[m].dimension.length != 0; };
  const bool length = is_length(static_cast<std::size_t>(item));
  // drives are in the order of their coordinates, but not every coordinate has one
  std::size_t drives = 0, number = 0;
  for (std::size_t m = 0; m < multipliers.size(); ++m) {
    if (multipliers[m].role != Role::drive || is_length(m) != length) continue;
    if (m == static_cast<std::size_t>(item)) number = drives;
    ++drives;
  }
  std::vector<std::size_t> alike;
  for (int i = 0; i < owner->coordinate_count(); ++i)
    if (const auto channel = static_cast<std::size_t>(2 * i);
        (element.channels()[channel].dimension == dimension::length) == length)
      alike.push_back(channel);
  return alike.size() == drives ? std::optional(alike[number]) : std::nullopt;
}

/// "HINGE 2 stands at 0.9975 rad and its drive asks for 1.1975 rad".
std::string explain_drive(const SolverContext& context, const Configuration& c, const Unknown& u, double open,
                          const std::string& unit) {
  const Model::Part& part = context.model.parts[static_cast<std::size_t>(u.part)];
  const std::string name = part.name();
  const std::optional<std::size_t> channel = driven_channel(*part.element, u.item);
  if (!channel)
    return fmt::format("{} stands {:.6g} {} from where its drive ({}) asks it to be", name, std::abs(open), unit,
                       multiplier_of(context.model, u).name);
  std::vector<double> values(part.element->channels().size());
  part.element->observe(context.assembler.view(u.part, c), values);
  const double at = values[*channel];
  return fmt::format("{} stands at {:.6g} {} and its drive asks for {:.6g} {}", name, at, unit, at - open, unit);
}

/// Another place of a support whose displacement is a function of time; empty if there is none. Rotations are left out: several
/// of one node have no components.
std::string explain_support(const SolverContext& context, const Configuration& c, double allowed) {
  for (const MotionSlots::Prescribed& p : context.motion.prescribed(c.time)) {
    const std::size_t node = p.slot / 6, component = p.slot % 6;
    if (node >= c.nodes.size() || component > 2) continue;
    const auto k = static_cast<Eigen::Index>(component);
    const double stands = c.nodes[node].x[k] - context.model.nodes[node].x[k];
    if (std::abs(stands - p.u) <= allowed) continue;
    const std::string unit = context.model.units.label(dimension::length);
    return fmt::format("the support of node {} ({}) stands at {:.6g} {} and its function asks for {:.6g} {}",
                       context.model.nodes[node].id, "xyz"[component], stands, unit, p.u, unit);
  }
  return {};
}

}  // namespace

std::string explain_jump(SolverContext& context, const Configuration& c) {
  const Numbering& numbering = context.numbering;
  const std::vector<double> phi = context.assembler.violations(c);
  // far from the origin the digits of positions are fewer
  double far = context.model.extent();
  for (const NodeState& node : c.nodes) far = std::max(far, node.x.norm());
  const double allowed = std::max(closed, 10 * context.options.precision);
  int widest = -1;
  double most = 1;
  bool of_drive = false;
  for (std::size_t m = 0; m < phi.size(); ++m) {
    const auto index = static_cast<int>(m);
    // redundant constraints follow from the others, and a step that opens them says so
    if (context.assembler.released(index) || numbering.equation(numbering.motion_slots() + index) < 0) continue;
    const Unknown& u = numbering.multiplier(index);
    const double open = std::abs(phi[m]) / (allowed * (u.measure == Measure::length ? far : 1.0));
    const bool drive = is_drive(context.model, u);
    // a drive that jumps is more often the cause than a joint
    if (!(open > 1) || (of_drive && !drive) || (drive == of_drive && !(open > most))) continue;
    widest = index;
    most = open;
    of_drive = drive;
  }
  const std::string cure =
      "A motion cannot jump: give functions that begin where the restart point stands, or run from the start without RESTART";
  if (widest < 0) {
    const std::string support = explain_support(context, c, allowed * far);
    return support.empty() ? support : fmt::format("{} at t = {:.6g}. {}", support, c.time, cure);
  }
  const Unknown& u = numbering.multiplier(widest);
  const double open = phi[static_cast<std::size_t>(widest)];
  const std::string unit = context.model.units.label(u.measure == Measure::length ? dimension::length : dimension::angle);
  if (of_drive) return fmt::format("{} at t = {:.6g}. {}", explain_drive(context, c, u, open, unit), c.time, cure);
  return fmt::format("{} is open by {:.4g} {} at t = {:.6g}. {}",
                     numbering.describe(numbering.equation(numbering.motion_slots() + widest)), std::abs(open), unit, c.time,
                     cure);
}

void save_speeds(const std::vector<ValueAndRate>& speeds, Snapshot& snapshot) {
  std::vector<double> flat;
  for (const ValueAndRate& speed : speeds) flat.insert(flat.end(), {speed.value, speed.rate});
  snapshot.put("runner/speeds", std::move(flat));
}

std::vector<ValueAndRate> load_speeds(const Model& model, const Snapshot& snapshot, double time) {
  std::vector<ValueAndRate> speeds = imposed_speeds(model, number_before(time));
  const std::vector<double>& flat = snapshot.array("runner/speeds");
  if (flat.size() != 2 * speeds.size()) return speeds;  // other supports: the speeds are those of the present functions
  for (std::size_t i = 0; i < speeds.size(); ++i) speeds[i] = {flat[2 * i], flat[2 * i + 1]};
  return speeds;
}

}  // namespace engrane::solve
