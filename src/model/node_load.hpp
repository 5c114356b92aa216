// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "model/element.hpp"
#include "model/function.hpp"

namespace engrane {

/// Force and moment on a node, fixed in space (global components), times an optional function of time (`.CLM CHA`). Needs
/// translations or rotations of the node only if there is a force or moment on them. `at`: reference position of the node, for
/// pictures. `linear`: the model is linear, so that moments do not turn with respect to the node.
std::unique_ptr<Element> make_node_load(int id, int node, const Vec3& at, const Vec3& force, const Vec3& moment,
                                        const Function* function, bool linear = false);

}  // namespace engrane
