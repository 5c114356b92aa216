// SPDX-License-Identifier: BSD-3-Clause
#include "app/companion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>

#include "app/instants.hpp"
#include "app/interruption.hpp"
#include "app/selection.hpp"
#include "app/writer.hpp"
#include "base/processor_time.hpp"
#include "output/progress.hpp"

namespace engrane::app {

using namespace solve;

namespace {

/// The companion's tolerance over that of the run: steps are about twice as long, or three times those of generalised-alpha.
constexpr double looser = 10, loosest = 0.05, longer = 2;
constexpr double loosest_precision = 2e-5;
/// Least ratio of how sharply they meet events.
constexpr double blunter = 4;
/// A run may be the companion of the next where its tolerance is so much looser.
constexpr double least_looser = 8, most_looser = 20;
/// Results are taken to differ by this power of the ratio of steps (docs/accuracy.md, The dial: what fits nine models best).
/// Radau's own order is 5; less where forces are interpolated, and where teeth and stops make and lose contact.
constexpr double order_of_alpha = 2, order_of_radau = 4;
/// That is so where steps follow the error that they leave; ten times TOL has this ratio of steps then, or less. Where TOL asks
/// for many more steps, it is for something that neither run resolves, such as waves in a mesh, and both may be off by it: of the
/// power counts the less the more steps there are, and with so many times the ratio the error may be the whole difference.
constexpr double smooth_ratio_of_alpha = 3.5, smooth_ratio_of_radau = 2.3, rough = 2.5;
/// TOL has chosen the steps where they are shorter than the longest by this, on the average.
constexpr double well_below = 2;
/// Fraction of the run after which this is decided.
constexpr double early = 0.2;
/// Nearer to 1 a ratio of steps shows nothing.
constexpr double least_ratio = 1.02;
/// Three runs show the order that errors fall with where each has at least so many times the steps of the one before.
constexpr double telling_ratio = 1.2;
/// Errors of motions with corners fall with this order; differences that fall less follow no power of the steps.
constexpr double least_order = 1;
/// No more values than this are kept, of no more instants: errors are means over time.
constexpr std::size_t most_values = std::size_t{1} << 23, most_instants = 2000;
/// A channel with a range of less than this fraction of the largest of its dimension, or of its own size, is taken as rounding;
/// so is an acceleration that changes no velocity by more than this in the whole run.
constexpr double no_range = 1e-6;
/// So is one with a range of less than this fraction of the sizes of its kind, about the residuals of iterations.
constexpr double no_size = 1e-9;
/// A range that falls below this fraction from the companion to the run is for the most part their error.
constexpr double ceases = 0.2;
/// A vibration with half of the range as its amplitude, root of the mean square over time and a little more.
constexpr double largest_lost = 0.4;
/// A velocity of an element is taken to be that of its nodes relative to each other, along an axis, where their ranges differ by
/// no more than this.
constexpr double same_range = 1.2;

bool is_velocity(const Dimension& d) { return d == dimension::velocity || d == dimension::angular_velocity; }

auto find_dimension(auto& all, const Dimension& d) {
  return std::find_if(all.begin(), all.end(), [&d](const auto& one) { return one.dimension == d; });
}

/// The rotation vector of the same rotation that is nearest to `other`: as many turns about its axis are added as it takes.
Vec3 nearest_rotation_vector(const Vec3& v, const Vec3& other) {
  constexpr double turn = 2 * std::numbers::pi;
  const double angle = v.norm();
  if (angle == 0) return v;
  return v * (1 + turn / angle * std::round((v.dot(other) / angle - angle) / turn));
}

/// Why there is no error to state, given the channels asked for that are never judged and whether others are asked for.
std::string why_none(const std::vector<std::string>& unjudged, bool others) {
  constexpr std::size_t most_named = 3;
  if (unjudged.empty()) return "nothing that is asked for changes";
  const auto end = unjudged.begin() + static_cast<std::ptrdiff_t>(std::min(unjudged.size(), most_named));
  return fmt::format("{}{} {} never judged, as no ratio, state or ENERGY_ERROR is{}; ask for a motion or a force beside",
                     fmt::join(unjudged.begin(), end, ", "), end == unjudged.end() ? "" : " and others",
                     unjudged.size() == 1 ? "is" : "are", others ? ", and nothing else that is asked for changes" : "");
}

}  // namespace

SolverOptions with_tolerance(const Model& model, const SolverOptions& options, double tolerance) {
  SolverOptions other = options;
  const double ratio = tolerance / options.tolerance;
  other.tolerance = tolerance;
  other.precision =
      ratio > 1 ? std::min(ratio * options.precision, std::max(loosest_precision, options.precision)) : ratio * options.precision;
  if (model.commands.analysis.events.values.empty()) other.event_tolerance = event_tolerance_for(tolerance);
  return other;
}

Companion::Companion(const Reading& reading, const SolverOptions& options, MPI_Comm comm, bool quiet,
                     const Resumption* resumption, Span span)
    : extent_(reading.model.extent()), duration_(options.end - options.begin), precision_of_run_(options.precision) {
  const double begun = processor_time();
  const Model& model = reading.model;
  SolverOptions loose =
      with_tolerance(model, options, std::min(looser * options.tolerance, std::max(loosest, 2 * options.tolerance)));
  loose.longest *= longer;
  // otherwise both meet the first event, before which they are alike, at the same wrong instant
  if (model.commands.analysis.events.values.empty())
    loose.event_tolerance = std::max(loose.event_tolerance, blunter * options.event_tolerance);
  precision_ = loose.precision;
  estimate_.tolerance = options.tolerance;
  estimate_.begins_looser = options.family == SolverOptions::Family::radau;
  estimate_.companion_tolerance = loose.tolerance;
  SolverContext context(model, loose, comm);
  observe::Observer observer(context.assembler, moves(model), select_compared(model));
  observer.keep_ends();
  choose_columns(observer, model);
  judges_run_ = std::any_of(columns_.begin(), columns_.end(), [](const Column& column) { return column.owner == "run"; });
  const Schedule shown(model.commands.stepping, model.commands.archive);
  const std::size_t expected = shown.expected_samples(), most = std::min(most_instants, most_values / (columns_.size() + 1));
  start_ = options.begin;
  interval_ = shown.even_step(options.step) * std::ceil(static_cast<double>(expected) / static_cast<double>(most));
  interval_ = std::min(interval_, duration_);
  deck::ArchiveCard archive = model.commands.archive;
  archive.history_step = interval_;
  archive.field_step = options.end - options.begin;  // fields are not compared
  Schedule schedule(model.commands.stepping, archive);
  using output::Progress;
  Progress progress(options.begin, options.end,
                    quiet || context.assembler.rank() != 0 ? Progress::Style::silent : Progress::suitable());
  progress.label("for the estimate: ");
  const auto scheme = make_scheme(context);
  order_of_steps_ = options.family == SolverOptions::Family::radau ? order_of_radau : order_of_alpha;
  estimate_.order_of_steps = order_of_steps_;
  estimate_.order = order_of_steps_ / scheme->order_of_error();
  Runner runner(context, *scheme);
  const double from = resumption ? resumption->point.time : options.begin;
  if (resumption) estimate_.since = from;
  double last = from;
  const auto take = [&](double time) {
    if (context.assembler.rank() == 0) record(time, observer.values());
  };
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  const auto follows = [&](long steps, double time) {
    return static_cast<double>(steps) * loose.longest >= well_below * (time - from);
  };
  const StepCallback seen = [&](const Configuration& c, const StepReport& step) {
    std::optional<Instants> instants;
    if (step.number > 0) instants.emplace(schedule, observer, context.out_of_plane, last, c, step);
    if (instants) instants->observe_inside(judges_run_);
    observer.observe(context.out_of_plane.completed(c), {step.step, 0, step.events.size(), step.corner}, true, false);
    if (instants) instants->show([&](double time, const Schedule::Due&) { take(time); });
    if (schedule.even(c.time)) take(c.time);
    if (step.chatter) progress.note("engrane: for the estimate: " + chatter_note(c.time));
    progress.update(c.time, step.step, step.number);
    last = c.time;
    if (were_interrupted(comm, ranks)) return false;  // the run itself then ends at its start
    return span == Span::whole || c.time < from + early * duration_ || follows(runner.steps(), c.time);
  };
  try {
    if (resumption) {
      observer.load(resumption->point.memory);
      runner.resume(resumption->point.memory, seen);
    } else {
      runner.run(seen, [](const StartReport&) {});
    }
  } catch (const SolutionFailure& failure) {
    estimate_.trouble = failure.what();
  } catch (const MemoryShortage& failure) {
    estimate_.trouble = failure.what();
  } catch (const std::out_of_range&) {
    if (!resumption) throw;  // else the run itself tells why it cannot go on
  }
  if (const LostVibrations* const lost = scheme->lost_vibrations()) lost_periods_ = lost->periods();
  find_loads(runner.references());
  steps_ = runner.steps();
  follows_tolerance_ = follows(steps_, last);
  last_ = -std::numeric_limits<double>::infinity();
  begun_ = processor_time();
  estimate_.companion_seconds = begun_ - begun;
}

void Companion::choose_columns(const observe::Observer& observer, const Model& model) {
  const deck::ArchiveCard& archive = model.commands.archive;
  const bool selected = selects(archive) || !archive.channels.empty();
  std::set<int> asked, asked_of_run;
  if (!selected)
    for (const deck::CheckCard& check : model.commands.checks)
      (check.element || check.node ? asked : asked_of_run).insert(checked_channel(observer, check));
  const bool named = selected || !asked.empty();
  const auto choose = [this, named, &model](int at, const std::string& owner, const Channel& channel, int part = -1,
                                            int node = -1) {
    if (channel.course != Channel::Course::smooth && channel.course != Channel::Course::size) {
      if (named) unjudged_.push_back(owner + "/" + channel.name);
      return;
    }
    columns_.push_back({static_cast<std::size_t>(at), static_cast<std::size_t>(at), owner, channel.name, channel.dimension, 0,
                        std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()});
    columns_.back().part = part;
    columns_.back().slides = part >= 0 && channel.course == Channel::Course::size && is_velocity(channel.dimension);
    if (part >= 0 && (channel.dimension == dimension::force || is_velocity(channel.dimension)))
      columns_.back().nodes = model.parts[static_cast<std::size_t>(part)].nodes;
    columns_.back().node = node;
  };
  int at = 0;
  for (const observe::Table& table : observer.tables()) {
    const std::string kind = table.path.substr(0, table.path.find('/') + 1);
    for (std::size_t owner = 0; owner < table.ids.size(); ++owner)
      for (const Channel& channel : table.channels) {
        if (asked.empty() || asked.count(at) > 0)
          choose(at, kind + std::to_string(table.ids[owner]), channel, kind == "element/" ? table.owners[owner] : -1,
                 kind == "node/" ? table.owners[owner] : -1);
        ++at;
      }
  }
  for (std::size_t c = 0; c + 2 < columns_.size(); ++c) {
    const Column &x = columns_[c], &z = columns_[c + 2];
    if (!x.owner.starts_with("node/") || x.owner != z.owner || x.dimension != z.dimension) continue;
    if (!x.channel.ends_with('X') || !z.channel.ends_with('Z')) continue;
    for (std::size_t k = 0; k < 3; ++k) columns_[c + k].component = static_cast<int>(k);
  }
  for (const Channel& channel : observer.run_channels()) {
    if (asked_of_run.count(at) > 0) {
      if (channel.name == "ENERGY_ERROR")
        unjudged_.push_back("run/" + channel.name);  // that is an error itself
      else
        choose(at, "run", channel);
    }
    ++at;
  }
  placed_ = asked.empty();  // else the run has more histories than this one
}

void Companion::find_loads(const References& references) {
  for (Column& column : columns_) {
    if (column.part < 0) continue;
    const Dimension& d = column.dimension;
    const auto part = static_cast<std::size_t>(column.part);
    if (d == dimension::force || d == dimension::moment)
      column.load = precision_ * references.peak_on(part, d == dimension::moment);
    // joints may be left open by a tenth of TOL, which is a lever for forces
    if (d == dimension::moment || d == dimension::power)
      column.load = std::max(column.load, estimate_.companion_tolerance * references.leverage_on(part));
  }
}

std::optional<std::size_t> Companion::place(double time) const {
  // an end of a step that is near an instant but not there is before an event, of which another run may be past
  const double k = std::round((time - start_) / interval_);
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * (std::abs(start_) + std::abs(time));
  if (std::abs(time - (start_ + k * interval_)) > rounding) return {};
  return static_cast<std::size_t>(k);
}

bool Companion::repeats(double time) {
  const double before = std::exchange(last_, time);
  return std::abs(time - before) <= 4 * std::numeric_limits<double>::epsilon() * std::abs(time);
}

void Companion::record(double time, const std::vector<double>& values) {
  const auto row = place(time);
  if (!row || repeats(time)) return;
  if (*row >= rows_) {
    rows_ = *row + 1;
    values_.resize(rows_ * columns_.size(), std::numeric_limits<double>::quiet_NaN());
  }
  for (std::size_t c = 0; c < columns_.size(); ++c) values_[*row * columns_.size() + c] = values[columns_[c].own];
}

void Companion::compare(double time, const observe::Observer& observer) {
  const auto row = place(time);
  if (!row || *row >= rows_ || repeats(time)) return;
  values_run_.resize(values_.size(), std::numeric_limits<double>::quiet_NaN());
  find_columns(observer);
  const std::vector<double>& values = observer.values();
  handled_ = observer.energies().handled();
  ++compared_;
  double* const run = &values_run_[*row * columns_.size()];
  const double* const companion = &values_[*row * columns_.size()];
  for (std::size_t c = 0; c < columns_.size(); ++c) run[c] = values[columns_[c].at];
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const double off = difference(c, run, companion);
    if (!std::isfinite(off)) continue;
    columns_[c].squares += off * off;
    columns_[c].include(run[c]);
  }
}

