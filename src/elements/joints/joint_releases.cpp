// SPDX-License-Identifier: BSD-3-Clause
// Other kinds of joint with fewer constraints: advice against redundant constraints.
#include <fmt/format.h>

#include <array>
#include <bitset>

#include "elements/joints/joint.hpp"

namespace engrane::elements::joints {

namespace {

/// Directions that a joint constrains, in its own axes: forces along 1, 2, 3, then moments about them.
using Held = std::bitset<6>;

constexpr unsigned force_1 = 1, force_2 = 2, force_3 = 4, moment_1 = 8, moment_2 = 16, moment_3 = 32;

/// The direction held by a constraint; none if it is not of this form.
Held held_by(Measure m) {
  switch (m) {
    case Measure::gap_1:
      return force_1;
    case Measure::gap_2:
      return force_2;
    case Measure::gap_3:
      return force_3;
    case Measure::turn_1:
      return moment_1;
    case Measure::tilt_2:
    case Measure::turn_2:
      return moment_2;
    case Measure::tilt_3:
    case Measure::turn_3:
      return moment_3;
    default:
      return {};
  }
}

struct Kind {
  const char* name;
  Held holds;
};

/// Ordered by preference: the most usual joints first.
const std::array<Kind, 7> kinds{{
    {"SPHERICAL", force_1 | force_2 | force_3},
    {"CYLINDRICAL", force_2 | force_3 | moment_2 | moment_3},
    {"POINT_LINE", force_2 | force_3},
    {"HINGE", force_1 | force_2 | force_3 | moment_2 | moment_3},
    {"PRISMATIC", force_2 | force_3 | moment_1 | moment_2 | moment_3},
    {"PLANAR", force_1 | moment_2 | moment_3},
    {"POINT_PLANE", force_1},
}};

std::string in_words(Held direction) {
  constexpr std::array axes{"the axis", "the second axis", "the third axis"};
  std::size_t bit = 0;
  while (!direction.test(bit)) ++bit;
  return fmt::format("{} {}", bit < 3 ? "force along" : "moment about", axes[bit % 3]);
}

}  // namespace

std::vector<Release> Joint::releases() const {
  // another kind of joint may not offer such a drive
  if (layout().multipliers.size() > parts_.constraints.size()) return Element::releases();
  Held mine;
  for (const JointConstraint& c : parts_.constraints) {
    const Held direction = held_by(c.measure);
    if (direction.none()) return {};
    mine |= direction;
  }
  std::vector<Release> all;
  for (const Kind& kind : kinds) {
    if (kind.holds == mine || (kind.holds & ~mine).any()) continue;
    Release release{fmt::format("make {{}} a {}", kind.name), {}, ""};
    for (std::size_t i = 0; i < parts_.constraints.size(); ++i) {
      const Held direction = held_by(parts_.constraints[i].measure);
      if ((kind.holds & direction).any()) continue;
      release.multipliers.push_back(static_cast<int>(i));
      release.what += (release.what.empty() ? "" : ", ") + in_words(direction);
    }
    all.push_back(std::move(release));
  }
  return all;
}

}  // namespace engrane::elements::joints
