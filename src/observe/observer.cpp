// SPDX-License-Identifier: BSD-3-Clause
#include "observe/observer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace engrane::observe {

namespace {

/// Values between two instants lie on a polynomial through at most so many.
constexpr std::size_t most_ends = 6;

/// Angles may begin anew after a turn, and speeds are as good as the motion. What is long may be the difference of much longer.
bool of_motion(const Dimension& d) {
  return d == dimension::angle || d == dimension::angular_velocity || d == dimension::velocity;
}

}  // namespace

std::vector<Named> run_channels(bool moves) {
  std::vector<Named> channels{{"STEP", dimension::time, "time step"},
                              {"ITERATIONS", dimension::none, "Newton iterations of the step"},
                              {"EVENTS", dimension::none, "events met since the start: teeth that begin or cease to touch"},
                              {"POTENTIAL_ENERGY", dimension::energy, "potential energy"}};
  if (moves) channels.push_back({"KINETIC_ENERGY", dimension::energy, "kinetic energy"});
  channels.push_back({"EXTERNAL_WORK", dimension::energy, "work of applied forces and drives"});
  if (moves) channels.push_back({"DISSIPATED_ENERGY", dimension::energy, "energy lost to damping"});
  channels.push_back({"ENERGY_ERROR", dimension::energy, "what the energy balance fails to close by"});
  for (const char* name : {"GROUND_FORCE_X", "GROUND_FORCE_Y", "GROUND_FORCE_Z"})
    channels.push_back({name, dimension::force, "sum of what supports and the elements on node 0 exert on the model, global"});
  for (const char* name : {"GROUND_MOMENT_X", "GROUND_MOMENT_Y", "GROUND_MOMENT_Z"})
    channels.push_back({name, dimension::moment, "its moment about the origin, global"});
  return channels;
}

Observer::Observer(Assembler& assembler, bool moves, const Selection& selection)
    : assembler_(assembler),
      moves_(moves),
      supports_(assembler),
      histories_(assembler, supports_, moves, selection),
      ledger_(assembler, supports_, moves),
      run_channels_(observe::run_channels(moves)),
      values_(histories_.columns() + run_channels_.size(), 0.0),
      element_fields_(assembler),
      ends_(most_ends, std::numeric_limits<double>::infinity()) {}

int Observer::channel(const std::string& owner, const std::string& name) const {
  const auto place = [&name](const std::vector<Named>& channels) {
    const auto found = std::find_if(channels.begin(), channels.end(), [&](const Named& c) { return c.name == name; });
    return found == channels.end() ? -1 : static_cast<int>(found - channels.begin());
  };
  if (owner == "run") {
    const int at = place(run_channels_);
    return at < 0 ? -1 : static_cast<int>(histories_.columns()) + at;
  }
  const std::size_t slash = owner.find('/');
  int first = 0;
  for (const Table& table : histories_.tables()) {
    if (table.path.compare(0, slash + 1, owner, 0, slash + 1) == 0) {
      const auto found = std::find(table.ids.begin(), table.ids.end(), std::stoi(owner.substr(slash + 1)));
      const int at = found == table.ids.end() ? -1 : place(table.channels);
      if (at >= 0) return first + static_cast<int>((found - table.ids.begin()) * static_cast<long>(table.channels.size())) + at;
    }
    first += static_cast<int>(table.columns());
  }
  return -1;
}

void Observer::observe(const Configuration& c, const Step& step, bool histories, bool fields) {
  last_reactions_ = supports_.at(c);
  histories = histories || keeps_ends_;
  fields = fields || keeps_fields_;
  // what comes after an event continues nothing
  if (step.events > 0) {
    ends_.clear();
    ledger_.forget();
  }
  ledger_.add(c, last_reactions_);
  events_ += static_cast<double>(step.events);
  if (fields && assembler_.rank() == 0) fields_ = nodal_fields(assembler_.model(), c, last_reactions_, moves_);
  if (fields) element_fields_.evaluate(c);
  if (histories) evaluate_histories(c, step);
  if (!keeps_ends_) return;
  gather(end_);
  ends_.add(c.time, end_);
}

void Observer::evaluate_histories(const Configuration& c, const Step& step) {
  const std::vector<double>& values = histories_.evaluate(c, last_reactions_);
  const Resultant ground = supports_.resultant(c, last_reactions_);
  if (assembler_.rank() != 0) return;
  const EnergyBalance& e = ledger_.balance();
  auto out = std::copy(values.begin(), values.end(), values_.begin());
  const std::vector<double> run =
      moves_ ? std::vector{step.length,  static_cast<double>(step.iterations),
                           events_,      e.potential,
                           e.kinetic,    e.external_work,
                           e.dissipated, e.error()}
             : std::vector{step.length, static_cast<double>(step.iterations), events_, e.potential, e.external_work, e.error()};
  out = std::copy(run.begin(), run.end(), out);
  for (const Vec3* part : {&ground.force, &ground.moment}) out = std::copy(part->data(), part->data() + 3, out);
}

