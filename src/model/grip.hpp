// SPDX-License-Identifier: BSD-3-Clause
// Dry friction that can rest (docs/theory.md, "Friction at rest").
#pragma once

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "math/dual.hpp"
#include "model/element.hpp"

namespace engrane {

/// What a friction that can rest does, as it stands in the history of its element. Speeds of sliding are the rates of its
/// coordinates times their levers; entries beyond GripShape::size are zero.
struct GripState {
  enum Mode {
    free = 0,     ///< no analysis follows it, and friction depends on the speed of sliding alone
    sliding = 1,  ///< in a known direction, against which friction acts
    holding = 2   ///< at rest at `held`
  };
  Mode mode = free;
  Vec3 held = Vec3::Zero();       ///< coordinates of the place of rest
  Vec3 direction = Vec3::Zero();  ///< of sliding, a unit vector
  double speed = 0;               ///< of sliding when the step began; only of several coordinates

  /// Sliding along several coordinates ends where less than this part is left of the speed with which a step began.
  static constexpr double halt = 0.1;
  /// A force beyond what holds by this part of it is rounding.
  static constexpr double slack = 1e-9;

  static GripState slides_towards(const Vec3& direction, const Vec3& held = Vec3::Zero()) {
    return {sliding, held, direction.normalized(), 0};
  }
  static GripState holds_at(const Vec3& held) { return {holding, held, Vec3::Zero(), 0}; }

  /// Numbers in the history.
  static int history(const GripShape& shape) { return 2 + 2 * shape.size; }
  /// That of a grip, from the history of the whole element.
  static GripState of(const Layout& layout, std::span<const double> history, std::size_t grip);
  void write(const Layout& layout, std::span<double> history, std::size_t grip) const;

  /// Of one coordinate: 1, −1, or 0 where it does not slide in a known direction.
  int sense() const { return mode != sliding ? 0 : direction[0] < 0 ? -1 : 1; }
  /// Of several coordinates: the unit vector of sliding with u. Near the speed zero, where that would turn at once, the part of u
  /// along the direction in which the step began counts as no less than half of what ends sliding.
  template <class T>
  Vec3T<T> towards(const Vec3T<T>& u, int size) const {
    using std::sqrt;
    Vec3T<T> way{T(direction[0]), T(direction[1]), T(direction[2])};
    if (size == 1 || speed == 0) return way;
    const double least = halt * speed;
    const T along = dot(u, way), x = along * (1 / least);
    if (value_of(x) >= 1) return u * T(1 / sqrt(dot(u, u)));
    // at x = 1 value, slope and curvature are those of x
    const T kept = value_of(x) <= 0 ? T(0.5) : T(0.5 + x * x * x * (1 - 0.5 * x));
    way = u + way * T(least * kept - along);
    return way * (T(1) / sqrt(dot(way, way)));
  }
};

/// What a step that ends with the speed of sliding u makes of a sliding grip of several coordinates: its direction, unless it
/// stops or is about to.
void follow(GripState& grip, const Vec3& u);

/// Adds a grip to a layout whose other multipliers and switches are complete: its multipliers, named and measured as `named`
/// says, two switches whose names begin with `where`, and its history.
void add_grip(Layout& layout, const std::vector<Named>& named, const GripShape& shape, const std::string& where = "");
inline void add_grip(Layout& layout, const Named& named) { add_grip(layout, {named}, {}); }

/// What the grips of an element do where no analysis follows them, from Element::start(): most are free, that of a belt holds.
std::vector<GripState> unfollowed_grips(const Element& element);

/// What a grip does now.
struct Grip {
  GripState state;
  GripShape shape;
  Vec3 place = Vec3::Zero();                        ///< coordinates less GripState::held
  Vec3 speed = Vec3::Zero(), acceleration = speed;  ///< of sliding
  Vec3 force = Vec3::Zero();                        ///< of friction at rest, on the speeds of sliding
  double limit = 0;                                 ///< the largest that holds
  /// By what it could be larger; below zero the grip gives way. The switch of the event and what is decided at it are this
  /// number.
  double spare() const { return (1 + GripState::slack) * limit - force.norm(); }
  double speeds = 0, accelerations = 0;  ///< sums of what these are differences of: what is rounding
};
/// Of each grip of an element, in the order of its multipliers.
void find_grips(const Element& element, const State& state, std::span<Grip> grips);

/// Writes the switches of an element's grips, two each: the speed in the direction of sliding, and what friction at rest could
/// hold beyond what it does.
void grip_switches(const Element& element, const State& state, std::span<Switch> values);

}  // namespace engrane
