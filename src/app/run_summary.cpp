// SPDX-License-Identifier: BSD-3-Clause
#include "app/run_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/options.hpp"
#include "app/version.hpp"
#include "base/text.hpp"

namespace engrane::app {

namespace {

using Json = nlohmann::ordered_json;

/// JSON has no NaN or infinity: they become null.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// JSON is UTF-8; decks may be Latin-1.
Json text(const std::string& raw) { return printable(raw); }

Json checks_json(const std::vector<output::CheckResult>& checks, bool compared) {
  Json list = Json::array();
  for (const output::CheckResult& c : checks) {
    Json one{{"name", text(c.text)}, {"value", number(c.value)}};
    if (compared) {
      one["expected"] = number(c.expected);
      one["tolerance"] = number(c.tolerance);
      one["passed"] = c.passed;
      if (!c.reference.empty()) one["reference"] = text(c.reference);
    }
    if (!c.remark.empty()) one["remark"] = text(c.remark);
    list.push_back(std::move(one));
  }
  return list;
}

Json diagnostics_json(const RunSummary& run) {
  Json list = Json::array();
  for (const Diagnostic& d : run.diagnostics) {
    Json one{{"severity", d.severity == Severity::error ? "error" : "warning"}};
    if (d.location.known()) {
      one["file"] = text(run.sources.at(static_cast<std::size_t>(d.location.file)));
      one["line"] = d.location.line;
      one["column"] = d.location.column;
    }
    one["message"] = text(d.message);
    if (!d.hint.empty()) one["hint"] = text(d.hint);
    list.push_back(std::move(one));
  }
  return list;
}

Json critical_json(const std::vector<solve::CriticalPoint>& points) {
  Json json = Json::array();
  for (const solve::CriticalPoint& point : points)
    json.push_back({{"kind", point.kind == solve::CriticalPoint::Kind::limit ? "limit" : "bifurcation"},
                    {"load_time", number(point.load_time)},
                    {"unstable_before", point.before},
                    {"unstable_behind", point.after},
                    {"mode", text(point.mode)}});
  return json;
}

Json run_json(const RunSummary& run) {
  Json json{{"deck", text(run.deck)}, {"status", run.status}, {"outcome", run.outcome()}};
  Json definitions = Json::object();
  for (const auto& [name, value] : run.overrides.definitions) definitions[printable(name.substr(1))] = text(value);
  json["definitions"] = std::move(definitions);
  json["cards"] = Json::array();
  for (const std::string& card : run.overrides.cards) json["cards"].push_back(text(card));
  if (!run.failure.empty()) json["failure"] = text(run.failure);
  json["diagnostics"] = diagnostics_json(run);
  json["steps"] = run.steps;
  json["iterations"] = run.iterations;
  json["failed_attempts"] = run.cuts;
  json["events"] = run.events;
  json["time"] = {{"reached", number(run.time)}, {"end", number(run.end)}};
  json["seconds"] = number(run.seconds);
  if (run.accuracy && run.accuracy->trouble.empty())
    json["accuracy"] = {{"estimated_error", number(run.accuracy->error)},
                        {"channel", text(run.accuracy->channel)},
                        {"tolerance", number(run.accuracy->tolerance)}};
  if (run.conditioning)
    json["linear_system"] = {{"condition", number(run.conditioning->condition)},
                             {"backward_error", number(run.conditioning->backward_error)},
                             {"error_bound", number(run.conditioning->error())}};
  if (run.energies)
    json["energies"] = {{"kinetic", number(run.energies->kinetic)},
                        {"potential", number(run.energies->potential)},
                        {"external_work", number(run.energies->external_work)},
                        {"dissipated", number(run.energies->dissipated)},
                        {"error", number(run.energies->error())}};
  if (!run.critical.empty()) json["critical_points"] = critical_json(run.critical);
  if (!run.buckling.empty()) {
    json["buckling"] = Json::array();
    for (const double load_time : run.buckling) json["buckling"].push_back(number(load_time));
  }
  if (run.stress_error)
    json["stress_error"] = {{"relative", number(run.stress_error->relative())},
                            {"energy", number(run.stress_error->difference)},
                            {"strain_energy", number(run.stress_error->energy)}};
  json["checks"] = checks_json(run.checks, true);
  json["results"] = checks_json(run.results, false);
  Json files = Json::array();
  for (const std::string& file : run.files) files.push_back(text(file));
  json["files"] = std::move(files);
  return json;
}

}  // namespace

double Conditioning::error() const {
  return std::min(1.0, condition * std::max(backward_error, std::numeric_limits<double>::epsilon()));
}

std::string Conditioning::describe() const {
  return fmt::format(
      "  condition         {:.1e}   estimate from the factors, largest sum of a column; in the units of the deck\n"
      "  backward error    {:.1e}   of the last solution that was judged\n"
      "  {}\n",
      condition, backward_error,
      error() < 1
          ? fmt::format("error bound       {:.1e}   of its largest entry: a Newton correction, found anew in each iteration",
                        error())
          : "error bound       none: a change in the last digit of the matrix may change the whole solution");
}

std::string RunSummary::outcome() const {
  switch (status) {
    case exit_status::fine:
      return "complete";
    case exit_status::wrong_deck:
      return "wrong deck";
    case exit_status::solution_failed:
      return "failed";
    case exit_status::check_failed:
      return "check failed";
    default:
      return "fault of the program";
  }
}

int worse_status(int a, int b) {
  static constexpr std::array order{exit_status::fine, exit_status::check_failed, exit_status::wrong_deck,
                                    exit_status::solution_failed, exit_status::our_error};
  return std::find(order.begin(), order.end(), a) > std::find(order.begin(), order.end(), b) ? a : b;
}

std::string summary_table(const std::vector<RunSummary>& runs) {
  std::size_t width = 4;
  for (const RunSummary& run : runs) width = std::max(width, character_count(printable(run.deck)));
  const auto padded = [width](const std::string& name) { return name + std::string(width - character_count(name), ' '); };
  std::string table =
      fmt::format("\n{}  {:<20}{:>9}{:>12}{:>9}{:>10}\n", padded("deck"), "outcome", "steps", "iterations", "checks", "seconds");
  for (const RunSummary& run : runs) {
    const auto passed = std::count_if(run.checks.begin(), run.checks.end(), [](const auto& c) { return c.passed; });
    table += fmt::format("{}  {:<20}{:>9}{:>12}{:>9}{:>10.2f}\n", padded(printable(run.deck)), run.outcome(), run.steps,
                         run.iterations, run.checks.empty() ? "-" : fmt::format("{}/{}", passed, run.checks.size()), run.seconds);
  }
  return table;
}

std::string summary_json(const std::vector<RunSummary>& runs, int status) {
  Json json{{"engrane", version}, {"status", status}, {"runs", Json::array()}};
  for (const RunSummary& run : runs) json["runs"].push_back(run_json(run));
  return json.dump(1) + "\n";
}

}  // namespace engrane::app
