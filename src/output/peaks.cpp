// SPDX-License-Identifier: BSD-3-Clause
#include "output/peaks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "output/table.hpp"

namespace engrane::output {

void Peaks::observe(double time, std::span<const double> values) {
  for (std::size_t i = 0; i < peaks_.size(); ++i)
    if (!started_ || std::abs(values[i]) > std::abs(peaks_[i].value)) peaks_[i] = {values[i], time};
  started_ = true;
}

void Peaks::save(Snapshot& snapshot) const {
  std::vector<double> values, times;
  for (const Peak& peak : peaks_) {
    values.push_back(peak.value);
    times.push_back(peak.time);
  }
  snapshot.put("peaks/values", std::move(values));
  snapshot.put("peaks/times", std::move(times));
}

bool Peaks::load(const Snapshot& snapshot) {
  if (!snapshot.has("peaks/values") || !snapshot.has("peaks/times")) return false;
  const std::vector<double>&values = snapshot.array("peaks/values"), &times = snapshot.array("peaks/times");
  if (values.size() != peaks_.size() || times.size() != peaks_.size()) return false;
  for (std::size_t i = 0; i < peaks_.size(); ++i) peaks_[i] = {values[i], times[i]};
  started_ = true;
  return true;
}

std::string listing_peaks(const std::vector<HistoryTable>& tables, const Peaks& peaks, const UnitSystem& units,
                          std::size_t most) {
  using Align = Table::Align;
  Table table({{"", Align::left}, {"channel", Align::left}, {"peak"}, {"unit", Align::left}, {"at time"}});
  std::size_t channel = 0, rows = 0;
  for (const HistoryTable& history : tables)
    for (std::size_t i = 0; i < history.owners(); ++i) {
      const bool node = history.type.empty() && !history.ids.empty();
      std::string owner = history.ids.empty() ? history.path : fmt::format("{} {}", history.type, history.ids[i]);
      for (const Named& named : history.channels) {
        const Peaks::Peak& peak = peaks.of(channel++);
        if (node || peak.value == 0 || std::isnan(peak.value) || rows++ >= most) continue;
        table.row({std::exchange(owner, ""), named.name, shown(peak.value), units.label(named.dimension), shown(peak.time, 8)});
      }
    }
  if (rows == 0) return "";
  return table.text() + (rows > most ? fmt::format("  and {} more, which `engrane plot` shows\n", rows - most) : "");
}

}  // namespace engrane::output
