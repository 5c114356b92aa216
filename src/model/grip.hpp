// SPDX-License-Identifier: BSD-3-Clause
// Dry friction with a sticking phase (docs/theory.md, "Friction at rest").
#pragma once

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "math/dual.hpp"
#include "model/element.hpp"

namespace engrane {

/// State of a dry friction with a sticking phase, as stored in the history of its element. Sliding velocities are coordinate
/// rates times their levers; entries beyond GripShape::size are zero.
struct GripState {
  enum Mode {
    free = 0,     ///< no analysis tracks its state, and friction depends on the sliding velocity only
    sliding = 1,  ///< in a known direction, with friction opposing it
    holding = 2   ///< sticking at `held`
  };
  Mode mode = free;
  Vec3 held = Vec3::Zero();       ///< coordinates of the sticking position
  Vec3 direction = Vec3::Zero();  ///< unit vector of the sliding direction
  double speed = 0;               ///< sliding speed at the start of the step; several coordinates only
  double rest = 0;                ///< speeds up to this one are rounding, and have no direction

  /// With several coordinates, sliding ends when the speed falls below this fraction of the speed at the start of the step.
  static constexpr double halt = 0.1;
  /// The friction limit may be exceeded by this fraction, to allow for rounding.
  static constexpr double slack = 1e-9;

  static GripState slides_towards(const Vec3& direction, const Vec3& held) { return {sliding, held, direction.normalized()}; }
  static GripState holds_at(const Vec3& held) { return {holding, held}; }

  /// Number of history values.
  static int history(const GripShape& shape) { return 3 + 2 * shape.size; }
  /// State of a grip, from the history of the whole element.
  static GripState of(const Layout& layout, std::span<const double> history, std::size_t grip);
  void write(const Layout& layout, std::span<double> history, std::size_t grip) const;

  /// One coordinate: sign of the sliding direction, 1 or −1; 0 unless sliding in a known direction.
  int sense() const { return mode != sliding ? 0 : direction[0] < 0 ? -1 : 1; }
  /// Several coordinates: unit vector of the sliding velocity u. Near zero speed this direction would turn abruptly. The
  /// component of u along the direction at the start of the step is therefore bounded smoothly from below by half the speed at
  /// which sliding ends.
  template <class T>
  Vec3T<T> towards(const Vec3T<T>& u, int size) const {
    using std::sqrt;
    Vec3T<T> way{T(direction[0]), T(direction[1]), T(direction[2])};
    if (size == 1 || speed == 0) return way;
    const double least = halt * speed;
    const T along = dot(u, way), x = along * (1 / least);
    if (value_of(x) >= 1) return u * T(1 / sqrt(dot(u, u)));
    // value, slope and curvature are continuous at x = 1
    const T kept = value_of(x) <= 0 ? T(0.5) : T(0.5 + x * x * x * (1 - 0.5 * x));
    way = u + way * T(least * kept - along);
    return way * (T(1) / sqrt(dot(way, way)));
  }
};

/// Updates the direction of a sliding grip of several coordinates after a step that ends with sliding velocity u. Unchanged if
/// the grip stops or is about to.
void follow(GripState& grip, const Vec3& u);

/// Adds a grip to a layout whose other multipliers and switches are complete: its multipliers, with names and dimensions from
/// `named`, two switches whose names begin with `where`, and its history.
void add_grip(Layout& layout, const std::vector<Named>& named, const GripShape& shape, const std::string& where = "");
inline void add_grip(Layout& layout, const Named& named) { add_grip(layout, {named}, {}); }

/// Initial grip states of an element when no analysis tracks them, from Element::start(): most are free, that of a belt holds.
std::vector<GripState> unfollowed_grips(const Element& element);

/// Current state of a grip.
struct Grip {
  GripState state;
  GripShape shape;
  Vec3 place = Vec3::Zero();                        ///< coordinates minus GripState::held
  Vec3 speed = Vec3::Zero(), acceleration = speed;  ///< of sliding
  Vec3 force = Vec3::Zero();                        ///< static friction force, conjugate to the sliding velocities
  double limit = 0;                                 ///< limit of static friction
  /// Margin to the friction limit; the grip slips when it is negative. The switch function of the event and the decision taken
  /// at it must both use this number.
  double spare() const { return (1 + GripState::slack) * limit - force.norm(); }
  double speeds = 0, accelerations = 0;  ///< magnitudes of the terms they are differences of, for judging rounding errors
};
/// Evaluates all grips of an element, in the order of its multipliers.
void find_grips(const Element& element, const State& state, std::span<Grip> grips);

/// Evaluates the switches of an element's grips, two each: the speed in the sliding direction, and the margin of static
/// friction.
void grip_switches(const Element& element, const State& state, std::span<Switch> values);

}  // namespace engrane
