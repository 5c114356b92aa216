// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/assembler.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "model/grip.hpp"

namespace engrane {

Assembler::Assembler(const Model& model, const Numbering& numbering, MPI_Comm comm, bool half)
    : model_(model), numbering_(numbering), comm_(comm), scatter_(numbering, comm, half) {
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &size_);
  find_batches();

  const auto multipliers = static_cast<std::size_t>(numbering.slots() - numbering.motion_slots());
  scale_.assign(multipliers, 1.0);
  carried_.assign(static_cast<std::size_t>(numbering.equations()), 0.0);
  released_.assign(multipliers, false);
  released_values_.assign(multipliers, 0.0);
  idle_.assign(multipliers, false);
  std::vector<int> grips;
  for (int p = 0; p < numbering.parts(); ++p) {
    const Layout& layout = element(p).layout();
    if (!layout.multipliers.empty()) constrained_parts_.push_back(p);
    if (layout.grips.empty()) continue;
    int multiplier = numbering.multiplier_begin(p) + layout.grip_row();
    const std::vector<GripState> states = unfollowed_grips(element(p));
    for (std::size_t i = 0; i < states.size(); ++i)
      for (int k = 0; k < layout.grips[i].size; ++k, ++multiplier)
        if (states[i].mode != GripState::holding) grips.push_back(multiplier);
  }
  set_idle(grips);
  if (size_ > 1) {
    Owned<Vec> sample;
    *sample.out() = new_vector();
    check_petsc(VecScatterCreateToAll(sample, to_all_.out(), everywhere_.out()));
  }
}

void Assembler::find_batches() {
  constexpr std::size_t most = 64, most_numbers = 4096;  // a batch should stay in the cache
  std::size_t widest_r = 0, widest_k = 0, longest = 0;
  for (std::size_t i = 0; i < numbering_.evaluated().size(); ++i) {
    const int p = evaluated(i);
    const std::size_t n = numbering_.part_slots(p).size();
    const bool room =
        !batches_.empty() && batches_.back().range.count() < most && (batches_.back().range.count() + 1) * n * n <= most_numbers;
    if (!room || !batches_.back().range.extend(element(p))) batches_.push_back({i, ElementRange(element(p)), n});
    const std::size_t count = batches_.back().range.count();
    longest = std::max(longest, count);
    widest_r = std::max(widest_r, count * n);
    widest_k = std::max(widest_k, count * n * n);
  }
  states_.resize(longest);
  local_r_.resize(widest_r);
  local_k_.resize(widest_k);
}

std::span<const State> Assembler::views(const Batch& batch, const Configuration& configuration) {
  for (std::size_t i = 0; i < batch.range.count(); ++i) states_[i] = view(evaluated(batch.first + i), configuration);
  return std::span(states_).first(batch.range.count());
}

template <class Use>
void Assembler::for_each_residual(const Configuration& configuration, Use&& use) {
  for (const Batch& batch : batches_) {
    batch.range.residual(views(batch, configuration), std::span(local_r_).first(batch.range.count() * batch.slots));
    for (std::size_t i = 0; i < batch.range.count(); ++i)
      use(evaluated(batch.first + i), std::span<const double>(local_r_).subspan(i * batch.slots, batch.slots));
  }
}

template <class Use>
void Assembler::for_each_tangent(const Configuration& configuration, Weights weights, Use&& use) {
  for (const Batch& batch : batches_) {
    const std::size_t n = batch.slots, count = batch.range.count();
    batch.range.tangent(views(batch, configuration), weights, std::span(local_r_).first(count * n),
                        std::span(local_k_).first(count * n * n));
    for (std::size_t i = 0; i < count; ++i) use(batch.first + i, std::span(local_k_).subspan(i * n * n, n * n));
  }
}

