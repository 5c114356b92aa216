// SPDX-License-Identifier: BSD-3-Clause
#include "app/terminal.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace engrane::app {

std::string terminal_text(std::string_view text) {
  std::string result;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    result += printable(text.substr(start, end - start));
    if (end < text.size()) result += '\n';
    start = end + 1;
  }
  return result;
}

}  // namespace engrane::app
