// SPDX-License-Identifier: BSD-3-Clause
#include "output/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "base/text.hpp"

namespace engrane::output {

namespace {

constexpr std::size_t gap = 2;

std::string padded(const std::string& text, std::size_t width, Table::Align align) {
  const std::size_t count = character_count(text);  // counting bytes would misalign °, ψ and the like
  const std::string blanks(width > count ? width - count : 0, ' ');
  return align == Table::Align::right ? blanks + text : text + blanks;
}

}  // namespace

std::string shown(double value, int digits) {
  if (std::isnan(value)) return "-";
  if (value == 0) return "0";
  return fmt::format("{:.{}g}", value, digits);
}

void Table::row(std::vector<std::string> cells) {
  assert(cells.size() == columns_.size());
  rows_.push_back(std::move(cells));
}

void Table::rule() { rows_.emplace_back(); }

std::vector<std::size_t> Table::natural_widths(const std::vector<std::size_t>& least) const {
  std::vector<std::size_t> widths(columns_.size());
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    widths[c] = std::max(character_count(columns_[c].title), c < least.size() ? least[c] : 0);
    for (const auto& row : rows_)
      if (!row.empty()) widths[c] = std::max(widths[c], character_count(row[c]));
  }
  return widths;
}

std::string Table::line(const std::vector<std::string>& cells, const std::vector<std::size_t>& least) const {
  return line_of(cells, natural_widths(least));
}

std::string Table::line_of(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths) const {
  std::string out;
  for (std::size_t c = 0; c < columns_.size(); ++c) out += std::string(gap, ' ') + padded(cells[c], widths[c], columns_[c].align);
  out.erase(out.find_last_not_of(' ') + 1);
  return out + "\n";
}

std::string Table::heading(const std::vector<std::size_t>& least) const {
  const std::vector<std::size_t> widths = natural_widths(least);
  std::vector<std::string> titles;
  for (const Column& column : columns_) titles.push_back(column.title);
  const std::size_t width = std::accumulate(widths.begin(), widths.end(), gap * (widths.size() - 1));
  return line(titles, least) + std::string(gap, ' ') + std::string(width, '-') + "\n";
}

std::string Table::text() const {
  const std::vector<std::size_t> widths = natural_widths({});
  std::string out = heading(widths);
  const std::string rule_line = out.substr(out.find('\n') + 1);
  for (const auto& row : rows_) out += row.empty() ? rule_line : line_of(row, widths);
  return out;
}

}  // namespace engrane::output