void Observer::keep_ends(bool fields) {
  keeps_ends_ = true;
  keeps_fields_ = fields;
  ledger_.integrate_smoothly();
  ways_ = ways();
}

void Observer::between(const Configuration& c, bool histories, bool fields) {
  std::vector<double> smooth(end_.size()), moved;
  ends_.at(c.time, 0, smooth);
  const std::vector<Reaction> reactions = supports_.at(c);
  if (histories) {
    const std::vector<double>& values = histories_.evaluate(c, reactions);
    if (assembler_.rank() == 0) std::copy(values.begin(), values.end(), values_.begin());
  }
  if (fields && assembler_.rank() == 0) fields_ = nodal_fields(assembler_.model(), c, reactions, moves_);
  if (fields) element_fields_.evaluate(c);
  gather(moved);
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (ways_[i] != Way::motion) moved[i] = ways_[i] == Way::end ? end_[i] : smooth[i];
  spread(moved);
}

void Observer::back_to_end() {
  if (!end_.empty()) spread(end_);
}

std::vector<Observer::Way> Observer::ways() const {
  std::vector<Way> all;
  const auto append = [&all](const Named& named, std::size_t count) {
    all.insert(all.end(), count, of_motion(named.dimension) ? Way::motion : Way::smooth);
  };
  for (const Table& table : histories_.tables())
    for (std::size_t owner = 0; owner < table.owners.size(); ++owner)
      for (const Named& channel : table.channels) append(channel, 1);
  for (const Named& channel : run_channels_) append(channel, 1);
  for (const char* name : {"STEP", "ITERATIONS", "EVENTS"}) all[static_cast<std::size_t>(channel("run", name))] = Way::end;
  if (!keeps_fields_ || assembler_.rank() != 0) return all;
  for (const Named& named : nodal_field_names(moves_)) append(named, 3 * (assembler_.model().nodes.size() - 1));
  for (const ElementField& field : element_fields_.fields()) {
    append(field.named, assembler_.model().parts.size() * field.width());
    append(field.named, field.place_parts.size() * field.width());
  }
  return all;
}

void Observer::gather(std::vector<double>& row) const {
  row = values_;
  if (!keeps_fields_ || assembler_.rank() != 0) return;
  for (const NodalField& field : fields_) row.insert(row.end(), field.rows.begin(), field.rows.end());
  for (const ElementField& field : element_fields_.fields())
    for (const std::vector<double>* rows : {&field.rows, &field.places}) row.insert(row.end(), rows->begin(), rows->end());
}

void Observer::spread(const std::vector<double>& row) {
  auto from = row.begin();
  const auto take = [&from](std::vector<double>& values) {
    const auto size = static_cast<std::ptrdiff_t>(values.size());
    std::copy(from, from + size, values.begin());
    from += size;
  };
  take(values_);
  if (!keeps_fields_ || assembler_.rank() != 0) return;
  for (NodalField& field : fields_) take(field.rows);
  element_fields_.replace(take);
}

void Observer::find_not_unique(const Configuration& c, const std::vector<Eigen::VectorXd>& undetermined) {
  if (undetermined.empty()) return;
  double size = 0;
  for (const double multiplier : c.multipliers) size = std::max(size, std::abs(multiplier));
  if (size == 0) size = 1;
  const std::vector<double> values = histories_.evaluate(c, supports_.at(c));
  std::set<int> found(not_unique_.begin(), not_unique_.end());
  for (const Eigen::VectorXd& change : undetermined) {
    Configuration other = c;
    for (std::size_t m = 0; m < other.multipliers.size(); ++m)
      other.multipliers[m] += size * change[static_cast<Eigen::Index>(m)];
    const std::vector<double>& changed = histories_.evaluate(other, supports_.at(other));
    for (std::size_t i = 0; i < values.size(); ++i)
      if (std::abs(changed[i] - values[i]) > 1e-7 * (size + std::abs(values[i]))) found.insert(static_cast<int>(i));
  }
  not_unique_.assign(found.begin(), found.end());
}

void Observer::save(Snapshot& snapshot) const {
  ledger_.save(snapshot);
  snapshot.put("observe/events", events_);
  std::vector<double> columns(not_unique_.begin(), not_unique_.end());
  snapshot.put("observe/not_unique", std::move(columns));
  snapshot.put("observe/columns", static_cast<double>(values_.size()));
  if (!keeps_ends_) return;
  snapshot.put("observe/end", end_);
  ends_.save(snapshot, "observe/ends");
}

void Observer::load(const Snapshot& snapshot) {
  ledger_.load(snapshot);
  events_ = snapshot.number("observe/events");
  not_unique_.clear();
  // with other histories than before the columns mean others: they are found again
  if (snapshot.number("observe/columns") != static_cast<double>(values_.size())) return;
  for (const double column : snapshot.array("observe/not_unique")) not_unique_.push_back(static_cast<int>(column));
  if (assembler_.rank() != 0 || !snapshot.has("observe/end") || snapshot.array("observe/end").size() != ways_.size()) return;
  end_ = snapshot.array("observe/end");
  ends_.load(snapshot, "observe/ends");
}

}  // namespace engrane::observe