State Assembler::view(int part, const Configuration& c) const {
  const Model::Part& p = model_.part(part);
  const Layout& layout = p.element->layout();
  const auto piece = [](const std::vector<double>& all, int begin, std::size_t count) {
    return std::span(all).subspan(static_cast<std::size_t>(begin), count);
  };
  State s;
  s.nodes = {c.nodes, p.nodes, c.remainders};
  s.scalars = piece(c.scalars, numbering_.scalar_begin(part), layout.scalars.size());
  s.scalar_rates = piece(c.scalar_rates, numbering_.scalar_begin(part), layout.scalars.size());
  s.scalar_accelerations = piece(c.scalar_accelerations, numbering_.scalar_begin(part), layout.scalars.size());
  s.multipliers = piece(c.multipliers, numbering_.multiplier_begin(part), layout.multipliers.size());
  s.history = piece(c.history, numbering_.history_begin(part), static_cast<std::size_t>(layout.history));
  s.time = c.load_time();
  s.h = c.h;
  find_gravity(s.time);
  s.gravity = gravity_;
  s.varying = varying_gravity_ ? &*varying_gravity_ : nullptr;
  s.penalty = penalty;
  s.contact_homotopy = contact_homotopy;
  return s;
}

Assembler::ElementTangent Assembler::element_tangent(int part, const Configuration& configuration, Weights weights) const {
  const std::size_t n = numbering_.part_slots(part).size();
  element_r_.resize(n);
  element_k_.resize(n * n);
  element(part).tangent(view(part, configuration), weights, element_r_, element_k_);
  return {element_r_, element_k_};
}

std::span<const double> Assembler::element_residual(int part, const Configuration& configuration) const {
  element_r_.resize(numbering_.part_slots(part).size());
  element(part).residual(view(part, configuration), element_r_);
  return element_r_;
}

void Assembler::find_gravity(double time) const {
  if (time == gravity_time_) return;
  gravity_ = model_.gravity_at(time);
  varying_gravity_ = model_.varying_gravity_at(time);
  gravity_time_ = time;
}

void Assembler::count_turns(Configuration& configuration) { write_history(configuration, &Element::count_turns); }

void Assembler::commit(Configuration& configuration) { write_history(configuration, &Element::commit); }

void Assembler::write_history(Configuration& configuration,
                              void (Element::*write)(const State&, std::span<double>, std::span<double>) const) {
  if (configuration.history.empty()) return;
  std::vector<double> history = configuration.history;
  for (int p = 0; p < numbering_.parts(); ++p) {
    const Layout& layout = element(p).layout();
    if (layout.history == 0) continue;
    (element(p).*write)(
        view(p, configuration),
        std::span(configuration.scalars).subspan(static_cast<std::size_t>(numbering_.scalar_begin(p)), layout.scalars.size()),
        std::span(history).subspan(static_cast<std::size_t>(numbering_.history_begin(p)),
                                   static_cast<std::size_t>(layout.history)));
  }
  configuration.history = std::move(history);
}

void Assembler::release(const std::vector<int>& multipliers, const std::vector<double>& values) {
  const std::vector<bool> before = released_;
  released_ = idle_;
  for (const int m : multipliers) {
    if (idle(m)) continue;
    released_[static_cast<std::size_t>(m)] = true;
    released_values_[static_cast<std::size_t>(m)] = values[static_cast<std::size_t>(m)];
  }
  if (released_ != before) ++changes_;
  note_released();
}

void Assembler::set_idle(const std::vector<int>& multipliers) {
  ++changes_;
  for (std::size_t m = 0; m < idle_.size(); ++m)
    if (idle_[m]) released_[m] = false;
  for (std::size_t m = 0; m < idle_.size(); ++m) idle_[m] = !numbered(static_cast<int>(m));
  for (const int m : multipliers) idle_[static_cast<std::size_t>(m)] = true;
  for (std::size_t m = 0; m < idle_.size(); ++m) {
    if (!idle_[m]) continue;
    released_[m] = true;
    released_values_[m] = 0;
  }
  idle_count_ = static_cast<int>(std::count(idle_.begin(), idle_.end(), true));
  note_released();
}

bool Assembler::numbered(int multiplier) const { return equation_of(static_cast<std::size_t>(multiplier)) >= 0; }

void Assembler::note_released() {
  any_released_ = false;
  for (std::size_t m = 0; m < released_.size() && !any_released_; ++m)
    any_released_ = released_[m] && numbered(static_cast<int>(m));
}

