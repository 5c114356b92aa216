// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

namespace engrane {

/// An element with channels that are functions of time and of other channels of its own. Between the instants at which results
/// are computed, such channels are evaluated rather than interpolated: they may have corners there, as the gap to the nearer of
/// two stops or the largest load on a ball, or change faster than the steps resolve, as a force given as a function of time.
class DeterminedChannels {
 public:
  struct Determined {
    int channel = 0;
    std::vector<int> sources = {};  ///< channels that it depends on, which are smooth; none: time alone
  };
  virtual std::vector<Determined> determined() const = 0;
  /// Value of one of these channels. `sources`: values of the channels that it depends on, in their order.
  virtual double determine(int channel, double time, std::span<const double> sources) const = 0;

 protected:
  ~DeterminedChannels() = default;
};

}  // namespace engrane
