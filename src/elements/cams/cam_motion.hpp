// SPDX-License-Identifier: BSD-3-Clause
// The lift of a cam's follower as a function of the cam's turn.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "math/jet.hpp"

namespace engrane::elements::cams {

/// How a lift goes from 0 to 1 while the cam turns through a segment (Norton, Cam Design and Manufacturing Handbook, 2nd ed.
/// (2009), ch. 3).
enum class CamLaw { cycloidal, modified_sine, poly_345, poly_4567, harmonic };

std::optional<CamLaw> cam_law(const std::string& name);
/// CYCLOIDAL, MODIFIED_SINE, ...
std::string cam_law_names();

/// The law at τ in [0, 1], with its derivatives by τ.
Jet unit_rise(CamLaw law, double tau);

/// The lift over one turn of the cam, segment by segment.
class CamMotion {
 public:
  struct Segment {
    double width = 0;         ///< of cam angle; all of them make 2π
    double from = 0, to = 0;  ///< lifts; equal: a dwell
    CamLaw law = CamLaw::cycloidal;
  };
  /// `phase`: the turn of the cam at which the first segment begins.
  CamMotion(std::vector<Segment> segments, double phase) : segments_(std::move(segments)), phase_(phase) {}

  /// Lift and derivatives by the cam's turn; where segments meet those of the later one.
  Jet at(double turn) const;
  const std::vector<Segment>& segments() const { return segments_; }

 private:
  std::vector<Segment> segments_;
  double phase_;
};

}  // namespace engrane::elements::cams