void Assembler::multipliers_to_unknowns(const Configuration& configuration, std::span<double> unknowns) const {
  for (std::size_t m = 0; m < scale_.size(); ++m)
    if (const int e = equation_of(m); e >= 0) unknowns[static_cast<std::size_t>(e)] = configuration.multipliers[m] / scale_[m];
}

void Assembler::unknowns_to_multipliers(std::span<const double> unknowns, Configuration& configuration) const {
  for (std::size_t m = 0; m < scale_.size(); ++m)
    if (const int e = equation_of(m); e >= 0) configuration.multipliers[m] = scale_[m] * unknowns[static_cast<std::size_t>(e)];
}

void Assembler::add_to_multipliers(std::span<const double> change, std::span<double> multipliers) const {
  for (std::size_t m = 0; m < scale_.size(); ++m)
    if (const int e = equation_of(m); e >= 0) multipliers[m] += scale_[m] * change[static_cast<std::size_t>(e)];
}

void Assembler::save(Snapshot& snapshot) const {
  snapshot.put("assembler/scale", scale_);
  snapshot.put("assembler/released", {released_.begin(), released_.end()});
  snapshot.put("assembler/idle", {idle_.begin(), idle_.end()});
  snapshot.put("assembler/released_values", released_values_);
}

void Assembler::load(const Snapshot& snapshot) {
  const std::vector<double>& scale = snapshot.array("assembler/scale");
  const auto flagged = [&](const char* name) {
    const std::vector<double>& flags = snapshot.array(name);
    if (flags.size() != scale_.size()) throw std::out_of_range("the restart point has another number of constraints");
    std::vector<int> multipliers;
    for (std::size_t m = 0; m < flags.size(); ++m)
      if (flags[m] != 0) multipliers.push_back(static_cast<int>(m));
    return multipliers;
  };
  if (scale.size() != scale_.size()) throw std::out_of_range("the restart point has another number of constraints");
  set_idle(flagged("assembler/idle"));
  release(flagged("assembler/released"), snapshot.array("assembler/released_values"));
  scale_ = scale;
}

bool Assembler::released_equation(int equation) const {
  const Unknown& u = numbering_.unknown(equation);
  return u.multiplier && released(u.slot - numbering_.motion_slots());
}

void Assembler::choose_scale(const Configuration& configuration, Weights weights, double fixed) {
  ++changes_;
  if (scale_.empty()) return;
  if (fixed > 0) {
    std::fill(scale_.begin(), scale_.end(), fixed);
    return;
  }
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  const auto motion = static_cast<std::size_t>(numbering_.motion_slots());
  std::vector<double> diagonal(motion, 0.0);
  for_each_tangent(configuration, weights, [&](std::size_t at, std::span<const double> local) {
    if (is_ghost(at)) return;
    const auto slots = numbering_.part_slots(evaluated(at));
    const std::size_t n = slots.size();
    for (std::size_t i = 0; i < n; ++i) {
      const auto slot = static_cast<std::size_t>(slots[i]);
      if (slot >= motion) continue;
      // a moment makes the tangent antisymmetric: what is left on the diagonal is rounding, and no stiffness
      double largest = 0;
      for (std::size_t j = 0; j < n; ++j)
        if (static_cast<std::size_t>(slots[j]) < motion) largest = std::max(largest, std::abs(local[i * n + j]));
      if (std::abs(local[i * n + i]) > rounding * largest) diagonal[slot] += local[i * n + i];
    }
  });
  MPI_Allreduce(MPI_IN_PLACE, diagonal.data(), static_cast<int>(motion), MPI_DOUBLE, MPI_SUM, comm_);

  // The mean of the stiffnesses d > 0 of what a constraint moves, with the squares of its gradient g as weights, over Σ g²;
  // angles count as displacements at the extent. Parts of the gradient that are but rounding then do no harm.
  const double extent = model_.extent();
  struct Sums {
    double steep = 0, of_stiff = 0, stiffness = 0;
  };
  std::vector<Sums> sums(scale_.size());
  for_each_tangent(configuration, weights, [&](std::size_t at, std::span<const double> local) {
    if (is_ghost(at)) return;
    const int part = evaluated(at);
    const auto slots = numbering_.part_slots(part);
    const std::size_t n = slots.size();
    for (std::size_t i = n - element(part).layout().multipliers.size(); i < n; ++i) {
      const std::size_t multiplier = static_cast<std::size_t>(slots[i]) - motion;
      for (std::size_t j = 0; j < n; ++j) {
        const auto slot = static_cast<std::size_t>(slots[j]);
        const int equation = slot < motion ? numbering_.equation(slots[j]) : -1;
        if (equation < 0) continue;
        const double lever = numbering_.unknown(equation).rotational() ? extent : 1;
        const double entry = local[i * n + j] / (std::max(std::abs(weights.q), 1e-300) * lever);
        sums[multiplier].steep += entry * entry;
        if (diagonal[slot] == 0) continue;
        sums[multiplier].of_stiff += entry * entry;
        sums[multiplier].stiffness += entry * entry * std::abs(diagonal[slot]) / (lever * lever);
      }
    }
  });
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(3 * sums.size()), MPI_DOUBLE, MPI_SUM, comm_);
  std::vector<double> k(scale_.size(), 0.0);
  for (std::size_t i = 0; i < k.size(); ++i)
    if (sums[i].of_stiff > 0) k[i] = sums[i].stiffness / (sums[i].of_stiff * sums[i].steep);
  // Constraints between parts without mass and stiffness take the largest scale of all others, multiplied by extent² for
  // moments. Rounding may leave a tiny value, hence the threshold; real machines have ratios down to about 1e-27.
  constexpr double nothing = 1e-30;
  const double square = extent * extent;
  const auto lever = [&](std::size_t i) { return numbering_.multiplier(static_cast<int>(i)).rotational() ? square : 1; };
  double stiffest = 0;
  for (std::size_t i = 0; i < k.size(); ++i) stiffest = std::max(stiffest, k[i] / lever(i));
  for (std::size_t i = 0; i < k.size(); ++i)
    scale_[i] = k[i] > nothing * stiffest * lever(i) ? k[i] : stiffest > 0 ? stiffest * lever(i) : 1.0;
}