double Companion::difference(std::size_t column, const double* run, const double* companion) const {
  const double off = run[column] - companion[column];
  if (columns_[column].dimension != dimension::angle) return off;
  const int component = columns_[column].component;
  // an angle begins anew after a turn, and so does a rotation vector along its axis
  if (component < 0) return std::remainder(off, 2 * std::numbers::pi);
  const std::size_t first = column - static_cast<std::size_t>(component);
  const Eigen::Map<const Vec3> own(run + first), other(companion + first);
  return (own - nearest_rotation_vector(other, own))[component];
}

void Companion::find_columns(const observe::Observer& observer) {
  if (!std::exchange(placed_, true))
    for (Column& column : columns_) column.at = static_cast<std::size_t>(observer.channel(column.owner, column.channel));
}

void Companion::widen(const observe::Observer& observer) {
  find_columns(observer);
  const std::vector<double>& values = observer.values();
  for (Column& column : columns_)
    if (std::isfinite(values[column.at])) column.include(values[column.at]);
}

bool Companion::serves(double tolerance) const {
  const double ratio = estimate_.tolerance / tolerance;
  return ratio >= least_looser && ratio <= most_looser;
}

void Companion::succeed(long steps, const SolverOptions& next, const LostVibrations* lost) {
  lost_periods_ = lost ? lost->periods() : std::vector<double>();
  const double now = processor_time();
  estimate_.earlier_seconds += estimate_.companion_seconds;
  estimate_.companion_seconds = now - std::exchange(begun_, now);
  estimate_.companion_tolerance = std::exchange(estimate_.tolerance, next.tolerance);
  precision_ = std::exchange(precision_of_run_, next.precision);
  for (Column& column : columns_) column.before = column.earlier = compared_ > 0 ? difference(column) : 0;
  steps_before_ = std::exchange(steps_, steps);
  values_ = std::exchange(values_run_, {});
  compared_ = 0;
  last_ = -std::numeric_limits<double>::infinity();
  for (Column& column : columns_) {
    column.squares = 0;
    column.least = std::numeric_limits<double>::infinity();
    column.largest = -column.least;
  }
}

