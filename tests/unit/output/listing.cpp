// SPDX-License-Identifier: BSD-3-Clause
#include "output/listing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>

#include "output/peaks.hpp"
#include "output/progress.hpp"
#include "output/table.hpp"
#include "sample_results.hpp"

namespace engrane::testing {

using namespace output;

namespace {

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Table, AlignsByCharactersNotBytes) {
  Table table({{"name", Table::Align::left}, {"value"}});
  table.row({"ψ", "1"});
  table.row({"angle", "-12.5"});
  EXPECT_EQ(table.text(),
            "  name   value\n"
            "  ------------\n"
            "  ψ          1\n"
            "  angle  -12.5\n");
  EXPECT_EQ(shown(0.1 + 0.2), "0.3");
  EXPECT_EQ(shown(-0.0), "0");
  EXPECT_EQ(shown(std::numeric_limits<double>::quiet_NaN()), "-");
}

TEST(Listing, Checks) {
  CheckResult good{"NODE 1 UX at the end", 1.0000001, 1, 1e-6, true, "by hand", ""};
  CheckResult bad{"RUN STEPS at the end", std::numeric_limits<double>::quiet_NaN(), 4, 0, false, "", "the run ended at t = 0.4"};
  EXPECT_TRUE(contains(listing_checks(std::vector{good}), "The check passed."));
  const std::string text = listing_checks(std::vector{good, bad});
  EXPECT_TRUE(contains(text, "PASS  by hand")) << text;
  EXPECT_TRUE(contains(text, "FAIL  the run ended at t = 0.4")) << text;
  EXPECT_TRUE(contains(text, "1 of 2 checks FAILED.")) << text;
  EXPECT_EQ(listing_checks({}), "");
}

TEST(Listing, Tables) {
  UnitSystem si;
  si.given = true;
  EXPECT_TRUE(contains(listing_reactions(std::vector{ReactionRow{57, Vec3(1, 2, 3), Vec3(0, 0, -4.5)}}, si), "[N]"));
  EXPECT_TRUE(contains(listing_energies(std::vector{EnergyRow{0.1, 1, 2, 3, 0, 1e-12}}, si), "time in s, energies in N·m"));
  BuiltSummary built;
  built.nodes = 4;
  built.elements = {{"GEAR", 1, 3, 3}};
  built.translations = built.rotations = 12;
  built.scalars = built.multipliers = 3;
  built.prescribed = 6;
  const std::string text = listing_built(built);
  EXPECT_TRUE(contains(text, "4 nodes")) << text;
  EXPECT_TRUE(contains(text, "to be solved for            24")) << text;
  const IterationRow row{3, 0.031, 2, 1e-3, 0, 0, 1e-12, 1e-5, "node 57 (rz)"};
  const std::string newton = listing_newton(std::vector{row}, true), more = listing_newton(std::vector{row}, false);
  EXPECT_EQ(newton.substr(newton.size() - more.size()), more);
  EXPECT_TRUE(contains(listing_times({{{"assembly", 1}, {"factorization", 2}}, 4}), "the rest"));
  EXPECT_TRUE(contains(listing_header({"0.1.0", "PETSc 3.18", "pair", "a.dat", "STATIC", ""}), "title     pair"));
}

TEST(Listing, PeaksGoOnAfterARestart) {
  const std::vector<HistoryTable> tables = {
      {"element/HINGE", "HINGE", {3, 4}, {{"ANGLE", dimension::angle, ""}, {"FORCE_1", dimension::force, ""}}},
      {"node/NODE", "", {7}, {{"UX", dimension::length, ""}}},
      {"run", "", {}, {{"ENERGY_ERROR", dimension::energy, ""}}}};
  const std::vector<HistoryTable> fewer(tables.begin(), tables.begin() + 2);
  Peaks first(tables), second(tables), other(fewer);
  first.observe(0, std::vector<double>{-3, 0, 0.5, 1, 9, 0}, false);
  first.observe(1, std::vector<double>{2, 0, -0.75, 1, 9, 0}, false);
  Snapshot snapshot;
  first.save(snapshot);
  EXPECT_TRUE(second.load(snapshot));
  EXPECT_FALSE(other.load(snapshot));
  second.observe(2, std::vector<double>{2.5, 0, 0.25, -4, 9, 0}, false);
  EXPECT_EQ(second.of(0).value, -3);
  EXPECT_EQ(second.of(0).time, 0);
  EXPECT_EQ(second.of(2).value, -0.75);
  EXPECT_EQ(second.of(2).time, 1);
  EXPECT_EQ(second.of(3).value, -4);
  UnitSystem si;
  si.given = true;
  EXPECT_EQ(listing_peaks(tables, second, si, 10),
            "           channel   peak  unit  at time\n"
            "  --------------------------------------\n"
            "  HINGE 3  ANGLE       -3  rad         0\n"
            "  HINGE 4  ANGLE    -0.75  rad         1\n"
            "           FORCE_1     -4  N           2\n");
  EXPECT_TRUE(contains(listing_peaks(tables, second, si, 1), "and 2 more"));
}

/// Peaks of a channel with these values at 0, 1, 2, …; before sample `event` there is an event, or at it if it `is_seen`.
Peaks::Peak peak_of(const std::vector<double>& values, std::size_t event = 0, bool is_seen = false,
                    Channel::Course course = Channel::Course::smooth, bool restarts = false) {
  std::vector<HistoryTable> tables = {{"run", "", {}, {}}};
  tables[0].channels.push_back({{"X", dimension::force, ""}, course, -10, 10});
  Peaks peaks(tables);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (event > 0 && i == event && !is_seen) peaks.interrupt();
    peaks.observe(static_cast<double>(i), std::array{values[i]}, is_seen && i == event);
    if (!restarts) continue;
    Snapshot snapshot;
    peaks.save(snapshot);
    peaks = Peaks(tables);
    EXPECT_TRUE(peaks.load(snapshot));
  }
  return peaks.of(0);
}

