// SPDX-License-Identifier: BSD-3-Clause
#include "output/results.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <thread>

#include "result_reader.hpp"
#include "sample_results.hpp"

namespace engrane::testing {

using namespace output;

namespace {

std::string read_text(const std::string& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Runs `child` in a process of its own, which must end by itself; returns its exit code, or minus the signal.
template <class F>
int in_child(F child) {
  const pid_t pid = fork();
  if (pid == 0) {
    child();
    std::exit(::testing::Test::HasFailure() ? 1 : 0);
  }
  int status = 0;
  waitpid(pid, &status, 0);
  return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

TEST(Results, HoldEverythingWritten) {
  const Scratch scratch;
  {
    Results results(scratch / "run", sample_layout());
    EXPECT_EQ(results.path(), scratch / "run.h5");
    results.set_pace({7, 1 << 20, std::chrono::hours(1)});
    for (std::size_t s = 0; s < 10000; ++s) {
      write_sample(results, s);
      if (s % 1000 == 0) write_frame(results, s / 1000);
    }
    CheckResult check;
    check.text = "ELEMENT 7 C0 at t = 1";
    check.value = 1.5;
    check.passed = true;
    results.checks({check});
    results.finish(RunStatus::complete);
  }
  const ResultReader file(scratch / "run.h5");
  ASSERT_TRUE(file.opens());
  EXPECT_FALSE(scratch.has("run.h5~"));
  EXPECT_EQ(file.attribute("/", "status"), "complete");
  EXPECT_EQ(file.attribute("/", "title"), "sample <1> & \"2\"");
  EXPECT_EQ(file.attribute("/history/element/GEAR", "type"), "GEAR");
  EXPECT_EQ(file.numbers("/history/element/GEAR/ids"), (std::vector<double>{7, 9}));
  EXPECT_EQ(file.texts("/history/element/GEAR/channels"), std::vector<std::string>{"C0"});
  EXPECT_EQ(file.texts("/history/element/GEAR/units"), std::vector<std::string>{"N"});
  EXPECT_EQ(file.attribute("/history/time", "unit"), "s");
  EXPECT_EQ(file.attribute("/fields/angular_velocity", "unit"), "rad/s");
  const std::vector<double> time = file.numbers("/history/time"), gears = file.numbers("/history/element/GEAR/values"),
                            last = file.numbers("/history/run/values");
  ASSERT_EQ(time.size(), 10000u);
  ASSERT_EQ(gears.size(), 20000u);
  ASSERT_EQ(last.size(), 10000u);
  for (std::size_t s = 0; s < time.size(); ++s) {
    ASSERT_EQ(time[s], 1e-3 * static_cast<double>(s));
    ASSERT_EQ(gears[2 * s + 1], sample_value(s, 1));
    ASSERT_EQ(last[s], sample_value(s, 2));
  }
  EXPECT_EQ(file.numbers("/fields/time").size(), 10u);
  EXPECT_EQ(file.numbers("/fields/rotation/000009")[11], 9.11);
  EXPECT_TRUE(file.has("/checks"));
  // the line of three points is two cells of one element
  EXPECT_EQ(file.numbers("/fields/STRESS/000009"), (std::vector<double>{1, 1, 2, 3, 9}));
  EXPECT_EQ(file.attribute("/fields/STRESS", "center"), "Cell");
  EXPECT_EQ(file.numbers("/points/STRESS/000009"), (std::vector<double>{7, 8, 9}));
  EXPECT_EQ(file.numbers("/points/STRESS/elements"), (std::vector<double>{2, 3, 3}));
  EXPECT_EQ(file.numbers("/points/STRESS/numbers"), (std::vector<double>{0, 0, 1}));
  EXPECT_EQ(file.attribute("/points/STRESS", "unit"), "Pa");
  // a line of three points is two lines, a point a line to itself; then a triangle and a quadrilateral
  const std::vector<double> topology = file.numbers("/mesh/topology");
  EXPECT_EQ(topology, (std::vector<double>{2, 2, 0, 1, 2, 2, 1, 2, 2, 2, 3, 3, 4, 0, 1, 2, 5, 0, 1, 2, 3}));
  EXPECT_EQ(file.numbers("/mesh/cell_elements"), (std::vector<double>{1, 1, 2, 3, 4}));
  const std::string index = read_text(scratch / "run.xdmf");
  EXPECT_NE(index.find("run.h5:/fields/displacement/000009"), std::string::npos);
  EXPECT_EQ(index.find("000010"), std::string::npos);
  EXPECT_NE(index.find("Name=\"STRESS\" AttributeType=\"Scalar\" Center=\"Cell\""), std::string::npos);
}

TEST(Results, AreThereFromTheStartAndWithoutAnEnd) {
  const Scratch scratch;
  {
    Results results(scratch / "run", sample_layout());
    // a copy, for HDF5 does not open a file twice in one process
    std::filesystem::copy_file(scratch / "run.h5", scratch / "copy.h5");
    EXPECT_TRUE(ResultReader(scratch / "copy.h5").opens());
    EXPECT_EQ(ResultReader(scratch / "copy.h5").attribute("/", "status"), "running");
    write_sample(results, 0);
    EXPECT_FALSE(scratch.has("run.h5~"));  // a short run needs no second file
  }
  EXPECT_EQ(ResultReader(scratch / "run.h5").numbers("/history/time").size(), 1u);
  EXPECT_FALSE(scratch.has("run.h5~"));
}

TEST(Results, APartialResultNeverReplacesAGoodOne) {
  const Scratch scratch;
  const auto write = [&](std::size_t samples, RunStatus status) {
    Results results(scratch / "run", sample_layout());
    for (std::size_t s = 0; s < samples; ++s) write_sample(results, s);
    write_frame(results, samples);
    results.finish(status);
    return results.path();
  };
  const auto samples_in = [&](const std::string& name) { return ResultReader(scratch / name).numbers("/history/time").size(); };
  EXPECT_EQ(write(1, RunStatus::failed), scratch / "run.h5");
  EXPECT_EQ(ResultReader(scratch / "run.h5").attribute("/", "status"), "failed");
  EXPECT_EQ(write(2, RunStatus::complete), scratch / "run.h5");  // a partial one is replaced at once
  EXPECT_EQ(write(3, RunStatus::failed), scratch / "run.partial.h5");
  EXPECT_EQ(samples_in("run.h5"), 2u);
  EXPECT_EQ(samples_in("run.partial.h5"), 3u);
  EXPECT_NE(read_text(scratch / "run.partial.xdmf").find("run.partial.h5:/"), std::string::npos);
  EXPECT_EQ(write(4, RunStatus::complete), scratch / "run.h5");
  EXPECT_EQ(samples_in("run.h5"), 4u);
  EXPECT_FALSE(scratch.has("run.partial.h5"));
  EXPECT_FALSE(scratch.has("run.partial.xdmf"));
  EXPECT_NE(read_text(scratch / "run.xdmf").find(">run.h5:/"), std::string::npos);

  std::ofstream(scratch / "notes.h5") << "my diary";
  const Results other(scratch / "notes", sample_layout());
  EXPECT_EQ(other.path(), scratch / "notes.partial.h5");
}

TEST(Results, SecondRunOfTheSameNameIsRefused) {
  const Scratch scratch;
  int written[2], tried[2];
  ASSERT_EQ(pipe(written), 0);
  ASSERT_EQ(pipe(tried), 0);
  char byte = 'x';
  const pid_t pid = fork();
  if (pid == 0) {
    Results first(scratch / "run", sample_layout());
    write_sample(first, 0);
    first.flush();
    if (write(written[1], &byte, 1) != 1 || read(tried[0], &byte, 1) != 1) _exit(1);
    write_sample(first, 1);
    first.finish(RunStatus::complete);
    _exit(0);
  }
  ASSERT_EQ(read(written[0], &byte, 1), 1);
  try {
    const Results second(scratch / "run", sample_layout());
    ADD_FAILURE() << "not refused";
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find("another run"), std::string::npos) << error.what();
  }
  ASSERT_EQ(write(tried[1], &byte, 1), 1);
  int status = 0;
  waitpid(pid, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(ResultReader(scratch / "run.h5").attribute("/", "status"), "complete");
  EXPECT_EQ(ResultReader(scratch / "run.h5").numbers("/history/time").size(), 2u);
}

TEST(FileNames, Exchange) {
  const Scratch scratch;
  const std::string a = scratch / "a", b = scratch / "a~";
  std::ofstream(a) << "first";
  std::ofstream(b) << "second";
  exchange_names(a, b);
  EXPECT_EQ(read_text(a) + read_text(b), "secondfirst");
  exchange_names_by_links(a, b);
  EXPECT_EQ(read_text(a) + read_text(b), "firstsecond");
  EXPECT_FALSE(scratch.has("a~~"));
  EXPECT_THROW(exchange_names(a, scratch / "c"), OutputError);
}

TEST(Results, ErrorsAreSentences) {
  const Scratch scratch;
  try {
    const Results results(scratch / "nowhere/run", sample_layout());
    FAIL();
  } catch (const OutputError& error) {
    EXPECT_EQ(std::string(error.what()), "Cannot write " + (scratch / "nowhere/run.h5") + ": No such file or directory.");
  }
}

TEST(Results, AFullDiskLeavesTheStepsWrittenBefore) {
  const Scratch scratch;
  // a limit on the size of files stands for the full disk; HDF5 must also survive its own end
  EXPECT_EQ(in_child([&] {
              signal(SIGXFSZ, SIG_IGN);
              const rlimit limit{3 << 20, 3 << 20};
              setrlimit(RLIMIT_FSIZE, &limit);
              Results results(scratch / "run", sample_layout(20));
              results.set_pace({1000, 1 << 30, std::chrono::hours(1)});
              try {
                for (std::size_t s = 0; s < 1000000; ++s) write_sample(results, s);
                ADD_FAILURE() << "no error";
              } catch (const OutputError& error) {
                EXPECT_EQ(std::string(error.what()), "Cannot write " + (scratch / "run.h5") + ": File too large.");
              }
              EXPECT_NO_THROW(results.finish(RunStatus::failed));
            }),
            0);
  const ResultReader file(scratch / "run.h5");
  ASSERT_TRUE(file.opens());
  EXPECT_FALSE(scratch.has("run.h5~"));
  const std::size_t samples = file.numbers("/history/time").size();
  EXPECT_GT(samples, 5000u);
  EXPECT_EQ(samples % 1000, 0u);
  EXPECT_EQ(file.numbers("/history/element/GEAR/values").size(), 20 * samples);
}

TEST(Results, TheSizeDependsLittleOnTheBatches) {
  // a slow machine writes in more batches than a fast one; what is foreseen of the size holds for both
  const auto size = [](std::size_t batch) {
    const Scratch scratch;
    {
      Results results(scratch / "run", sample_layout());
      results.set_pace({batch, 1 << 30, std::chrono::hours(1)});
      for (std::size_t s = 0; s < 500; ++s) {
        write_sample(results, s);
        if (s % 2 == 0) write_frame(results, s / 2);
      }
      results.finish(RunStatus::complete);
    }
    return static_cast<double>(std::filesystem::file_size(scratch / "run.h5"));
  };
  const double once = size(1000);
  for (const std::size_t batch : {200, 50}) EXPECT_NEAR(size(batch) / once, 1, 0.05) << batch;
}

TEST(Results, AKilledRunLeavesAWholeFile) {
  // Batches of a few samples follow each other without a pause, so that nearly every kill falls into a write.
  const int kills = std::getenv("ENGRANE_KILLS") ? std::atoi(std::getenv("ENGRANE_KILLS")) : 30;
  std::mt19937 random(1);
  std::uniform_int_distribution<int> milliseconds(1, 60);
  std::size_t most = 0, spares = 0, indexed = 0;
  for (int kill_number = 0; kill_number < kills; ++kill_number) {
    const Scratch scratch;
    int ready[2];
    ASSERT_EQ(pipe(ready), 0);
    const pid_t pid = fork();
    if (pid == 0) {
      Results results(scratch / "run", sample_layout(50));
      results.set_pace({37, 1 << 30, std::chrono::hours(1)});
      write_sample(results, 0);
      results.flush();
      if (write(ready[1], "x", 1) != 1) _exit(1);
      for (std::size_t s = 1;; ++s) {
        write_sample(results, s);
        if (s % 100 == 0) write_frame(results, s / 100);
      }
    }
    char byte = 0;
    ASSERT_EQ(read(ready[0], &byte, 1), 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds(random)));
    kill(pid, SIGKILL);
    waitpid(pid, nullptr, 0);
    close(ready[0]);
    close(ready[1]);

    const ResultReader file(scratch / "run.h5");
    ASSERT_TRUE(file.opens()) << "kill " << kill_number;
    EXPECT_EQ(file.attribute("/", "status"), "running");
    const std::vector<double> time = file.numbers("/history/time");
    ASSERT_GE(time.size(), 1u);
    most = std::max(most, time.size());
    const std::vector<double> values = file.numbers("/history/element/GEAR/values");
    ASSERT_EQ(values.size(), 50 * time.size());
    for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i], sample_value(i / 50, i % 50));
    const std::size_t frames = file.numbers("/fields/time").size();
    for (std::size_t f = 0; f < frames; ++f) {
      ASSERT_EQ(file.numbers(fmt::format("/fields/reaction_torque/{:06}", f)).size(), 12u);
    }
    spares += scratch.has("run.h5~");
    // the index never speaks of a frame that is not there
    const std::string index = read_text(scratch / "run.xdmf");
    if (index.empty()) continue;
    ++indexed;
    EXPECT_NE(index.find("</Xdmf>"), std::string::npos);
    EXPECT_EQ(index.find(fmt::format("displacement/{:06}", frames)), std::string::npos);
  }
  RecordProperty("most_samples", static_cast<int>(most));
  std::printf("%d kills: up to %zu samples read back, %zu spares left, %zu with an index\n", kills, most, spares, indexed);
}

}  // namespace
}  // namespace engrane::testing
