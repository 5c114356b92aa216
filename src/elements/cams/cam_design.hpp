// SPDX-License-Identifier: BSD-3-Clause
// Checks of a cam's profile against its follower's motion: pressure angles, curvatures, undercut.
#pragma once

#include "elements/cams/cam_contact.hpp"
#include "model/registry.hpp"

namespace engrane::elements::cams {

/// The follower in the plane of the cam, relative to the cam's centre, in the reference configuration.
struct CamPlan {
  Vec2 point = Vec2::Zero();      ///< the follower's point
  Vec2 direction = Vec2::Zero();  ///< of a slide
  Vec2 pivot = Vec2::Zero();      ///< of an arm
  Vec2 face = Vec2::Zero();       ///< normal of a flat face
  double base = 0;                ///< radius of the base circle of a motion
};

/// Reports an error if the follower of a motion is on the side of the centre to which it cannot lift. An arm cannot be there:
/// its profile is made for the side on which it is.
bool check_side(const BuildContext& context, const CamPlan& plan, const CamParts& parts, const CamMotion& motion);

/// Warns if the follower of a motion is not on its profile in the reference configuration, where the cam angle is zero.
void check_place(const BuildContext& context, const CamPlan& plan, const CamParts& parts);

/// Checks the profile by itself and against its follower. Reports errors if it is no valid profile, and warnings if the
/// follower would not fit. Fills parts.derived.
bool check_design(const BuildContext& context, const CamPlan& plan, CamParts& parts);

}  // namespace engrane::elements::cams