TEST(Listing, PeaksBetweenSamples) {
  std::vector<double> sine;
  for (int i = 0; i < 12; ++i) sine.push_back(-5 * std::sin(0.35 * i));
  const double top = std::numbers::pi / 0.7;  // 4.49: the samples reach 4.93
  for (const bool restarts : {false, true}) {
    const Peaks::Peak peak = peak_of(sine, 0, false, Channel::Course::smooth, restarts);
    EXPECT_NEAR(peak.value, -5, 0.002);
    EXPECT_NEAR(peak.time, top, 0.02);
  }
  const double least = std::min(sine[4], sine[5]);
  EXPECT_EQ(peak_of(sine, 5).value, least);             // an event between both samples, at one that is not seen
  EXPECT_NEAR(peak_of(sine, 5, true).value, -5, 0.01);  // at the later one
  EXPECT_EQ(peak_of({0, 1, 2, 3, 1, -1}, 3, true).value, 3);
  EXPECT_EQ(peak_of(sine, 0, false, Channel::Course::state).value, least);
  // neither at jumps, nor beyond limits
  EXPECT_EQ(peak_of({0, 0, 0, 3, 3, 3, 3}).value, 3);
  EXPECT_EQ(peak_of({0, 0, 0, 3, 3, 3, 3}).time, 3);
  EXPECT_EQ(peak_of({1, 7, 9.9, 9.9, 7, 1}).value, 10);
}

TEST(Listing, FileKeepsOutOfTheWayOfACompleteResult) {
  const Scratch scratch;
  const auto write = [&](const std::string& text, bool complete) {
    Results results(scratch / "run", sample_layout());
    Listing listing(results.name());
    listing.write(text);
    results.finish(complete ? RunStatus::complete : RunStatus::failed);
    listing.finish(complete);
    return listing.path();
  };
  const auto read = [&](const std::string& name) {
    std::ifstream file(scratch / name);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(write("one", true), scratch / "run.lst");
  EXPECT_EQ(write("two", false), scratch / "run.partial.lst");
  EXPECT_EQ(read("run.lst"), "one");
  EXPECT_EQ(write("three", true), scratch / "run.lst");
  EXPECT_EQ(read("run.lst"), "three");
  EXPECT_FALSE(scratch.has("run.partial.lst"));
  EXPECT_THROW(Listing(OutputName(scratch / "none/run")), OutputError);
}

TEST(Progress, LinesInABatch) {
  std::ostringstream out;
  double now = 100;
  Progress progress(0, 2, Progress::Style::lines, out, [&] { return now; });
  for (int i = 1; i <= 1000; ++i) {
    now += 0.05;
    progress.update(2e-3 * i, 2e-3, i);
  }
  progress.finish();
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10) << text;
  EXPECT_TRUE(contains(text, " 10 %  t = 0.2  h = 0.002  step 100  20 steps/s  45 s left")) << text;
  EXPECT_TRUE(contains(text, "100 %")) << text;
}

TEST(Progress, SlowRunSpeaksEveryHalfMinute) {
  std::ostringstream out;
  double now = 0;
  Progress progress(0, 1, Progress::Style::lines, out, [&] { return now; });
  for (int i = 1; i <= 100; ++i) progress.update(1e-5 * i, 1e-5, i), now += 10;
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 33) << text;
}

TEST(Progress, OneLineOnATerminal) {
  std::ostringstream out;
  double now = 0;
  {
    Progress progress(0, 1, Progress::Style::terminal, out, [&] { return now; });
    for (int i = 1; i <= 10; ++i) {
      now += 0.06;
      progress.update(0.1 * i, 0.1, i);
    }
    progress.note("warning");
  }
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  EXPECT_EQ(text.substr(text.size() - 9), "\rwarning\n");
  EXPECT_EQ(duration_text(245), "4 min 05 s");
  EXPECT_EQ(duration_text(8000), "2 h 13 min");
}

}  // namespace
}  // namespace engrane::testing
