// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace engrane {

/// An element with channels that are functions of time and of at most one other channel of its own. Between the instants at
/// which results are computed, such channels are evaluated rather than interpolated: they may have corners there, as the gap to
/// the nearer of two stops, or change faster than the steps resolve, as a force given as a function of time.
class DeterminedChannels {
 public:
  struct Determined {
    int channel = 0;
    int source = -1;  ///< channel that it depends on, which is smooth; −1: time alone
  };
  virtual std::vector<Determined> determined() const = 0;
  /// Value of one of these channels. `source`: value of its source channel, if it has one.
  virtual double determine(int channel, double time, double source) const = 0;

 protected:
  ~DeterminedChannels() = default;
};

}  // namespace engrane
