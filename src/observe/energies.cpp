// SPDX-License-Identifier: BSD-3-Clause
#include "observe/energies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "assembly/configuration_snapshot.hpp"
#include "model/filled.hpp"

namespace engrane::observe {

namespace {

constexpr std::size_t points_of_powers = 4;
/// A step more than this many times as long as the previous one follows a jump of a force, for instance. A polynomial would
/// extrapolate across it with slopes that, from such short steps, are mostly rounding errors. Step control from the first step
/// to the longest one grows by less.
constexpr double longest_beside = 100;
/// Integrals from the beginning of a step to the second, third and fourth of the points of Lobatto quadrature, of the cubic
/// through four values of a function: to the end of the step they are exact for degree five (the coefficients of Lobatto IIIA of
/// order 6: Hairer and Wanner, Solving Ordinary Differential Equations II, table IV.5.8).
constexpr std::array<std::array<double, 4>, 3> lobatto{{
    {(11 + sqrt5) / 120, (25 - sqrt5) / 120, (25 - 13 * sqrt5) / 120, (sqrt5 - 1) / 120},
    {(11 - sqrt5) / 120, (25 + 13 * sqrt5) / 120, (25 + sqrt5) / 120, (-1 - sqrt5) / 120},
    {1.0 / 12, 5.0 / 12, 5.0 / 12, 1.0 / 12},
}};

}  // namespace

EnergyLedger::EnergyLedger(Assembler& assembler, Reactions& supports, bool moves)
    : assembler_(assembler), supports_(supports), fillings_(assembler), moves_(moves), powers_(points_of_powers, longest_beside) {
  int filled = fillings_.any() ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &filled, 1, MPI_INT, MPI_MAX, assembler.comm());
  filled_ = moves && filled != 0;
}

double EnergyLedger::over_ranks(double work) const {
  if (filled_) MPI_Allreduce(MPI_IN_PLACE, &work, 1, MPI_DOUBLE, MPI_SUM, assembler_.comm());
  return work;
}

EnergyLedger::Moment EnergyLedger::moment_at(const Configuration& c, const std::vector<Reaction>& reactions) {
  Moment moment{c.time, total_energies(assembler_, c), {}};
  if (filled_) {
    moment.fillings = fillings_.at(c);
    moment.energies.external -= over_ranks(Fillings::power(moment.fillings));
  }
  for (const Reaction& reaction : reactions)
    moment.energies.external += reaction.power(c.nodes[static_cast<std::size_t>(reaction.node)]);
  return moment;
}

EnergyLedger::Moment EnergyLedger::beside_corner(const Configuration& c, const std::vector<Reaction>& reactions, int side) {
  constexpr double near = 1e-9;
  Configuration beside = c;
  beside.lead += side * near * (c.time - last_time_before_);
  Moment moment = moment_at(c, reactions);
  const Moment powers = moment_at(beside, reactions);
  moment.energies.external = powers.energies.external;
  moment.energies.dissipated = powers.energies.dissipated;
  return moment;
}

double EnergyLedger::work_of_jump(const Configuration& c) const {
  Configuration before = c;
  before.lead += last_time_ - c.time;
  double work = 0;
  for (const int p : assembler_.own_parts()) {
    const Element& element = *assembler_.model().part(p).element;
    if (filled(element)) continue;  // fill_to() has their work
    work += element.energies(assembler_.view(p, c)).potential - element.energies(assembler_.view(p, before)).potential;
  }
  MPI_Allreduce(MPI_IN_PLACE, &work, 1, MPI_DOUBLE, MPI_SUM, assembler_.comm());
  return work;
}