void Assembler::residual(const Configuration& configuration, Vec r) {
  static const PetscLogEvent event = log_event("Residual");
  const LoggedTime time(event);
  std::fill(carried_.begin(), carried_.end(), 0.0);
  Scatter::VectorSum sum(scatter_, r);
  const int motion = numbering_.motion_slots();
  for_each_residual(configuration, [&](int part, std::span<const double> local) {
    const auto slots = numbering_.part_slots(part);
    std::size_t i = 0;  // multipliers come last
    for (; i < slots.size() && slots[i] < motion; ++i) {
      const int row = numbering_.equation(slots[i]);
      if (row < 0) continue;
      sum.add(row, local[i]);
      double& size = carried_[static_cast<std::size_t>(row)];
      size = std::max(size, std::abs(local[i]));
    }
    const bool shares = element(part).layout().shares_multipliers;
    for (; i < slots.size(); ++i) {
      const int row = numbering_.equation(slots[i]);
      if (row < 0) continue;
      const auto m = static_cast<std::size_t>(slots[i] - motion);
      // a value that stands for the whole constraint must be added only once, not by each element that shares it
      if (shares && (released_[m] || stated.has(m))) continue;
      const double open = stated.has(m) ? -stated.value[m] : local[i];
      const double value = released_[m] ? released_values_[m] - configuration.multipliers[m] : open * scale_[m];
      sum.add(row, value);
    }
  });
  if (size_ > 1) MPI_Allreduce(MPI_IN_PLACE, carried_.data(), static_cast<int>(carried_.size()), MPI_DOUBLE, MPI_MAX, comm_);
}

void Assembler::scale_multipliers(int part, std::span<double> k) const {
  const auto slots = numbering_.part_slots(part);
  const std::size_t n = slots.size();
  for (std::size_t i = n - element(part).layout().multipliers.size(); i < n; ++i) {
    const int m = slots[i] - numbering_.motion_slots();
    const double factor = scale_[static_cast<std::size_t>(m)];
    if (released(m))
      std::fill_n(k.begin() + static_cast<std::ptrdiff_t>(i * n), n, 0.0);
    else
      for (std::size_t j = 0; j < n; ++j) k[i * n + j] *= factor;
    for (std::size_t j = 0; j < n; ++j) k[j * n + i] *= factor;
  }
}

