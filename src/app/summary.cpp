// SPDX-License-Identifier: BSD-3-Clause
#include "app/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "math/angle.hpp"
#include "model/masses.hpp"

namespace engrane::app {

using namespace output;

namespace {

/// The plane that a model is solved in, or the plane that would save unknowns; empty if there is none and the deck did not ask
/// for one.
std::string describe_plane(const Model& model) {
  if (has_cells(model) && !model.plane.active()) return "";  // cells have no out-of-plane unknowns
  if (model.plane.active()) return fmt::format("the plane {}", plane_name(model.plane.normal));
  const bool asked = model.commands.analysis.plane.is("AUTO");
  const PlaneModel plane = asked ? PlaneModel{} : find_plane(model);
  const PlaneSaving saving = plane.active() ? plane_saving(model, plane) : PlaneSaving{};
  if (saving.motions + saving.multipliers > 0)
    return fmt::format(
        "space; all motion stays in {0}, and .SAM PLANE {0} would leave out {1} unknowns of nodes and {2} multipliers",
        plane_name(plane.normal), saving.motions, saving.multipliers);
  return asked ? "space: there is no coordinate plane that all motion stays in" : "";
}

}  // namespace

BuiltSummary summarize(const Model& model, const Numbering& numbering) {
  BuiltSummary summary;
  std::map<std::string, BuiltSummary::ElementCount> counts;
  std::size_t held_by_friction = 0;  // not constraints while their surfaces slide
  const PlaneModel& plane = model.plane;
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const Layout& layout = model.parts[p].element->layout();
    auto& count = counts[model.parts[p].type];
    ++count.count;
    count.scalars += layout.scalars.size();
    const int first = numbering.multiplier_begin(static_cast<int>(p)), own = static_cast<int>(layout.own_multipliers());
    for (int m = first; m < first + own; ++m) {
      if (plane.leaves_out_multiplier(m)) continue;
      ++count.constraints;
      if (m >= first + layout.grip_row()) ++held_by_friction;
    }
    std::size_t active = 0;
    for (const int slot : numbering.part_slots(static_cast<int>(p))) active += numbering.equation(slot) >= 0;
    summary.nonzeros += active * active;
  }
  for (auto& [type, count] : counts) {
    count.type = type;
    summary.elements.push_back(count);
  }
  summary.nodes = model.nodes.size() - 1;
  for (const Unknown& u : numbering.unknowns()) {
    if (u.multiplier)
      ++summary.multipliers;
    else if (u.part >= 0)
      ++summary.scalars;
    else if (u.item < 3)
      ++summary.translations;
    else
      ++summary.rotations;
  }
  // supports remove unknowns only where some element needs them
  std::vector<bool> needed(6 * model.nodes.size(), false);
  for (const Model::Part& part : model.parts)
    for (std::size_t i = 0; i < part.nodes.size(); ++i)
      for (int c = 0; c < 6; ++c)
        if (part.element->layout().has(i, c)) needed[static_cast<std::size_t>(6 * part.nodes[i] + c)] = true;
  for (const Support& s : model.supports) {  // each component of a node only once
    if (!needed[static_cast<std::size_t>(6 * s.node + s.component)] || plane.leaves_out(s.component)) continue;
    ++(s.component < 3 ? summary.translations : summary.rotations);
    ++summary.prescribed;
  }
  if (const std::string solved = describe_plane(model); !solved.empty()) summary.choices.emplace_back("solved in", solved);
  if (const Partition& partition = numbering.partition(); partition.ranks() > 1) {
    std::vector<int> shares(static_cast<std::size_t>(partition.ranks()), 0);
    for (std::size_t p = 0; p < model.parts.size(); ++p) ++shares[static_cast<std::size_t>(partition.owner(static_cast<int>(p)))];
    const auto [least, most] = std::minmax_element(shares.begin(), shares.end());
    summary.choices.emplace_back("elements of a process",
                                 *least == *most ? std::to_string(*least) : fmt::format("{} to {}", *least, *most));
    summary.choices.emplace_back("elements evaluated by several", std::to_string(numbering.shared_parts()));
  }
  const auto motions = summary.translations + summary.rotations + summary.scalars - summary.prescribed;
  const auto constraints = summary.multipliers - held_by_friction;
  summary.choices.emplace_back("motions less constraints",
                               std::to_string(static_cast<long>(motions) - static_cast<long>(constraints)));
  return summary;
}

