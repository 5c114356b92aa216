// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.hpp"

namespace engrane {

struct Model;

/// The coordinate plane in which all motion of a model stays, when the model is to be solved there: three unknowns a node, and
/// only the constraints that act in the plane (docs/decisions/0023-plane-models.md).
struct PlaneModel {
  int normal = -1;                 ///< axis 0 to 2 that the plane is normal to; −1: the model is solved in space
  std::vector<bool> out_of_plane;  ///< by multiplier, in the order of Model::parts: acts out of the plane only
  /// Some element pushes out of the plane, against constraints: the multipliers left out are those that hold against it.
  /// Otherwise they are zero.
  bool carries = false;

  bool active() const { return normal >= 0; }
  /// Whether a component 0 to 5 of a node leads out of the plane.
  bool leaves_out(int component) const { return active() && (component < 3 ? component == normal : component - 3 != normal); }
  bool leaves_out_multiplier(int multiplier) const { return active() && out_of_plane[static_cast<std::size_t>(multiplier)]; }
};

/// "XY", "YZ" or "ZX".
const char* plane_name(int normal);

/// Why a model is not one of a plane.
struct PlaneFault {
  Location location;  ///< unknown: of the model as a whole
  std::string what;   ///< names the element or node
  std::string hint;   ///< what would be right
};

/// Looks whether all motion of a model stays in the plane: whether, in any configuration of the plane, no element pushes out of
/// it, or constraints that act only out of it hold all nodes there. Finds at most `most` faults; without any, `plane` describes
/// the model.
std::vector<PlaneFault> examine_plane(const Model& model, int normal, std::size_t most, PlaneModel& plane);

/// The plane with the fewest unknowns of those that the motion of the model stays in; not active when there is none.
PlaneModel find_plane(const Model& model);

/// Slots (6 node + component) that lead out of the plane and would be unknown in space, ascending.
std::vector<int> slots_out_of_plane(const Model& model, const PlaneModel& plane);

/// What solving in a plane saves: unknowns of nodes, and multipliers.
struct PlaneSaving {
  std::size_t motions = 0, multipliers = 0;
};
PlaneSaving plane_saving(const Model& model, const PlaneModel& plane);

}  // namespace engrane
