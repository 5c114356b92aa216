// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace engrane::output {

/// A number as listings show it: at most `digits` significant digits, exponents only where they save space, `-` when it is
/// not a number.
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

  /// One line; as many cells as columns.
  void row(std::vector<std::string> cells);
  /// A line that separates rows.
  void rule();
  bool empty() const { return rows_.empty(); }

  /// The whole table, each line indented by two blanks. Ends with a newline.
  std::string text() const;

  /// Heading and rows apart, for tables that grow while they are printed: the widths are those given, or of the titles.
  std::string heading(const std::vector<std::size_t>& widths = {}) const;
  std::string line(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths = {}) const;

 private:
  std::vector<std::size_t> natural_widths(const std::vector<std::size_t>& least) const;
  std::string line_of(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths) const;
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;  ///< an empty row is a rule
};

}  // namespace engrane::output