void Assembler::tangent(const Configuration& configuration, Weights weights, Mat into, const Change& change) {
  static const PetscLogEvent event = log_event("Tangent");
  const LoggedTime time(event);
  if (into == matrix()) ++changes_;
  Scatter::MatrixSum sum(scatter_, into);
  for_each_tangent(configuration, weights, [&](std::size_t at, std::span<double> k) {
    if (change) change(evaluated(at), k);
    scale_multipliers(evaluated(at), k);
    sum.add(at, k);
  });
  for (int row = numbering_.first_row(); any_released_ && weights.multipliers != 0 && row < numbering_.end_row(); ++row)
    if (released_equation(row))
      sum.add_diagonal(row, -scale_[static_cast<std::size_t>(numbering_.unknown(row).slot - numbering_.motion_slots())]);
  sum.finish();
}

void Assembler::projection(const Configuration& configuration, Metric metric, std::span<const int> held, Mat into,
                           std::span<const double> give) {
  if (into == matrix()) ++changes_;
  const bool mass = metric != Metric::geometric;
  const auto motion = static_cast<std::size_t>(numbering_.motion_slots());
  std::vector<double> inertia(motion, 0.0);
  Scatter::MatrixSum sum(scatter_, into);
  for_each_tangent(configuration, {1, 0, 0}, [&](std::size_t at, std::span<double> k) {
    const int part = evaluated(at);
    const auto slots = numbering_.part_slots(part);
    const std::size_t n = slots.size(), m0 = n - element(part).layout().multipliers.size();
    const double stiffness = give.empty() ? 0 : give[static_cast<std::size_t>(part)];
    const bool weighted = mass || stiffness > 0;
    std::span<const double> of_motion;
    if (weighted) of_motion = element_tangent(part, configuration, {stiffness, 0, mass ? 1.0 : 0.0, 0}).k;
    for (std::size_t i = 0; i < m0; ++i) {
      for (std::size_t j = 0; j < m0; ++j) k[i * n + j] = weighted ? of_motion[i * n + j] : 0.0;
      if (!is_ghost(at)) inertia[static_cast<std::size_t>(slots[i])] += k[i * n + i];
      // a multiplier's column may hold more than −Bᵀ (e.g. the separating force of gears), but a projection needs −Bᵀ alone
      if (metric == Metric::dynamic) continue;
      for (std::size_t j = m0; j < n; ++j) k[i * n + j] = k[j * n + i];
    }
    for (std::size_t i = m0; i < n; ++i)
      if (released(slots[i] - numbering_.motion_slots())) std::fill_n(k.begin() + static_cast<std::ptrdiff_t>(i * n), n, 0.0);
    sum.add(at, k);
  });
  MPI_Allreduce(MPI_IN_PLACE, inertia.data(), static_cast<int>(motion), MPI_DOUBLE, MPI_SUM, comm_);
  // masses and moments of inertia have different units, so each is compared only with the largest of its own kind
  Magnitudes heaviest;
  for (int e = 0; e < numbering_.equations(); ++e) {
    const Unknown& u = numbering_.unknown(e);
    if (u.multiplier) continue;
    const double d = inertia[static_cast<std::size_t>(u.slot)];
    heaviest[u.measure] = std::max(heaviest[u.measure], d);
  }
  const double extent = model_.extent();
  const Magnitudes missing = find_missing_inertia(heaviest);
  std::vector<bool> fixed(static_cast<std::size_t>(numbering_.equations()), false);
  for (const int equation : held) fixed[static_cast<std::size_t>(equation)] = true;
  for (int row = numbering_.first_row(); row < numbering_.end_row(); ++row) {
    const Unknown& u = numbering_.unknown(row);
    const double one = u.measure == Measure::force ? 1 / (extent * extent) : 1.0;
    double d = any_released_ && released_equation(row) ? 1.0 : 0.0;
    if (!u.multiplier && !mass) d = u.part >= 0 ? 1e-12 * one : one;
    if (!u.multiplier && mass && inertia[static_cast<std::size_t>(u.slot)] == 0) d = missing[u.measure];
    if (fixed[static_cast<std::size_t>(row)]) d = 1e10 * (!mass ? one : heaviest[u.measure] > 0 ? heaviest[u.measure] : d);
    sum.add_diagonal(row, d);
  }
  sum.finish();
}

