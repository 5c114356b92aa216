// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace engrane::output {

/// Formats a number for listings: at most `digits` significant digits, an exponent only where it is shorter, `-` for NaN.
std::string shown(double value, int digits = 6);

/// A table of text in aligned columns under a ruled heading.
///
///     node    force x [N]   force y [N]
///     ---------------------------------
///        1      1064.18      -387.329
class Table {
 public:
  enum class Align : unsigned char { left, right };
  struct Column {
    std::string title;
    Align align = Align::right;
  };
  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}

  /// Adds a row, with as many cells as columns.
  void row(std::vector<std::string> cells);
  /// Adds a rule between rows.
  void rule();
  bool empty() const { return rows_.empty(); }

  /// The whole table, each line indented by two spaces. Ends with a newline.
  std::string text() const;

  /// Heading and rows separately, for tables that are printed as they grow. Columns are at least as wide as `widths`, their
  /// titles and all rows added.
  std::string heading(const std::vector<std::size_t>& widths = {}) const;
  std::string line(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths = {}) const;

 private:
  std::vector<std::size_t> natural_widths(const std::vector<std::size_t>& least) const;
  std::string line_of(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths) const;
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;  ///< an empty row is a rule
};

}  // namespace engrane::output
