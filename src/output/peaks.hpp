// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/snapshot.hpp"
#include "output/results_layout.hpp"
#include "output/stretch.hpp"

namespace engrane::output {

/// Largest magnitude of each channel so far, and its time. Between samples the channels are cubics, as in a Window.
class Peaks {
 public:
  /// The value with its sign.
  struct Peak {
    double value = 0;
    double time = 0;
  };
  /// Of the channels of these tables, which must outlive this object.
  explicit Peaks(const std::vector<HistoryTable>& tables);

  /// `ends`: at an event or a corner, across which nothing is interpolated.
  void observe(double time, std::span<const double> values, bool ends);
  /// There is one between the last sample and the next.
  void interrupt();
  const Peak& of(std::size_t channel) const { return peaks_[channel]; }

  void save(Snapshot& snapshot) const;
  /// Returns false and changes nothing if the snapshot does not match the number of channels.
  bool load(const Snapshot& snapshot);

 private:
  /// Looks for peaks in the interval behind sample `i` of the stretch.
  void look_between(std::size_t i);

  std::vector<const Channel*> channels_;
  std::vector<Peak> peaks_;
  Stretch<std::vector<double>> stretch_;
  bool started_ = false;
  bool interrupted_ = false;
};

/// Table of peaks for the listing: channels of all elements and of the run. Channels that were always zero are left out; rows
/// after the first `most` are only counted.
std::string listing_peaks(const std::vector<HistoryTable>& tables, const Peaks& peaks, const UnitSystem& units, std::size_t most);

}  // namespace engrane::output
