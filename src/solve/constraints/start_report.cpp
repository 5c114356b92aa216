// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/start_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "math/angle.hpp"

namespace engrane::solve {

namespace {

constexpr std::size_t most_rows = 8;

std::string iterations(int n) { return fmt::format("{} iteration{}", n, n == 1 ? "" : "s"); }

/// The first few, and how many more there are.
std::string listed(const std::vector<std::string>& all) {
  const std::size_t shown = std::min(all.size(), most_rows);
  std::string text = fmt::format("{}", fmt::join(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
  return shown < all.size() ? text + fmt::format(" and {} more", all.size() - shown) : text;
}

std::string positions(const Model& model, const StartReport& report) {
  std::string text = "  1. positions: the mechanism closes as given";
  if (report.position_iterations > 0) text = fmt::format("  1. positions: closed in {}", iterations(report.position_iterations));
  if (report.path_steps > 0) text += fmt::format(", and little by little in {} parts", report.path_steps);
  text += '\n';
  for (const std::string& coordinate : report.coordinates) text += "     moved to " + coordinate + "\n";
  if (report.position_iterations == 0 && report.coordinates.empty()) return text;
  const std::string unit = model.units.label(dimension::length);
  for (std::size_t i = 0; i < report.opened.size() && i < most_rows; ++i) {
    const StartReport::Opened& o = report.opened[i];
    text += fmt::format("     {:<22}{}", model.part(o.part).name(), i == 0 ? "was open by" : "           ");
    if (o.length > 0) text += fmt::format(" {:.4g} {}", o.length, unit);
    if (o.angle > 0) text += fmt::format("{} {:.4g} deg", o.length > 0 ? " and" : "", o.angle / degree);
    text += '\n';
  }
  if (report.opened.size() > most_rows) text += fmt::format("     and {} more\n", report.opened.size() - most_rows);
  for (std::size_t i = 0; i < report.moved.size() && i < most_rows; ++i) {
    const StartReport::Moved& m = report.moved[i];
    text +=
        fmt::format("     {:<22}{} {:.4g} {}, turned by {:.4g} deg\n",
                    fmt::format("node {}", model.nodes[static_cast<std::size_t>(m.node)].id),
                    i == 0 ? "moved by   " : "           ", m.move < 1e-12 * model.extent() ? 0 : m.move, unit, m.turn / degree);
  }
  if (report.moved.size() > most_rows) text += fmt::format("     and {} more\n", report.moved.size() - most_rows);
  return text;
}

}  // namespace

std::string slot_name(const Model& model, std::size_t slot) {
  return fmt::format("node {} ({})", model.nodes[slot / 6].id, component_name(static_cast<int>(slot % 6)));
}

std::string describe_start(const Model& model, const StartReport& report) {
  std::string text = positions(model, report);
  if (report.velocities_fitted) {
    text += "  2. velocities: ";
    if (report.rate_violated_most.empty())
      text += "those given fit the joints and drives\n";
    else
      text += fmt::format("changed by up to {:.4g}, at {}, to fit joints and drives; those given opened {} fastest\n",
                          report.largest_velocity_change, report.velocity_changed_most, report.rate_violated_most);
  }
  if (!report.carried.empty())
    text += fmt::format("     elastic bodies that follow joints and drives, strained only as these demand: {}\n",
                        listed(report.carried));
  for (const std::string& remark : report.remarks) text += "     warning: " + remark + "\n";
  if (report.massless > 0)
    text += fmt::format("     {} without mass, {}: kept in equilibrium with springs and dampers\n",
                        report.massless == 1 ? "1 motion" : fmt::format("{} motions", report.massless),
                        (report.massless == 1 ? "" : "for example ") + report.massless_example);
  if (report.accelerations_found) {
    text += fmt::format("  3. accelerations and multipliers: {}", iterations(report.acceleration_iterations));
    if (!report.accelerated_most.empty())
      text += fmt::format("; largest acceleration {:.4g}, {}", report.largest_acceleration, report.accelerated_most);
    if (!report.carried_most.empty())
      text += fmt::format("; largest multiplier {:.4g}, {}", report.largest_force, report.carried_most);
    text += '\n';
    if (report.softened)
      text +=
          "     loads that act from here on excite vibrations with periods shorter than two steps: these begin\n"
          "     near their equilibrium; a shorter H would resolve them\n";
  }
  return text;
}

}  // namespace engrane::solve
