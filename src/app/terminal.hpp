// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace engrane::app {

/// Makes text safe for a terminal, so that titles, references and formulas of a deck cannot send control sequences. Control
/// characters other than line ends become `?`.
std::string terminal_text(std::string_view text);

}  // namespace engrane::app