Magnitudes Assembler::find_missing_inertia(const Magnitudes& heaviest) {
  constexpr double negligible = 1e-13;
  const double square = model_.extent() * model_.extent();
  Magnitudes missing;
  for (const Measure m : {Measure::force, Measure::moment, Measure::length, Measure::angle}) {
    double own = heaviest[m];
    if (own == 0 && m == Measure::moment) own = heaviest[Measure::force] * square;
    if (own == 0 && m == Measure::force) own = heaviest[Measure::moment] / square;
    missing[m] = negligible * (own > 0 ? own : 1.0);
  }
  missing_inertia_ = std::max(missing[Measure::force] * square, missing[Measure::moment]);
  return missing;
}

void Assembler::constraint_rates(const Configuration& configuration, std::vector<double>& phi, std::vector<double>& rate,
                                 std::vector<double>& second) {
  constraint_rates(configuration, constrained_parts_, phi, rate, second);
}

void Assembler::constraint_rates(const Configuration& configuration, std::span<const int> parts, std::vector<double>& phi,
                                 std::vector<double>& rate, std::vector<double>& second) {
  phi.assign(scale_.size(), 0);
  rate = second = phi;
  // every rank evaluates all elements, which saves a reduction
  std::array<std::vector<double>, 3> share;
  for (const int part : parts) {
    const std::size_t count = element(part).layout().multipliers.size();
    const auto begin = static_cast<std::size_t>(numbering_.multiplier_begin(part));
    if (!element(part).layout().shares_multipliers) {
      element(part).constraint_rates(view(part, configuration), std::span(phi).subspan(begin, count),
                                     std::span(rate).subspan(begin, count), std::span(second).subspan(begin, count));
      continue;
    }
    for (std::vector<double>& values : share) values.assign(count, 0);
    element(part).constraint_rates(view(part, configuration), share[0], share[1], share[2]);
    for (std::size_t m = 0; m < count; ++m) {
      phi[begin + m] += share[0][m];
      rate[begin + m] += share[1][m];
      second[begin + m] += share[2][m];
    }
  }
  for (std::size_t m = 0; idle_count_ > 0 && m < idle_.size(); ++m)
    if (idle_[m]) phi[m] = rate[m] = second[m] = 0;
}

std::vector<double> Assembler::violations(const Configuration& configuration) {
  std::vector<double> phi, rate, second;
  constraint_rates(configuration, phi, rate, second);
  return phi;
}

std::vector<double> Assembler::slot_residual(const Configuration& configuration) {
  std::vector<double> all(static_cast<std::size_t>(numbering_.slots()), 0.0);
  for (const int p : own_parts()) {
    const auto slots = numbering_.part_slots(p);
    const auto r = element_residual(p, configuration);
    for (std::size_t i = 0; i < slots.size(); ++i) all[static_cast<std::size_t>(slots[i])] += r[i];
  }
  if (size_ > 1) MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, comm_);
  return all;
}

std::span<const double> Assembler::gather(Vec x) {
  gathered_.resize(static_cast<std::size_t>(numbering_.equations()));
  Vec source = x;
  if (size_ > 1) {
    check_petsc(VecScatterBegin(to_all_, x, everywhere_, INSERT_VALUES, SCATTER_FORWARD));
    check_petsc(VecScatterEnd(to_all_, x, everywhere_, INSERT_VALUES, SCATTER_FORWARD));
    source = everywhere_;
  }
  const PetscScalar* values = nullptr;
  check_petsc(VecGetArrayRead(source, &values));
  std::copy_n(values, gathered_.size(), gathered_.begin());
  check_petsc(VecRestoreArrayRead(source, &values));
  return gathered_;
}

void Assembler::spread(std::span<const double> all, Vec x) const {
  PetscScalar* values = nullptr;
  check_petsc(VecGetArrayWrite(x, &values));
  std::copy(all.begin() + numbering_.first_row(), all.begin() + numbering_.end_row(), values);
  check_petsc(VecRestoreArrayWrite(x, &values));
}

}  // namespace engrane
