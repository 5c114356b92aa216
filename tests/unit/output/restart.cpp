// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "output/checks.hpp"
#include "output/restart_file.hpp"
#include "result_reader.hpp"
#include "sample_results.hpp"

namespace engrane::testing {

using namespace output;

namespace {

constexpr std::size_t all_steps = 40;

Snapshot memory(std::size_t step) {
  Snapshot s;
  s.put("configuration/nodes", {0.1 * static_cast<double>(step), 2.0, 1.0 / 3.0});
  s.put("step", static_cast<double>(step));
  s.put("nothing", std::vector<double>{});
  // larger than what stands in a header, so that it is compressed
  s.put("many", std::vector<double>(5000, static_cast<double>(step)));
  return s;
}

/// Steps from `first` to before `end`, with a frame and a kept restart point every tenth step.
void write_steps(Results& results, std::size_t first, std::size_t end) {
  for (std::size_t s = first; s < end; ++s) {
    write_sample(results, s);
    if (s % 10 == 0) write_frame(results, s / 10);
    results.restart_point(1e-3 * static_cast<double>(s), memory(s), s % 10 == 5);
    results.restart_point(1e-3 * static_cast<double>(s), memory(s));
  }
}

void write_run(const std::string& prefix, std::size_t end, RunStatus status = RunStatus::complete) {
  Results results(prefix, sample_layout());
  results.set_pace({7, 1 << 20, std::chrono::hours(1)});
  write_steps(results, 0, end);
  results.finish(status);
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const RestartError& error) {
    return error.what();
  }
  return "(no error)";
}

TEST(Restart, PointsComeBackAsTheyWere) {
  const Scratch scratch;
  write_run(scratch / "run", 20);
  const RestartFile file(scratch / "run");
  EXPECT_EQ(file.deck_text(), ".FIN 1\n");
  EXPECT_EQ(file.times(), (std::vector<double>{0.005, 0.015, 0.019}));
  const RestartPoint last = file.load(), kept = file.load(0.0185);
  EXPECT_EQ(last.time, 0.019);
  EXPECT_EQ(last.memory.arrays(), memory(19).arrays());
  EXPECT_EQ(kept.time, 0.015);
  EXPECT_EQ(kept.samples, 16u);
  EXPECT_EQ(kept.frames, 2u);
  EXPECT_EQ(kept.memory.arrays(), memory(15).arrays());
  EXPECT_EQ(file.load(0.015 * (1 - 1e-12)).time, 0.015);  // as a sum of steps it may be a digit larger than it is written
  EXPECT_EQ(message_of([&] { file.load(0.001); }),
            "Cannot restart from " + (scratch / "run.h5") + " at t = 0.001: its restart points are at t = 0.005, 0.015, 0.019.");
}

TEST(Restart, ErrorsAreSentences) {
  const Scratch scratch;
  EXPECT_EQ(message_of([&] { RestartFile(scratch / "run"); }),
            fmt::format("Cannot restart from {0}: there is no file {0}.h5.", scratch / "run"));
  std::ofstream(scratch / "diary.h5") << "dear diary";
  EXPECT_NE(message_of([&] { RestartFile(scratch / "diary"); }).find("is not a result of engrane"), std::string::npos);
  write_run(scratch / "old", 1);
  {
    const hdf5::Handle file(H5Fopen((scratch / "old.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
    const std::string name = "old.h5";
    hdf5::Place{file.id(), name}.attribute("format_version", 1);
  }
  EXPECT_EQ(message_of([&] { RestartFile(scratch / "old"); }),
            "Cannot restart from " + (scratch / "old.h5") + ": its format has version 1, this program's has 2.");
}

TEST(Restart, NewerPartialResultsAreTold) {
  const Scratch scratch;
  write_run(scratch / "run", all_steps);
  EXPECT_EQ(RestartFile(scratch / "run").advice_on_newer_partial(), "");
  write_run(scratch / "run", 20, RunStatus::failed);  // beside the complete one
  const std::string partial = scratch / "run.partial.h5";
  const auto own = std::filesystem::last_write_time(scratch / "run.h5");
  std::filesystem::last_write_time(partial, own + std::chrono::seconds(1));
  const RestartFile complete(scratch / "run");
  EXPECT_EQ(complete.load().time, 0.039);
  EXPECT_EQ(complete.advice_on_newer_partial(),
            fmt::format("The newer {0}.h5, of a run that was not completed, can be continued from t = 0.019: --restart {0}, or "
                        "RESTART \"{0}\"",
                        scratch / "run.partial"));
  EXPECT_EQ(RestartFile(scratch / "run.partial").advice_on_newer_partial(), "");
  std::filesystem::last_write_time(partial, own - std::chrono::seconds(1));
  EXPECT_EQ(complete.advice_on_newer_partial(), "");
  std::ofstream(partial) << "dear diary";
  EXPECT_EQ(complete.advice_on_newer_partial(), "");
}

TEST(Restart, TheContinuedFileIsThatOfTheUncutRun) {
  for (const bool in_place : {false, true}) {
    const Scratch scratch;
    write_run(scratch / "whole", all_steps);
    write_run(scratch / "cut", 33, RunStatus::failed);  // beyond the point, which is at 25
    const std::string prefix = scratch / (in_place ? "cut" : "rest");
    {
      const RestartFile earlier(scratch / "cut");
      const RestartPoint point = earlier.load(0.025);
      Results results(prefix, sample_layout(), earlier, point);
      write_steps(results, static_cast<std::size_t>(point.memory.number("step")) + 1, all_steps);
      results.finish(RunStatus::complete);
    }
    const ResultReader whole(scratch / "whole.h5"), rest(prefix + ".h5");
    for (const char* name :
         {"/history/time", "/history/element/GEAR/values", "/history/run/values", "/fields/time", "/fields/displacement/000000",
          "/fields/velocity/000003", "/fields/STRESS/000002", "/points/STRESS/000002", "/restart/latest/many",
          "/restart/000002/configuration/nodes", "/restart/000003/many"})
      EXPECT_EQ(whole.numbers(name), rest.numbers(name)) << name;
    EXPECT_FALSE(rest.has("/fields/displacement/000004"));
    EXPECT_FALSE(rest.has("/restart/000004"));
    EXPECT_EQ(RestartFile(prefix).times(), RestartFile(scratch / "whole").times());
  }
}

TEST(Restart, HistoriesThatTheEarlierRunDidNotKeepAreNotANumber) {
  const Scratch scratch;
  write_run(scratch / "run", 12);
  ResultsLayout layout = sample_layout();
  layout.history[0].ids = {9, 8};
  {
    const RestartFile earlier(scratch / "run");
    Results results(scratch / "next", layout, earlier, earlier.load());
    results.finish(RunStatus::complete);
  }
  const std::vector<double> values = ResultReader(scratch / "next.h5").numbers("/history/element/GEAR/values");
  ASSERT_EQ(values.size(), 24u);
  for (std::size_t s = 0; s < 12; ++s) {
    EXPECT_EQ(values[2 * s], sample_value(s, 1));
    EXPECT_TRUE(std::isnan(values[2 * s + 1]));
  }
}

TEST(Restart, ALatestPointInEveryBatchDoesNotLetTheFileGrow) {
  const Scratch scratch;
  const auto size_after = [&](std::size_t batches) {
    Results results(scratch / "run", sample_layout());
    for (std::size_t b = 0; b < batches; ++b) {
      results.restart_point(0.1 * static_cast<double>(b), memory(b));
      results.flush();
    }
    return std::filesystem::file_size(scratch / "run.h5");
  };
  EXPECT_EQ(size_after(4), size_after(400));
}

TEST(Restart, ChecksGoOn) {
  deck::CheckCard mean, value;
  mean.run = value.run = true;
  mean.quantity = value.quantity = "KINETIC_ENERGY";
  mean.measure.tag = "MEAN";
  mean.window = {0.2, 0.9};
  value.time = 0.55;
  const auto at = [](double t) { return std::vector<double>{std::sin(3 * t)}; };
  Checks whole({{mean, 0}, {value, 0}}), first({{mean, 0}, {value, 0}}), second({{mean, 0}, {value, 0}});
  for (int i = 0; i <= 5; ++i) first.observe(0.1 * i, at(0.1 * i));
  Snapshot snapshot;
  first.save(snapshot);
  second.load(snapshot);
  for (int i = 0; i <= 10; ++i) {
    whole.observe(0.1 * i, at(0.1 * i));
    if (i > 5) second.observe(0.1 * i, at(0.1 * i));
  }
  for (std::size_t i : {0u, 1u}) EXPECT_EQ(whole.results()[i].value, second.results()[i].value);

  // a check that the earlier run did not have knows only what comes after
  deck::CheckCard early = value;
  early.time = 0.25;
  Checks added({{early, 0}});
  added.load(snapshot);
  added.observe(0.6, at(0.6));
  EXPECT_TRUE(std::isnan(added.results()[0].value));
  EXPECT_EQ(added.results()[0].remark, "the run started at t = 0.6");
}

}  // namespace
}  // namespace engrane::testing
