// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/snapshot.hpp"
#include "output/results_layout.hpp"

namespace engrane::output {

/// The largest size that each channel has had, and when.
class Peaks {
 public:
  /// The value itself, with its sign.
  struct Peak {
    double value = 0;
    double time = 0;
  };
  explicit Peaks(std::size_t channels) : peaks_(channels) {}

  void observe(double time, std::span<const double> values);
  const Peak& of(std::size_t channel) const { return peaks_[channel]; }

  void save(Snapshot& snapshot) const;
  /// Peaks of a run with other channels are left: false.
  bool load(const Snapshot& snapshot);

 private:
  std::vector<Peak> peaks_;
  bool started_ = false;
};

/// The table of the listing: of all elements and of the run, channel by channel; what was always zero is left out, and of a large
/// model what comes behind the first `most` rows.
std::string listing_peaks(const std::vector<HistoryTable>& tables, const Peaks& peaks, const UnitSystem& units, std::size_t most);

}  // namespace engrane::output
