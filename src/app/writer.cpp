// SPDX-License-Identifier: BSD-3-Clause
#include "app/writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <utility>

#include "app/largest.hpp"
#include "app/layout.hpp"
#include "app/model_json.hpp"
#include "app/plausibility.hpp"
#include "app/selection.hpp"
#include "app/summary.hpp"
#include "app/terminal.hpp"
#include "app/trial.hpp"
#include "app/version.hpp"
#include "base/text.hpp"

namespace engrane::app {

using namespace output;
using namespace solve;

namespace {

/// Checks of the deck with their channels. The reader has verified that the channels exist.
Checks resolve_checks(const Model& model, const observe::Observer& observer) {
  std::vector<Checks::Resolved> all;
  for (const deck::CheckCard& card : model.commands.checks)
    all.push_back({card, static_cast<std::size_t>(checked_channel(observer, card))});
  return Checks(std::move(all));
}

Results make_results(const std::string& prefix, ResultsLayout layout, const Resumption* resumed) {
  if (resumed) return {prefix, std::move(layout), resumed->earlier, resumed->point};
  return {prefix, std::move(layout)};
}

/// Empty for a model without a mesh.
std::string listed_loads(const observe::Observer& observer, const UnitSystem& units) {
  const auto value = [&observer](const char* name, std::size_t next = 0) {
    return observer.values()[static_cast<std::size_t>(observer.channel("run", name)) + next];
  };
  const auto vector = [&value](const char* first) { return Vec3(value(first), value(first, 1), value(first, 2)); };
  if (observer.channel("run", "LOAD_WORK") < 0) return {};
  return listing_loads(
      {vector("LOAD_FORCE_X"), vector("LOAD_MOMENT_X"), vector("GROUND_FORCE_X"), vector("GROUND_MOMENT_X"), value("LOAD_WORK")},
      units);
}

/// The message with its hint, if it has one.
std::string with_hint(const Diagnostic& one) { return one.hint.empty() ? one.message : one.message + "; " + one.hint; }

/// Further events are only counted.
constexpr long most_listed_events = 100;
constexpr std::size_t most_listed_bodies = 100, most_listed_peaks = 400;

}  // namespace

std::string chatter_note(double time) {
  return fmt::format(
      "t = {:.6g}: events come too thick to be met one by one; some steps pass over them. Where a law jumps and the motion stays "
      "at the jump, as with a relay, a steep slope in the place of the jump takes fewer steps",
      time);
}

Writer::Writer(const Reading& reading, const observe::Observer& observer, const Schedule& schedule, const Options& options,
               const std::string& prefix, const Resumption* resumed, RunSummary& summary)
    : reading_(reading),
      options_(options),
      summary_(summary),
      observer_(observer),
      schedule_(schedule),
      results_(make_results(prefix, results_layout(reading, observer, schedule.expected_samples()), resumed)),
      listing_(results_.name()),
      checks_(resolve_checks(reading.model, observer)),
      progress_(reading.model.commands.stepping.start, reading.model.commands.stepping.end,
                options.quiet ? Progress::Style::silent : Progress::suitable()),
      peaks_(results_.layout().history) {}

void Writer::begin(const SolverContext& context, int ranks) {
  const Model& model = reading_.model;
  std::string deck = summary_.deck;
  for (const auto& [name, text] : summary_.overrides.definitions) deck += fmt::format(" -D {}={}", name.substr(1), text);
  for (const std::string& card : summary_.overrides.cards) deck += fmt::format(" --card \"{}\"", card);
  listing_.write(listing_header({version, library_versions(), model.title, deck, describe_analysis(context),
                                 fmt::format("{} process{}", ranks, ranks == 1 ? "" : "es")}));
  listing_.write(listing_section("What was built"));
  listing_.write(listing_built(summarize(model, context.numbering)));
  listing_.write(describe_geometry(model));
  if (const std::string masses = describe_masses(model, most_listed_bodies); !masses.empty()) {
    listing_.write(listing_section("Masses"));
    listing_.write(masses);
  }
  listing_.write(listing_warnings(reading_.diagnostics, reading_.sources));
  if (const std::string text = reading_.assumptions(); !text.empty()) {
    listing_.write(fmt::format("\n  {}\n", text));
    progress_.note("engrane: " + text);
  }
  if (const std::string text = left_out_histories(model); !text.empty()) {
    listing_.write(fmt::format("\n  {}\n", text));
    progress_.note("engrane: " + text);
  }
  listing_.write(listing_section("Start"));
}

void Writer::resumed(const Resumption& from) {
  continues_ = true;
  checks_.load(from.point.memory);
  peaks_.load(from.point.memory);
  const Snapshot& memory = from.point.memory;
  const std::vector<double>& counts = memory.array("writer/counts");
  steps_ = static_cast<long>(counts.at(0));
  iterations_ = static_cast<long>(counts.at(1));
  cuts_ = static_cast<long>(counts.at(2));
  locating_ = static_cast<long>(counts.at(3));
  event_count_ = static_cast<long>(counts.at(4));
  if (counts.size() > 5) coupled_ = static_cast<long>(counts[5]);  // missing in files of earlier versions
  const std::vector<double>&energies = memory.array("writer/energies"), &ground = memory.array("writer/ground");
  for (std::size_t i = 0; i + 6 <= energies.size(); i += 6)
    energies_.push_back({energies[i], energies[i + 1], energies[i + 2], energies[i + 3], energies[i + 4], energies[i + 5]});
  for (std::size_t i = 0; i + 7 <= ground.size(); i += 7)
    ground_.push_back({"", ground[i], Vec3(&ground[i + 1]), Vec3(&ground[i + 4])});
  while (memory.has(fmt::format("writer/mode {}", modes_.size()))) {
    const std::size_t i = modes_.size();
    const auto array = [&](const char* what) { return memory.array(fmt::format("writer/mode {}{}", i, what)); };
    modes_.push_back({array(" time").at(0), array(""), array(" rotation")});
  }
  marked_ = observer_.not_unique().size();
  results_.mark_not_unique(observer_.not_unique());
  listing_.write(fmt::format("  restarted from {} at t = {:.10g}\n", from.earlier.path(), from.point.time));
  // of a corner of the function itself the reader has told already
  const auto is_told = [this](const std::string& message) {
    const std::vector<Diagnostic>& all = reading_.diagnostics.all();
    return std::any_of(all.begin(), all.end(), [&](const Diagnostic& one) { return one.message == message; });
  };
  if (auto jump = speed_jump_warning(reading_.model, memory, from.point.time); jump && !is_told(jump->message))
    warn(std::move(*jump));
  if (reading_.model.commands.archive.newton) listing_.write(listing_section("Newton iterations"));
}

void Writer::remember(const Configuration& c, const Runner& runner, bool kept, bool last) {
  if (!kept && !last && !results_.due()) return;
  // a restart point would hold the matrix, and fields written now would be written again at the end
  if (reading_.is_one_solution() && (!last || c.time >= reading_.model.commands.stepping.end)) return;
  Snapshot memory;
  runner.save(memory);
  save_choice(reading_.model, runner.options(), memory);
  observer_.save(memory);
  schedule_.save(memory);
  checks_.save(memory);
  peaks_.save(memory);
  memory.put("writer/counts", {static_cast<double>(steps_), static_cast<double>(iterations_), static_cast<double>(cuts_),
                               static_cast<double>(locating_), static_cast<double>(event_count_), static_cast<double>(coupled_)});
  std::vector<double> energies, ground;
  for (const EnergyRow& e : energies_)
    energies.insert(energies.end(), {e.time, e.kinetic, e.potential, e.external_work, e.dissipated, e.error});
  for (const GroundRow& row : ground_)
    ground.insert(ground.end(),
                  {row.time, row.force[0], row.force[1], row.force[2], row.moment[0], row.moment[1], row.moment[2]});
  memory.put("writer/energies", std::move(energies));
  memory.put("writer/ground", std::move(ground));
  for (std::size_t i = 0; i < modes_.size(); ++i) {
    memory.put(fmt::format("writer/mode {}", i), modes_[i].displacement);
    memory.put(fmt::format("writer/mode {} rotation", i), modes_[i].rotation);
    memory.put(fmt::format("writer/mode {} time", i), modes_[i].load_time);
  }
  results_.restart_point(c.time, std::move(memory), kept);
  if (results_.due()) results_.flush();
}

void Writer::started(const StartReport& start) {
  listing_.write(describe_start(reading_.model, start));
  listing_.write(start.mobility);
  for (const std::string& remark : start.remarks) progress_.note("engrane: assembly: " + remark);
  if (start.redundant > 0)
    progress_.note(
        fmt::format("engrane: {} redundant constraint{}: how some reactions share a load is not unique (see the listing)",
                    start.redundant, start.redundant == 1 ? "" : "s"));
  if (!start.friction.empty())
    progress_.note(fmt::format(
        "engrane: friction in {} depends on these reactions, and so does the motion: the least ones are taken", start.friction));
  if (reading_.model.commands.archive.newton) listing_.write(listing_section("Newton iterations"));
}

void Writer::step(const Configuration& c, const StepReport& step, const Schedule::Due& due, const Numbering& numbering) {
  show(c.time, schedule_.controlled() ? schedule_.even(c.time) : step.regular, due, !step.events.empty() || step.corner);
  if (observer_.not_unique().size() != marked_) {
    marked_ = observer_.not_unique().size();
    results_.mark_not_unique(observer_.not_unique());
  }
  if (due.frame || std::exchange(frame_between_, false)) {
    const observe::EnergyBalance& e = observer_.energies();
    energies_.push_back({c.time, e.kinetic, e.potential, e.external_work, e.dissipated, e.error()});
  }
  summary_.time = c.time;
  ++steps_;
  cuts_ += step.cuts;
  locating_ += step.locating;
  note_events(c, step);
  if (step.newton) {
    iterations_ += step.newton->iterations;
    coupled_ += step.newton->coupled;
    if (reading_.model.commands.archive.newton) write_newton(c, step, numbering);
  }
  if (step.course && step.course->critical) note_critical(*step.course->critical);
  progress_.update(step.course ? c.load_time() : c.time, step.step, step.number);
  if (!step.last) return;
  progress_.finish();
  collect_remarks(c, numbering);
}

void Writer::between(double time, const Schedule::Due& due) {
  show(time, true, due);
  frame_between_ = frame_between_ || due.frame;
}

void Writer::show(double time, bool regular, const Schedule::Due& due, bool corner) {
  if (!checks_.empty()) checks_.observe(time, observer_.values(), regular, corner);
  if (due.sample || !checks_.empty())
    follow(time, corner);
  else if (corner)
    peaks_.interrupt();
  if (due.sample) results_.sample(time, observer_.values());
  if (due.frame) results_.frame(time, frame_values(reading_.model, observer_));
}

void Writer::accuracy(const ErrorEstimate& estimate, double target, const std::string& sharper_failed) {
  accuracy_ = estimate.describe(target);
  summary_.accuracy = estimate;
  if (const std::string warning = estimate.warning(target, sharper_failed); !warning.empty()) warn(warning);
}

int Writer::finish(RunStatus status, const std::string& failure, const TimeSplit& times) {
  progress_.finish();
  list_results();
  section("The run failed", failure.empty() ? "" : "  " + failure + "\n");
  const bool passed = list_checks(failure.empty());
  list_accuracy();
  list_effort(times);
  results_.modes(std::move(modes_));
  results_.finish(status);
  listing_.finish(status == RunStatus::complete);
  summary_.energies = observer_.energies();
  summary_.steps = std::max(0L, steps_ - 1);
  summary_.iterations = iterations_;
  summary_.cuts = cuts_;
  summary_.events = event_count_;
  summary_.seconds = times.total;
  if (!failure.empty()) return exit_status::solution_failed;
  return passed ? exit_status::fine : exit_status::check_failed;
}

void Writer::section(const char* title, const std::string& text) {
  if (text.empty()) return;
  listing_.write(listing_section(title));
  listing_.write(text);
}

void Writer::list_results() {
  const UnitSystem& units = reading_.model.units;
  listing_.write(listing_section("Energies"));  // even without any, as after a failure at the start
  listing_.write(listing_energies(thinned_energies(), units));
  std::vector<ReactionRow> reactions;
  for (const Reaction& r : observer_.reactions()) reactions.push_back({reading_.model.node(r.node).id, r.force, r.torque});
  section("Reactions at the end", listing_reactions(reactions, units));
  section("Loads and reactions at the end", listed_loads(observer_, units));
  section("Largest in the last fields", describe_largest(reading_.model, observer_));
  section("Forces of the ground", ground_.empty() ? "" : listing_ground(ground_, units));
  peaks_.interrupt();  // the last ones
  const std::string peaks = listing_peaks(results_.layout().history, peaks_, units, most_listed_peaks);
  section("Peaks", peaks.empty() ? ""
                                 : "  largest magnitude of each channel, with its sign, at the instants observed and, on cubics, "
                                   "between them; angles in "
                                   "radians\n\n" +
                                       peaks);
  section("Not unique", marked_ > 0 ? listing_not_unique(results_.layout().history, observer_.not_unique()) : "");
  section("Linearised buckling", buckling_);
  section("Critical points", critical_);
  if (event_count_ > 0) {
    listing_.write(listing_section("Events"));
    listing_.write(events_);
    if (event_count_ > listed_events_) listing_.write(fmt::format("  and {} more\n", event_count_ - listed_events_));
    listing_.write(fmt::format("  {} in all, located by {} attempts beyond those of the steps\n", event_count_, locating_));
  }
  std::string remarks;
  for (const Diagnostic& one : warnings_) remarks += "  warning: " + with_hint(one) + "\n";
  section("Remarks", remarks);
}

bool Writer::list_checks(bool talk) {
  std::vector<CheckResult> results = checks_.results();
  const auto first_wanted = results.end() - static_cast<std::ptrdiff_t>(reading_.wanted);
  summary_.results.assign(first_wanted, results.end());
  results.erase(first_wanted, results.end());
  if (!results.empty()) {
    results_.checks(results);
    const std::string table = listing_checks(results);
    section("Checks", table);
    if (talk && !options_.json) std::cout << terminal_text(table);
  }
  const std::string wanted = wanted_table();
  section("Results asked for", wanted);
  if (!options_.json) std::cout << terminal_text(wanted);
  summary_.checks = std::move(results);
  return std::all_of(summary_.checks.begin(), summary_.checks.end(), [](const CheckResult& r) { return r.passed; });
}

void Writer::list_accuracy() {
  summary_.stress_error = observer_.stress_error();
  std::string text = accuracy_;
  if (summary_.stress_error)
    text += fmt::format(
        "  estimated error of the stresses, energy norm: {:.3g} %   (Zienkiewicz and Zhu; by cells in the field ERROR)\n",
        100 * summary_.stress_error->relative());
  section("Accuracy", text);
}

void Writer::list_effort(const TimeSplit& times) {
  section("Last linear system", summary_.conditioning ? summary_.conditioning->describe() : "");
  std::string text = "  no steps\n";
  if (steps_ > 1)
    text = fmt::format("  {} steps, {} Newton iterations ({:.2f} per step), {} failed attempts\n", steps_ - 1, iterations_,
                       static_cast<double>(iterations_) / static_cast<double>(steps_ - 1), cuts_);
  if (coupled_ > 0)
    text += fmt::format("  {} solved with a tangent for each stage: one tangent for all stages did not converge\n",
                        coupled_ == 1 ? "1 step was" : fmt::format("{} steps were", coupled_));
  section("Effort", text + listing_times(times));
}

std::string Writer::stem() const { return path().substr(0, path().size() - std::string_view(".h5").size()); }

std::vector<std::string> Writer::paths() const {
  std::vector<std::string> files;
  std::error_code error;
  for (const std::string& file : {path(), stem() + ".xdmf", listing_.path()})
    if (std::filesystem::exists(file, error)) files.push_back(file);
  return files;
}

std::string Writer::closing_lines() const {
  const std::vector<std::string> files = paths();
  const std::string prefix = stem();
  if (files.empty()) return {};
  if (!holds_samples()) return fmt::format("no results; written: {}\n", join(files));
  std::string text = fmt::format("results in {}\n", join(files));
  const std::string picture = fmt::format("engrane picture {0} --both -o {0}.png", prefix);
  // prefer a table of elements other than loads, whose values are known
  const auto tells = [](const HistoryTable& one) { return !one.type.empty() && one.type != "CHA"; };
  const HistoryTable* table = nullptr;
  for (const HistoryTable& one : results_.layout().history)
    if (!table || (!tells(*table) && tells(one))) table = &one;
  if (table && !table->channels.empty()) {
    const std::string plot =
        fmt::format("engrane plot {0} {1}/{2} -o {0}.png", prefix, table->owner(0), table->channels.front().name);
    text += fmt::format("  {:<{}}  plots a channel; --list shows all of them\n", plot, picture.size());
  }
  const std::string index = stem() + ".xdmf";
  if (std::find(files.begin(), files.end(), index) == files.end()) return text;
  return text + fmt::format("  {}  draws the mechanism before and after; ParaView opens {}\n", picture, index);
}

GroundRow Writer::ground(double time) const {
  GroundRow row;
  row.time = time;
  const auto first = static_cast<std::size_t>(observer_.channel("run", "GROUND_FORCE_X"));
  for (std::size_t k = 0; k < 3; ++k) {
    row.force[static_cast<Eigen::Index>(k)] = observer_.values()[first + k];
    row.moment[static_cast<Eigen::Index>(k)] = observer_.values()[first + 3 + k];
  }
  return row;
}

void Writer::follow(double time, bool corner) {
  peaks_.observe(time, observer_.values(), corner);
  const GroundRow now = ground(time);
  if (ground_.empty()) ground_.assign(3, now);
  ground_[0] = now;
  if (now.force.norm() > ground_[1].force.norm()) ground_[1] = now;
  if (now.moment.norm() > ground_[2].moment.norm()) ground_[2] = now;
  ground_[0].when = "at the end";
  ground_[1].when = "with the largest force";
  ground_[2].when = "with the largest moment";
}

std::string Writer::wanted_table() const {
  std::string table;
  for (const CheckResult& r : summary_.results)
    table += fmt::format("  {}: {}\n", r.text, r.remark.empty() ? fmt::format("{:.10g}", r.value) : r.remark);
  return table;
}

void Writer::note_events(const Configuration& c, const StepReport& step) {
  for (const Event& e : step.events) {
    ++event_count_;
    if (listed_events_ == most_listed_events) continue;
    ++listed_events_;
    const Model::Part& part = reading_.model.part(e.part);
    const SwitchNames& names = part.element->layout().switches[static_cast<std::size_t>(e.index)];
    events_ += fmt::format("  t = {:<14.9g} {}: {}\n", c.time, part.name(), e.rises ? names.rises : names.falls);
  }
  if (!step.chatter) return;
  const std::string text = chatter_note(c.time);
  events_ += "  warning: " + text + "\n";
  progress_.note("engrane: " + text);
}

void Writer::note_critical(const CriticalPoint& point) {
  summary_.critical.push_back(point);
  const bool limit = point.kind == CriticalPoint::Kind::limit;
  std::string text = fmt::format("{} at load time {:.9g}, ", limit ? "limit point" : "bifurcation point", point.load_time);
  text += point.after > point.before ? "stability is lost" : "stability is regained";
  if (point.after < point.before && !point.counted) text += ", or lost in one more direction";
  if (std::abs(point.after - point.before) > 1)
    text += fmt::format(" in {} directions at once", std::abs(point.after - point.before));
  progress_.note("engrane: " + text);
  critical_ += fmt::format("  {}\n    unstable in {} directions before it and {} behind it\n    mode: {}\n", text, point.before,
                           point.after, point.mode);
  if (point.switched != 0)
    critical_ +=
        fmt::format("    the path goes on along the mode, with a displacement of {:g} in its first step\n", point.switched);
}

void Writer::buckling(const std::vector<BucklingMode>& modes, int asked, const Configuration& equilibrium) {
  buckling_ =
      fmt::format("  the tangent at load time {:.9g} continued as it changes there is singular at\n\n", equilibrium.load_time());
  buckling_ += fmt::format("  {:>6}{:>20}   {}\n", "mode", "load time", "largest displacements");
  if (modes.empty()) buckling_ += "  no load time: the loads do not make the tangent singular\n";
  const std::vector<int>& copies = observer_.points().copies();
  for (const BucklingMode& mode : modes) {
    summary_.buckling.push_back(mode.load_time);
    buckling_ += fmt::format("  {:>6}{:>20.10g}   {}\n", modes_.size() + 1, mode.load_time, mode.largest);
    const auto rows = [&](const std::vector<Vec3>& parts) {
      std::vector<double> all;
      for (std::size_t node = 1; node < parts.size(); ++node) all.insert(all.end(), parts[node].begin(), parts[node].end());
      for (const int node : copies) {
        const Vec3& part = parts[static_cast<std::size_t>(node)];
        all.insert(all.end(), part.begin(), part.end());
      }
      return all;
    };
    modes_.push_back({mode.load_time, rows(mode.displacement), rows(mode.rotation)});
  }
  if (!modes.empty() && modes.size() < static_cast<std::size_t>(asked))
    buckling_ += fmt::format("\n  {} were asked for; at no other load time is the tangent singular\n", asked);
  progress_.note(modes.empty() ? "engrane: no buckling loads"
                               : fmt::format("engrane: buckling at load time {:.6g} (linearised)", modes.front().load_time));
  constexpr double visible = 0.1, far = 0.2;
  if (modes.empty() || (modes.front().left_out <= visible && modes.front().turn <= far)) return;
  warn({.severity = Severity::warning,
        .location = {},
        .message =
            fmt::format("before load time {:.6g} the loads turn members by up to {:.2g} rad, which changes the stiffness against "
                        "them by {:.0f} per cent: linearised buckling leaves this out",
                        modes.front().load_time, modes.front().turn, 100 * modes.front().left_out),
        .hint = "follow the equilibria by .PATH, or take them nearer to that load (BASE END)"});
}

void Writer::collect_remarks(const Configuration& c, const Numbering& numbering) {
  for (int p = 0; p < numbering.parts(); ++p) {
    const Model::Part& part = reading_.model.part(p);
    const auto size = static_cast<std::size_t>(part.element->layout().history);
    for (const std::string& remark :
         part.element->remarks(std::span(c.history).subspan(static_cast<std::size_t>(numbering.history_begin(p)), size)))
      warn(part.name() + ": " + remark);
  }
  const auto& path = reading_.model.commands.path;
  const auto& met = summary_.critical;
  if (!path || !path->branch || continues_) return;
  if (std::any_of(met.begin(), met.end(), [](const CriticalPoint& point) { return point.switched != 0; })) return;
  const auto bifurcations = std::count_if(
      met.begin(), met.end(), [](const CriticalPoint& point) { return point.kind == CriticalPoint::Kind::bifurcation; });
  warn(fmt::format("BRANCH {} was not taken: the path has met {} bifurcation point{}", *path->branch, bifurcations,
                   bifurcations == 1 ? "" : "s"));
}

void Writer::warn(Diagnostic warning) {
  progress_.note("engrane: " + with_hint(warning));
  warnings_.push_back(std::move(warning));
}

void Writer::write_newton(const Configuration& c, const StepReport& step, const Numbering& numbering) {
  std::vector<IterationRow> rows;
  for (const NewtonRow& r : step.newton->rows)
    rows.push_back({step.number, c.time, r.iteration, r.force, r.moment, r.length, r.angle, r.correction,
                    r.worst >= 0 ? numbering.describe(r.worst) : ""});
  listing_.write(listing_newton(rows, step.number == 1));
}

std::vector<EnergyRow> Writer::thinned_energies() const {
  std::vector<EnergyRow> rows;
  const std::size_t every = std::max<std::size_t>(1, (energies_.size() + 19) / 20);
  for (std::size_t i = 0; i < energies_.size(); ++i)
    if (i % every == 0 || i + 1 == energies_.size()) rows.push_back(energies_[i]);
  return rows;
}

}  // namespace engrane::app
