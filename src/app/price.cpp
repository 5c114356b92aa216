// SPDX-License-Identifier: BSD-3-Clause
#include "app/price.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <map>
#include <vector>

#include "app/schedule.hpp"
#include "app/selection.hpp"
#include "observe/observer.hpp"
#include "output/table.hpp"

namespace engrane::app {

namespace {

/// Processor time, because other programs may be using the processor too.
double seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Shortest time of `work`, which is called repeatedly for about four milliseconds, at most 20 times and at least once.
template <class Work>
double shortest(const Work& work) {
  double least = std::numeric_limits<double>::infinity();
  const double begun = seconds();
  for (int call = 0; call < 1 || (call < 20 && seconds() - begun < 0.004); ++call) {
    const double start = seconds();
    work();
    least = std::min(least, seconds() - start);
  }
  return least;
}

/// Factorisations with more operations are only estimated, not performed. The limit is five seconds at this speed, which one
/// core of a machine of 2020 reaches.
constexpr double operations_per_second = 1e10, most_operations = 5 * operations_per_second;

std::string time_text(double time) {
  if (time < 1e-3) return fmt::format("{:.0f} us", time * 1e6);
  if (time < 1) return fmt::format("{:.3g} ms", time * 1e3);
  if (time < 120) return fmt::format("{:.2g} s", time);
  return time < 7200 ? fmt::format("{:.2g} min", time / 60) : fmt::format("{:.2g} h", time / 3600);
}

std::string size_text(double bytes) {
  if (bytes < 1e3) return fmt::format("{:.0f} bytes", bytes);
  return bytes < 1e6   ? fmt::format("{:.3g} kB", bytes / 1e3)
         : bytes < 1e9 ? fmt::format("{:.3g} MB", bytes / 1e6)
                       : fmt::format("{:.3g} GB", bytes / 1e9);
}

}  // namespace

double expected_result_bytes(std::size_t channels, std::size_t samples, std::size_t nodes, std::size_t frames) {
  constexpr std::size_t components = 6;  // displacement and rotation of a node
  constexpr double description = 1.5e5;  // the deck, the model, names and restart data
  return description + 8.0 * (static_cast<double>(channels + 1) * static_cast<double>(samples) +
                              static_cast<double>(components * nodes) * static_cast<double>(frames));
}

std::string describe_price(const Reading& reading, solve::SolverContext& context, const Configuration& c) {
  const Model& model = reading.model;
  const Numbering& numbering = context.numbering;
  if (numbering.equations() == 0) return "";
  const deck::SteppingCard& stepping = model.commands.stepping;
  Configuration here = c;
  here.h = stepping.step;
  const double h = stepping.step;
  const Weights weights = model.commands.analysis.type.is("DYNAMIC") ? Weights{1, 1 / h, 4 / (h * h)} : Weights{1, 0, 0};

  std::map<std::string, std::vector<int>> kinds;
  for (int p = 0; p < numbering.parts(); ++p) kinds[model.parts[static_cast<std::size_t>(p)].type].push_back(p);
  std::map<std::string, double> times;
  double elements = 0;
  std::vector<double> r, k;
  for (const auto& [kind, parts] : kinds) {
    // a hundred elements of a kind are representative
    const std::size_t count = std::min<std::size_t>(parts.size(), 100);
    const double time = shortest([&] {
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t n = numbering.part_slots(parts[i]).size();
        r.assign(n, 0);
        k.assign(n * n, 0);
        model.parts[static_cast<std::size_t>(parts[i])].element->tangent(context.assembler.view(parts[i], here), weights, r, k);
      }
    });
    times[kind] = time * static_cast<double>(parts.size()) / static_cast<double>(count);
    elements += times[kind];
  }
  context.assembler.choose_scale(here, weights, context.options.scale);
  const double assembly = shortest([&] { context.assembler.tangent(here, weights); });
  Owned<Vec> right, solution;
  *right.out() = context.assembler.new_vector();
  *solution.out() = context.assembler.new_vector();
  const double residual = shortest([&] { context.assembler.residual(here, right); });
  bool regular = true, factored = true;
  double solving = 0, bytes = 0;
  context.assembler.tangent(here, weights);
  if (const auto foreseen = context.solver.foresee(); foreseen && foreseen->operations > most_operations) {
    factored = false;
    bytes = foreseen->bytes;
    solving = assembly + foreseen->operations / operations_per_second;
  } else {
    solving = shortest([&] {
      context.assembler.tangent(here, weights);
      regular = context.solver.solve(right, solution) && regular;
    });
    bytes = context.solver.factor_bytes();
  }
  const double factors = std::max(solving - assembly, 0.0), iteration = residual + std::max(solving, assembly);

  std::string text = "\nExpected cost\n";
  output::Table table({{"of an iteration", output::Table::Align::left}, {"number"}, {"share, %"}});
  for (const auto& [kind, time] : times) {
    const double share = elements > 0 ? time / elements * std::min(assembly / iteration, 1.0) : 0;
    table.row({kind, std::to_string(kinds[kind].size()), fmt::format("{:.0f}", 100 * share)});
  }
  table.row({"factors and solution", "", regular ? fmt::format("{:.0f}", 100 * factors / iteration) : "-"});
  table.row({"residual", "", fmt::format("{:.0f}", 100 * residual / iteration)});
  text += table.text();
  MatInfo info{};
  check_petsc(MatGetInfo(context.assembler.matrix(), MAT_LOCAL, &info));
  const double whole = context.assembler.half() ? 2 * info.nz_used - numbering.equations() : info.nz_used;
  text += fmt::format("  matrix: {} equations, {:.0f} nonzeros", numbering.equations(), whole);
  if (regular && bytes > 0) text += fmt::format("; the factors take {}{}", factored ? "" : "about ", size_text(bytes));
  const double steps = std::ceil((stepping.end - stepping.start) / h * (1 - 1e-9)), step = 1.2 * 2 * iteration;
  const std::string source = factored ? "as measured on this machine"
                                      : fmt::format("if it makes {:.0f} operations in a nanosecond", operations_per_second / 1e9);
  if (regular && steps == 0)
    text += fmt::format("\n  about {} for the one equilibrium, processor time {}\n", time_text(step), source);
  else if (regular)
    text += fmt::format("\n  about {} a step and {} for {:.0f} steps, at two iterations a step, processor time {}\n",
                        time_text(step), time_text(step * steps), steps, source);
  else
    text += "\n  the matrix is singular in the first position: no time is foreseen\n";
  const observe::Observer observer(context.assembler, moves(model), select_histories(model));
  std::size_t channels = observer.run_channels().size();
  for (const observe::Table& one : observer.tables()) channels += one.ids.size() * one.channels.size();
  const std::size_t samples = Schedule(stepping, model.commands.archive).expected_samples();
  const double frame_step = model.commands.archive.field_step.value_or((stepping.end - stepping.start) / 200);
  const auto frames =
      steps == 0 ? 1 : static_cast<std::size_t>(std::min(steps, (stepping.end - stepping.start) / frame_step)) + 1;
  return text + fmt::format("  results: {} channels, {} samples, {} frames: a file of about {}\n", channels, samples, frames,
                            size_text(expected_result_bytes(channels, samples, model.nodes.size() - 1, frames)));
}

}  // namespace engrane::app
