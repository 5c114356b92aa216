// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "assembly/configuration.hpp"
#include "base/snapshot.hpp"

namespace engrane {

/// Writes a configuration, every bit of it, under names that begin with `configuration/`.
void save_configuration(const Configuration& configuration, Snapshot& snapshot);

/// Takes it back into a configuration of the same model. Throws std::out_of_range when the snapshot was made of a model with
/// other nodes or unknowns, naming what differs.
void load_configuration(const Snapshot& snapshot, Configuration& configuration);

}  // namespace engrane
