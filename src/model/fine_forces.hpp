// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

namespace engrane {

/// An element with forces of finer structure than steps resolve, as friction that passes from one pair of teeth to the next.
/// Where a model has one, all forces between the ends of steps come from a balance there, and are not interpolated.
class FineForces {
 public:
  virtual bool has_fine_forces() const = 0;

  /// An angle over whose turn the forces repeat, as that from tooth to tooth: `factor` times a scalar of the element.
  struct Repetition {
    int scalar = 0;
    double factor = 1;
  };
  virtual std::optional<Repetition> repetition() const { return {}; }

 protected:
  ~FineForces() = default;
};

struct Model;
/// Whether an element of the model has such forces.
bool has_fine_forces(const Model& model);

}  // namespace engrane
