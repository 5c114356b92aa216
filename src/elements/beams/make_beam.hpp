// SPDX-License-Identifier: BSD-3-Clause
// Builds beams for BEAM in `.MCE` and for the beam cells of `.MAI`.
#pragma once

#include <memory>
#include <optional>

#include "elements/beams/beam_section.hpp"
#include "elements/beams/line_shape.hpp"

namespace engrane::elements::beams {

struct BeamOptions {
  SectionChoice sections;
  std::optional<Vec3> axis_2, axis_2_end;  ///< direction across the beam at its first and last node, of any length
  bool small = false;                      ///< small displacements: forces are linear in them
  bool lumped = false;                     ///< lumped instead of consistent masses
};

/// Builds the pieces of a line of nodes. Returns the first and appends the others to BuildContext::more. Returns nullptr after
/// an error, which is reported at the keyword N, BPR, BPR_END, MAT, AXIS2 or AXIS2_END of the record.
std::unique_ptr<Element> make_beam(const LineNodes& line, const BeamOptions& options, BuildContext& context);

}  // namespace engrane::elements::beams
