// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/energies.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/fillings.hpp"
#include "math/rotation.hpp"

namespace engrane {

namespace {

/// Where load time stands still along an equilibrium path, it is assumed to advance by this fraction of the step length.
constexpr double stand_still = 1e-9;

/// Sum of the energies of this rank's elements.
Energies own_energies(Assembler& assembler, const Configuration& c) {
  Energies sum;
  for (const int p : assembler.own_parts()) {
    const Energies e = assembler.model().part(p).element->energies(assembler.view(p, c));
    sum.kinetic += e.kinetic;
    sum.potential += e.potential;
    sum.external += e.external;
    sum.dissipated += e.dissipated;
    sum.strain += e.strain;
  }
  return sum;
}

void come_to_rest(Configuration& c) {
  for (NodeState& node : c.nodes) node.v = node.W = node.a = node.A = Vec3::Zero();
  std::fill(c.scalar_rates.begin(), c.scalar_rates.end(), 0.0);
  std::fill(c.scalar_accelerations.begin(), c.scalar_accelerations.end(), 0.0);
}

/// Unbalanced loads on the free components of the nodes. After a restart, loads need not be those that the equilibrium was
/// found with: loads that have ended are unbalanced, and those that were added, with the opposite sign.
std::vector<Reaction> lack_of_balance(Assembler& assembler, const Configuration& c) {
  const std::vector<double> r = assembler.slot_residual(c);
  std::vector<Reaction> lacks;
  for (std::size_t node = 0; node < c.nodes.size(); ++node) {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (std::size_t i = 0; i < 6; ++i)
      if (const std::size_t slot = 6 * node + i; assembler.numbering().equation(static_cast<int>(slot)) >= 0)
        (i < 3 ? force : moment)[static_cast<Eigen::Index>(i % 3)] = r[slot];
    if (!force.isZero(0) || !moment.isZero(0)) lacks.push_back({static_cast<int>(node), force, c.nodes[node].R * moment});
  }
  return lacks;
}

}  // namespace

Energies total_energies(Assembler& assembler, const Configuration& c) {
  const Energies own = own_energies(assembler, c);
  double sums[5] = {own.kinetic, own.potential, own.dissipated, own.external, own.strain};
  MPI_Allreduce(MPI_IN_PLACE, sums, 5, MPI_DOUBLE, MPI_SUM, assembler.comm());
  return {sums[0], sums[1], sums[2], sums[3], sums[4]};
}

double StaticWork::lost(double change, double bend) const {
  constexpr double allowed = 0.05;
  const double gap = std::clamp(change, std::min(first, second), std::max(first, second)) - change;
  const bool off = std::abs(gap) > bend * varied + allowed * std::max(handled, std::abs(change));
  return off && !(gap > 0 ? dissipates : gives) ? gap : 0;
}

StaticWork static_work(Assembler& assembler, Reactions& supports, Configuration from, const Configuration& to) {
  StaticWork work;
  if (!(to.time > from.time)) return work;
  // along an equilibrium path, load time may decrease or stand still, and the drives follow it
  const double loads = to.load_time() - from.load_time(), least = stand_still * (to.time - from.time);
  const double time = std::abs(loads) > least ? loads : least;
  // saves a copy: configurations of large meshes take much memory
  Configuration& c = from;
  const Fillings fillings(assembler);
  const Fillings::At before = fillings.at(from), after = fillings.at(to);
  double dissipated = 0, given = 0;
  const auto works_of_elements = [&] {
    std::vector<double> works;
    works.reserve(assembler.own_parts().size());
    for (const int p : assembler.own_parts()) {
      const Element& element = *assembler.model().part(p).element;
      const Energies rates = element.energies(assembler.view(p, c));
      works.push_back(filled(element) != nullptr ? 0.0 : time * rates.external);
      dissipated += std::abs(rates.dissipated);
      given += std::max(-rates.dissipated, 0.0);
    }
    return works;
  };
  const auto works_of = [&](const std::vector<Reaction>& reactions) {
    std::vector<double> works;
    for (const Reaction& reaction : reactions)
      works.push_back(time * reaction.power(c.nodes[static_cast<std::size_t>(reaction.node)]));
    return works;
  };
  come_to_rest(c);  // a restart may begin from a motion
  // reactions of the equilibria themselves: with the velocities set below, dampers would contribute
  const std::vector<Reaction> first = supports.at(from), second = supports.at(to), lacks = lack_of_balance(assembler, from);
  for (std::size_t i = 0; i < c.nodes.size(); ++i) {
    const Vec3 v = (to.nodes[i].x - from.nodes[i].x) / time;
    // the rotation vector between the two orientations has the same components in either
    const Vec3 W = rotation_log(from.nodes[i].R.transpose() * to.nodes[i].R) / time;
    c.nodes[i].v = v;
    c.nodes[i].W = W;
  }
  for (std::size_t i = 0; i < c.scalars.size(); ++i) c.scalar_rates[i] = (to.scalars[i] - from.scalars[i]) / time;
  // evaluate functions of time just inside the step: they may have a corner at its ends
  c.lead += 1e-8 * time;
  const std::vector<double> first_of_elements = works_of_elements(), first_of_supports = works_of(first),
                            first_of_others = works_of(lacks);
  for (std::size_t i = 0; i < c.nodes.size(); ++i) {
    NodeState end = to.nodes[i];
    end.v = c.nodes[i].v;
    end.W = c.nodes[i].W;
    c.nodes[i] = end;
  }
  c.time = to.time;
  c.lead = to.lead - 1e-8 * time;
  c.h = to.h;
  c.scalars = to.scalars;
  c.scalar_accelerations = to.scalar_accelerations;
  c.remainders = to.remainders;
  c.multipliers = to.multipliers;
  c.history = to.history;
  work.add(first_of_elements, works_of_elements());
  work.add(fillings.works(before, after, before), fillings.works(before, after, after));
  double sums[6] = {work.first, work.second, work.varied, work.handled, dissipated, given};
  MPI_Allreduce(MPI_IN_PLACE, sums, 6, MPI_DOUBLE, MPI_SUM, assembler.comm());
  work = {sums[0], sums[1], sums[2], sums[3], sums[4] > 0, sums[5] > 0};
  work.add(first_of_supports, works_of(second));
  work.add(first_of_others, std::vector<double>(first_of_others.size(), 0.0));
  return work;
}

void StaticWork::add(const std::vector<double>& with_first, const std::vector<double>& with_second) {
  for (std::size_t i = 0; i < with_first.size(); ++i) {
    first += with_first[i];
    second += with_second[i];
    varied += std::abs(with_second[i] - with_first[i]);
    handled += std::max(std::abs(with_first[i]), std::abs(with_second[i]));
  }
}

}  // namespace engrane
