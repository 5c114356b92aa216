// SPDX-License-Identifier: BSD-3-Clause
// Output channels common to all pairs of toothed bodies: forces on both, power, friction, and the state of the teeth.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "elements/gears/tooth_contact.hpp"

namespace engrane::elements::gears {

/// Writes channel values one after another.
class ChannelWriter {
 public:
  explicit ChannelWriter(std::span<double> values) : values_(values) {}
  void put(double value) { values_[next_++] = value; }
  void put(const Vec3& v) {
    for (int k = 0; k < 3; ++k) put(v[k]);
  }

 private:
  std::span<double> values_;
  std::size_t next_ = 0;
};

/// Force and moment of the teeth on both bodies, global components, and the contact point. `bodies` are their names in the
/// help.
void add_force_channels(std::vector<Channel>& list, const std::array<const char*, 2>& bodies);
void put_force_channels(ChannelWriter& out, const ContactReport& report, const Vec3& contact);

/// Power, sliding, friction and the state of the teeth, as far as the contact options provide them.
void add_contact_channels(std::vector<Channel>& list, const ToothContact& contact);
/// Their values. `power` is the power transferred from the teeth to A and to B, in the pair's frame.
void put_contact_channels(ChannelWriter& out, const ToothContact& contact, const ContactReport& report,
                          const std::array<double, 2>& power, std::span<const double> scalars);

}  // namespace engrane::elements::gears
