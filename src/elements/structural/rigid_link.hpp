// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/structural/node_link.hpp"

namespace engrane::elements::structural {

/// `I 7 RIGID_LINK N 100 GROUP "hub"`
struct RigidLinkData : LinkData {};

ElementType rigid_link_type();

}  // namespace engrane::elements::structural