std::string describe_analysis(const solve::SolverContext& context) {
  const deck::AnalysisCard& a = context.model.commands.analysis;
  const deck::SteppingCard& s = context.model.commands.stepping;
  const SolverOptions& options = context.options;
  const bool another = a.scheme_is_free && options.family == SolverOptions::Family::chung;
  std::string text = a.type.tag;
  if (a.type.is("DYNAMIC")) {
    text += ", " + (another ? "CHUNG" : a.scheme.tag);
    if (options.family == SolverOptions::Family::chung) text += fmt::format(" rho {:g}", options.damping);
    if (options.keep_factors && options.family != SolverOptions::Family::radau) text += " with tangents kept";
    if (a.alpha && !a.scheme.is("CHUNG")) text += fmt::format(" alpha {:g}", *a.alpha);
  }
  if (options.path.follow)
    text += fmt::format(", along the path of equilibria from t = {:g} to {:g}, first step {:g}", s.start, s.end, s.step);
  else if (s.end == s.start)
    text += fmt::format(", t = {:g}", s.end);
  else
    text += fmt::format(", t = {:g} to {:g}, {}", s.start, s.end,
                        options.tolerance > 0
                            ? fmt::format("steps of local error {:g}", options.tolerance)
                            : fmt::format("{:.0f} steps of {:g}", std::ceil((s.end - s.start) / s.step * (1 - 1e-9)), s.step));
  return text + ", " + (a.solver.is("AUTO") ? context.solver.package() : a.solver.tag);
}

std::string describe_geometry(const Model& model) {
  std::string text, values, before;
  const Model::Part *first = nullptr, *last = nullptr;
  std::size_t alike = 0;
  const auto tell = [&] {
    if (!first) return;
    text += fmt::format("\n  {}, nodes {}", first->name(), fmt::join(first->element->node_ids(), " "));
    if (alike > 0) text += fmt::format(", and {} alike up to {}", alike, last->name());
    text += "\n" + before;
  };
  for (const Model::Part& part : model.parts) {
    const auto derived = part.element->derived();
    if (derived.empty()) continue;
    values.clear();
    for (const Derived& d : derived) {
      // angles are in radians internally and in degrees wherever users read or write them
      const bool angle = d.dimension == dimension::angle;
      const double shown = angle ? d.value / degree : d.value;
      const double value = std::abs(shown) < 1e-14 ? 0.0 : shown;  // rounding errors, and no negative zero
      values += fmt::format("    {:<42}{:>16.9g} {}\n", d.name, value,
                            angle                            ? "deg"
                            : d.dimension == dimension::none ? ""
                                                             : model.units.label(d.dimension));
    }
    if (first && part.type == first->type && values == before) {
      ++alike;
    } else {
      tell();
      first = &part;
      alike = 0;
      before = values;
    }
    last = &part;
  }
  tell();
  return text;
}

std::string describe_masses(const Model& model, std::size_t most) {
  std::vector<MassRow> rows;
  MassProperties sum, cells;
  for (const Model::Part& part : model.parts) {
    const MassProperties one = mass_properties(model, part);
    if (!one.any()) continue;
    sum.add(one);
    if (part.element->cell_shape() != CellShape::none) {
      cells.add(one);
      continue;
    }
    rows.push_back({part.name(), one.mass, one.centre, one.inertia});
  }
  if (cells.any()) rows.push_back({"cells", cells.mass, cells.centre, cells.inertia});
  return listing_masses(rows, {"all", sum.mass, sum.centre, sum.inertia}, model.units, most);
}

}  // namespace engrane::app
