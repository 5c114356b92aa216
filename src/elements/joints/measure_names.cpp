// SPDX-License-Identifier: BSD-3-Clause
#include "elements/joints/measure_names.hpp"

namespace engrane::elements::joints {

Dimension dimension_of(Measure m) {
  switch (m) {
    case Measure::gap_1:
    case Measure::gap_2:
    case Measure::gap_3:
    case Measure::distance:
    case Measure::screw:
    case Measure::radius:
      return dimension::length;
    default:
      return dimension::angle;
  }
}

bool is_length(Measure m) { return dimension_of(m) == dimension::length; }

Multiplier multiplier(Measure m) {
  switch (m) {
    case Measure::gap_1:
      return {"FORCE_1", dimension::length, "force along the axis", Role::force};
    case Measure::gap_2:
      return {"FORCE_2", dimension::length, "force along the joint's second axis", Role::force};
    case Measure::gap_3:
      return {"FORCE_3", dimension::length, "force along the joint's third axis", Role::force};
    case Measure::tilt_2:
    case Measure::turn_2:
      return {"MOMENT_2", dimension::angle, "moment about the joint's second axis", Role::moment};
    case Measure::tilt_3:
    case Measure::turn_3:
      return {"MOMENT_3", dimension::angle, "moment about the joint's third axis", Role::moment};
    case Measure::distance:
      return {"THRUST", dimension::length, "force that pushes the points apart"};
    case Measure::screw:
      return {"THREAD_FORCE", dimension::length, "force of the thread along the axis"};
    case Measure::pins:
      return {"TORQUE", dimension::angle, "moment across both pins"};
    case Measure::twist:
      return {"TORQUE", dimension::angle, "torque from shaft to shaft"};
    case Measure::radius:
      return {"NORMAL_FORCE", dimension::length, "force away from the axis"};
    default:
      return {"MOMENT_1", dimension::angle, "moment about the axis", Role::moment};
  }
}

}  // namespace engrane::elements::joints
