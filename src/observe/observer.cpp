// SPDX-License-Identifier: BSD-3-Clause
#include "observe/observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "assembly/loads.hpp"
#include "model/fine_forces.hpp"
#include "model/masses.hpp"

namespace engrane::observe {

std::vector<Channel> run_channels(const Model& model, bool moves) {
  const bool cells = has_cells(model);
  std::vector<Channel> channels{
      {"STEP", dimension::time, "time step", Channel::Course::step},
      {"ITERATIONS", dimension::none, "Newton iterations of the step", Channel::Course::step},
      {"EVENTS", dimension::none, "events met since the start: teeth that begin or cease to touch", Channel::Course::step},
      {"POTENTIAL_ENERGY", dimension::energy, "potential energy"}};
  if (moves) channels.push_back({"KINETIC_ENERGY", dimension::energy, "kinetic energy", Channel::Course::smooth, 0});
  channels.push_back({"EXTERNAL_WORK", dimension::energy, "work of applied forces and drives"});
  if (moves) channels.push_back({"DISSIPATED_ENERGY", dimension::energy, "energy lost to damping"});
  channels.push_back({"ENERGY_ERROR", dimension::energy, "what the energy balance fails to close by"});
  for (const char* name : {"GROUND_FORCE_X", "GROUND_FORCE_Y", "GROUND_FORCE_Z"})
    channels.push_back(
        {name, dimension::force, "sum of what supports, .LIA and the elements on node 0 exert on the model, global"});
  for (const char* name : {"GROUND_MOMENT_X", "GROUND_MOMENT_Y", "GROUND_MOMENT_Z"})
    channels.push_back({name, dimension::moment, "its moment about the origin, global"});
  if (model.commands.path) {
    channels.push_back({"LOAD_TIME", dimension::time, "load time: that of functions, which also falls along the path"});
    channels.push_back(
        {"UNSTABLE", dimension::none,
         "directions in which the equilibrium is unstable; with an unsymmetric tangent whether their number is odd"});
    channels.push_back(
        {"CRITICAL_TIME", dimension::time, "load time of the last limit or bifurcation point; 0 before the first"});
  }
  for (int mode = 1; model.commands.buckling && mode <= model.commands.buckling->modes; ++mode)
    channels.push_back({fmt::format("BUCKLING_TIME_{}", mode), dimension::time,
                        "time of functions at which the model buckles, by linearisation; 0 where it is not known"});
  if (!cells) return channels;
  channels.push_back({"STRAIN_ENERGY", dimension::energy, "energy that cells and beams hold as strain"});
  channels.push_back({"LOAD_WORK", dimension::energy, "work u·F of these loads on the displacements from the reference"});
  for (const char* name : {"LOAD_FORCE_X", "LOAD_FORCE_Y", "LOAD_FORCE_Z"})
    channels.push_back({name, dimension::force, "sum of loads, pressures and weight, global"});
  for (const char* name : {"LOAD_MOMENT_X", "LOAD_MOMENT_Y", "LOAD_MOMENT_Z"})
    channels.push_back({name, dimension::moment, "their moment about the origin, global"});
  channels.push_back({"MASS", dimension::mass, "mass of all elements"});
  channels.push_back({"EQUATIONS", dimension::none, "number of equations"});
  return channels;
}

Observer::Observer(Assembler& assembler, bool moves, const Selection& selection)
    : assembler_(assembler),
      moves_(moves),
      supports_(assembler),
      element_fields_(assembler),
      histories_(assembler, supports_, element_fields_, moves, selection),
      ledger_(assembler, supports_, moves),
      run_channels_(observe::run_channels(assembler.model(), moves)),
      values_(histories_.columns() + run_channels_.size(), 0.0),
      buckling_times_(
          assembler.model().commands.buckling ? static_cast<std::size_t>(assembler.model().commands.buckling->modes) : 0, 0.0),
      fine_forces_(engrane::has_fine_forces(assembler.model())),
      cells_(has_cells(assembler.model())) {
  if (!cells_) return;
  for (const int p : assembler.own_parts()) mass_ += mass_of(assembler.model(), assembler.model().part(p));
  MPI_Allreduce(MPI_IN_PLACE, &mass_, 1, MPI_DOUBLE, MPI_SUM, assembler.comm());
}

int Observer::channel(const std::string& owner, const std::string& name) const {
  const auto place = [&name](const std::vector<Channel>& channels) {
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
  // nothing continues across an event; a drift is interpolated linearly, and the points of the next step begin at its end
  const bool inside = !inside_.empty(), begins = step.events > 0 && !inside;
  if (step.events > 0) ledger_.forget();
  ledger_.add(c, last_reactions_, {step.corner, step.jump, step.impulse});
  keep_inside();
  if (step.events > 0 && interpolation_) interpolation_->begin_anew();
  events_ += static_cast<double>(step.events);
  if (fields) find_fields(c);
  if (histories || interpolation_) evaluate_histories(c, step);
  if (step.corner) ledger_.begin_anew(c, last_reactions_);
  if (!interpolation_) return;
  interpolation_->add(c.time, values_, sources_);
  if (!inside && !begins) interpolation_->doubt();
  if (begins || step.corner) interpolation_->begin_anew();
}

void Observer::observe_inside(const Configuration& c) {
  last_reactions_ = supports_.at(c);
  ledger_.add_inside(c, last_reactions_);
  evaluate_histories(c, {});
  inside_.push_back({c.time, values_, sources_});
}

void Observer::keep_inside() {
  const std::vector<EnergyBalance> balances = ledger_.take_inside();
  for (std::size_t i = 0; i < inside_.size(); ++i) {
    values_.swap(inside_[i].values);
    sources_.swap(inside_[i].sources);
    if (assembler_.rank() == 0) put_energies(balances[i]);
    interpolation_->add(inside_[i].time, values_, sources_);
  }
  inside_.clear();
}

void Observer::evaluate_histories(const Configuration& c, const Step& step) {
  if (interpolation_) sources_ = histories_.sources(c);
  const std::vector<double>& values = histories_.evaluate(c, last_reactions_);
  const Resultant ground = supports_.resultant(c, last_reactions_);
  const LoadSum loads = cells_ ? sum_loads(assembler_, c) : LoadSum{};
  if (assembler_.rank() != 0) return;
  auto out = std::copy(values.begin(), values.end(), values_.begin());
  for (const double value : {step.length, static_cast<double>(step.iterations), events_}) *out++ = value;
  out += put_energies(ledger_.balance());
  put_ground(ground);
  out += 6;
  if (assembler_.model().commands.path) {
    *out++ = c.load_time();
    *out++ = step.unstable;
    *out++ = step.critical_time;
  }
  out = std::copy(buckling_times_.begin(), buckling_times_.end(), out);
  if (!cells_) return;
  ++out;  // put_energies()
  *out++ = loads.work;
  for (const Vec3* part : {&loads.force, &loads.moment}) out = std::copy(part->data(), part->data() + 3, out);
  *out++ = mass_;
  *out++ = static_cast<double>(assembler_.numbering().equations());
}

std::ptrdiff_t Observer::put_energies(const EnergyBalance& e) {
  const auto first = values_.begin() + channel("run", "POTENTIAL_ENERGY");
  const std::vector<double> energies = moves_ ? std::vector{e.potential, e.kinetic, e.external_work, e.dissipated, e.error()}
                                              : std::vector{e.potential, e.external_work, e.error()};
  std::copy(energies.begin(), energies.end(), first);
  if (cells_) values_[static_cast<std::size_t>(channel("run", "STRAIN_ENERGY"))] = e.strain;
  return static_cast<std::ptrdiff_t>(energies.size());
}

void Observer::keep_ends() {
  ledger_.integrate_smoothly();
  std::size_t element_values = 0;
  for (std::size_t t = 0; t < histories_.part_tables(); ++t) element_values += tables()[t].columns();
  const std::vector<const Channel*> all = channels();
  for (const Channel* channel : all) of_steps_.push_back(channel->course == Channel::Course::step);
  interpolation_.emplace(all, element_values, assembler_.comm());
}

void Observer::between(const Configuration& c, bool motion) {
  const bool steady = interpolation_->steady();
  const std::vector<double>* moved = nullptr;
  if (motion && !steady)
    moved = &histories_.evaluate(c, supports_.at(c));
  else if (motion && assembler_.rank() == 0)
    moved = &histories_.evaluate_nodes(c);
  if (assembler_.rank() != 0) return;
  const std::span<const double> taken = moved ? std::span(*moved) : std::span<const double>();
  put_known(c, steady || !motion, interpolation_->at(c.time, taken, steady ? histories_.node_columns() : 0, values_));
}

void Observer::put_known(const Configuration& c, bool steady, std::span<const double> sources) {
  const std::vector<Histories::Known>& known = histories_.known();
  if (known.empty()) return;
  const std::vector<double>* moved = steady ? nullptr : &histories_.sources(c);
  std::vector<double> own;
  for (const Histories::Known& one : known) {
    const std::span<const double> all = moved && of_motion(one.of_source) ? std::span<const double>(*moved) : sources;
    own.clear();
    for (const std::size_t column : one.columns) own.push_back(values_[column]);
    const std::size_t count = one.determined.sources.size();
    values_[one.column] = one.at(c.load_time(), own.empty() ? all.subspan(one.first, count) : std::span<const double>(own));
  }
}

void Observer::take_balance(const Configuration& c) {
  const std::vector<Reaction> reactions = supports_.at(c);
  const std::vector<double>& values = histories_.evaluate(c, reactions);
  const Resultant ground = supports_.resultant(c, reactions);
  if (assembler_.rank() != 0) return;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!of_steps_[i]) values_[i] = values[i];
  put_ground(ground);
}

void Observer::put_ground(const Resultant& ground) {
  auto out = values_.begin() + channel("run", "GROUND_FORCE_X");
  for (const Vec3* part : {&ground.force, &ground.moment}) out = std::copy(part->data(), part->data() + 3, out);
}

void Observer::back_to_end() {
  const std::span<const double> end = interpolation_->latest();
  std::copy(end.begin(), end.end(), values_.begin());
}

void Observer::find_fields(const Configuration& c) {
  const std::vector<Reaction> reactions = supports_.at(c);
  if (assembler_.rank() == 0) fields_ = nodal_fields(assembler_.model(), c, reactions, moves_);
  element_fields_.evaluate(c);
}

void Observer::find_fields(const Configuration& c, const Configuration& from, const Configuration& to) {
  find_fields(to);
  std::vector<std::vector<double>> ends;
  element_fields_.replace([&](std::vector<double>& values) { ends.push_back(values); });
  const std::vector<NodalField> last = fields_;
  find_fields(from);
  const double part = (c.time - from.time) / (to.time - from.time);
  const auto blend = [part](std::vector<double>& values, const std::vector<double>& end) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += part * (end[i] - values[i]);
  };
  auto end = ends.begin();
  element_fields_.replace([&](std::vector<double>& values) { blend(values, *end++); });
  if (assembler_.rank() != 0) return;
  std::vector<NodalField> moved = nodal_fields(assembler_.model(), c, {}, moves_);
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    const Dimension& d = fields_[f].named.dimension;
    if (d == dimension::force || d == dimension::moment)
      blend(fields_[f].rows, last[f].rows);
    else
      fields_[f].rows = std::move(moved[f].rows);
  }
}

std::vector<const Channel*> Observer::channels() const {
  std::vector<const Channel*> all;
  for (const Table& table : histories_.tables())
    for (std::size_t owner = 0; owner < table.owners.size(); ++owner)
      for (const Channel& channel : table.channels) all.push_back(&channel);
  for (const Channel& channel : run_channels_) all.push_back(&channel);
  return all;
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
  snapshot.put("observe/buckling_times", buckling_times_);
  snapshot.put("observe/columns", static_cast<double>(values_.size()));
  if (interpolation_) interpolation_->save(snapshot);
}

void Observer::load(const Snapshot& snapshot) {
  ledger_.load(snapshot);
  events_ = snapshot.number("observe/events");
  if (const auto& times = snapshot.array("observe/buckling_times"); times.size() == buckling_times_.size())
    buckling_times_ = times;
  not_unique_.clear();
  // with other histories the columns have another meaning; non-unique ones will be found again
  if (snapshot.number("observe/columns") != static_cast<double>(values_.size())) return;
  for (const double column : snapshot.array("observe/not_unique")) not_unique_.push_back(static_cast<int>(column));
  if (interpolation_) interpolation_->load(snapshot, histories_.source_count());
}

}  // namespace engrane::observe
