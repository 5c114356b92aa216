// SPDX-License-Identifier: BSD-3-Clause
// Limits of one coordinate, shared by STOP and the stops of joints.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "elements/common/along_motion.hpp"
#include "elements/common/building.hpp"
#include "elements/common/stop_law.hpp"

namespace engrane::elements {

/// One end of a coordinate's range. `sign` is 1 for the lower end, which pushes the coordinate up, and −1 for the upper.
struct StopLimit {
  double place = 0, sign = 1;
  template <class T>
  T pressed(const T& coordinate) const {
    return sign * (place - coordinate);
  }
};

/// Card data of a range.
struct StopRangeData {
  std::optional<double> lower, upper;
  double stiffness = 0, exponent = 1;
  deck::Tagged damping;  ///< HUNT d, REST e v or LINEAR c
};

/// The keywords of these data, for messages.
struct StopWords {
  std::string lower = "MIN", upper = "MAX", damping = "DAMP";
};

/// A range of a coordinate, with contacts at its ends.
struct StopRange {
  std::vector<StopLimit> limits;
  StopLaw law;

  bool given() const { return !limits.empty(); }
  /// Whether gap() has a corner: halfway between two limits.
  bool two_sided() const { return limits.size() > 1; }

  /// Generalised force of the contacts on the coordinate. `contact_homotopy`: see StopLaw::force.
  template <class T>
  T push(const T& value, const T& rate, double contact_homotopy) const {
    T sum(0);
    for (const StopLimit& limit : limits)
      sum += limit.sign * law.force(T(limit.pressed(value)), T(-limit.sign * rate), contact_homotopy);
    return sum;
  }

  /// Distance to the nearer limit; negative in contact.
  double gap(double value) const;
  /// Stored energy and dissipated power of the contacts.
  double stored(double value) const;
  double lost(double value, double rate) const;

  /// Appends the switch names, each prefixed by `before`.
  void name_switches(std::vector<SwitchNames>& names, const std::string& before) const;
  /// Writes the switches of a coordinate with its first and second time derivatives; returns their number.
  std::size_t switches(double value, double rate, double second, std::span<Switch> values) const;

  /// Builds the range from a card whose limits are in units of `unit`; it is empty if none is given. Returns nothing, with an
  /// error, if limits or damping are invalid.
  static std::optional<StopRange> of(const BuildContext& context, const StopRangeData& data, const StopWords& words, double unit);
};

/// Reads the damping of a contact given by `keyword`; returns false, with an error, if it is invalid.
bool set_stop_damping(const deck::Tagged& damping, const BuildContext& context, const std::string& keyword, StopLaw& law);
/// Adds the options of the damping.
void add_stop_damping(deck::FieldBuilder field);

}  // namespace engrane::elements
