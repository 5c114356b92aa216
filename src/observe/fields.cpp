// SPDX-License-Identifier: BSD-3-Clause
#include "observe/fields.hpp"

#include "math/rotation.hpp"

namespace engrane::observe {

NodalFields nodal_fields(const Model& model, const Configuration& c, const std::vector<Reaction>& reactions, bool moves) {
  NodalFields fields;
  const auto put = [](std::vector<double>& field, const Vec3& v) { field.insert(field.end(), v.data(), v.data() + 3); };
  for (std::size_t i = 1; i < c.nodes.size(); ++i) {
    const NodeState& node = c.nodes[i];
    put(fields.displacement, node.x - model.nodes[i].x);
    put(fields.rotation, rotation_log(node.R));
    if (!moves) continue;
    put(fields.velocity, node.v);
    put(fields.angular_velocity, node.R * node.W);
  }
  fields.reaction_force.assign(fields.displacement.size(), 0.0);
  fields.reaction_torque.assign(fields.displacement.size(), 0.0);
  for (const Reaction& reaction : reactions) {
    const auto at = 3 * static_cast<std::size_t>(reaction.node - 1);
    for (std::size_t k = 0; k < 3; ++k) {
      fields.reaction_force[at + k] = reaction.force[static_cast<Eigen::Index>(k)];
      fields.reaction_torque[at + k] = reaction.torque[static_cast<Eigen::Index>(k)];
    }
  }
  return fields;
}

}  // namespace engrane::observe
