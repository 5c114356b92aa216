// SPDX-License-Identifier: BSD-3-Clause
// What a cam's profile and its follower's way make of each other: pressure angles, curvatures, undercut.
#pragma once

#include "elements/cams/cam_contact.hpp"
#include "model/registry.hpp"

namespace engrane::elements::cams {

/// The follower seen in the plane of the cam, in the reference configuration, from the cam's centre.
struct CamPlan {
  Vec2 point = Vec2::Zero();      ///< the follower's point
  Vec2 direction = Vec2::Zero();  ///< of a slide
  Vec2 pivot = Vec2::Zero();      ///< of an arm
  Vec2 face = Vec2::Zero();       ///< normal of a flat face
  double base = 0;                ///< radius of the base circle of a motion
};

/// Checks the profile against itself and its follower: errors where it makes none, warnings where a follower would not
/// fit. Fills parts.derived.
bool check_design(const BuildContext& context, const CamPlan& plan, CamParts& parts);

}  // namespace engrane::elements::cams
