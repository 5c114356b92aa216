// SPDX-License-Identifier: BSD-3-Clause
// Limits of one coordinate: what STOP and the stops of joints have in common.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "elements/common/along_motion.hpp"
#include "elements/common/building.hpp"
#include "elements/common/stop_law.hpp"

namespace engrane::elements {

/// One end of a coordinate's range. `sign` 1: the lower, which pushes the coordinate up.
struct StopLimit {
  double place = 0, sign = 1;
  template <class T>
  T pressed(const T& coordinate) const {
    return sign * (place - coordinate);
  }
};

/// What a card says of a range.
struct StopRangeData {
  std::optional<double> lower, upper;
  double stiffness = 0, exponent = 1;
  deck::Tagged damping;  ///< HUNT d, REST e v or LINEAR c
};

/// The keywords it says it by, for messages.
struct StopWords {
  std::string lower = "MIN", upper = "MAX", damping = "DAMP";
};

/// A range of a coordinate, with the contact at its ends.
struct StopRange {
  std::vector<StopLimit> limits;
  StopLaw law;

  bool given() const { return !limits.empty(); }

  /// Generalised force of the contacts on the coordinate. `contact_homotopy`: as StopLaw::force.
  template <class T>
  T push(const T& value, const T& rate, double contact_homotopy) const {
    T sum(0);
    for (const StopLimit& limit : limits)
      sum += limit.sign * law.force(T(limit.pressed(value)), T(-limit.sign * rate), contact_homotopy);
    return sum;
  }

  /// Way to the nearer limit; negative when pressed.
  double gap(double value) const;
  /// Energy stored and power lost in the contacts.
  double stored(double value) const;
  double lost(double value, double rate) const;

  /// Adds the switches' names, each behind `before`.
  void name_switches(std::vector<SwitchNames>& names, const std::string& before) const;
  /// Writes the switches of a coordinate with its first and second time derivative; returns how many.
  std::size_t switches(double value, double rate, double second, std::span<Switch> values) const;

  /// From a card whose limits are given in units of `unit`; without limits when it has none. An error, and nothing, when they or
  /// the damping make no sense.
  static std::optional<StopRange> of(const BuildContext& context, const StopRangeData& data, const StopWords& words, double unit);
};

/// The damping of a contact as a card gives it by `keyword`; false, with an error, when it is none.
bool set_stop_damping(const deck::Tagged& damping, const BuildContext& context, const std::string& keyword, StopLaw& law);
/// Its options.
void add_stop_damping(deck::FieldBuilder field);

}  // namespace engrane::elements
