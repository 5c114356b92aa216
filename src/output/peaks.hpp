// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/snapshot.hpp"
#include "output/results_layout.hpp"

namespace engrane::output {

/// Largest magnitude of each channel so far, and its time.
class Peaks {
 public:
  /// The value with its sign.
  struct Peak {
    double value = 0;
    double time = 0;
  };
  explicit Peaks(std::size_t channels) : peaks_(channels) {}

  void observe(double time, std::span<const double> values);
  const Peak& of(std::size_t channel) const { return peaks_[channel]; }

  void save(Snapshot& snapshot) const;
  /// Returns false and changes nothing if the snapshot does not match the number of channels.
  bool load(const Snapshot& snapshot);

 private:
  std::vector<Peak> peaks_;
  bool started_ = false;
};

/// Table of peaks for the listing: channels of all elements and of the run. Channels that were always zero are left out; rows
/// after the first `most` are only counted.
std::string listing_peaks(const std::vector<HistoryTable>& tables, const Peaks& peaks, const UnitSystem& units, std::size_t most);

}  // namespace engrane::output
