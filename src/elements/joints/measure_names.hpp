// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/joints/joint_measures.hpp"
#include "model/element.hpp"

namespace engrane::elements::joints {

/// A length or an angle.
Dimension dimension_of(Measure m);
bool is_length(Measure m);
/// Name and meaning of the force or moment that constrains a measure.
Multiplier multiplier(Measure m);

}  // namespace engrane::elements::joints
