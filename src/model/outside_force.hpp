// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace engrane {

/// Mixin of constraints between nodes whose forces may have a resultant. It comes from outside the model, as the reaction of a
/// support does: the relation u = 0 of one node is a support.
class OutsideForce {
 public:
  virtual ~OutsideForce() = default;
};

}  // namespace engrane
