// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/reactions.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <span>

#include "assembly/loads.hpp"
#include "math/linear_rotation.hpp"
#include "model/outside_force.hpp"

namespace engrane {

Reactions::Reactions(Assembler& assembler) : assembler_(assembler) {
  const Model& model = assembler.model();
  std::set<int> supported;
  for (const Support& support : model.supports) supported.insert(support.node);
  nodes_.assign(supported.begin(), supported.end());
  place_.assign(model.nodes.size(), -1);
  for (std::size_t i = 0; i < nodes_.size(); ++i) place_[static_cast<std::size_t>(nodes_[i])] = static_cast<int>(i);
  for (const int p : assembler.own_parts()) {
    const std::vector<int>& ends = model.part(p).nodes;
    if (std::find(ends.begin(), ends.end(), 0) != ends.end()) grounded_.push_back(p);
    if (dynamic_cast<const OutsideForce*>(model.part(p).element.get())) outside_.push_back(p);
    for (const int node : model.part(p).nodes)
      if (node >= 0 && this->supported(node)) {
        parts_.push_back(p);
        break;
      }
  }
}

bool Reactions::supported(int node) const { return place_[static_cast<std::size_t>(node)] >= 0; }

std::vector<Reaction> Reactions::at(const Configuration& c) {
  std::vector<Reaction> reactions;
  if (nodes_.empty()) return reactions;
  const Numbering& numbering = assembler_.numbering();
  std::vector<double> sums(6 * nodes_.size(), 0.0);
  for (const int part : parts_) {
    const std::span<const int> slots = numbering.part_slots(part);
    const auto r = assembler_.element_residual(part, c);
    for (std::size_t i = 0; i < slots.size(); ++i) {
      const auto node = static_cast<std::size_t>(slots[i] / 6);
      if (node < place_.size() && place_[node] >= 0) sums[static_cast<std::size_t>(6 * place_[node] + slots[i] % 6)] += r[i];
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, assembler_.comm());
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (int i = 0; i < 6; ++i)
      if (numbering.equation(6 * nodes_[n] + i) < 0) (i < 3 ? force : moment)[i % 3] = sums[6 * n + static_cast<std::size_t>(i)];
    reactions.push_back({nodes_[n], force, moment_in_space(c.nodes[static_cast<std::size_t>(nodes_[n])].R, moment)});
  }
  return reactions;
}

Resultant Reactions::resultant(const Configuration& c, const std::vector<Reaction>& reactions) {
  std::array<double, 6> sum{};
  for (const int part : grounded_) {
    const std::span<const int> slots = assembler_.numbering().part_slots(part);
    const auto r = assembler_.element_residual(part, c);
    // the ground is at the origin and does not rotate, so its slots are forces and moments about the origin
    for (std::size_t i = 0; i < slots.size(); ++i)
      if (slots[i] < 6) sum[static_cast<std::size_t>(slots[i])] += r[i];
  }
  for (const int part : outside_) {
    const std::span<const int> slots = assembler_.numbering().part_slots(part);
    const auto r = assembler_.element_residual(part, c);
    for (std::size_t i = 0; i < slots.size(); ++i) {
      const int node = slots[i] / 6, component = slots[i] % 6;
      if (node == 0 || static_cast<std::size_t>(node) >= place_.size()) continue;  // counted above, or a multiplier
      Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
      if (component < 3) {
        force[component] = -r[i];
        moment = place_of_force(assembler_.model(), c, node).cross(force);
      } else {
        moment = -r[i] * c.nodes[static_cast<std::size_t>(node)].R.col(component - 3);
      }
      for (int k = 0; k < 3; ++k) {
        sum[static_cast<std::size_t>(k)] += force[k];
        sum[static_cast<std::size_t>(3 + k)] += moment[k];
      }
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, sum.data(), 6, MPI_DOUBLE, MPI_SUM, assembler_.comm());
  Resultant all{{sum[0], sum[1], sum[2]}, {sum[3], sum[4], sum[5]}};
  for (const Reaction& reaction : reactions) {
    if (reaction.node == 0) continue;
    all.force += reaction.force;
    all.moment += reaction.torque + place_of_force(assembler_.model(), c, reaction.node).cross(reaction.force);
  }
  return all;
}

}  // namespace engrane
