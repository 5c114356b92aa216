// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "model/model.hpp"
#include "observe/observer.hpp"

namespace engrane::app {

/// Section of the listing for a model with cells: the largest displacement with its node, and the largest equivalent stress of
/// von Mises with its cell and place, of the last fields of the observer. Empty without cells or fields. On rank 0.
std::string describe_largest(const Model& model, const observe::Observer& observer);

}  // namespace engrane::app
