// SPDX-License-Identifier: BSD-3-Clause
#include "output/listing.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>
#include <set>
#include <sstream>

#include "base/text.hpp"
#include "output/error.hpp"
#include "output/table.hpp"

namespace engrane::output {

namespace {

using Align = Table::Align;

std::string with_unit(const std::string& title, const std::string& unit) {
  if (unit.empty()) return title;
  return unit.front() == '[' ? title + " " + unit : title + " [" + unit + "]";
}

std::string entry(const std::string& name, const std::string& text) {
  return text.empty() ? "" : fmt::format("  {:<10}{}\n", name, text);
}

/// Formats residuals and the like with three significant digits, and an exact zero as 0.
std::string magnitude(double value) {
  if (std::isnan(value)) return "-";
  return value == 0 ? "0" : fmt::format("{:.2e}", value);
}

}  // namespace

std::string listing_header(const ListingHeader& header) {
  std::string out = "engrane " + header.version + "\n";
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  out += entry("title", printable(header.title)) + entry("deck", header.deck) + entry("analysis", header.analysis) +
         entry("date", fmt::format("{:%Y-%m-%d %H:%M:%S %z}", local)) + entry("machine", header.machine) +
         entry("libraries", header.libraries);
  return out;
}

std::string listing_section(const std::string& title) {
  return "\n" + title + "\n" + std::string(character_count(title), '=') + "\n";
}

std::string listing_built(const BuiltSummary& s) {
  Table elements({{"element", Align::left}, {"count"}, {"own unknowns"}, {"constraints"}});
  for (const BuiltSummary::ElementCount& e : s.elements)
    elements.row({e.type, std::to_string(e.count), std::to_string(e.scalars), std::to_string(e.constraints)});
  Table unknowns({{"unknowns", Align::left}, {"number"}});
  unknowns.row({"translations of nodes", std::to_string(s.translations)});
  unknowns.row({"rotations of nodes", std::to_string(s.rotations)});
  unknowns.row({"of elements", std::to_string(s.scalars)});
  unknowns.row({"multipliers", std::to_string(s.multipliers)});
  unknowns.row({"prescribed by supports", (s.prescribed > 0 ? "-" : "") + std::to_string(s.prescribed)});
  unknowns.rule();
  unknowns.row({"to be solved for", std::to_string(s.translations + s.rotations + s.scalars + s.multipliers - s.prescribed)});
  std::string out = "  " + counted(s.nodes, "node") + "\n\n";
  if (!elements.empty()) out += elements.text() + "\n";
  out += unknowns.text();
  if (s.nonzeros > 0) out += fmt::format("  {} nonzeros in the tangent\n", s.nonzeros);
  if (!s.choices.empty()) {
    Table choices({{"setting", Align::left}, {"value", Align::left}});
    for (const auto& [name, value] : s.choices) choices.row({name, value});
    out += "\n" + choices.text();
  }
  return out;
}

std::string listing_warnings(const Diagnostics& diagnostics, const SourceMap& sources) {
  if (diagnostics.all().empty()) return "";
  std::ostringstream out;
  diagnostics.print(out, sources);
  return out.str();
}

std::string listing_newton(std::span<const IterationRow> rows, bool with_heading) {
  const Table table({{"step"},
                     {"time"},
                     {"it."},
                     {"forces"},
                     {"moments"},
                     {"lengths"},
                     {"angles"},
                     {"correction"},
                     {"largest residual", Align::left}});
  // fixed widths, because rows are printed step by step
  const std::vector<std::size_t> widths{6, 12, 3, 9, 9, 9, 9, 10, 24};
  std::string out = with_heading ? table.heading(widths) : "";
  for (const IterationRow& r : rows)
    out += table.line({std::to_string(r.step), shown(r.time, 8), std::to_string(r.iteration), magnitude(r.forces),
                       magnitude(r.moments), magnitude(r.lengths), magnitude(r.angles), magnitude(r.correction), r.blame},
                      widths);
  return out;
}

std::string listing_energies(std::span<const EnergyRow> rows, const UnitSystem& units) {
  if (rows.empty()) return "";
  Table table({{"time"}, {"kinetic"}, {"potential"}, {"external work"}, {"dissipated"}, {"balance error"}});
  for (const EnergyRow& r : rows)
    table.row({shown(r.time, 8), shown(r.kinetic), shown(r.potential), shown(r.external_work), shown(r.dissipated),
               magnitude(r.error)});
  // labels of units without names are long, so they are given only once
  return "  time in " + units.label(dimension::time) + ", energies in " + units.label(dimension::energy) + "\n\n" + table.text();
}

std::string listing_reactions(std::span<const ReactionRow> rows, const UnitSystem& units) {
  if (rows.empty()) return "";
  const std::string force = units.label(dimension::force), torque = units.label(dimension::moment);
  Table table({{"node"},
               {with_unit("force x", force)},
               {with_unit("y", force)},
               {with_unit("z", force)},
               {with_unit("torque x", torque)},
               {with_unit("y", torque)},
               {with_unit("z", torque)}});
  for (const ReactionRow& r : rows)
    table.row({std::to_string(r.node), shown(r.force[0]), shown(r.force[1]), shown(r.force[2]), shown(r.torque[0]),
               shown(r.torque[1]), shown(r.torque[2])});
  return table.text();
}

std::string listing_loads(const LoadRows& rows, const UnitSystem& units) {
  const std::string force = units.label(dimension::force), moment = units.label(dimension::moment);
  Table table({{"resultant", Align::left},
               {with_unit("force x", force)},
               {"y"},
               {"z"},
               {with_unit("moment about the origin x", moment)},
               {"y"},
               {"z"}});
  const auto add = [&table](const char* of, const Vec3& f, const Vec3& m) {
    table.row({of, shown(f[0]), shown(f[1]), shown(f[2]), shown(m[0]), shown(m[1]), shown(m[2])});
  };
  add("loads", rows.load_force, rows.load_moment);
  add("reactions", rows.reaction_force, rows.reaction_moment);
  return "  loads, pressures and weight; reactions of supports, of .LIA and of node 0\n\n" + table.text() +
         fmt::format("\n  work of the loads on the displacements (total potential energy): {} {}\n", shown(rows.work),
                     units.label(dimension::energy));
}

std::string listing_masses(std::span<const MassRow> bodies, const MassRow& model, const UnitSystem& units, std::size_t most) {
  if (bodies.empty()) return "";
  const std::string inertia = units.label(dimension::inertia);
  Table table({{"body", Align::left},
               {with_unit("mass", units.label(dimension::mass))},
               {with_unit("centre x", units.label(dimension::length))},
               {"y"},
               {"z"},
               {with_unit("Jxx", inertia)},
               {"Jyy"},
               {"Jzz"},
               {"Jxy"},
               {"Jyz"},
               {"Jzx"}});
  const auto add = [&table](const MassRow& r) {
    table.row({r.name, shown(r.mass), shown(r.centre[0]), shown(r.centre[1]), shown(r.centre[2]), shown(r.inertia(0, 0)),
               shown(r.inertia(1, 1)), shown(r.inertia(2, 2)), shown(r.inertia(0, 1)), shown(r.inertia(1, 2)),
               shown(r.inertia(2, 0))});
  };
  for (std::size_t i = 0; i < bodies.size() && i < most; ++i) add(bodies[i]);
  table.rule();
  add(model);
  return "  inertia about the centre of each, global axes, as the deck places them\n\n" + table.text() +
         (bodies.size() > most ? fmt::format("  and {} more bodies, counted in the sum\n", bodies.size() - most) : "");
}

std::string listing_ground(std::span<const GroundRow> rows, const UnitSystem& units) {
  const std::string force = units.label(dimension::force), moment = units.label(dimension::moment);
  Table table({{"sum over supports and node 0", Align::left},
               {"time"},
               {with_unit("force x", force)},
               {"y"},
               {"z"},
               {"size"},
               {with_unit("moment about the origin x", moment)},
               {"y"},
               {"z"}});
  for (const GroundRow& r : rows)
    table.row({r.when, shown(r.time, 8), shown(r.force[0]), shown(r.force[1]), shown(r.force[2]), shown(r.force.norm()),
               shown(r.moment[0]), shown(r.moment[1]), shown(r.moment[2])});
  return table.text();
}

std::string listing_not_unique(const std::vector<HistoryTable>& tables, std::span<const int> columns) {
  std::string out =
      "  Redundant constraints leave the share of a load between these open. The least were given; a real machine's follow from "
      "its\n"
      "  clearances and compliances. In the results they have unique = 0.\n\n";
  const std::set<int> open(columns.begin(), columns.end());
  auto column = open.begin();
  std::size_t first = 0;
  for (const HistoryTable& table : tables) {
    for (std::size_t i = 0; i < table.owners(); ++i, first += table.channels.size()) {
      std::string names;
      for (; column != open.end() && static_cast<std::size_t>(*column) < first + table.channels.size(); ++column)
        names += " " + table.channels[static_cast<std::size_t>(*column) - first].name;
      if (names.empty()) continue;
      const std::string owner = table.type.empty() ? "node" : table.type;
      out += fmt::format("  {:<20}{}\n", table.ids.empty() ? table.path : fmt::format("{} {}", owner, table.ids[i]), names);
    }
  }
  return out;
}

std::string listing_checks(std::span<const CheckResult> checks) {
  if (checks.empty()) return "";
  Table table({{"check", Align::left},
               {"value"},
               {"expected"},
               {"deviation"},
               {"allowed"},
               {"", Align::left},
               {"reference", Align::left}});
  std::size_t passed = 0;
  for (const CheckResult& c : checks) {
    passed += c.passed ? 1 : 0;
    // show enough digits: a failing value must not look like the expected one
    const std::string reference = printable(c.reference);
    table.row({printable(c.text), shown(c.value, 10), shown(c.expected, 10), magnitude(std::abs(c.value - c.expected)),
               magnitude(c.tolerance), c.passed ? "PASS" : "FAIL",
               c.remark.empty() ? reference : c.remark + (reference.empty() ? "" : "; " + reference)});
  }
  const std::string sum = passed == checks.size()
                              ? (passed == 1 ? "The check passed." : fmt::format("All {} checks passed.", passed))
                              : fmt::format("{} of {} checks FAILED.", checks.size() - passed, checks.size());
  return table.text() + "  " + sum + "\n";
}

std::string listing_times(const TimeSplit& split) {
  Table table({{"time spent", Align::left}, {"seconds"}, {"%"}});
  const double percent = split.total > 0 ? 100 / split.total : 0;
  double known = 0;
  for (const auto& [name, seconds] : split.parts) {
    table.row({name, fmt::format("{:.3f}", seconds), fmt::format("{:.1f}", percent * seconds)});
    known += seconds;
  }
  const double rest = std::max(0.0, split.total - known);
  if (rest > 5e-4 * split.total) table.row({"the rest", fmt::format("{:.3f}", rest), fmt::format("{:.1f}", percent * rest)});
  table.rule();
  table.row({"total", fmt::format("{:.3f}", split.total), ""});
  return table.text();
}

Listing::Listing(OutputName name) : name_(std::move(name)), path_(name_.path(".lst")), file_(std::fopen(path_.c_str(), "we")) {
  if (!file_) throw OutputError(path_, std::strerror(errno));
}

Listing::~Listing() {
  if (file_) std::fclose(file_);
}

void Listing::write(std::string_view text) {
  if (!file_) return;
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size() || std::fflush(file_) != 0)
    throw OutputError(path_, std::strerror(errno));
}

void Listing::finish(bool complete) {
  if (!file_) return;
  const bool closed = std::fclose(std::exchange(file_, nullptr)) == 0;
  if (!closed) throw OutputError(path_, std::strerror(errno));
  const std::string final_path = name_.final_path(".lst");
  if (complete && path_ != final_path) {
    rename_over(path_, final_path);
    path_ = final_path;
  }
}

}  // namespace engrane::output
