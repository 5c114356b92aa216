// SPDX-License-Identifier: BSD-3-Clause
// Models with known motions, as decks, that the schemes of dynamics are tested with.
#pragma once

#include <fmt/format.h>

#include <numbers>
#include <string>

namespace engrane::test {

/// Undamped oscillator of period 1 along x, m 1, started at rest from 1. `scheme` is what `.SAM TYPE DYNAMIC` goes on with.
inline std::string oscillator(double h, double end, const std::string& scheme) {
  return fmt::format(R"(
.NOE
 I 1 X 0 0 0
.MCE
 I 1 INERTIA N 1 M 1
 I 2 SPRING N 0 1 K {0} {0} {0}
.CLM
 FIX NOEUD 1 C 2 3
.INI
 DEP NOEUD 1 C 1 V 1
.SAM TYPE DYNAMIC {3}
.SUB TF {2} H {1}
)",
                     4 * std::numbers::pi * std::numbers::pi, h, end, scheme);
}

/// Compound pendulum on a hinge: length to the centre of mass 1, m 1, J 0, released from the horizontal under 9.81; ends at 1.
inline std::string pendulum(double h, const std::string& scheme) {
  return fmt::format(R"(
.NOE
 I 1 X -1 0 0
.MCE
 I 1 HINGE N 0 1 AXIS 0 0 1 AT 0 0 0
 I 2 INERTIA N 1 M 1 J 0 0 0
.CLM
 STRU ACC VAL 0 -9.81 0
.SAM TYPE DYNAMIC {}
.SUB TF 1 H {}
)",
                     scheme, h);
}

}  // namespace engrane::test
