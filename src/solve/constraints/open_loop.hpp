// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "assembly/assembler.hpp"
#include "solve/constraints/motion.hpp"

namespace engrane::solve {

/// Says which loop of joints does not close, at which joint, and by how much: "with all other joints closed HINGE 14 stays open
/// by 0.3 m; its loop: ground - HINGE 11 - node 1 - HINGE 14 - ground". `given`: where the assembly began. The smallest gap is
/// found by the Levenberg–Marquardt method, first shared among all joints, then with all but one held closed. Not collective.
std::string explain_open_loop(Assembler& assembler, const MotionSlots& motion, const Configuration& given);

/// Joints on the shortest path from one side of an element with constraints to the other that avoids the element: "node 1 -
/// HINGE 12 - node 2"; empty if there is none. Supports count as the ground.
std::string loop_of(const Model& model, int part);

}  // namespace engrane::solve
