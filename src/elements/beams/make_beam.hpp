// SPDX-License-Identifier: BSD-3-Clause
// What BEAM of `.MCE` and beams among the cells of `.MAI` are made by.
#pragma once

#include <memory>
#include <optional>

#include "elements/beams/beam_section.hpp"
#include "elements/beams/line_shape.hpp"

namespace engrane::elements::beams {

struct BeamOptions {
  SectionChoice sections;
  std::optional<Vec3> axis_2, axis_2_end;  ///< of any length; across the beam at its first node and at its last
  bool small = false;                      ///< displacements are small: forces are linear in them
  bool lumped = false;                     ///< masses at the nodes
};

/// The pieces of a line of nodes: the first, and the others into BuildContext::more. Faults are reported at the keywords N, BPR,
/// BPR_END, MAT, AXIS2 and AXIS2_END of the record that is built; nullptr then.
std::unique_ptr<Element> make_beam(const LineNodes& line, const BeamOptions& options, BuildContext& context);

}  // namespace engrane::elements::beams
