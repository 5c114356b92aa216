// SPDX-License-Identifier: BSD-3-Clause
#include "app/price.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "app/layout.hpp"
#include "app/schedule.hpp"
#include "app/selection.hpp"
#include "base/processor_time.hpp"
#include "observe/observer.hpp"
#include "output/table.hpp"

namespace engrane::app {

namespace {

/// Shortest time of `work`, which is called repeatedly for about four milliseconds, at most 20 times and at least once. In
/// processor time, because other programs may be using the processor too.
template <class Work>
double shortest(const Work& work) {
  double least = std::numeric_limits<double>::infinity();
  const double begun = processor_time();
  for (int call = 0; call < 1 || (call < 20 && processor_time() - begun < 0.004); ++call) {
    const double start = processor_time();
    work();
    least = std::min(least, processor_time() - start);
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

/// Bytes that HDF5 1.10 adds, as measured in files of this program: the header of an array with its entry in the group, the
/// index of an array in chunks, and a group.
constexpr double array_bytes = 240, index_bytes = 2100, group_bytes = 1100;
/// Arrays above this size are stored in chunks and compressed (hdf5::Place).
constexpr double small = 4096;
/// Fraction left by compression of arrays of computed values, and of texts.
constexpr double values_left = 0.75, text_left = 0.25;

/// Bytes of an array in the file. `left`: fraction left by compression.
double array_size(double bytes, double left) { return array_bytes + (bytes <= small ? bytes : index_bytes + left * bytes); }

double numbers_size(std::size_t count, double left = values_left) { return array_size(8.0 * static_cast<double>(count), left); }

/// A list of texts, all stored with the length of the longest.
template <class Text>
double texts_size(const output::HistoryTable& table, const Text& text) {
  std::size_t width = 1;
  for (const Channel& channel : table.channels) width = std::max(width, text(channel).size());
  return array_size(static_cast<double>(width * table.channels.size()), text_left);
}

double histories_size(const output::ResultsLayout& layout, std::size_t samples) {
  double sum = array_bytes + index_bytes + 8.0 * static_cast<double>(samples);  // times
  for (const output::HistoryTable& table : layout.history) {
    sum += group_bytes + array_size(4.0 * static_cast<double>(table.ids.size()), text_left);
    sum += texts_size(table, [](const Channel& channel) -> const std::string& { return channel.name; });
    sum += texts_size(table, [](const Channel& channel) -> const std::string& { return channel.help; });
    sum += texts_size(table, [&](const Channel& channel) { return layout.units.label(channel.dimension); });
    sum += array_bytes + index_bytes + 8.0 * static_cast<double>(table.columns() * samples);
  }
  return sum;
}

/// The groups of the fields, each with two or three attributes, and what belongs to all instants.
double field_groups_size(const output::ResultsLayout& layout) {
  constexpr double attributes = 300;
  const std::size_t groups =
      layout.node_fields.size() + layout.cell_fields.size() + layout.point_fields.size() + layout.averages.size();
  double sum = static_cast<double>(groups) * (group_bytes + attributes);
  for (const output::PointField& field : layout.point_fields)
    sum += 2 * array_size(4.0 * static_cast<double>(field.rows()), text_left);
  return sum;
}

/// The fields of one instant.
double frame_size(const output::ResultsLayout& layout) {
  constexpr double few_left = 0.02;  // of arrays that are almost all zero
  const std::size_t points = layout.points.size();
  const bool only_cells = std::none_of(layout.cells.begin(), layout.cells.end(),
                                       [](const output::Cell& cell) { return cell.shape == CellShape::none; });
  double sum = 8;
  for (const Named& field : layout.node_fields) {
    const bool turns = field.name.find("rotation") != std::string::npos || field.name.starts_with("angular");
    const bool sparse = field.name.starts_with("reaction") || (turns && only_cells);
    sum += numbers_size(3 * points, sparse ? few_left : values_left);
  }
  for (const output::CellField& field : layout.averages) sum += numbers_size(points * field.width());
  for (const output::CellField& field : layout.cell_fields) sum += numbers_size(layout.cells.size() * field.width());
  for (const output::PointField& field : layout.point_fields) sum += numbers_size(field.rows() * field.field.width());
  return sum;
}

double restart_size(const output::ResultsLayout& layout, const ResultCounts& counts) {
  // arrays of a point and their groups; most hold one number to five
  constexpr double arrays = 75, groups = 13, in_chunks = 3, few = 100;
  // positions, rates and accelerations of a node with its frame; peaks of channels; energies of frames; the matrix twice
  const double numbers = few + 50.0 * static_cast<double>(layout.points.size()) +
                         2.0 * static_cast<double>(layout.channel_count()) + 6.0 * static_cast<double>(counts.frames) +
                         2.0 * counts.nonzeros;
  return arrays * array_bytes + groups * group_bytes + in_chunks * index_bytes + values_left * 8 * numbers;
}

/// Processor times in seconds of the parts of an iteration, and what its factors take.
struct IterationCost {
  struct Kind {
    std::size_t elements = 0;
    double tangents = 0;
  };
  std::map<std::string, Kind> kinds;  ///< of elements
  double assembly = 0;                ///< of the tangent, with those of all elements
  double residual = 0;
  double solving = 0;       ///< assembly, factors and solution
  double factor_bytes = 0;  ///< 0: not known
  bool regular = true;      ///< the matrix has factors
  bool factored = true;     ///< they were made, not only foreseen

  double factors() const { return std::max(solving - assembly, 0.0); }
  double whole() const { return residual + std::max(solving, assembly); }
};

/// Measures an iteration at `c`. Changes the assembler's scale and the solver's factors. Collective.
IterationCost measure_iteration(const Model& model, solve::SolverContext& context, const Configuration& c) {
  IterationCost cost;
  const double h = model.commands.stepping.step;
  Configuration here = c;
  here.h = h;
  const Weights weights = model.commands.analysis.type.is("DYNAMIC") ? Weights{1, 1 / h, 4 / (h * h)} : Weights{1, 0, 0};
  std::map<std::string, std::vector<int>> kinds;
  for (int p = 0; p < context.numbering.parts(); ++p) kinds[model.part(p).type].push_back(p);
  for (const auto& [kind, parts] : kinds) {
    // a hundred elements of a kind are representative
    const std::span<const int> some = std::span(parts).first(std::min<std::size_t>(parts.size(), 100));
    const double time = shortest([&] {
      for (const int part : some) context.assembler.element_tangent(part, here, weights);
    });
    cost.kinds[kind] = {parts.size(), time * static_cast<double>(parts.size()) / static_cast<double>(some.size())};
  }
  context.assembler.choose_scale(here, weights, context.options.scale);
  cost.assembly = shortest([&] { context.assembler.tangent(here, weights); });
  Owned<Vec> right, solution;
  *right.out() = context.assembler.new_vector();
  *solution.out() = context.assembler.new_vector();
  cost.residual = shortest([&] { context.assembler.residual(here, right); });
  context.assembler.tangent(here, weights);
  if (const auto foreseen = context.solver.foresee(); foreseen && foreseen->operations > most_operations) {
    cost.factored = false;
    cost.factor_bytes = foreseen->bytes;
    cost.solving = cost.assembly + foreseen->operations / operations_per_second;
  } else {
    cost.solving = shortest([&] {
      context.assembler.tangent(here, weights);
      cost.regular = context.solver.solve(right, solution) && cost.regular;
    });
    cost.factor_bytes = context.solver.factor_bytes();
  }
  return cost;
}

std::string shares_table(const IterationCost& cost) {
  output::Table table({{"of an iteration", output::Table::Align::left}, {"number"}, {"share, %"}});
  const double whole = cost.whole();
  double elements = 0;
  for (const auto& [name, kind] : cost.kinds) elements += kind.tangents;
  for (const auto& [name, kind] : cost.kinds) {
    const double share = elements > 0 ? kind.tangents / elements * std::min(cost.assembly / whole, 1.0) : 0;
    table.row({name, std::to_string(kind.elements), fmt::format("{:.0f}", 100 * share)});
  }
  table.row({"factors and solution", "", cost.regular ? fmt::format("{:.0f}", 100 * cost.factors() / whole) : "-"});
  table.row({"residual", "", fmt::format("{:.0f}", 100 * cost.residual / whole)});
  return table.text();
}

/// Time of a step and of a run of so many; 0: of one equilibrium.
std::string describe_times(const IterationCost& cost, double steps) {
  if (!cost.regular) return "\n  the matrix is singular in the first position: no time is foreseen\n";
  const double step = 1.2 * 2 * cost.whole();
  const std::string source = cost.factored
                                 ? "as measured on this machine"
                                 : fmt::format("if it makes {:.0f} operations in a nanosecond", operations_per_second / 1e9);
  if (steps == 0) return fmt::format("\n  about {} for the one equilibrium, processor time {}\n", time_text(step), source);
  return fmt::format("\n  about {} a step and {} for {:.0f} steps, at two iterations a step, processor time {}\n",
                     time_text(step), time_text(step * steps), steps, source);
}

double nonzeros_of(const Assembler& assembler) {
  MatInfo info{};
  check_petsc(MatGetInfo(assembler.matrix(), MAT_LOCAL, &info));
  return assembler.half() ? 2 * info.nz_used - assembler.numbering().equations() : info.nz_used;
}

}  // namespace

double expected_result_bytes(const output::ResultsLayout& layout, const ResultCounts& counts) {
  constexpr double rest = 12e3;  // groups and attributes of the file, units, checks
  const double description = array_size(static_cast<double>(layout.deck_text.size()), text_left) +
                             array_size(static_cast<double>(layout.model_json.size()), text_left) +
                             numbers_size(3 * layout.points.size()) + numbers_size(4 * layout.cells.size(), text_left);
  return rest + description + histories_size(layout, counts.samples) + field_groups_size(layout) +
         frame_size(layout) * static_cast<double>(counts.frames) +
         restart_size(layout, counts) * static_cast<double>(counts.restarts);
}

std::string describe_price(const Reading& reading, solve::SolverContext& context, const Configuration& c) {
  const Model& model = reading.model;
  const Numbering& numbering = context.numbering;
  if (numbering.equations() == 0) return "";
  const deck::SteppingCard& stepping = model.commands.stepping;
  const IterationCost cost = measure_iteration(model, context, c);
  const double nonzeros = nonzeros_of(context.assembler);
  std::string text = "\nExpected cost\n" + shares_table(cost);
  text += fmt::format("  matrix: {} equations, {:.0f} nonzeros", numbering.equations(), nonzeros);
  if (cost.regular && cost.factor_bytes > 0)
    text += fmt::format("; the factors take {}{}", cost.factored ? "" : "about ", size_text(cost.factor_bytes));
  const double steps = std::ceil((stepping.end - stepping.start) / stepping.step * (1 - 1e-9));
  text += describe_times(cost, steps);
  const observe::Observer observer(context.assembler, moves(model), select_histories(model));
  const std::size_t samples = Schedule(stepping, model.commands.archive).expected_samples();
  const output::ResultsLayout layout = results_layout(reading, observer, samples);
  const double frame_step = model.commands.archive.field_step.value_or((stepping.end - stepping.start) / 200);
  const auto frames =
      steps == 0 ? 1 : static_cast<std::size_t>(std::min(steps, (stepping.end - stepping.start) / frame_step)) + 1;
  ResultCounts counts{samples, frames, reading.is_one_solution() ? 0U : 1U, nonzeros};
  if (const std::optional<double> interval = model.commands.archive.restart_step; interval && *interval > 0)
    counts.restarts += static_cast<std::size_t>((stepping.end - stepping.start) / *interval);
  return text + fmt::format("  results: {} channels, {} samples, {} frames: a file of about {}\n", layout.channel_count(),
                            samples, frames, size_text(expected_result_bytes(layout, counts)));
}

}  // namespace engrane::app