void EnergyLedger::add(const Configuration& c, const std::vector<Reaction>& reactions, const End& end) {
  last_time_before_ = last_time_;
  const bool corner = end.corner && moves_ && started_;
  const Moment moment = corner ? beside_corner(c, reactions, -1) : moment_at(c, reactions);
  const Energies& sum = moment.energies;
  if (!started_) {
    balance_.initial = sum.kinetic + sum.potential;
    initial_potential_ = sum.potential;
    if (smooth_) powers_.add(c.time, std::array{sum.external, sum.dissipated});
  } else if (!moves_) {
    const StaticWork work = static_work(assembler_, supports_, before_.unpacked(), c);
    balance_.external_work += work.mean();
    if (const double lost = work.lost(sum.potential - last_potential_); std::abs(lost) > std::abs(balance_.jump.lost))
      balance_.jump = {last_time_, c.time, lost};
  } else if (end.impulse) {
    end_steps_inside();
    const double work = sum.kinetic - balance_.kinetic;
    balance_.external_work += work;
    balance_.passed += std::abs(work);
    fill_to(moment);
  } else if (smooth_ && inside_.size() == lobatto_points.size()) {
    integrate_over_inside(moment);
  } else {
    end_steps_inside();
    integrate_to(moment);
  }
  if (started_ && moves_ && end.jump) {
    const double work = work_of_jump(c);
    balance_.external_work += work;
    balance_.passed += std::abs(work);
  }
  started_ = true;
  arrive(moment);
  if (!moves_) before_ = PackedConfiguration(c);
}

void EnergyLedger::add_inside(const Configuration& c, const std::vector<Reaction>& reactions) {
  if (!moves_) {
    add(c, reactions, {});
    balances_inside_.push_back(balance_);
    return;
  }
  inside_.push_back(moment_at(c, reactions));
}

std::vector<EnergyBalance> EnergyLedger::take_inside() { return std::exchange(balances_inside_, {}); }

void EnergyLedger::forget() {
  end_steps_inside();
  powers_.clear();
}

void EnergyLedger::integrate_to(const Moment& moment) {
  const Energies& sum = moment.energies;
  const double step = moment.time - last_time_, half = 0.5 * step;
  // do not interpolate across an event: a force that jumps has no slope there
  const bool continues = !powers_.empty();
  if (smooth_) powers_.add(moment.time, std::array{sum.external, sum.dissipated});
  if (continues) {  // two-point Gauss quadrature, exact for cubics
    for (const double side : {-1.0, 1.0}) {
      std::array<double, 2> power{};
      powers_.at(last_time_ + half * (1 + side / std::numbers::sqrt3), step, power);
      balance_.external_work += half * power[0];
      balance_.dissipated += half * power[1];
    }
  } else {
    balance_.external_work += half * (external_power_ + sum.external);
    balance_.dissipated += half * (dissipated_power_ + sum.dissipated);
  }
  balance_.passed +=
      half * (std::abs(external_power_) + std::abs(sum.external) + std::abs(dissipated_power_) + std::abs(sum.dissipated));
  fill_to(moment);
}

void EnergyLedger::fill_to(const Moment& moment) {
  if (!filled_) return;
  const double work = over_ranks(fillings_.work(last_fillings_, moment.fillings));
  balance_.external_work += work;
  balance_.passed += std::abs(work);
}

void EnergyLedger::integrate_over_inside(const Moment& end) {
  const EnergyBalance begin = balance_;
  const double step = end.time - last_time_;
  const std::array<Energies, 4> powers{Energies{.dissipated = dissipated_power_, .external = external_power_},
                                       inside_[0].energies, inside_[1].energies, end.energies};
  const Fillings::At filled = last_fillings_;
  const std::array<const Fillings::At*, 4> fillings{&filled, &inside_[0].fillings, &inside_[1].fillings, &end.fillings};
  for (std::size_t i = 0; i < lobatto.size(); ++i) {
    balance_.external_work = begin.external_work;
    balance_.dissipated = begin.dissipated;
    for (std::size_t p = 0; p < powers.size(); ++p) {
      balance_.external_work += step * lobatto[i][p] * powers[p].external;
      balance_.dissipated += step * lobatto[i][p] * powers[p].dissipated;
    }
    const Moment& moment = i < inside_.size() ? inside_[i] : end;
    if (filled_) {
      const double work = over_ranks(fillings_.work(fillings, i + 1, lobatto[i]));
      balance_.external_work += work;
      if (i == inside_.size()) balance_.passed += std::abs(work);
    }
    if (smooth_) powers_.add(moment.time, std::array{moment.energies.external, moment.energies.dissipated});
    if (i == inside_.size()) break;
    arrive(moment);
    balances_inside_.push_back(balance_);
  }
  for (std::size_t p = 0; p < powers.size(); ++p)
    balance_.passed += step * lobatto.back()[p] * (std::abs(powers[p].external) + std::abs(powers[p].dissipated));
  inside_.clear();
}

