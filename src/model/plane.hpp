// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.hpp"

namespace engrane {

struct Model;

/// The coordinate plane to which all motion of a model is confined, if it is to be solved in that plane: three unknowns per
/// node, and only the constraints that act in the plane (docs/decisions/0023-plane-models.md).
struct PlaneModel {
  int normal = -1;                 ///< normal of the plane, axis 0 to 2; −1: the model is solved in space
  std::vector<bool> out_of_plane;  ///< by multiplier, in the order of Model::parts: acts out of plane only
  /// Some element exerts out-of-plane forces, which are balanced by the omitted multipliers. Otherwise those multipliers are
  /// zero.
  bool carries = false;

  bool active() const { return normal >= 0; }
  /// Whether component 0 to 5 of a node is out of plane.
  bool leaves_out(int component) const { return active() && (component < 3 ? component == normal : component - 3 != normal); }
  bool leaves_out_multiplier(int multiplier) const { return active() && out_of_plane[static_cast<std::size_t>(multiplier)]; }
};

/// "XY", "YZ" or "ZX".
const char* plane_name(int normal);

/// Reason why a model is not plane.
struct PlaneFault {
  Location location;  ///< unknown: concerns the model as a whole
  std::string what;   ///< names the element or node
  std::string hint;   ///< suggested correction
};

/// Checks whether all motion of a model stays in a plane: in any configuration of the plane, either no element exerts
/// out-of-plane forces, or constraints that act only out of plane restrain all nodes there (friction at rest does not). Returns
/// at most `most` faults; if there are none, `plane` describes the model.
std::vector<PlaneFault> examine_plane(const Model& model, int normal, std::size_t most, PlaneModel& plane);

/// Of the planes to which the motion of the model is confined, the one with the fewest unknowns; not active if there is none.
PlaneModel find_plane(const Model& model);

/// Whether elements other than cells on nodes of plane cells, which have no z translation, ask for one there or at other nodes.
bool asks_plane_cells_for_z(const Model& model);

/// Slots (6 node + component) that are out of plane and would be unknowns in space, ascending.
std::vector<int> slots_out_of_plane(const Model& model, const PlaneModel& plane);

/// Unknowns saved by solving in a plane: nodal components, and multipliers.
struct PlaneSaving {
  std::size_t motions = 0, multipliers = 0;
};
PlaneSaving plane_saving(const Model& model, const PlaneModel& plane);

}  // namespace engrane