std::vector<double> Companion::differences() const {
  std::vector<double> all;
  for (std::size_t c = 0; c < columns_.size() && compared_ > 0; ++c) all.push_back(difference(columns_[c]));
  return all;
}

void Companion::remember(const std::vector<double>& differences) {
  if (differences.size() != columns_.size()) return;
  for (std::size_t c = 0; c < columns_.size(); ++c) columns_[c].earlier = differences[c];
}

double Companion::difference(const Column& column) const { return std::sqrt(column.squares / static_cast<double>(compared_)); }

double Companion::order_of(const Column& column, long steps, double assumed) const {
  const auto number = [](long n) { return static_cast<double>(std::max(n, 1L)); };
  const double refined = number(steps_) / number(steps_before_), ratio = number(steps) / number(steps_);
  if (!(column.before > 0) || assumed <= least_order || std::min(refined, ratio) < telling_ratio) return assumed;
  // the differences of the second pair over those of the first; it falls with p
  const auto quotient = [&](double p) { return (1 - std::pow(ratio, -p)) / (std::pow(refined, p) - 1); };
  const double found = difference(column) / column.before;
  // with less than the least order a run may be good and its companion not: ErrorEstimate::follow() sees what does not fall
  if (found <= quotient(assumed) || found >= quotient(least_order)) return assumed;
  double low = least_order, high = assumed;
  for (int halvings = 0; halvings < 30; ++halvings) {
    const double middle = 0.5 * (low + high);
    (quotient(middle) > found ? low : high) = middle;
  }
  return low;
}

