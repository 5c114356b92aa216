// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace engrane {

/// Physical dimension of a number: exponents of length, mass, time and angle.
struct Dimension {
  signed char length = 0;
  signed char mass = 0;
  signed char time = 0;
  signed char angle = 0;

  friend bool operator==(const Dimension&, const Dimension&) = default;
};

/// Named dimensions used by decks, elements and results.
namespace dimension {
inline constexpr Dimension none{};
inline constexpr Dimension length{1, 0, 0, 0};
inline constexpr Dimension angle{0, 0, 0, 1};  ///< radians internally; degrees in the deck
inline constexpr Dimension mass{0, 1, 0, 0};
inline constexpr Dimension time{0, 0, 1, 0};
inline constexpr Dimension velocity{1, 0, -1, 0};
inline constexpr Dimension acceleration{1, 0, -2, 0};
inline constexpr Dimension angular_velocity{0, 0, -1, 1};
inline constexpr Dimension angular_acceleration{0, 0, -2, 1};
inline constexpr Dimension force{1, 1, -2, 0};
inline constexpr Dimension moment{2, 1, -2, 0};
inline constexpr Dimension energy{2, 1, -2, 0};
inline constexpr Dimension power{2, 1, -3, 0};
inline constexpr Dimension inertia{2, 1, 0, 0};
inline constexpr Dimension stiffness{0, 1, -2, 0};  ///< force per length
inline constexpr Dimension damping{0, 1, -1, 0};    ///< force per velocity
inline constexpr Dimension pressure{-1, 1, -2, 0};
inline constexpr Dimension torsional_stiffness{2, 1, -2, -1};  ///< moment per radian
inline constexpr Dimension torsional_damping{2, 1, -1, -1};    ///< moment per radian per second
}  // namespace dimension

/// Factors from the deck's units to SI (`.UNIT`). Used for labels only: numbers are never rescaled.
struct UnitSystem {
  bool given = false;  ///< without `.UNIT` the deck's units are consistent but unnamed
  double length = 1;
  double mass = 1;
  double time = 1;

  /// Factor that converts a number of this dimension to SI.
  double to_si(Dimension d) const;
  /// Name of the unit: "N", "lbf", "mm/s", "rad"; if no units were given, the name of the dimension in brackets, "[force]".
  std::string label(Dimension d) const;
};

}  // namespace engrane
