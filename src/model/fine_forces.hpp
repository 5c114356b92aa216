// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace engrane {

/// An element with forces of finer structure than steps resolve, as friction that passes from one pair of teeth to the next.
/// Where a model has one, all forces between the ends of steps come from a balance there, and are not interpolated.
class FineForces {
 public:
  virtual bool has_fine_forces() const = 0;

 protected:
  ~FineForces() = default;
};

}  // namespace engrane