std::vector<Companion::Largest> Companion::largest_by_dimension() const {
  std::vector<Largest> all;
  for (const Column& column : columns_) {
    auto found = find_dimension(all, column.dimension);
    if (found == all.end()) found = all.insert(found, {column.dimension});
    found->range = std::max(found->range, column.range());
    found->size = std::max(found->size, column.size());
  }
  return all;
}

bool Companion::stands_still(const Column& column) const {
  constexpr double rounding = 32 * std::numeric_limits<double>::epsilon();
  static const std::map<char, char> places{{'V', 'U'}, {'A', 'U'}, {'W', 'R'}, {'E', 'R'}};
  if (column.node < 0 || column.channel.size() != 2 || !places.contains(column.channel[0])) return false;
  const std::string place{places.at(column.channel[0]), column.channel[1]};
  for (const Column* other = &column; other->node == column.node; --other) {  // those of a node follow one another
    if (other->channel == place) return other->range() <= rounding * (place[0] == 'U' ? extent_ : 1.0);
    if (other == columns_.data()) break;
  }
  return false;
}

bool Companion::is_rounding(const Column& column, const std::vector<Largest>& all) const {
  constexpr double falling = 0.5, small = 1e-4;
  return column.earlier > 0 && difference(column) > falling * column.earlier &&
         column.range() < small * find_dimension(all, column.dimension)->range;
}

