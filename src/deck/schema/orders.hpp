// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>

namespace engrane::deck {

/// An order to the reader of a deck, which is no card: it stands on a line of its own and makes no record.
struct Order {
  std::string_view word;     ///< in capitals, as it is written: with its dot, if it has one
  std::string_view form;     ///< with placeholders, for the manual
  std::string_view meaning;  ///< Markdown
};

std::span<const Order> orders();
/// The order of this word, in letters of either case, with or without a dot; nullptr if there is none.
const Order* find_order(std::string_view word);

}  // namespace engrane::deck
