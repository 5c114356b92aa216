// SPDX-License-Identifier: BSD-3-Clause
// The lift of a cam's follower as a function of the cam's angle of rotation.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "math/jet.hpp"

namespace engrane::elements::cams {

/// Shape of the lift from 0 to 1 over one segment of the cam's turn (Norton, Cam Design and Manufacturing Handbook, 2nd ed.
/// (2009), ch. 3).
enum class CamLaw { cycloidal, modified_sine, poly_345, poly_4567, harmonic };

std::optional<CamLaw> cam_law(const std::string& name);
/// The names, for messages: CYCLOIDAL, MODIFIED_SINE, ...
std::string cam_law_names();

/// The law at τ in [0, 1], with derivatives with respect to τ.
Jet unit_rise(CamLaw law, double tau);

/// The lift over one turn of the cam, segment by segment.
class CamMotion {
 public:
  struct Segment {
    double width = 0;         ///< cam angle; all widths sum to 2π
    double from = 0, to = 0;  ///< lifts; equal for a dwell
    CamLaw law = CamLaw::cycloidal;
  };
  /// `phase`: cam angle at which the first segment begins.
  CamMotion(std::vector<Segment> segments, double phase) : segments_(std::move(segments)), phase_(phase) {}

  /// Lift and derivatives with respect to the cam angle; at the joint of two segments, those of the later one.
  Jet at(double turn) const;
  const std::vector<Segment>& segments() const { return segments_; }
  /// Cam angles in [0, 2π), ascending, at which the second, third or fourth derivative of the lift jumps.
  std::vector<double> joints() const;

 private:
  std::vector<Segment> segments_;
  double phase_;
};

}  // namespace engrane::elements::cams