double Companion::noise_of(const Column& column, const std::vector<Largest>& all) const {
  if (stands_still(column)) return std::numeric_limits<double>::infinity();
  const Dimension& own = column.dimension;
  const bool is_place = own.mass == 0 && own.time == 0, is_acceleration = own.mass == 0 && own.time == -2;
  // iterations balance loads up to a part of those around, and with them powers and accelerations
  double noise = no_range * column.size();
  if (is_acceleration && column.component >= 0)
    for (const Column *x = &column - column.component, *k = x; k < x + 3; ++k) noise = std::max(noise, precision_ * k->size());
  if (own == dimension::power) {
    const auto size = [&all](const Dimension& d) {
      const auto found = find_dimension(all, d);
      return found == all.end() ? 0 : found->size;
    };
    const double moment = column.load + no_size * (size(dimension::moment) + extent_ * size(dimension::force));
    noise = std::max({noise, precision_ * column.size(), moment * size(dimension::angular_velocity)});
  } else {
    noise = std::max(noise, column.load);
  }
  // work that loads and drives do on one another, and nothing else
  if (column.owner == "run" && own == dimension::energy) noise = std::max(noise, no_range * handled_);
  // rates that lead no farther in the whole run are no more than such places
  if (own.mass == 0 && own.time <= 0)
    noise = std::max(noise, no_size * std::pow(extent_, own.length) * std::pow(duration_, own.time));
  for (const Largest& other : all) {
    if (other.dimension == own) noise = std::max(noise, no_range * other.range);
    // an angular velocity and a velocity, a force and a moment are of one kind but for a lever
    const int levers = own.length - other.dimension.length, times = own.time - other.dimension.time;
    if (is_place || other.dimension.mass != own.mass || std::abs(levers) > 1) continue;
    const double size = other.size * std::pow(extent_, levers) * std::pow(duration_, times);
    if (is_acceleration && times == -1)
      noise = std::max(noise, no_range * size);
    else if (times == 0 || own.mass != 0)
      noise = std::max(noise, (column.slides ? precision_ : no_size) * size);
  }
  return noise;
}

