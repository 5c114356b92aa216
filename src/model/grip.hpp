// SPDX-License-Identifier: BSD-3-Clause
// Dry friction that can rest (docs/theory.md, "Friction at rest").
#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/element.hpp"

namespace engrane {

/// What a friction that can rest does, as it stands in the history of its element.
struct GripState {
  enum Mode { free = 0, forward = 1, backward = -1, holding = 2 };
  static constexpr int history = 2;  ///< numbers in the history
  /// free: no analysis follows it, and friction depends on the speed of sliding alone; forward, backward: it slides in the
  /// direction in which its coordinate grows or falls, and friction is against that direction; holding: at rest at `held`.
  Mode mode = free;
  double held = 0;

  /// That of grip i of `grips`, from the history of the whole element.
  static GripState of(std::span<const double> history, int grips, int i) {
    const std::size_t at = place(history.size(), grips, i);
    return {static_cast<Mode>(static_cast<int>(history[at])), history[at + 1]};
  }
  void write(std::span<double> all, int grips, int i) const {
    const std::size_t at = place(all.size(), grips, i);
    all[at] = mode;
    all[at + 1] = held;
  }
  bool slides() const { return mode == forward || mode == backward; }
  /// 1, −1, or 0 where it does not slide in a known direction.
  int direction() const { return slides() ? mode : 0; }

 private:
  static std::size_t place(std::size_t size, int grips, int i) { return size - static_cast<std::size_t>(history * (grips - i)); }
};

/// Adds a grip to a layout whose other multipliers and switches are complete: its multiplier, named and measured as `named`
/// says, two switches whose names begin with `where`, and its history.
void add_grip(Layout& layout, Named named, const std::string& where = "");

/// What the grips of an element do where no analysis follows them, from Element::start(): most are free, that of a belt holds.
std::vector<GripState> unfollowed_grips(const Element& element);

/// What a grip does now.
struct Grip {
  GripState state;
  double place = 0, speed = 0, acceleration = 0;  ///< of sliding: its coordinate less GripState::held, and its time derivatives
  double force = 0, limit = 0;                    ///< of friction at rest, and the largest that holds
  double speeds = 0, accelerations = 0;           ///< sums of what these are differences of: what is rounding
};
/// Of each grip of an element, in the order of its multipliers.
void find_grips(const Element& element, const State& state, std::span<Grip> grips);

/// Writes the switches of an element's grips, two each: the speed in the direction of sliding, and what friction at rest could
/// hold beyond what it does.
void grip_switches(const Element& element, const State& state, std::span<Switch> values);

}  // namespace engrane
