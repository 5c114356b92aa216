// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "assembly/configuration.hpp"
#include "base/snapshot.hpp"

namespace engrane {

/// Writes a configuration bit for bit, under names that begin with `configuration/`.
void save_configuration(const Configuration& configuration, Snapshot& snapshot);

/// Restores it into a configuration of the same model. Throws std::out_of_range if the snapshot belongs to a model with other
/// nodes or unknowns, naming the array that differs.
void load_configuration(const Snapshot& snapshot, Configuration& configuration);

}  // namespace engrane
