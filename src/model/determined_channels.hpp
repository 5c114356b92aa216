// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

namespace engrane {

/// An element with channels that are functions of time and of at most two other channels of its own. Between the instants at
/// which results are computed, such channels are evaluated rather than interpolated: they may have corners there, as the gap to
/// the nearer of two stops or the larger of two tensions, or change faster than the steps resolve, as a force given as a function
/// of time.
class DeterminedChannels {
 public:
  struct Determined {
    int channel = 0;
    int first = -1, second = -1;  ///< channels that it depends on, which are smooth; −1: time alone
  };
  using Sources = std::array<double, 2>;
  virtual std::vector<Determined> determined() const = 0;
  /// Value of one of these channels. `sources`: values of the channels that it depends on.
  virtual double determine(int channel, double time, const Sources& sources) const = 0;

 protected:
  ~DeterminedChannels() = default;
};

}  // namespace engrane