double Companion::scale_of(std::size_t c) const {
  const Column& column = columns_[c];
  Column companion = column;
  companion.least = std::numeric_limits<double>::infinity();
  companion.largest = -companion.least;
  for (std::size_t row = 0; row < rows_; ++row)
    if (const double value = values_[row * columns_.size() + c]; std::isfinite(value)) companion.include(value);
  return column.range() < ceases * companion.range() ? column.size() : column.range();
}

bool Companion::contradicts(const LostVibrations& lost, std::size_t slot) const {
  constexpr double same = 1.3;
  const double own = lost.period(slot), other = slot / 3 < lost_periods_.size() ? lost_periods_[slot / 3] : 0;
  return own > 0 && other > 0 && (own > same * other || other > same * own);
}

LostChannel Companion::lost_acceleration(const Column& column, const LostVibrations& lost) const {
  const bool turns = column.dimension == dimension::angular_acceleration;
  if (column.node < 0 || (!turns && column.dimension != dimension::acceleration)) return {};
  const auto first = static_cast<std::size_t>(6 * column.node + (turns ? 3 : 0));
  const auto axis = static_cast<std::size_t>(column.channel.back() - 'X');
  double missing = lost.missing(first + axis), range = column.range();
  // rotations have axes of their own: all of their part is compared with all of the range
  if (turns && column.component >= 0) {
    missing = std::hypot(lost.missing(first), lost.missing(first + 1), lost.missing(first + 2));
    const Column* const x = &column - column.component;
    range = std::hypot(x[0].range(), x[1].range(), x[2].range());
    // it is told of the one that changes most
    if (column.range() < std::max({x[0].range(), x[1].range(), x[2].range()})) return {};
  }
  if (contradicts(lost, first)) return {};
  return {missing / range, column.owner + "/" + column.channel, lost.period(first)};
}