void EnergyLedger::end_steps_inside() {
  for (const Moment& moment : inside_) {
    integrate_to(moment);
    arrive(moment);
    balances_inside_.push_back(balance_);
  }
  inside_.clear();
}

void EnergyLedger::arrive(const Moment& moment) {
  const Energies& sum = moment.energies;
  balance_.kinetic = sum.kinetic;
  balance_.potential = sum.potential;
  balance_.strain = sum.strain;
  balance_.exchanged = std::max(balance_.exchanged, std::abs(sum.potential - initial_potential_));
  balance_.largest_error = std::max(balance_.largest_error, std::abs(balance_.error()));
  external_power_ = sum.external;
  dissipated_power_ = sum.dissipated;
  last_potential_ = sum.potential;
  last_time_ = moment.time;
  last_fillings_ = moment.fillings;
}

void EnergyLedger::begin_anew(const Configuration& c, const std::vector<Reaction>& reactions) {
  powers_.clear();
  if (moves_) {
    const Energies powers = beside_corner(c, reactions, 1).energies;
    external_power_ = powers.external;
    dissipated_power_ = powers.dissipated;
  }
  if (smooth_) powers_.add(last_time_, std::array{external_power_, dissipated_power_});
}

void EnergyLedger::save(Snapshot& snapshot) const {
  snapshot.put("observe/energies",
               {balance_.kinetic, balance_.potential, balance_.external_work, balance_.dissipated, balance_.initial,
                balance_.largest_error, external_power_, dissipated_power_, last_time_, balance_.passed, balance_.exchanged,
                initial_potential_, balance_.jump.begin, balance_.jump.end, balance_.jump.lost});
  if (smooth_) powers_.save(snapshot, "observe/powers");
}

void EnergyLedger::load(const Snapshot& snapshot) {
  const std::vector<double>& state = snapshot.array("observe/energies");
  balance_ = {};
  balance_.kinetic = state.at(0);
  balance_.potential = state.at(1);
  balance_.external_work = state.at(2);
  balance_.dissipated = state.at(3);
  balance_.initial = state.at(4);
  balance_.largest_error = state.at(5);
  external_power_ = state.at(6);
  dissipated_power_ = state.at(7);
  last_time_ = state.at(8);
  balance_.passed = state.at(9);
  balance_.exchanged = state.at(10);
  initial_potential_ = state.at(11);
  balance_.jump = {state.at(12), state.at(13), state.at(14)};
  started_ = true;
  if (smooth_ && snapshot.has("observe/powers")) powers_.load(snapshot, "observe/powers");
  Configuration before = assembler_.numbering().reference_configuration(last_time_);
  load_configuration(snapshot, before);
  // loads may have been added since the earlier run: their potential energy is not the work of anything
  last_potential_ = total_energies(assembler_, before).potential;
  const double come = last_potential_ - balance_.potential;
  balance_.potential = last_potential_;
  balance_.initial += come;
  initial_potential_ += come;
  if (!moves_) before_ = PackedConfiguration(before);
  if (filled_) last_fillings_ = fillings_.at(before);
}

}  // namespace engrane::observe
