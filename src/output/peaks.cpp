// SPDX-License-Identifier: BSD-3-Clause
#include "output/peaks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "output/extreme.hpp"
#include "output/table.hpp"

namespace engrane::output {

namespace {

/// Between samples that are below this fraction of the peak so far there is none: a cubic that rises farther is no good one.
constexpr double most_beyond = 0.7;

}  // namespace

Peaks::Peaks(const std::vector<HistoryTable>& tables) {
  for (const HistoryTable& table : tables)
    for (std::size_t owner = 0; owner < table.owners(); ++owner)
      for (const Channel& channel : table.channels) channels_.push_back(&channel);
  peaks_.resize(channels_.size());
}

void Peaks::observe(double time, std::span<const double> values, bool ends) {
  for (std::size_t i = 0; i < peaks_.size(); ++i)
    if (!started_ || std::abs(values[i]) > std::abs(peaks_[i].value)) peaks_[i] = {values[i], time};
  started_ = true;
  const auto look = [this](std::size_t i) { look_between(i); };
  if (std::exchange(interrupted_, false)) stretch_ = {};
  stretch_.add(time, {values.begin(), values.end()}, look);
  if (ends) stretch_.end(look);
}

void Peaks::interrupt() {
  stretch_.end([this](std::size_t i) { look_between(i); });
  interrupted_ = true;
}

void Peaks::look_between(std::size_t i) {
  const auto& points = stretch_.points();
  if (points.size() < 4) return;
  std::array<Sample, 4> around{};
  for (std::size_t k = 0; k < around.size(); ++k) around[k].time = points[k].time;
  for (std::size_t c = 0; c < peaks_.size(); ++c) {
    const Channel& channel = *channels_[c];
    if (channel.course != Channel::Course::smooth && channel.course != Channel::Course::size) continue;
    for (std::size_t k = 0; k < around.size(); ++k) around[k].value = points[k].value[c];
    const double a = around[i].value, b = around[i + 1].value, sign = a + b < 0 ? -1 : 1, level = std::max(sign * a, sign * b);
    // most channels have none there
    const bool rises = i == 0 || sign * (a - around[i - 1].value) > 0, falls = i == 2 || sign * (b - around[i + 2].value) > 0;
    if (!rises || !falls || !(level > most_beyond * std::abs(peaks_[c].value))) continue;
    const Extreme found = extreme_between(around, i, around[i].time, around[i + 1].time, sign, level);
    const double value = std::clamp(sign * (level + found.beyond), channel.low, channel.high);
    if (found.beyond > 0 && std::abs(value) > std::abs(peaks_[c].value)) peaks_[c] = {value, found.time};
  }
}

void Peaks::save(Snapshot& snapshot) const {
  std::vector<double> values, times, recent{interrupted_ ? 1.0 : 0.0, static_cast<double>(stretch_.taken())};
  for (const Peak& peak : peaks_) {
    values.push_back(peak.value);
    times.push_back(peak.time);
  }
  for (const auto& point : stretch_.points()) {
    recent.push_back(point.time);
    recent.insert(recent.end(), point.value.begin(), point.value.end());
  }
  snapshot.put("peaks/values", std::move(values));
  snapshot.put("peaks/times", std::move(times));
  snapshot.put("peaks/recent", std::move(recent));
}

bool Peaks::load(const Snapshot& snapshot) {
  if (!snapshot.has("peaks/values") || !snapshot.has("peaks/times")) return false;
  const std::vector<double>&values = snapshot.array("peaks/values"), &times = snapshot.array("peaks/times");
  if (values.size() != peaks_.size() || times.size() != peaks_.size()) return false;
  for (std::size_t i = 0; i < peaks_.size(); ++i) peaks_[i] = {values[i], times[i]};
  started_ = true;
  stretch_ = {};
  if (!snapshot.has("peaks/recent")) return true;  // files of earlier versions lack it
  const std::vector<double>& recent = snapshot.array("peaks/recent");
  std::vector<Stretch<std::vector<double>>::Point> points;
  for (auto at = recent.begin() + 2; at < recent.end(); at += static_cast<std::ptrdiff_t>(peaks_.size() + 1))
    points.push_back({*at, {at + 1, at + 1 + static_cast<std::ptrdiff_t>(peaks_.size())}});
  interrupted_ = recent[0] != 0;
  stretch_.restore(std::move(points), static_cast<std::size_t>(recent[1]));
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