LostChannel Companion::lost_force(const Column& column, const LostVibrations& lost) const {
  if (column.part < 0 || column.dimension != dimension::force) return {};  // moments have the dimension of energies
  // which of the forces of an element it is cannot be told: the one that changes most
  const auto begin = columns_.begin() + (&column - columns_.data());
  const auto elsewhere = [&](const Column& other) { return other.part != column.part; };
  const auto larger = [&](const Column& other) { return other.dimension == column.dimension && other.range() > column.range(); };
  // the channels of an element follow one another
  const auto before = std::make_reverse_iterator(begin);
  if (std::any_of(before, std::find_if(before, columns_.rend(), elsewhere), larger)) return {};
  if (std::any_of(begin, std::find_if(begin, columns_.end(), elsewhere), larger)) return {};
  LostChannel most;
  for (const int node : column.nodes) {
    if (node == 0) continue;
    const auto first = static_cast<std::size_t>(6 * node);
    if (contradicts(lost, first)) continue;
    const double error = lost.missing_force(first) / column.range();
    // the force has shown what was lost, unless another element carries it
    if (error > most.error && error < largest_lost) most = {error, column.owner + "/" + column.channel, lost.period(first)};
  }
  return most;
}

LostChannel Companion::lost_speed(const Column& column, const LostVibrations& lost) const {
  if (column.part < 0 || !is_velocity(column.dimension) || column.nodes.empty() || column.nodes.size() > 2) return {};
  const int a = column.nodes.front(), b = column.nodes.size() == 2 ? column.nodes.back() : 0;
  if (a == b) return {};
  const std::size_t first = lost.relative(a, b) + (column.dimension == dimension::angular_velocity ? 3 : 0);
  if (contradicts(lost, first)) return {};
  LostChannel most;
  for (std::size_t slot = first; slot < first + 3; ++slot) {
    const double error = lost.missing_speed(slot) / column.range(), ratio = lost.range_of_speed(slot) / column.range();
    if (error > most.error && error < largest_lost && ratio < same_range && same_range * ratio > 1)
      most = {error, column.owner + "/" + column.channel, lost.period(slot)};
  }
  return most;
}

LostChannel Companion::most_lost(const LostVibrations& lost) const {
  LostChannel most;
  const std::vector<Largest> all = largest_by_dimension();
  for (const Column& column : columns_) {
    if (!(column.range() > noise_of(column, all))) continue;
    for (const LostChannel& found : {lost_acceleration(column, lost), lost_force(column, lost), lost_speed(column, lost)})
      if (found.error > most.error) most = found;
  }
  return most;
}

ErrorEstimate Companion::estimate(long steps) const {
  ErrorEstimate found = estimate_;
  found.seconds = processor_time() - begun_;
  if (!found.trouble.empty()) return found;
  found.ratio_of_steps = static_cast<double>(steps) / static_cast<double>(std::max(steps_, 1L));
  const double ratio = std::max(found.ratio_of_steps, least_ratio);
  const double smooth = order_of_steps_ == order_of_radau ? smooth_ratio_of_radau : smooth_ratio_of_alpha;
  const double kept = 1 - std::clamp(std::log(ratio / smooth) / std::log(rough), 0.0, 1.0), assumed = order_of_steps_ * kept;
  const auto share_of = [ratio](double order) { return 1 / (std::pow(ratio, order) - 1); };  // the error over the difference
  const double share = ratio > smooth ? std::min(share_of(assumed), 1.0) : share_of(assumed);
  const std::vector<Largest> all = largest_by_dimension();
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const Column& column = columns_[c];
    if (!(column.range() > noise_of(column, all)) || is_rounding(column, all)) continue;
    const double order = order_of(column, steps, assumed);
    const double own_share = order < assumed ? std::max(share, std::min(share_of(order), 1.0)) : share;
    const double error = own_share * difference(column) / scale_of(c);
    if (error >= found.error) {
      found.error = error;
      found.share = own_share;
      found.order = estimate_.order * (order < assumed ? order / order_of_steps_ : 1);
      found.channel = column.owner + "/" + column.channel;
    }
  }
  if (found.channel.empty()) found.trouble = why_none(unjudged_, !columns_.empty());
  return found;
}

}  // namespace engrane::app
