// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/loads.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "math/linear_rotation.hpp"
#include "math/rotation.hpp"

namespace engrane {

Vec3 place_of_force(const Model& model, const Configuration& c, int node) {
  const auto at = static_cast<std::size_t>(node);
  return model.commands.analysis.displacements.is("SMALL") ? model.nodes[at].x : c.nodes[at].x;
}

namespace {

/// Element::applied(), or the same from the residual: minus that of a load, and the part of it that is proportional to gravity.
bool applied(const Element& element, State state, std::vector<double>& forces, std::vector<double>& scratch) {
  if (element.applied(state, forces)) return true;
  if (!element.is_load() && state.gravity.isZero(0)) return false;
  element.residual(state, forces);
  scratch.assign(forces.size(), 0.0);
  if (!element.is_load()) {
    state.gravity.setZero();
    state.varying = nullptr;
    element.residual(state, scratch);
  }
  for (std::size_t i = 0; i < forces.size(); ++i) forces[i] = scratch[i] - forces[i];
  return true;
}

}  // namespace

bool any_loads(const Assembler& assembler, const Configuration& c) {
  std::vector<double> forces, scratch;
  int any = 0;
  for (const int p : assembler.own_parts()) {
    const Element& element = *assembler.model().part(p).element;
    forces.assign(static_cast<std::size_t>(element.layout().slots()), 0.0);
    if (any == 0 && applied(element, assembler.view(p, c), forces, scratch))
      any = std::any_of(forces.begin(), forces.end(), [](double force) { return force != 0; });
  }
  MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, assembler.comm());
  return any != 0;
}

LoadSum sum_loads(const Assembler& assembler, const Configuration& c) {
  const Model& model = assembler.model();
  std::vector<double> forces, scratch;
  LoadSum sum;
  for (const int p : assembler.own_parts()) {
    const Model::Part& part = model.part(p);
    const Layout& layout = part.element->layout();
    forces.resize(static_cast<std::size_t>(layout.slots()));
    if (!applied(*part.element, assembler.view(p, c), forces, scratch)) continue;
    std::size_t slot = 0;
    for (std::size_t i = 0; i < part.nodes.size(); ++i) {
      const auto node = static_cast<std::size_t>(part.nodes[i]);
      const NodeState& state = c.nodes[node];
      Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
      for (int k = 0; k < 6; ++k)
        if (layout.has(i, k)) (k < 3 ? force : moment)[k % 3] = forces[slot++];
      moment = moment_in_space(state.R, moment);
      sum.force += force;
      sum.moment += moment + place_of_force(model, c, part.nodes[i]).cross(force);
      const Vec3 displacement = state.x - model.nodes[node].x + Eigen::Map<const Vec3>(&c.remainders[6 * node]);
      sum.work += force.dot(displacement) + moment.dot(rotation_log(state.R));
    }
  }
  std::array<double, 7> all{sum.force[0], sum.force[1], sum.force[2], sum.moment[0], sum.moment[1], sum.moment[2], sum.work};
  MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, assembler.comm());
  return {{all[0], all[1], all[2]}, {all[3], all[4], all[5]}, all[6]};
}

}  // namespace engrane
