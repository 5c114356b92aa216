// SPDX-License-Identifier: BSD-3-Clause
#include "model/fine_forces.hpp"

#include <algorithm>

#include "model/model.hpp"

namespace engrane {

bool has_fine_forces(const Model& model) {
  return std::any_of(model.parts.begin(), model.parts.end(), [](const Model::Part& part) {
    const auto* fine = dynamic_cast<const FineForces*>(part.element.get());
    return fine && fine->has_fine_forces();
  });
}

}  // namespace engrane
